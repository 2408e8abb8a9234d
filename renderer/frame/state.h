// State that all passes of one frame share: values derived from scene and settings, and resources of the context.
#pragma once

#include <array>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/frame/driver_info.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/plan.h"
#include "renderer/frame/scene_gpu.h"
#include "renderer/frame/value_range.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/pass_clock.h"
#include "renderer/gl/program_cache.h"
#include "renderer/gl/target.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/param.h"
#include "renderer/software/texel_buffer.h"
#include "renderer/view/culling/map_cells.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/units.h"

namespace si {

/// Largest number of panes in the split view.
inline constexpr int kMaxPanes = 4;
/// Number of images that hold position and normals of the visible surfaces.
inline constexpr int kVisibleSurfaceImages = 5;  ///< see lib/seen_surface.glsl

/// Measured depth range of the surfaces that a camera sees. Maps are narrowed to it under light.depth_bounds sdsm.
struct VisibleDepths {
    std::uint64_t key = 0;          ///< FrameState::surfaces_key() at the measurement
    std::optional<DepthSpan> span;  ///< metres; nullopt: no surface is visible
    PassInfo info;
};

/// GPU buffers of the uniform blocks that all shaders read: see frame/blocks.h.
struct Blocks {
    TexelBuffer frame{"frame uniforms"}, settings{"settings uniforms"};
    TexelBuffer disk{"places of disks"};  ///< sample positions of disk kernels
};

struct SceneFindings;
struct CasterFindings;

/// GPU resources that outlast a frame and belong to no single pass: programs, blocks, samplers, the scene, fitted
/// lights.
struct Resources {
    gl::ProgramCache programs;
    Blocks blocks;
    gl::VertexArray empty_vao;
    gl::Sampler map_nearest, map_compare, map_blended;
    std::unique_ptr<SceneGpu> scene;
    gl::Target camera_depth;                          ///< depth of the visible surfaces, with its cache key
    std::shared_ptr<SceneFindings> found;             ///< see optimisations/scene_findings.h
    std::shared_ptr<CasterFindings> caster_findings;  ///< see passes/caster_findings.h
    PlacedLights placed;
    std::vector<FittedLight> fitted_without_camera;  ///< lights fitted without a camera
    std::uint64_t as_placed_key = 0;
    std::vector<FittedLight> fitted;  ///< lights fitted for the frame's camera
    std::uint64_t fit_key = 0;
    VisibleDepths seen;
    /// Number of the last drawing into each cached image, by the address of the image's key. Each drawing gets the next
    /// number.
    std::map<const std::uint64_t*, std::uint64_t> drawings;
    std::uint64_t last_drawing = 0;
};

/// Returns the picture that a target holds, for read-back.
inline Image image_of(const gl::Target& target) {
    return {target.texture.id(), target.width, target.height};
}

/// State of one frame while it is planned and drawn: inputs, values derived from them (camera, fitted lights, keys),
/// plan and resources. Passes read it.
struct FrameState {
    const Scene& scene;
    Settings settings;  ///< sanitised and within the driver's limits
    FrameRequest request;
    Resources& gl;
    const DriverInfo& driver;

    Camera camera;
    std::optional<DepthSpan> seen_m;  ///< measured depth range of visible surfaces; nullopt: not needed or none visible
    glm::dvec3 origin{0};             ///< world origin of camera-relative positions
    std::vector<int> first_view;      ///< by light: layer of its first view in the map textures
    int view_count = 0;
    MapSize map_size;
    bool map_size_is_given = false;  ///< imported maps fix map_size; a lack of memory does not reduce it
    /// Returns the layer count of map textures; 0 for a single view, which is a plain 2-D texture.
    int map_layers() const { return view_count > 1 ? view_count : 0; }
    /// Returns the OpenGL format of shadow map textures under the frame's settings.
    GLenum map_format() const;
    /// Returns true when map.blur_texels blurs the stored depths of shadow maps.
    bool blurs_depths() const { return settings.map.blur_texels > 0 && view_count > 0; }
    /// Returns true when contact shadows (short rays through the picture's depths, light.contact) darken surfaces under
    /// a light.
    /// @param light index of the light
    bool has_contact_shadows(std::size_t light) const;
    /// Returns true when a light may change the picture. If false, shading skips the light.
    /// @param light index of the light
    bool may_light_picture(std::size_t light) const;
    /// Returns true when shading treats a light as unshadowed and skips its shadow map look-up: see is_always_lit().
    /// @param light index of the light
    bool shades_as_lit(std::size_t light) const;
    /// Returns the imported shadow maps of a light, whose images are given instead of drawn; null when the light's maps
    /// are drawn or it has none.
    /// @param light index of the light
    const ImportedMaps* imported(std::size_t light) const;
    bool paged = false;                      ///< maps are virtual and drawn by pages (map.virtual)
    std::string separate_visibility_reason;  ///< reason for a separate visibility texture; empty: there is none
    bool separate_visibility = false;
    glm::ivec2 pixel_origin{0};                ///< picture position of pixel (0, 0) of the target
    std::vector<glm::vec2> disk_texels;        ///< disk sample positions that shaders read from an image
    bool filter_sampler = false;               ///< the kernel compares depths by a hardware shadow sampler
    std::vector<gl::Define> defines;           ///< defines from settings and kernel
    Key geometry_key, camera_key, lights_key;  ///< cache keys of scene, camera and lights
    std::vector<std::string> notes;

