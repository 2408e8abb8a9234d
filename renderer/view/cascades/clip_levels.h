// Clip levels: concentric maps of a directional light about the camera, each with texels twice as wide as the one
// before. They lie on grids of the light's own that do not move with the camera, so that pages of them can be kept.
// Losasso, Hoppe, Geometry Clipmaps, SIGGRAPH 2004; Sakmary, Ryan, Hall, Lustri, Virtual Shadow Maps, GPU Zen 3, 2024.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>
#include <span>
#include <vector>

#include "renderer/projection/light_view.h"
#include "renderer/projection/view_choice.h"
#include "renderer/view/lights/light.h"

namespace si {

struct Camera;
struct SceneShape;

struct ClipLevels {
    std::vector<LightView> views;  ///< finest first; all share axes and depths
    std::vector<ClipLevel> levels;
    ViewChooser chooser;
};

struct ClipLevelRequest {
    glm::dvec3 to_light{0, 1, 0};
    DepthConvention convention;
    int resolution = 0, page_texels = 0, count = 1;
    double bias = 0;           ///< in levels, as map.virtual_bias
    double margin_texels = 0;  ///< how far from a surface its look-ups lead
    int picture_lines = 720;   ///< pixels of the picture's height
};

/// The levels for a camera. A pure function.
ClipLevels clip_levels(const ClipLevelRequest& request, const SceneShape& shape, const Camera& camera);

/// What the shaders that draw pages of a scene count positions from: a grid point near its centre, so that casters
/// which move do not move it each time.
glm::dvec3 page_origin(const SceneShape& shape);

/// Of blocks of this many pages to a side each page is drawn as part of one, wherever the camera stands.
inline constexpr int kBlockPages = 8;

/// The view of the block of a level's grid that holds a page.
/// @param[out] page its place in the block
LightView block_view(const LightView& of_level, const ClipLevel& level, int page_texels, const glm::i64vec2& grid_page,
                     glm::ivec2& page);

/// Quotient rounded down.
constexpr glm::i64 floor_div(glm::i64 a, glm::i64 b) {
    return a / b - (a % b != 0 && (a < 0) != (b < 0));
}

}  // namespace si
