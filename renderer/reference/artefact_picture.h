// Picture of a frame's shadow errors: the frame in grey with wrong pixels in colour.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/reference/metrics.h"

namespace si {

/// Name and display colour of one cause of shadow errors.
struct ArtefactStyle {
    Artefact artefact;
    std::string_view key, label;
    std::array<std::uint8_t, 3> rgb;  ///< sRGB, distinguishable with colour blindness
};

/// Returns the names and display colours of all causes of shadow errors except Artefact::None, in the order of the
/// enumeration.
std::span<const ArtefactStyle> artefact_styles();

/// Draws a picture of a frame's shadow errors: the frame in grey, with wrong pixels in the colour of their cause.
/// @param picture colours of the frame
/// @param classified class of each pixel of the ray-traced reference, top row first
/// @param step pixels of the picture per pixel of the reference (ReferenceOptions::step)
ByteImage artefact_picture(const ByteImage& picture, const std::vector<ClassifiedPixel>& classified, int step = 1);

}  // namespace si
