#!/usr/bin/env python3
"""Tests of the criteria: a mask that is wrong in a known way is seen to fail."""
import math
import unittest

import numpy as np

import criteria
import scenes

WIDTH, HEIGHT, TEXEL_PX = 200, 120, 2.0


def picture(edge_x):
    """Returns a mask whose shadow begins at a column, which may be between two."""
    xs = np.arange(WIDTH) + 0.5
    return np.tile((xs < edge_x).astype(np.float32), (HEIGHT, 1))


def places():
    ys, xs = np.mgrid[0:HEIGHT, 0:WIDTH] + 0.5
    return np.stack([xs, ys], -1) / TEXEL_PX


def compared(theirs, ours):
    return criteria.compare(theirs, ours, picture(100), np.ones((HEIGHT, WIDTH), bool), places())


class Criteria(unittest.TestCase):
    def test_equal_masks_pass(self):
        result = compared(picture(100), picture(100))
        self.assertTrue(all(result["passed"].values()), result)

    def test_interior_keeps_three_texels_and_two_pixels(self):
        inner = criteria.interior(picture(100), np.ones((HEIGHT, WIDTH), bool), places())
        left_out = np.nonzero(~inner[60])[0]
        # The edge has a pixel on each side, which the distance counts from.
        reach = 1 + criteria.INTERIOR_PIXELS + criteria.INTERIOR_TEXELS * TEXEL_PX
        self.assertGreaterEqual(len(left_out), 2 * reach)
        self.assertLessEqual(len(left_out), 2 * (reach + 1.5 * TEXEL_PX))

    def test_an_edge_off_by_one_texel_passes(self):
        self.assertTrue(all(compared(picture(102), picture(100))["passed"].values()))

    def test_an_edge_off_by_two_texels_fails(self):
        result = compared(picture(104), picture(100))
        self.assertFalse(result["passed"]["edges"], result)
        self.assertAlmostEqual(result["edge_max_texels"], 2, delta=0.6)

    def test_acne_on_one_per_cent_fails(self):
        mask = picture(100)
        mask[::10, ::10] = 0
        self.assertFalse(compared(mask, picture(100))["passed"]["equal"])

    def test_a_shade_of_difference_fails(self):
        self.assertFalse(compared(0.9 * picture(100), picture(100))["passed"]["equal"])

    def test_a_picture_of_edges_has_too_little_interior(self):
        stripes = np.tile((np.arange(WIDTH) // 8 % 2).astype(np.float32), (HEIGHT, 1))
        result = criteria.compare(stripes, stripes, stripes, np.ones((HEIGHT, WIDTH), bool), places())
        self.assertFalse(result["passed"]["interior"])

    def test_a_pixel_of_a_soft_kernel_is_dark_where_a_shade_is_missing(self):
        mask = np.ones((HEIGHT, WIDTH), np.float32)
        mask[0, :10], mask[1, :10] = 0.97, 0.985
        self.assertAlmostEqual(criteria.dark_share(mask), 10 / mask.size)

    def test_acne_begins_at_the_last_step_without(self):
        self.assertEqual(criteria.acne_begins({0: 0.2, 1: 0.01, 2: 0.0009, 3: 0}), 2)
        self.assertEqual(criteria.acne_begins({0: 0, 1: 0.01, 2: 0}), 2, "acne comes back below")
        self.assertIsNone(criteria.acne_begins({0: 0.2, 1: 0.2}))


class Planes(unittest.TestCase):
    def test_a_plane_is_tilted_against_the_light_along_axis_or_diagonal(self):
        for tilt in (20, 45, 70):
            for diagonal in (False, True):
                scene = scenes.tilted_plane(tilt, diagonal)
                normal = scene.objects[0].normals[0].astype(float)
                self.assertAlmostEqual(normal @ scene.to_light, math.cos(math.radians(tilt)), 5)
                in_map = scene.light_view_from_world[:3, :3] @ normal
                gradient = np.abs(in_map[:2] / in_map[2])
                expected = math.tan(math.radians(tilt)) * (np.ones(2) / math.sqrt(2) if diagonal else np.array([1, 0]))
                self.assertTrue(np.allclose(gradient, expected, atol=1e-4), (gradient, expected))

    def test_a_plane_fills_its_picture(self):
        for tilt in (20, 70):
            scene = scenes.tilted_plane(tilt, True)
            corners = np.hstack([scene.objects[0].positions, np.ones((4, 1))]) @ scene.camera_clip_from_world().T
            ndc = corners[:, :2] / corners[:, 3:]
            for i in range(4):
                a, b = ndc[i], ndc[(i + 1) % 4]
                for x in (-1, 1):
                    for y in (-1, 1):
                        side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
                        self.assertGreater(abs(side), 0)
                signs = {np.sign((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]))
                         for x in (-1, 1) for y in (-1, 1)}
                self.assertEqual(len(signs), 1)


if __name__ == "__main__":
    unittest.main()
