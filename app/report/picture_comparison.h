// Images made of other images: comparison of two pictures of one frame, thumbnails.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "renderer/frame/frame.h"
#include "renderer/settings/settings.h"

namespace si {

/// Makes an image whose channels, alpha too, all have one value. @param value 0 to 255
ByteImage plain_image(int width, int height, std::uint8_t value);
/// Copies an image into the image `to`. Rows and columns beyond its right or lower edge are left out.
/// @param corner place of the upper left corner in `to`, pixels, not negative
/// @param columns largest number of columns to copy
void paste_image(ByteImage& to, const ByteImage& from, glm::ivec2 corner,
                 int columns = std::numeric_limits<int>::max());

/// Shrinks an image to at most `width` pixels across, keeping its proportions, by averaging areas. Returns smaller
/// images unchanged.
ByteImage shrunk(const ByteImage& image, int width);

/// Combines two sets of settings, to compare their shadows in one view. Maps, casters, bias, filter, lights and shading
/// come from `other`. The pose of the scene, camera, views and reference come from `shown`.
Settings settings_with_shadows_of(const Settings& shown, const Settings& other);

/// Composes two images of one size into one: `a` left of a white line, two pixels wide, and `b` right of it. @param at
/// place of the line, 0..1 of the width
ByteImage swipe_image(const ByteImage& a, const ByteImage& b, double at);
/// Composes two images into one: `a` on the left, `b` on the right, with a gap between them.
ByteImage side_by_side_image(const ByteImage& a, const ByteImage& b);
/// Computes the difference of two images of one size: 2 |a - b|, at most 255, in each colour channel. The result is
/// opaque.
ByteImage difference_image(const ByteImage& a, const ByteImage& b);
/// Computes the mean absolute difference of two images of one size, over all pixels and colour channels: 0 (equal) to
/// 1.
double mean_difference(const ByteImage& a, const ByteImage& b);

}  // namespace si