    /// One of the pictures that the split view shows side by side (view.panes). Panes with the same overlay share
    /// images.
    struct ShownPane {
        int overlay = 0;               ///< as view.overlay
        int slot = 0;                  ///< index of the first pane with this overlay
        bool lacks_reference = false;  ///< `overlay` is 0 for lack of a reference
        /// Returns the table row of the pane's overlay; null without an overlay.
        const Overlay* row() const { return overlay > 0 ? &overlays()[std::size_t(overlay - 1)] : nullptr; }
    };
    std::vector<ShownPane> panes;
    bool studio = false;                ///< the picture has the look "studio": view.look, FrameRequest::with_look
    bool slabs_shown = false;           ///< view.slabs shows texels of a map as quads
    ReferenceNeed reference;            ///< reference that the frame needs, see FrameResult::reference
    std::vector<ReferenceNeed> traced;  ///< by light, see FrameResult::traced
    /// Ray-traced visibility by light. Null: the light's source is not ray tracing, or nothing is traced yet.
    std::vector<const ReferencePicture*> traced_pictures;
    std::vector<LightMapNeed> light_maps;  ///< by light, see FrameResult::light_maps
    /// Baked light map by light. Null: the light's source is not a light map, or none is baked yet.
    std::vector<const LightMap*> light_map_of_light;
    std::uint64_t reference_content = 0;  ///< cache key of the reference's values in use
    Plan plan;                            ///< see plan_frame()
    /// Cells of a grid over the map (MapCells) that are drawn, for each map layer; look-ups read nothing outside them.
    /// Valid once the map passes are planned.
    std::vector<MapCells> drawn_cells_by_layer;
    Key maps_extent;                    ///< cache key of drawn_cells_by_layer; valid once the map passes are planned
    bool maps_are_whole = true;         ///< FrameResult::maps_are_whole; valid once the map passes are planned
    bool camera_depth_renewed = false;  ///< camera depth was redrawn in this frame, for FrameRequest::force

    /// Returns true when shaders read settings and frame data from buffer images in place of uniform blocks.
    bool blocks_as_images() const { return request.blocks_as_images.value_or(driver.blocks_as_images); }
    /// Returns an image of a pass's result. The target has no texture where no pass of the frame makes the result.
    const gl::Target& result(const ResultRef& of, std::size_t image = 0) const { return plan.target(of, image); }
    /// Registers a texture array in the frame's plan (list of passes and their results) as the shadow maps that
    /// look-ups compare with (Result::ShadowMaps). The array gets the texture unit for reading depths. Unless depths
    /// are stored as colour, it also gets the unit of the comparison sampler.
    void place_compared_maps(const gl::Target& maps);
    /// Binds the images of these results to the texture units that the plan assigned. The renderer does this before
    /// each pass, for the results that the pass reads.
    void bind_results(std::span<const ResultRef> results) const;
    /// Binds the images of these results to the texture units that the plan assigned.
    void bind_results(std::initializer_list<ResultRef> results) const {
        bind_results(std::span(results.begin(), results.size()));
    }

    /// Returns the light view whose map the map viewer shows (view.light and view.face); null when that light has no
    /// map.
    /// @param[out] layer layer of this view in the map textures
    const LightView* shown_view(int* layer = nullptr) const;
    /// Returns the depth curve (mapping from distance to stored depth) of the image in the map viewer; null when the
    /// viewer shows none.
    const DepthCurve* shown_curve() const;
    /// Returns the mip level of the moments image that the map viewer shows; 0 is the finest.
    int shown_mip() const;
    /// Returns true when the map viewer's grey range follows the drawn depths: by view.map_fit, or by automatic
    /// contrast (view.map_contrast).
    bool fits_grey_range() const;
    /// Returns the cache key of the surfaces that the camera sees, at the picture's size.
    Key surfaces_key() const { return Key(geometry_key).add(camera_key).add(gl.programs.source().generation()); }
    /// Returns a cache key: `from` extended by the values of the settings that a kind of pass reads on the CPU
    /// (Param::read_by). Settings that have no effect at present are left out.
    /// @param from key to extend
    /// @param pass kind of pass
    Key with_settings(Key from, ReadBy pass) const { return with_settings(std::move(from), pass, settings); }
    /// Returns a cache key: `from` extended by the values of the settings that a kind of pass reads on the CPU
    /// (Param::read_by). They are taken from `values` instead of the frame's settings. Settings that have no effect
    /// under `values` are left out.
    /// @param from key to extend
    /// @param pass kind of pass
    static Key with_settings(Key from, ReadBy pass, const Settings& values);
    /// Returns the cache key of visible surfaces, lights and look-ups, without the contents of sampled textures.
    Key lighting_key() const { return surfaces_key().add(lights_key); }
    /// Returns the cache key of visible surfaces, lights and look-ups for a pass that evaluates view.light alone.
    Key shown_light_key() const { return with_settings(lighting_key(), ReadBy::OneLight); }
    /// Returns the result (image of a pass) that is the picture without overlays, and without map texels drawn as
    /// quads.
    Result base_picture_result() const { return studio ? Result::Creases : Result::Shaded; }
    /// Returns true when a pane's overlay is multiplied by the picture, so that the overlay is dark where the picture
    /// is dark (view.overlay_blend).
    bool tints(const ShownPane& pane) const;
    /// Returns the result that holds a pane's finished picture: with map texels drawn as quads, with the overlay, or
    /// the shaded picture alone.
    ResultRef pane_picture_result(const ShownPane& pane) const;
    std::string preamble;      ///< GLSL before every shader: settings block, facts about the lights
    bool mask_levels = false;  ///< some caster's alpha mask may be sampled at a coarser mip level
    /// Returns true when the unfiltered shadow map, without polygon offset and with alpha masks at their finest mip
    /// level, differs from the map as drawn. A pass then draws the unfiltered map.
    bool needs_unfiltered_map() const;
    bool surface_flags = false;  ///< shaders read flags by object: some object receives no shadow, or is unlit

