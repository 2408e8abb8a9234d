// Small pictures for reports.
#pragma once

#include <string>

#include "renderer/frame/frame.h"

namespace si {

/// Made no wider than `width` by averaging whole areas; smaller pictures stay as they are.
ByteImage shrunk(const ByteImage& image, int width);

/// A JPEG's bytes. @throws Error
std::string jpg_bytes(const ByteImage& image, int quality = 85);

}  // namespace si
