// What rays find of a light on all surfaces of a scene, traced once for whatever camera: its light map. Arvo, Backward
// Ray Tracing, SIGGRAPH 1986 course notes, for textures that hold light; Abrash, Quake's Lighting Model (Graphics
// Programming Black Book, chapter 68), 1997, for an atlas of them.
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
#include "renderer/reference/truth.h"
#include "renderer/reference/truth_scene.h"

namespace si {

/// Everything that a bake needs; it touches neither scene nor GPU any more.
struct LightMapTask {
    std::shared_ptr<const ReferenceGeometry> geometry;
    Emitter emitter;
    int side = 0;     ///< of the atlas, texels
    int samples = 1;  ///< most rays a texel, over the light's area; 1: one to its middle
    std::uint64_t key = 0;
};

struct LightMap {
    std::uint64_t key = 0;      ///< light_map_key() of the frames that it is for
    std::uint64_t version = 0;  ///< another one for each content
    std::shared_ptr<const LightMapLayout> layout;
    /// side x side, bottom row first: round(255 * visibility), so that a look-up is off by 1/510 at most for that. What
    /// no look-up reaches is 255.
    std::vector<std::uint8_t> texels;
    std::uint64_t rays = 0;
    double bake_ms = 0;  ///< wall time, of reading it where it was kept on disk
    bool from_disk = false;
    HeldMemory held;  ///< what its texels take
    std::string
        remark;  ///< why the one on disk was not taken, or this one not kept there; empty: nothing is to be said
};

/// The key of a light's map in this process: scene, casters, light, light_map.*. Not of the camera. 0 when there is no
/// such light.
std::uint64_t light_map_key(const Scene& scene, const Settings& settings, const std::vector<FittedLight>& lights,
                            int light);

/// @param frame of this scene and these settings @throws Error when it asks for no light map of that light
LightMapTask light_map_task(const Scene& scene, const Settings& settings, const FrameResult& frame, int light);

/// The key of what the map is made of, whatever process asks: triangles as placed, masks, light, settings.
std::uint64_t light_map_content(const LightMapTask& task);

/// Another one each time, for LightMap::version.
std::uint64_t next_light_map_version();

/// Traces every texel that a look-up may read, on the side of its surface that the light is on: what shows the other
/// one faces away and is dark. Texels beside their chart are moved to the nearest point of it, and a quarter of a texel
/// in from its borders, so that none lies in the plane of a wall that stands there. Equal for any number of threads.
/// @throws Cancelled; Error as ReferenceScene does
LightMap bake_light_map(const LightMapTask& task, std::shared_ptr<const LightMapLayout> layout,
                        const ReferenceScene& scene, const Workers& workers);

}  // namespace si
