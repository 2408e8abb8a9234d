// Images made of other images: comparison of two pictures of one frame, thumbnails.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "renderer/frame/frame.h"
#include "renderer/settings/settings.h"

namespace si {

/// Makes an image with all channels at `value`.
ByteImage plain_image(int width, int height, std::uint8_t value);
/// Copies an image into another at a corner. Rows and columns beyond the other image are left out.
/// @param columns columns to copy at most
void paste_image(ByteImage& to, const ByteImage& from, glm::ivec2 corner,
                 int columns = std::numeric_limits<int>::max());

/// Shrinks an image to a width of at most `width` pixels by area averaging. Returns smaller images unchanged.
ByteImage shrunk(const ByteImage& image, int width);

/// Returns settings that draw the view of `shown` with the shadows of `other`: maps, casters, bias, filter, lights and
/// shading from `other`; camera, time and views from `shown`.
Settings settings_with_shadows_of(const Settings& shown, const Settings& other);

/// Composes an image of `a` left of a vertical white line, two pixels wide, and `b` right of the line. Both have one
/// size. @param at the place of the line, 0..1 of the width
ByteImage swipe_image(const ByteImage& a, const ByteImage& b, double at);
/// Composes two images side by side with a gap.
ByteImage side_by_side_image(const ByteImage& a, const ByteImage& b);
/// Computes the difference image 2 |a - b| of each channel.
ByteImage difference_image(const ByteImage& a, const ByteImage& b);
/// Computes the mean absolute difference of two images over pixels and colour channels, 0..1.
double mean_difference(const ByteImage& a, const ByteImage& b);

}  // namespace si
