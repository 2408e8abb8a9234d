// Everything the passes of one frame share: facts derived from scene and settings, and the context's resources.
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

inline constexpr int kMaxPanes = 4;
inline constexpr int kSeenImages = 5;  ///< see lib/seen_surface.glsl

/// Depths of all that a camera sees, as its depth buffer held them.
struct SeenDepths {
    std::uint64_t key = 0;          ///< FrameState::surfaces_key() of what was seen
    std::optional<DepthSpan> span;  ///< metres; nothing: it saw nothing
    PassInfo info;
};

/// Buffers of what all shaders of a frame read: see frame/blocks.h.
struct Blocks {
    TexelBuffer frame{"frame uniforms"}, settings{"settings uniforms"};
    TexelBuffer disk{"places of disks"};  ///< of kernels that sample a circle
};

struct SceneFindings;
struct CasterFindings;

/// What outlives a frame and is no pass's own: programs, blocks, samplers, the scene, fitted lights.
struct Resources {
    std::shared_ptr<gl::ProgramCache> shared_programs;  ///< see Renderer's constructor
    gl::ProgramCache& programs;
    Blocks blocks;
    gl::VertexArray empty_vao;
    gl::Sampler map_nearest, map_compare, map_blended;
    std::unique_ptr<SceneGpu> scene;
    gl::Target camera_depth;               ///< of the picture's size; its key is of the surfaces that are in it
    std::shared_ptr<SceneFindings> found;  ///< see optimisations/scene_findings.h
    std::shared_ptr<CasterFindings> caster_findings;  ///< see passes/caster_findings.h
    PlacedLights placed;
    std::vector<FittedLight> as_placed;  ///< fitted without a camera
    std::uint64_t as_placed_key = 0;
    std::vector<FittedLight> fitted;  ///< for the frame's camera where a fit reads it
    std::uint64_t fit_key = 0;
    SeenDepths seen;
    /// Which drawing each key of contents is from; drawings are counted.
    std::map<const std::uint64_t*, std::uint64_t> drawings;
    std::uint64_t last_drawing = 0;

    explicit Resources(std::shared_ptr<gl::ProgramCache> of)
        : shared_programs(std::move(of)), programs(*shared_programs) {}
};

struct FrameState {
    const Scene& scene;
    Settings settings;  ///< sanitised and within the driver's limits
    FrameRequest request;
    Resources& gl;
    const DriverInfo& driver;

    Camera camera;
    std::optional<DepthSpan> seen_m;  ///< depths of all that it sees, where a fit asks for them
    glm::dvec3 origin{0};             ///< of camera-relative positions
    std::vector<int> first_view;      ///< per light: its first layer
    int view_count = 0;
    int map_resolution = 0;
    /// As gl::Target counts layers: 0 for a single view.
    int map_layers() const { return view_count > 1 ? view_count : 0; }
    GLenum map_format() const;                          ///< as OpenGL names it
    bool blurs_depths() const;                          ///< map.blur_texels has maps to blur
    bool has_contact_shadows(std::size_t light) const;  ///< contact shadows darken the light
    bool may_light_picture(std::size_t light) const;  ///< the light may change the picture: else shading leaves it out
    bool shades_as_lit(std::size_t light) const;      ///< shading looks nothing up of it: see never_shadows()
    bool paged = false;  ///< the maps are drawn by pages: there are some, and map.virtual acts
    bool separate_visibility = false;
    glm::ivec2 pixel_origin{0};                ///< of the picture's pixel that is (0, 0) in what is drawn
    std::vector<glm::vec2> disk_texels;        ///< places of the kernel's disks that shaders read from an image
    bool filter_sampler = false;               ///< the kernel compares in a shadow sampler
    std::vector<gl::Define> defines;           ///< from settings and kernel
    Key geometry_key, camera_key, lights_key;  ///< what results depend on
    std::vector<std::string> notes;

