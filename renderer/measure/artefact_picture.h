// What is wrong with a frame's shadows, as a picture.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/reference/metrics.h"

namespace si {

struct ArtefactStyle {
    Artefact artefact;
    std::string_view key, label;
    std::array<std::uint8_t, 3> rgb;  ///< sRGB; told apart by people who are colour-blind, too
};

/// All but Artefact::None, in its order.
std::span<const ArtefactStyle> artefact_styles();

/// The picture in grey, what is wrong in colour. @param judged one per pixel of the truth, top row first
/// @param step pixels of the picture per pixel of the truth (ReferenceOptions::step)
ByteImage artefact_picture(const ByteImage& picture, const std::vector<JudgedPixel>& classified, int step = 1);

}  // namespace si
