// Thumbnails for reports.
#pragma once

#include <string>

#include "renderer/frame/frame.h"

namespace si {

/// Shrinks an image to a width of at most `width` pixels by area averaging. Returns smaller images unchanged.
ByteImage shrunk(const ByteImage& image, int width);

/// Encodes an image as JPEG. @throws Error
std::string jpg_bytes(const ByteImage& image, int quality = 85);

}  // namespace si
