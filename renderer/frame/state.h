// Everything the passes of one frame share: facts derived from scene and settings, and the context's resources.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/owned.h"
#include "renderer/frame/plan.h"
#include "renderer/frame/renderer.h"
#include "renderer/frame/scene_gpu.h"
#include "renderer/frame/texel_slabs.h"
#include "renderer/frame/value_range.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/program_cache.h"
#include "renderer/gl/target.h"
#include "renderer/gl/timer.h"
#include "renderer/settings/overlays.h"
#include "shaders/shared/frame.h"

namespace si {

/// Texture units, the same in every program (layout(binding) in shaders/).
enum Unit : GLuint {
    kShadowMap,
    kShadowMapCompare,
    kBaseColour,
    kVisibility,
    kShaded,
    kOverlayValues,
    kNormalMap,
    kTruth,
    kMoreTruth,
    kJudged,
    kUnfilteredMap,
    kSeenSurfaces,
    kMoments = kSeenSurfaces + 3,
    kVolumes
};

inline constexpr int kMaxPanes = 4;
inline constexpr int kSeenImages = 3;  ///< see lib/seen_surface.glsl

/// What one pane draws into, and the range fitted to its values.
struct PaneTargets {
    gl::Target values, composed, slabs;
    gl::Framebuffer values_framebuffer, composed_framebuffer, slabs_framebuffer;
    ValueRange fitted;
    std::uint64_t fitted_key = 0;  ///< of the values that `fitted` was found in
};

struct SlabResources {
    gl::VertexArray vao;
    gl::Buffer instances;
    int count = 0;
    std::vector<float> depths;  ///< stored depths of the region, bottom row first
    std::uint64_t depths_key = 0, instances_key = 0;
};

/// What outlives a frame: targets with the keys of their contents, programs, buffers.
struct Resources {
    gl::ProgramCache programs;
    gl::Buffer frame_block, settings_block;
    gl::VertexArray empty_vao;
    gl::Sampler map_nearest, map_compare;
    std::unique_ptr<SceneGpu> scene;
    Owned owned;                       ///< what single passes keep
    gl::Target map, map_depth;         ///< shadow maps, one layer per view; depth beside a colour map
    gl::Target map_blurred, map_rows;  ///< of map.blur_texels: the maps' depths blurred, and one layer along x only
    /// The shadow maps that are compared, shown and read back.
    const gl::Target& compared_map() const { return map_blurred.texture ? map_blurred : map; }
    std::vector<std::uint64_t> map_keys;  ///< per light: key of its layers' contents
    gl::Target camera_depth, visibility, shaded, map_coordinates, depth_range, map_view;
    gl::Target surface_ids;  ///< RG32UI
    std::array<PaneTargets, kMaxPanes> panes;
    gl::Texture visibility_view;  ///< one layer of visibility as a 2-D texture
    int visibility_view_layer = -1;
    gl::Framebuffer map_framebuffer, camera_depth_framebuffer, visibility_framebuffer, shaded_framebuffer,
        map_coordinates_framebuffer, depth_range_framebuffer, map_view_framebuffer, surface_ids_framebuffer;
    SlabResources slabs;
    gl::Target truth, more_truth;              ///< of the truth picture; the key of `truth` is its version
    std::array<gl::Target, kSeenImages> seen;  ///< RGBA32F; the key of all is the first one's
    gl::Target judged;                         ///< RG32F, see judgement() in lib/truth.glsl
    gl::Target error_tiles;                    ///< RGBA32F, see error_tiles.frag.glsl
    std::uint64_t causes_key = 0;              ///< of `judged` with the causes in it
    gl::Target marks;                          ///< depths MARK_* of shared/judged.h
    gl::Target map_unfiltered;                 ///< the maps without polygon offset, masks at their finest level
    std::array<gl::Target, kEvidenceImages> evidence;
    gl::Target true_visibility, true_shaded;
    gl::Framebuffer seen_framebuffer, judged_framebuffer, evidence_framebuffer, error_tiles_framebuffer,
        true_shaded_framebuffer;
    std::shared_ptr<const LiveError> error;  ///< of the error tiles
    std::uint64_t depth_key = 0;             ///< of the camera depth: what of the scene is in it
    PlacedLights placed;
    std::vector<FittedLight> as_placed;  ///< fitted without a camera
    std::uint64_t as_placed_key = 0;
    std::vector<FittedLight> fitted;  ///< for the frame's camera where a fit reads it
    std::uint64_t fit_key = 0;
    glm::vec2 drawn_range{0, 1};  ///< smallest and largest drawn depth, as in depth_range
    /// Which drawing each key of contents is from; drawings are counted.
    std::map<const std::uint64_t*, std::uint64_t> drawings;
    std::uint64_t last_drawing = 0;
};

struct FrameState {
    const Scene& scene;
    Settings settings;  ///< sanitised and within the driver's limits
    FrameRequest request;
    Resources& gl;
    const DriverInfo& driver;

    Camera camera;
    glm::dvec3 origin{0};         ///< of camera-relative positions
    std::vector<int> first_view;  ///< per light: its first layer
    int view_count = 0;
    int map_resolution = 0;
    bool separate_visibility = false;
    glm::ivec2 pixel_origin{0};                          ///< of the picture's pixel that is (0, 0) in what is drawn
    bool filter_sampler = false;                         ///< the kernel compares in a shadow sampler
    std::vector<gl::Define> defines;                     ///< from settings and kernel
    Key geometry_key, camera_key, lights_key, maps_key;  ///< what results depend on
    std::vector<std::string> notes;

