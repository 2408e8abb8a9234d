// Everything the passes of one frame share: facts derived from scene and settings, and the context's resources.
#pragma once

#include <memory>
#include <vector>

#include "renderer/frame.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/program_cache.h"
#include "renderer/gl/target.h"
#include "renderer/gl/timer.h"
#include "renderer/key.h"
#include "renderer/plan.h"
#include "renderer/renderer.h"
#include "renderer/scene_gpu.h"
#include "renderer/techniques.h"
#include "shaders/shared/frame.h"

namespace si {

/// Texture units, the same in every program (layout(binding) in shaders/).
enum Unit : GLuint { kShadowMap, kShadowMapCompare, kBaseColour, kVisibility, kShaded, kOverlayValues, kNormalMap };

/// What outlives a frame: targets with the keys of their contents, programs, buffers.
struct Resources {
    gl::ProgramCache programs;
    gl::Buffer frame_block, settings_block;
    gl::VertexArray empty_vao;
    gl::Sampler map_nearest, map_compare;
    std::unique_ptr<SceneGpu> scene;
    gl::Target map, map_depth;              ///< shadow maps, one layer per view; depth beside a colour map
    gl::Target map_blurred, map_rows;       ///< of map.blur_texels: the maps' depths blurred, and one layer along x only
    /// The shadow maps that are compared, shown and read back.
    const gl::Target& compared_map() const { return map_blurred.texture ? map_blurred : map; }
    std::vector<std::uint64_t> map_keys;    ///< per light: key of its layers' contents
    gl::Target camera_depth, visibility, shaded, overlay, composed, map_view;
    gl::Texture visibility_view;            ///< one layer of visibility as a 2-D texture
    int visibility_view_layer = -1;
    gl::Framebuffer map_framebuffer, visibility_framebuffer, shaded_framebuffer, overlay_framebuffer,
        composed_framebuffer, map_view_framebuffer;
    std::uint64_t depth_key = 0;            ///< of the camera depth: what of the scene is in it
    std::uint64_t fit_key = 0;
    std::vector<FittedLight> fitted;
    /// What the last map view was made of, for reading it back.
    struct Shown {
        MapSource source = MapSource::Light;
        int light = -1, face = 0;
    } shown;
};

struct FrameState {
    const Scene& scene;
    Settings settings;  ///< sanitised and within the driver's limits
    FrameRequest request;
    Resources& gl;
    const DriverInfo& driver;

    Camera camera;
    glm::dvec3 origin{0};        ///< of camera-relative positions
    glm::dvec3 light_origin{0};  ///< of the light passes
    std::vector<int> first_view; ///< per light: its first layer
    int view_count = 0;
    int map_resolution = 0;
    bool separate_visibility = false;
    bool filter_sampler = false;  ///< the kernel compares in a shadow sampler
    std::vector<gl::Define> defines;  ///< from settings and kernel
    Key geometry_key, camera_key, lights_key, maps_key;  ///< what results depend on
    std::vector<std::string> notes;

    const Overlay* overlay() const {
        return settings.view.overlay > 0 ? &overlays()[std::size_t(settings.view.overlay - 1)] : nullptr;
    }
    std::string preamble;             ///< GLSL before every shader: settings block, facts about the lights
    bool surface_flags = false;       ///< some object or material needs the per-object flags

    /// The program of a scene or full-screen pass under the frame's settings.
    GLuint program(std::string_view vertex, std::string_view fragment, std::vector<gl::Define> extra = {}) const;
    /// Draws the batches that `filter` accepts from the camera with the fragment shader given, textures bound.
    void draw_from_camera(std::string_view fragment, const std::vector<gl::Define>& extra, PassInfo& info) const;
    /// The program for one batch, with what its material and objects call for.
    GLuint batch_program(std::string_view vertex, std::string_view fragment, const std::vector<gl::Define>& extra,
                         const Batch& batch, bool alpha_only) const;
    /// Binds what the batch's fragments sample.
    void bind_textures(const Batch& batch) const;
    /// Prepares depth test and write for a camera pass into a framebuffer that holds the camera depth.
    void begin_camera_pass(GLuint framebuffer) const;
    void bind_maps() const;
    /// Prepares a pass that computes every pixel of a framebuffer by one triangle; draw it with draw_fullscreen().
    void begin_fullscreen_pass(GLuint framebuffer, int width, int height) const;
    static void draw_fullscreen(PassInfo& info);
};

// One function per pass; each appends itself to the plan. (renderer/passes/)
void add_light_depth_passes(FrameState& f, std::vector<Pass>& plan);
void add_depth_blur_pass(FrameState& f, std::vector<Pass>& plan);
void add_visibility_pass(FrameState& f, std::vector<Pass>& plan);
void add_shade_pass(FrameState& f, std::vector<Pass>& plan);
void add_overlay_passes(FrameState& f, std::vector<Pass>& plan);
void add_map_view_pass(FrameState& f, std::vector<Pass>& plan);

}  // namespace si
