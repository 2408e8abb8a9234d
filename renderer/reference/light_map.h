// Light maps: one light's ray-traced visibility on all surfaces of a scene, independent of the camera. Textures that
// store light: Arvo, Backward Ray Tracing, SIGGRAPH 1986 course notes. Atlases of them: Abrash, Quake's Lighting Model
// (Graphics Programming Black Book, chapter 68), 1997.
//
//     LightMapTask task = light_map_task(scene, settings, frame, light);        // on the renderer's thread
//     request.light_maps[light] = light_maps().get(task, workers);              // any thread
//     FrameResult drawn = renderer.render(scene, settings, request);            // drawn.light_maps[light].met
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/reference/light_map_layout.h"
#include "renderer/reference/reference.h"
#include "renderer/reference/reference_scene.h"

namespace si {

/// Input for baking a light map, which holds the traced visibility of one light on all surfaces. Independent of scene
/// and GPU, so that any thread may bake it.
struct LightMapTask {
    std::shared_ptr<const ReferenceGeometry> geometry;
    Emitter emitter;
    int side = 0;     ///< side of the atlas, texels
    int samples = 1;  ///< largest number of rays per texel to the light's area; 1: one ray to its centre
    std::uint64_t key = 0;
};

/// Baked visibility of one light on all surfaces of a scene: an atlas of 8-bit texels with its layout.
struct LightMap {
    std::uint64_t key = 0;      ///< light_map_key() of the frames that may use it
    std::uint64_t version = 0;  ///< unique per content, by next_version()
    std::shared_ptr<const LightMapLayout> layout;
    /// Visibility as round(255 * visibility), `layout->side` squared texels, bottom row first. Rounding errors are at
    /// most 1/510. Texels that no look-up reaches are 255.
    std::vector<std::uint8_t> texels;
    std::uint64_t rays = 0;
    double bake_ms = 0;  ///< wall time of baking, or of reading it from disk
    bool from_disk = false;
    TrackedMemory held;  ///< bytes of the texels
    std::string remark;  ///< reason why the file on disk could not be read or written; empty: none
};

/// Returns the cache key of a light's baked light map within this process. It depends on scene, casters, light and
/// light_map.*, not on the camera. 0 when there is no such light. @param light index in `lights`
std::uint64_t light_map_key(const Scene& scene, const Settings& settings, const std::vector<FittedLight>& lights,
                            int light);

/// Collects the input for baking the light map of one light. Call on the renderer's thread.
/// @param frame a frame of this scene and these settings @throws Error when the frame needs no light map of that light
LightMapTask light_map_task(const Scene& scene, const Settings& settings, const FrameResult& frame, int light);

/// Returns the cache key of a light map's content (placed triangles, alpha masks, light, settings). The key is equal in
/// every process, so that it finds light maps stored on disk.
std::uint64_t light_map_content_key(const LightMapTask& task);

/// Bakes a light map: traces the light's visibility for every texel that a look-up may read, from the side of the
/// surface that faces the light. A texel outside its chart (patch of triangles in the atlas) is traced at the chart's
/// nearest point, a quarter of a texel inside the border. So no ray starts in the plane of an adjoining wall. The
/// result does not depend on the number of threads.
/// @throws Cancelled; Error as ReferenceScene does
LightMap bake_light_map(const LightMapTask& task, std::shared_ptr<const LightMapLayout> layout,
                        const ReferenceScene& scene, const Workers& workers);

}  // namespace si