    /// Panes that show the same share one slot, which is the first such pane's number.
    struct ShownPane {
        int overlay = 0;  ///< as view.overlay
        int slot = 0;
        bool lacks_truth = false;  ///< `overlay` is 0 for that
        const Overlay* row() const { return overlay > 0 ? &overlays()[std::size_t(overlay - 1)] : nullptr; }
    };
    std::vector<ShownPane> panes;
    bool slabs_shown = false;       ///< view.slabs has a map to show
    TruthNeed truth;                ///< what the frame needs of a truth, and whether request.truth is it
    std::vector<TruthNeed> traced;  ///< as FrameResult::traced
    /// What rays found for a light whose source is ray traced; null: its source is another, or they are not traced yet.
    std::vector<const TruthPicture*> traced_pictures;
    std::uint64_t truth_content = 0;  ///< key of what of it is used

    /// The view of a light whose map is shown (view.light, view.face), or null. `layer` is its layer of the maps.
    const LightView* shown_view(int* layer = nullptr) const;
    /// The depth curve of what the map viewer shows, or null when there is nothing to show.
    const DepthCurve* shown_curve() const;
    /// Whether the map viewer's greys follow what is drawn (view.map_fit), and which greys it uses.
    bool fits_greys() const;
    glm::vec2 grey_range() const;
    Key camera_depth_key() const;
    /// The results that are a pane's finished picture and its overlay's values; the picture's target.
    ResultRef picture_of(const ShownPane& pane) const;
    ResultRef values_of(const ShownPane& pane) const;
    const gl::Target& target_of(const ShownPane& pane) const;
    /// The colour scale of a pane. A fitted one reads back the pane's values, once for each change of them.
    ValueRange range_of(const ShownPane& pane) const;
    std::string preamble;      ///< GLSL before every shader: settings block, facts about the lights
    bool mask_levels = false;  ///< some caster's mask may be read from a coarser mip level
    /// Whether the unfiltered map is not the map as drawn, but one of its own.
    bool draws_unfiltered() const;
    /// The map that the nearest texel's trials read.
    const gl::Target& unfiltered_map() const { return draws_unfiltered() ? gl.map_unfiltered : gl.map; }
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
    /// Prepares depth test and write for a camera pass into a framebuffer that holds the camera depth.
    void begin_camera_pass(GLuint framebuffer) const;
    void bind_maps() const;
    /// Prepares a pass that computes every pixel of a framebuffer by one triangle; draw it with draw_fullscreen().
    void begin_fullscreen_pass(GLuint framebuffer, int width, int height) const;
    static void draw_fullscreen(PassInfo& info);
};

/// Writes what rays found into a light's layer of a visibility texture of the frame's size.
void put_traced_visibility(const TruthPicture& truth, const gl::Target& visibility, int light);

/// Defines and texture for shaders that read the truth (lib/truth.glsl).
std::vector<gl::Define> truth_defines(const FrameState& f);
void bind_truth(const FrameState& f);

// One function per pass; each appends itself to the plan. (renderer/passes/)
void add_light_depth_passes(FrameState& f, std::vector<Pass>& plan);
void add_depth_blur_pass(FrameState& f, std::vector<Pass>& plan);
/// What a sampler finds beyond a map's sides, by map.wrap; with a border, that in each channel.
void set_map_wrap(GLuint sampler, const MapSettings& map, float border);
/// Mean and mean square of the maps' depths, for kernels that read those.
void add_moments_pass(FrameState& f, std::vector<Pass>& plan);
void bind_moments(const FrameState& f);
/// What a pass reads that evaluates the kernel.
std::vector<ResultRef> lookup_reads(const FrameState& f);
void add_camera_depth_pass(FrameState& f, std::vector<Pass>& plan);
void add_surface_ids_pass(FrameState& f, std::vector<Pass>& plan);
void add_visibility_pass(FrameState& f, std::vector<Pass>& plan);
/// Draws the maps again where what is compared is not what a caster's surface is: see FrameState::unfiltered_map().
void add_unfiltered_map_pass(FrameState& f, std::vector<Pass>& plan);
/// The surface of every pixel, kept while the camera rests.
void add_seen_surfaces_pass(FrameState& f, std::vector<Pass>& plan);
void bind_seen_surfaces(std::span<const gl::Target, kSeenImages> seen);
/// Uploads the truth, compares each pixel with it, finds why some are wrong, and sums up.
void add_truth_passes(FrameState& f, std::vector<Pass>& plan);
/// All trials of every pixel of a light into eight colour attachments, see CauseEvidence.
void draw_evidence(const FrameState& f, int light, bool truth_known, PassInfo& info);
void add_true_shade_pass(FrameState& f, std::vector<Pass>& plan);
void add_shade_pass(FrameState& f, std::vector<Pass>& plan);
void add_pane_passes(FrameState& f, std::vector<Pass>& plan);
void add_map_coordinates_pass(FrameState& f, std::vector<Pass>& plan);
/// Which texels of the shown map the kernels of all pixels fetch, exactly.
void add_texels_read_pass(FrameState& f, std::vector<Pass>& plan);
Image texels_read_image(const FrameState& f);
void add_map_view_passes(FrameState& f, std::vector<Pass>& plan);
/// Of one pane, over its picture so far, whose key is `under_key`. The caller names it and what it reads and writes.
Pass slabs_pass(FrameState& f, const FrameState::ShownPane& pane, std::uint64_t under_key);

}  // namespace si
