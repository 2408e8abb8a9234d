// Clip levels of virtual shadow maps: concentric maps of a directional light around the camera, each with texels twice
// as wide as the level before. Levels lie on world-space grids that do not move with the camera, so that their pages
// can be cached. Losasso, Hoppe, Geometry Clipmaps, SIGGRAPH 2004; Sakmary, Ryan, Hall, Lustri, Virtual Shadow Maps,
// GPU Zen 3, 2024.
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

/// Clip levels of a directional light (concentric shadow maps around the camera): their views, grid positions, and the
/// rule that chooses the level for a point.
struct ClipLevels {
    std::vector<LightView> views;   ///< finest first; all share axes and depths
    std::vector<ClipLevel> levels;  ///< grid positions, in the order of `views`
    ViewChooser chooser;            ///< rule that chooses the level for a point
};

/// Input for computing the clip levels of a directional light (concentric shadow maps around the camera): light
/// direction, resolution, number and density of the levels.
struct ClipLevelRequest {
    glm::dvec3 to_light{0, 1, 0};  ///< unit vector towards the light
    DepthConvention convention;
    int resolution = 0;        ///< texels along a side of a level
    int page_texels = 0;       ///< texels along a side of a page
    int count = 1;             ///< number of levels
    double bias = 0;           ///< added to the level, as the setting map.virtual_bias; above 0: coarser
    double margin_texels = 0;  ///< largest distance from a surface's place in the map to a texel that a look-up reads
    int picture_lines = 720;   ///< height of the picture in pixels
};

/// Computes the clip levels of a directional light: concentric shadow maps around the camera, each with texels twice as
/// wide as the level before. Each level covers the distances from the camera at which its texels are about as large as
/// the picture's pixels. A pure function.
ClipLevels clip_levels(const ClipLevelRequest& request, const SceneShape& shape, const Camera& camera);

/// Returns the world-space point to which positions are relative when pages of virtual shadow maps are drawn: a grid
/// point near the scene's centre. It stays the same while casters move a little, so that cached pages stay valid.
glm::dvec3 page_origin(const SceneShape& shape);

/// Pages (tiles of a virtual shadow map) along a side of a block of pages. Each page is drawn as a part of its block,
/// so its depths do not depend on the camera.
inline constexpr int kBlockPages = 8;

/// Returns the light view of the block of pages (kBlockPages along a side) that contains a page of a clip level. A page
/// is drawn as a part of its block, so that its depths do not depend on the camera.
/// @param of_level view of the level
/// @param grid_page index of the page, counted from the world's origin
/// @param[out] page place of the page within its block, 0 to kBlockPages - 1
LightView block_view(const LightView& of_level, const ClipLevel& level, int page_texels, const glm::i64vec2& grid_page,
                     glm::ivec2& page);

/// Returns a / b rounded down, also for negative numbers.
constexpr glm::i64 floor_div(glm::i64 a, glm::i64 b) {
    return a / b - (a % b != 0 && (a < 0) != (b < 0));
}

}  // namespace si
