#!/usr/bin/env python3
"""Compares the shadow masks of real engines with the inspector's, under the engine's profile with converted numbers.

prove.py ENGINE... -o FOLDER writes FOLDER/results.json and pictures. Exit code 0: all criteria are met, 1: one is not,
77: a package is missing.
"""
import argparse
import concurrent.futures
import json
import math
import os
import subprocess
import sys
import time

import numpy as np

import criteria
import jobs
import pictures
import scenes
from engines import ENGINES
from inspector import Inspector, InspectorError, map_facts

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
LACKS = 77
TILTS_DEG = (20, 45, 70)
FILTER_TILT_DEG = 45
# Bias of the scenes, in texels, as in the worked example.
CONSTANT_TEXELS = 1.5
NORMAL_TEXELS = 1.0
# Least N·L of the triangle's plane: below, the interpolated normal may face away from the light.
MIN_N_DOT_L = 0.1
STEPS_AROUND = 3      # steps of the grid on both sides of the inspector's
STEPS_WIDE = 60       # the same where the engine begins elsewhere


class Lacking(Exception):
    """Package that an engine needs."""


def exported(inspector, folder, scene):
    """Returns the objects of a scene that the inspector exports."""
    path = os.path.join(folder, os.path.basename(scene).split(".")[0] + ".glb")
    if not os.path.exists(path):
        inspector.run("export", scene, "-o", path)
    return scenes.read_glb(path)


def proof_scenes(inspector, folder):
    """Returns the scenes whose masks are compared."""
    stage = scenes.ProofScene("stage", "stage", exported(inspector, folder, "stage"), (-2.3, 3.25, 9.1),
                              (0.12, 0.98, -0.6), 35, scenes.direction(140, 50), 2048)
    teapot = scenes.ProofScene("teapot", "teapot", exported(inspector, folder, "teapot"), (0.30, 0.52, 1.12),
                               (-0.03, 0.13, 0), 34, scenes.direction(58, 38), 1024)
    return [scenes.box_scene(), stage, teapot]


def run_engine(name, folders):
    """Has an engine draw jobs. Raises Lacking if a package is missing."""
    program = os.path.join(HERE, ENGINES[name].get("folder", name), "run.sh")
    done = subprocess.run([program, *folders], capture_output=True, text=True)
    if done.returncode == LACKS:
        raise Lacking((done.stderr.strip().splitlines() or ["lacks a package"])[-1].removeprefix("lacks "))
    if done.returncode != 0:
        raise InspectorError(f"{name}: {done.stderr.strip()[-4000:]}")


def read_facts(folder):
    with open(os.path.join(folder, "facts.json")) as file:
        return json.load(file)


def matrix_of(facts):
    """Returns the light's matrix with depth from -1 to 1, near plane first."""
    matrix = np.array(facts["clip_from_world"], float).reshape(4, 4).T
    if facts.get("depth_range", "-1..1") == "0..1":
        matrix[2] = 2 * matrix[2] - matrix[3]
    if facts.get("reversed_z", False):
        matrix[2] = -matrix[2]
    return matrix


class Reference:
    """Pictures of a scene that no engine's number changes: rays, N·L and the place of each pixel."""

    def __init__(self, inspector, scene, bundle):
        size = (scene.width, scene.height)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            mask = pool.submit(inspector.picture, bundle, size, "truth")
            n_dot_l = pool.submit(inspector.picture, bundle, size, "render", "--view", "n-dot-l")
            depth = pool.submit(inspector.picture, bundle, size, "render", "--view", "camera-depth",
                                "--set", "view.map=linear")
            # Metres along the view; the far plane is where no surface is.
            self.mask, self.n_dot_l, along = mask.result(), n_dot_l.result(), depth.result()
        self.surface = along < scene.far_m * (1 - 1e-5)
        ys, xs = np.mgrid[0:scene.height, 0:scene.width]
        x = (2 * (xs + 0.5) / scene.width - 1) / scene.clip_from_view[0, 0]
        y = (1 - 2 * (ys + 0.5) / scene.height) / scene.clip_from_view[1, 1]
        view = np.stack([x * along, y * along, -along, np.ones_like(along)], -1)
        self.places = view @ np.linalg.inv(scene.view_from_world).T
        self.compared = self.surface & (np.nan_to_num(self.n_dot_l, nan=-1) > MIN_N_DOT_L)

    def texels(self, clip_from_world, texels):
        """Returns the place of each pixel in the map, in texels."""
        clip = self.places @ np.asarray(clip_from_world).T
        return (clip[..., :2] / clip[..., 3:] * 0.5 + 0.5) * texels

    def angle_deg(self):
        """Returns the angle between normal and light that 95 % of the lit pixels do not exceed."""
        lit = self.compared & (self.mask >= 0.5)
        return math.degrees(math.acos(float(np.quantile(np.clip(self.n_dot_l[lit], 0, 1), 0.05))))


