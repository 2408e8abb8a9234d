// Marks over the map viewer's picture: texels, a kernel's footprint, numbers in texels, outlines of cameras; and the
// text about the texel under the mouse.
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <utility>

#include "renderer/frame/frame.h"
#include "renderer/inspect/texel_usage.h"

namespace si {

/// Placement of the map viewer's image on the screen, which converts between pixels, map coordinates and texels. Map
/// coordinates go from 0 to 1 over the image: u to the right, v up.
struct MapRect {
    ImVec2 lo{0, 0}, size{1, 1};
    glm::ivec2 texels{1};
    /// Returns the map coordinates of a position on the screen.
    glm::dvec2 uv(ImVec2 p) const { return {(p.x - lo.x) / size.x, 1 - (p.y - lo.y) / size.y}; }
    /// Returns the position on the screen of map coordinates.
    ImVec2 screen(const glm::dvec2& uv) const { return {lo.x + float(uv.x) * size.x, lo.y + float(1 - uv.y) * size.y}; }
    /// Returns the width of a texel on the screen, pixels.
    float texel_pixels() const { return size.x / float(texels.x); }
    /// Returns true if the depth image has this texel.
    bool holds(glm::ivec2 texel) const {
        return texel.x >= 0 && texel.y >= 0 && texel.x < texels.x && texel.y < texels.y;
    }
    /// Returns the upper left and the lower right corner of a texel of the map on the screen, pixels.
    /// @param texel column and row of the texel, from the lower left
    std::pair<ImVec2, ImVec2> square(glm::ivec2 texel) const;
};

/// Draws the outline of a rectangle of texels over the image in the map viewer. A rectangle too small to see gets a
/// ring around it.
/// @param first lower left texel @param size width and height in texels
void outline_texels(const MapRect& rect, glm::ivec2 first, glm::ivec2 size, ImU32 colour);

/// Draws the stored value of each visible texel as a number over the image in the map viewer. Draws nothing if texels
/// are too small on the screen (fits_texel_values()).
/// @param values shown image: one channel, top row first @param clip_lo, clip_hi visible part, pixels of the screen
void draw_texel_values(const MapRect& rect, const FloatImage& values, ImVec2 clip_lo, ImVec2 clip_hi);
/// Returns true if texels of the map viewer's image are large enough on the screen to hold their values as numbers,
/// which draw_texel_values() draws.
bool fits_texel_values(const MapRect& rect);

/// Draws line segments over the image in the map viewer, such as the outline of a camera's frustum.
/// @param lines both ends of each segment in map coordinates, 0..1, v up
void draw_map_lines(const MapRect& rect, std::span<const std::pair<glm::dvec2, glm::dvec2>> lines, ImU32 colour);

/// Formats the map viewer's text about one texel. The first line gives the texel and the number of pixels that read it.
/// The second gives its depth: in metres, as stored, and as a share of the range from near to far plane.
/// @param texel the texel, y up, of a depth image of `size` texels
/// @param values the stored depths, row 0 at the top; null or of another size: not read back yet
/// @param shown the kind of image. For moments the second line gives the moment, or with `linear` the depth of a single
/// surface that has this moment. At a mip level `values` have that level's size.
/// @param usage texels that pixels read; null: not known @param frozen true: the pixels are those of the frozen camera,
/// to which maps stay fitted
std::pair<std::string, std::string> texel_readout(glm::ivec2 texel, glm::ivec2 size, const FloatImage* values,
                                                  const DepthCurve& curve, const TexelUsage* usage, bool frozen,
                                                  const ShownMap& shown = {}, bool linear = false);

}  // namespace si