    /// Panes that show the same share one slot, which is the first such pane's number.
    struct ShownPane {
        int overlay = 0;  ///< as view.overlay
        int slot = 0;
        bool lacks_reference = false;  ///< `overlay` is 0 for that
        const Overlay* row() const { return overlay > 0 ? &overlays()[std::size_t(overlay - 1)] : nullptr; }
    };
    std::vector<ShownPane> panes;
    bool slabs_shown = false;           ///< view.slabs has a map to show
    ReferenceNeed reference;            ///< what the frame needs of a truth, and whether request.truth is it
    std::vector<ReferenceNeed> traced;  ///< as FrameResult::traced
    /// What rays found for a light whose source is ray traced; null: its source is another, or they are not traced yet.
    std::vector<const ReferencePicture*> traced_pictures;
    std::vector<LightMapNeed> light_maps;  ///< as FrameResult::light_maps
    /// The baked one of a light whose source it is; null: its source is another, or it is not baked yet.
    std::vector<const LightMap*> light_map_of_light;
    std::uint64_t reference_content = 0;  ///< key of what of it is used
    Plan plan;                            ///< see plan_frame()
    /// What of each of the maps is drawn: of the rest nothing is read. Once their passes are planned.
    std::vector<MapCells> layers_held;
    Key maps_extent;                    ///< of what the maps hold of all that they could; the same
    bool maps_are_whole = true;         ///< FrameResult::maps_are_whole; the same
    bool camera_depth_renewed = false;  ///< where the request forces it: once a frame

    /// How shaders read numbers of Blocks.
    bool blocks_as_images() const { return request.blocks_as_images.value_or(driver.blocks_as_images); }
    /// An image of a result; one without a texture where nothing of the frame makes it.
    const gl::Target& result(const ResultRef& of, std::size_t image = 0) const { return plan.target(of, image); }
    /// Binds results to the texture units that they were placed at. Done before each pass for what it reads.
    void bind_results(std::span<const ResultRef> results) const;
    void bind_results(std::initializer_list<ResultRef> results) const {
        bind_results(std::span(results.begin(), results.size()));
    }

    /// The view of a light whose map is shown (view.light, view.face), or null. `layer` is its layer of the maps.
    const LightView* shown_view(int* layer = nullptr) const;
    /// The depth curve of what the map viewer shows, or null when there is nothing to show.
    const DepthCurve* shown_curve() const;
    /// The mip level of the moment that the map viewer shows.
    int shown_mip() const;
    /// Whether the map viewer's greys follow what is drawn (view.map_fit).
    bool fits_grey_range() const;
    /// Of the surfaces that the camera sees, in the size of the picture.
    Key surfaces_key() const;
    /// Of the settings that a kind of pass reads itself (Param::read_by), on top of `from`.
    Key with_settings(Key from, ReadBy pass) const;
    /// Of what shaders find out about their light and shadow, but for what they sample.
    Key lighting_key() const;
    /// The same for the light shown.
    Key shown_light_key() const { return with_settings(lighting_key(), ReadBy::OneLight); }
    /// The results that are a pane's finished picture and its overlay's values.
    ResultRef pane_picture_result(const ShownPane& pane) const;
    ResultRef pane_values_result(const ShownPane& pane) const;
    std::string preamble;      ///< GLSL before every shader: settings block, facts about the lights
    bool mask_levels = false;  ///< some caster's mask may be read from a coarser mip level
    /// Whether the unfiltered map is not the map as drawn, but one of its own.
    bool needs_unfiltered_map() const;
    bool surface_flags = false;  ///< some object or material needs the per-object flags

    /// The program of a scene or full-screen pass under the frame's settings. Of the extra defines those whose name
    /// ends in _FILE say which file such an include stands for; others take the place of the frame's of their name.
    GLuint program(std::string_view vertex, std::string_view fragment, std::vector<gl::Define> extra = {}) const;
    /// Draws the batches that `filter` accepts from the camera with the fragment shader given, textures bound.
    void draw_from_camera(std::string_view fragment, const std::vector<gl::Define>& extra, PassInfo& info) const;
    /// The program for one batch, with what its material and objects call for.
    GLuint batch_program(std::string_view vertex, std::string_view fragment, const std::vector<gl::Define>& extra,
                         const Batch& batch, bool alpha_only) const;
    /// Binds what the batch's fragments sample.
    void bind_textures(const Batch& batch) const;
    /// Prepares depth test and write as passes from the camera have them; see CameraPass for those of the picture.
    void begin_camera_pass(GLuint framebuffer) const;
    /// Prepares a pass that computes every pixel of a framebuffer by one triangle; draw it with draw_fullscreen().
    void begin_fullscreen_pass(GLuint framebuffer, int width, int height) const;
    static void draw_fullscreen(PassInfo& info);
    /// Draws no more than these pixels of it.
    static void draw_fullscreen(std::span<const TexelRect> rects, PassInfo& info);
};

}  // namespace si