class Proof:
    """Proof of one engine."""

    def __init__(self, name, options):
        self.name, self.engine, self.options = name, ENGINES[name], options
        self.inspector = Inspector(options.inspector)
        self.folder = os.path.join(options.out, name)
        os.makedirs(self.folder, exist_ok=True)
        self.given = {}  # facts that the engine reported, by scene

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def broken(self, parameters):
        """Returns parameters with the bias multiplied by the factor of --broken, for the engine alone."""
        return {key: value * self.options.broken if key in self.engine["off"] and not isinstance(value, str) else value
                for key, value in parameters.items()}

    def draw(self, rows):
        """Has the engine draw jobs, given as folder, scene and parameters."""
        for folder, scene, parameters in rows:
            jobs.write_job(folder, self.name, scene, self.engine["settings"]["filter.kernel"], self.broken(parameters))
        run_engine(self.name, [folder for folder, _, _ in rows])

    def learn_boxes(self, all_scenes):
        """Takes the light's box of each scene: the engine's own where it fits one."""
        if self.engine["fits"]:
            rows = [(self.path("fit", s.name), s, self.parameters_off(s)) for s in all_scenes]
            self.draw(rows)
        else:
            run_engine(self.name, [])  # is all there that it needs?
        for scene in all_scenes:
            matrix, texels = scene.clip_from_world(), scene.resolution
            if self.engine["fits"]:
                facts = read_facts(self.path("fit", scene.name))
                matrix, texels = matrix_of(facts), facts.get("map_resolution", texels)
            self.given[scene.name] = (matrix, texels)
            reversed_z = self.engine.get("reversed", False)
            if reversed_z:  # the matrix of facts.json is that of standard depth
                matrix = np.diag([1, 1, -1, 1]) @ matrix
            jobs.write_bundle(self.bundle(scene), scene, matrix, texels, reversed_z=reversed_z)

    def bundle(self, scene):
        return self.path("bundles", scene.name + ".bundle")

    def filter_of(self, name):
        """Returns parameters and settings of a filter; None is the engine's hardest."""
        return self.engine["filters"][name] if name else self.engine

    def parameters_off(self, scene, filter_name=None):
        plane = self.engine["plane"] if scene.name.startswith("plane-") else {}
        return {**self.filter_of(filter_name)["kernel"], **plane, **self.engine["off"]}

    def facts_of(self, scene):
        return map_facts(*self.given[scene.name])

    def converted(self, scene, bias, angle_deg, filter_name=None):
        """Returns the engine's numbers for a bias in settings of the inspector, in texels."""
        settings = {"bias.kind": "constant", "bias.unit": "texels", "bias.constant": 0, "bias.slope": 0, "bias.normal": 0,
                    **bias, **self.filter_of(filter_name)["settings"]}
        return self.inspector.convert(self.name, settings, self.facts_of(scene), angle_deg)

    def check_box(self, scene, folder):
        """Checks that the engine used the box that the inspector was given."""
        facts = read_facts(folder)
        if "clip_from_world" not in facts:
            return None
        matrix, texels = self.given[scene.name]
        points = np.vstack([o.positions for o in scene.objects]).astype(float)
        points = np.hstack([points, np.ones((len(points), 1))])
        return float(np.abs((points @ (matrix_of(facts) - matrix).T)[:, :2]).max() * texels / 2)

    # Masks of scenes

    def prepare_scenes(self, all_scenes):
        """Returns the jobs of the scenes, with the inspector's masks."""
        rows = []
        for scene in all_scenes:
            reference = Reference(self.inspector, scene, self.bundle(scene))
            bias = {"bias.constant": CONSTANT_TEXELS, "bias.normal": NORMAL_TEXELS}
            converted = self.converted(scene, bias, reference.angle_deg())
            parameters = {**self.engine["kernel"], **{key: converted[key]["value"] for key in self.engine["off"]}}
            ours = self.inspector.visibility(self.bundle(scene), (scene.width, scene.height), self.name, parameters)
            rows.append((scene, reference, parameters, ours))
        return rows

    def compare_scenes(self, rows):
        out = []
        for scene, reference, parameters, ours in rows:
            folder = self.path("jobs", scene.name)
            theirs = jobs.read_pgm(os.path.join(folder, "mask.pgm"))
            matrix, texels = self.given[scene.name]
            places = reference.texels(matrix, texels)
            result = criteria.compare(theirs, ours, reference.mask, reference.compared, places)
            inner = criteria.interior(reference.mask, reference.compared, places)
            facts = read_facts(folder)
            result |= {"scene": scene.name, "title": scene.title, "parameters": parameters, "texels": texels,
                       "engine_version": str(facts.get("version", "")),
                       "driver": str(facts.get("driver", "")), "angle_deg": reference.angle_deg(),
                       "box_texels": self.check_box(scene, folder), **self.facts_of(scene)}
            out.append(result)
            row = [pictures.grey(theirs, reference.compared), pictures.grey(ours, reference.compared),
                   pictures.difference(theirs, ours, reference.compared, inner)]
            pictures.write_png(self.path(f"{scene.name}.png"), pictures.side_by_side(row))
            np.savez_compressed(self.path(f"{scene.name}.npz"), theirs=theirs, ours=ours, reference=reference.mask,
                                compared=reference.compared, interior=inner, places=places)
        return out

    # Beginning of acne

    def acne_cases(self, planes):
        """Yields plane, tilt, direction, parameter, setting and filter of each search."""
        wanted = self.options.parameters
        for tilt, diagonal, plane in planes:
            for parameter, setting in self.engine["acne"]:
                if not wanted or parameter in wanted:
                    yield plane, tilt, diagonal, parameter, setting, None
            if tilt == FILTER_TILT_DEG:
                for name in self.engine.get("filters", {}):
                    yield plane, tilt, diagonal, *self.engine["acne"][0], name

    def begin_acne(self, plane, tilt_deg, diagonal, parameter, setting, filter_name):
        """Returns where acne begins in the inspector's pictures: the number at step 0, the step and the shares."""
        tilt = math.radians(tilt_deg)
        least = math.tan(tilt) / 2 * (math.sqrt(2) if diagonal else 1)
        amounts = {"bias.constant": least, "bias.normal": least * math.cos(tilt),
                   "bias.raster_slope": least / math.tan(tilt)}
        row = self.converted(plane, {setting: amounts[setting]}, tilt_deg, filter_name)[parameter]
        base = row["value"] or row["literal"]
        size, off, shares = (plane.width, plane.height), self.parameters_off(plane, filter_name), {}

        def has_acne(step):
            if step not in shares:
                mask = self.inspector.visibility(self.bundle(plane), size, self.name,
                                                 {**off, parameter: base * criteria.GRID_STEP ** step})
                shares[step] = criteria.dark_share(mask)
            return shares[step] >= criteria.MAX_DARK_SHARE

        kFirst, kLimit = 2, 64
        low, high = -kFirst, kFirst
        while has_acne(high) and high < kLimit:
            low, high = high, 2 * high + 2
        while not has_acne(low) and low > -kLimit:
            low, high = 2 * low - 2, low
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if has_acne(middle) else (low, middle)
        found = high if not has_acne(high) and has_acne(low) else None
        return {"parameter": parameter, "filter": filter_name, "tilt_deg": tilt_deg, "diagonal": diagonal, "base": base, "ours_step": found,
                "ours": None if found is None else base * criteria.GRID_STEP ** found,
                "ours_shares": {str(k): v for k, v in sorted(shares.items())}}

    def acne_jobs(self, row, plane, steps):
        off = self.parameters_off(plane, row["filter"])
        name = f"{plane.name}-{row['parameter']}" + (f"-{row['filter']}" if row["filter"] else "")
        return {step: (self.path("jobs", name, str(step)), plane,
                       {**off, row["parameter"]: row["base"] * criteria.GRID_STEP ** step}) for step in steps}

    def read_acne(self, row, plane, steps):
        """Reads where acne begins in the engine's pictures."""
        shares = {step: criteria.dark_share(jobs.read_pgm(os.path.join(folder, "mask.pgm")))
                  for step, (folder, _, _) in self.acne_jobs(row, plane, steps).items()}
        begins = criteria.acne_begins(shares)
        bracketed = begins is not None and begins > min(steps)
        row["theirs_shares"] = {str(k): v for k, v in sorted(shares.items())}
        row["theirs_step"] = begins if bracketed else None
        row["theirs"] = row["base"] * criteria.GRID_STEP ** begins if bracketed else None
        ratio = abs(row["theirs"] / row["ours"]) if bracketed and row["ours"] else None
        row["ratio"] = ratio
        row["passed"] = ratio is not None and 1 / criteria.MAX_ACNE_RATIO <= ratio <= criteria.MAX_ACNE_RATIO
        return bracketed

    def prove(self):
        """Runs the proof and returns its numbers."""
        start = time.time()
        options = self.options
        shown = [s for s in proof_scenes(self.inspector, self.folder) if s.name in options.scenes]
        for scene in shown:
            scene.resolution *= self.engine.get("resolution_factor", 1)
        planes = [(t, d, scenes.tilted_plane(t, d)) for t in options.tilts for d in (False, True)] if options.acne else []
        self.learn_boxes(shown + [p for _, _, p in planes])
        compared = self.prepare_scenes(shown)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            begun = [(plane, pool.submit(self.begin_acne, plane, *case)) for plane, *case in self.acne_cases(planes)]
            acne = [(plane, future.result()) for plane, future in begun]
        rows = [(self.path("jobs", scene.name), scene, parameters) for scene, _, parameters, _ in compared]
        steps_of = {}
        for plane, row in acne:
            middle = row["ours_step"] or 0
            steps = range(middle - STEPS_AROUND, middle + STEPS_AROUND + 1)
            steps_of[id(row)] = steps
            rows += self.acne_jobs(row, plane, steps).values()
        drawn = time.time()
        self.draw(rows)
        engine_s = time.time() - drawn
        elsewhere = [(plane, row) for plane, row in acne if not self.read_acne(row, plane, steps_of[id(row)])]
        if elsewhere:
            again = []
            for plane, row in elsewhere:
                middle = row["ours_step"] or 0
                steps_of[id(row)] = range(middle - STEPS_WIDE, middle + STEPS_WIDE + 1)
                again += self.acne_jobs(row, plane, steps_of[id(row)]).values()
            self.draw(again)
            for plane, row in elsewhere:
                self.read_acne(row, plane, steps_of[id(row)])
        result = {"engine": self.name, "title": self.engine["title"], "scenes": self.compare_scenes(compared),
                  "acne": [row for _, row in acne], "seconds": time.time() - start, "engine_seconds": engine_s}
        versions = [s["engine_version"] for s in result["scenes"]]
        result["version"] = versions[0] if versions else ""
        result["passed"] = all(all(s["passed"].values()) for s in result["scenes"]) and all(
            row["passed"] for row in result["acne"])
        return result