    /// Returns the shader program of a scene or full-screen pass under the frame's settings, compiled on first use.
    /// @param extra more defines, which override the frame's; a define named *_FILE selects the file of an include
    /// @throws Error when a shader does not compile
    GLuint program(std::string_view vertex, std::string_view fragment, std::vector<gl::Define> extra = {}) const;
    /// Returns true when a fragment shader reads the corners of its triangle. It needs them for the unit of polygon
    /// offset, which in float formats depends on the triangle's greatest depth. Draws with such a shader call
    /// SceneGpu::bind_triangles() first.
    /// @param fragment fragment shader file
    bool reads_corners(std::string_view fragment) const;
    /// Draws the opaque and masked batches (instances of a mesh in one draw call) that the camera sees, with their
    /// textures, into the bound framebuffer.
    /// @param fragment fragment shader file
    /// @param extra more defines, as for program()
    /// @param[out] info draw and triangle counts
    void draw_from_camera(std::string_view fragment, const std::vector<gl::Define>& extra, PassInfo& info) const;
    /// Returns the shader program that draws one batch (instances of a mesh in one draw call), with the defines for the
    /// batch's material; compiled on first use.
    /// @param extra more defines, as for program()
    /// @param alpha_only true: leaves out textures other than the alpha mask
    GLuint batch_program(std::string_view vertex, std::string_view fragment, const std::vector<gl::Define>& extra,
                         const Batch& batch, bool alpha_only) const;
    /// Sets the uniform `faces_left_out` of a program in use: the faces of a batch (front, back, both, none) that are
    /// not drawn into shadow maps.
    void set_faces_left_out(GLuint program, const Batch& batch) const;
    /// Sets the uniform `caster_shift` of a program in use, if the program has it: for each map view, how far an engine
    /// moved casters away from the light before drawing them.
    void set_caster_shifts(GLuint program) const;
    /// Draws one batch of the scene (instances of a mesh in one draw call) and counts it. Call
    /// SceneGpu::bind_vertices() before.
    /// @param[out] info draw and triangle counts
    void draw_batch(const Batch& batch, PassInfo& info) const;
    /// Binds the textures that the fragment shader samples for a batch of instances: base colour and normal map.
    void bind_textures(const Batch& batch) const;
    /// Binds a framebuffer of the picture's size, and sets viewport, depth test, clip control and blending for drawing
    /// from the camera. CameraDrawing does this for the picture's own passes.
    void begin_camera_pass(GLuint framebuffer) const;
    /// Binds a framebuffer, and sets the state for a full-screen pass, which computes all pixels with one triangle.
    /// Follow with draw_fullscreen().
    /// @param width, height pixels
    void begin_fullscreen_pass(GLuint framebuffer, int width, int height) const;
    /// Creates a framebuffer over an image, and begins a full-screen pass that computes all pixels of the image. Keep
    /// the framebuffer until draw_fullscreen().
    /// @param label name of the framebuffer in frame debuggers
    /// @param layer layer of an array texture to draw into; -1: the whole image
    gl::Framebuffer begin_fullscreen_pass(std::string_view label, const gl::Target& into, int layer = -1) const;
    /// Binds the program of a full-screen pass, see program(), and returns it for setting uniforms.
    GLuint use_fullscreen(std::string_view fragment, std::vector<gl::Define> extra = {}) const;
    /// Draws one triangle over the whole viewport, after begin_fullscreen_pass(). The fragment shader in use computes
    /// each pixel.
    /// @param[out] info draw and triangle counts
    static void draw_fullscreen(PassInfo& info);
    /// Computes only some rectangles of the viewport with the fragment shader in use, by one draw for each rectangle.
    /// Call after begin_fullscreen_pass().
    /// @param rects rectangles in pixels, from the lower left
    /// @param[out] info draw and triangle counts
    static void draw_fullscreen(std::span<const TexelRect> rects, PassInfo& info);
};

}  // namespace si