def print_result(result):
    print(f"{result['title']} {result['version']}: {'passed' if result['passed'] else 'FAILED'}, "
          f"{result['seconds']:.0f} s, of which the engine {result['engine_seconds']:.0f} s")
    for s in result["scenes"]:
        faults = [key for key, passed in s["passed"].items() if not passed]
        furthest = "beyond the window" if s["edge_max_texels"] is None else f"{s['edge_max_texels']:.2f} texels"
        print(f"  {s['title']}: interior {100 * s['interior_share']:.1f} % of {s['compared_px']} px, equal on "
              f"{100 * s['equal_share']:.3f} %, edges differ on {s['edge_differ_px']} of {s['edge_px']} px, "
              f"{s['edge_beyond_px']} beyond {criteria.MAX_EDGE_TEXELS} texels (at most {furthest})"
              f"{': FAILED ' + ', '.join(faults) if faults else ''}")
    for a in result["acne"]:
        ratio = "not found" if a["ratio"] is None else f"{a['ratio']:.3f}"
        print(f"  acne {a['parameter']} at {a['tilt_deg']} deg {'diagonal' if a['diagonal'] else 'axis'}{' under ' + a['filter'] if a['filter'] else ''}: inspector "
              f"{a['ours']}, engine {a['theirs']}, ratio {ratio}{'' if a['passed'] else ': FAILED'}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("engines", nargs="+", choices=list(ENGINES))
    parser.add_argument("-o", "--out", required=True)
    parser.add_argument("--inspector", default=os.path.join(ROOT, "build/release/shadow-inspector"))
    parser.add_argument("--scenes", default="box,stage,teapot", type=lambda text: [s for s in text.split(",") if s])
    parser.add_argument("--no-acne", dest="acne", action="store_false")
    parser.add_argument("--tilts", default=list(TILTS_DEG), type=lambda text: [float(t) for t in text.split(",")])
    parser.add_argument("--parameters", default=[], type=lambda text: text.split(","))
    parser.add_argument("--broken", default=1.0, type=float, help="factor on the numbers that the engine alone is given")
    parser.add_argument("--expect-failure", action="store_true", help="exit code 0 if a criterion is not met, else 1")
    parser.add_argument("--lacking", help="file that gets a line for each engine that lacks a package")
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    results, lacking, failed = [], [], False
    for name in options.engines:
        try:
            results.append(Proof(name, options).prove())
        except Lacking as error:
            lacking.append(f"proof.{name} lacks {error}")
            print(f"{name}: lacks {error}", file=sys.stderr)
            continue
        except (InspectorError, OSError, ValueError) as error:
            print(f"{name}: {error}", file=sys.stderr)
            return 1
        print_result(results[-1])
        sys.stdout.flush()
        failed |= not results[-1]["passed"]
        with open(os.path.join(options.out, name, "result.json"), "w") as file:
            json.dump(results[-1], file, indent=1)
    if lacking and options.lacking:
        with open(options.lacking, "w") as file:
            file.write("".join(line + "\n" for line in lacking))
    if results and failed != options.expect_failure:
        return 1
    return LACKS if lacking and not results else 0


if __name__ == "__main__":
    sys.exit(main())
