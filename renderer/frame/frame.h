// What a frame is asked for and what it answers: settings go in, facts come out.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/causes.h"
#include "renderer/frame/numeric_health.h"
#include "renderer/frame/optimisation_set.h"
#include "renderer/frame/page_facts.h"
#include "renderer/frame/results.h"
#include "renderer/projection/camera.h"
#include "renderer/projection/depth_span.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

struct ReferencePicture;  // renderer/reference/reference_picture.h
struct LightMap;          // renderer/reference/light_map.h
struct LiveError;         // renderer/reference/live_error.h
struct Precision;         // renderer/reference/precision.h
namespace gl {
struct Target;
}

/// Outputs a frame can be asked for. Passes nobody's output depends on do not run.
struct Outputs {
    bool colour = true;            ///< the panes' pictures: shaded, with their overlays and the texel slabs over them
    bool shadow_map = false;       ///< the depth as stored, and the map viewer's picture of it
    bool visibility = false;       ///< one float per pixel for view.light, 1 lit, 0 in shadow
    bool overlay = false;          ///< the raw values of the panes' overlays
    bool surface_ids = false;      ///< the object and triangle behind each pixel
    bool map_coordinates = false;  ///< where in the map of view.light each pixel's kernel is centred
    bool texels_read = false;      ///< which texels of the shown map the kernels of all pixels fetch
    bool error = false;       ///< what is wrong with the shadows of view.light, in numbers; needs FrameRequest::truth
    bool classified = false;  ///< the same pixel by pixel; needs FrameRequest::truth
    bool precision = false;   ///< how far look-ups are off by single precision: FrameResult::precision
    bool evidence = false;  ///< all trials of every pixel (CauseEvidence); takes FrameRequest::truth where it is there
    bool unfiltered_map = false;  ///< what trials of a probed pixel read is up to date
    bool true_colour = false;     ///< the picture as the truth lights it; needs FrameRequest::truth
    bool health = false;          ///< whether all its numbers are sound: Renderer::numeric_health()
    bool operator==(const Outputs&) const = default;
};

/// The camera that maps are made for, where it is not the picture's.
struct MapCamera {
    Camera camera;
    /// Depths of all that it sees, where they were measured: FrameResult::seen_m of its own picture.
    std::optional<DepthSpan> seen_m;
    bool operator==(const MapCamera&) const = default;
};

/// One shadow map image of a light: the whole map, a face or a cascade.
struct MapOfLight {
    int light = 0, view = 0;
    bool operator==(const MapOfLight&) const = default;
};

/// The most that FrameRequest::smoothed asks for.
inline constexpr int kMaxSmoothedShadings = 8;
/// Name of the pass that makes it.
inline constexpr std::string_view kSmoothingPass = "smoothing at rest";

struct FrameRequest {
    int width = 1280, height = 720;  ///< of each pane's picture, in pixels
    Outputs outputs;
    bool timing = false;                   ///< measure each pass (costs time itself)
    bool force = false;                    ///< run every pass even when its result is cached
    OptimisationSet forced;                ///< savings not to make: the same picture by more work
    std::optional<bool> blocks_as_images;  ///< how shaders read numbers (Blocks); nothing: DriverInfo::blocks_as_images
    std::optional<MapOfLight> emptied;     ///< left as if nothing cast into it: what does it show? Not of virtual maps
    std::optional<MapCamera> map_camera;   ///< nothing: the picture's own
    int smoothed = 0;  ///< shadings beside the picture that a smooth one is made of so far: FrameResult::smooth
    /// What rays found for this very view and light; another one's is left unused. See FrameResult::truth.
    std::shared_ptr<const ReferencePicture> reference;
    /// The same by light, for those whose source is ray traced; may end early, and hold none for others.
    std::vector<std::shared_ptr<const ReferencePicture>> traced;
    /// By light, for those whose source is a light map; may end early, and hold none for others. Those of another
    /// scene, light or setting are left unused: see FrameResult::light_maps.
    std::vector<std::shared_ptr<const LightMap>> light_maps;
};

enum class PassState { Drawn, Cached, Skipped };

/// What a pass's time is booked under.
enum class PassCategory {
    Maps,     ///< draws shadow maps or what stands for them, or prepares them for look-ups
    Picture,  ///< shades, with the look-ups
    Tool,     ///< judges, measures or shows; no part of what an engine would draw
};

/// What a pass did of one thing that it could have done: a cascade, a face, the casters of a map.
struct PartInfo {
    std::string name;  ///< "cascade 2 of light 0"
    PassState state = PassState::Skipped;
    std::string reason;
    std::uint64_t draws = 0, triangles = 0;
    std::uint64_t left_out = 0;      ///< of what `unit` names, by `by`
    std::string_view unit;           ///< "casters", "triangles", "taps"
    std::optional<Optimisation> by;  ///< the saving that spared it, wholly or in part; nothing: none did
};

struct PassInfo {
    std::string name;
    PassState state = PassState::Skipped;
    std::string reason;
    double gpu_ms = 0, cpu_ms = 0;  ///< 0 unless timing was asked for
    std::uint64_t draws = 0, triangles = 0;
    PassCategory category = PassCategory::Picture;
    int light = -1;               ///< that it is for; below 0: for all, or for none
    std::vector<PartInfo> parts;  ///< empty: the pass is one thing
};

/// A texture of the frame: a GL name that the UI shows and the renderer can read back.
struct Image {
    unsigned texture = 0;
    int width = 0, height = 0;
};

/// One picture of the split view.
struct Pane {
    Image picture;    ///< RGBA8, sRGB-encoded, bottom row first; the shaded picture when nothing is drawn over it
    Image values;     ///< RGBA32F, x is the value of scalar overlays, a is 0 where nothing was drawn; empty: no overlay
    int overlay = 0;  ///< 0 none, else row of the overlay table + 1
    float overlay_min = 0, overlay_max = 1;  ///< the colour scale in use
    bool lacks_reference = false;  ///< its overlay needs a truth that FrameRequest did not bring; it is not drawn
};

/// What truth a frame asks for, and whether it had it.
struct ReferenceNeed {
    std::uint64_t key = 0;  ///< reference_key() of this frame; 0: nothing asks for it, or there is no light
    bool met = false;       ///< FrameRequest::truth was the one
};

/// What light map a light asks for, and whether the frame had it.
struct LightMapNeed {
    std::uint64_t key = 0;        ///< light_map_key() of this frame; 0: the light's source is another
    bool met = false;             ///< FrameRequest::light_maps held it
    int resolution = 0;           ///< texels a side that it is to have
    std::uint64_t bytes = 0;      ///< of the one used
    double texels_per_metre = 0;  ///< of the same
    std::size_t charts = 0;       ///< of the same
    std::uint64_t rays = 0;       ///< that it was baked by
    double bake_ms = 0;           ///< wall time before the frame, of reading where it was kept on disk
    bool from_disk = false;
};

/// What of a frame lies in the renderer's images, where a later frame may take its place: see
/// Renderer::has_images_of().
struct FrameContents {
    struct Part {
        Result of;
        const gl::Target* image;     ///< the first of it; the renderer's
        const std::uint64_t* place;  ///< where the key of what is there stands; the renderer's
        std::uint64_t key, drawn;    ///< as the frame left it, and which drawing that was
    };
    std::uint64_t renderer = 0;  ///< which one drew it; 0: none did
    std::vector<Part> parts;
};

/// The depth image that a frame's map viewer shows.
struct ShownMap {
    MapSource source = MapSource::Light;
    int light = -1, face = 0;  ///< light -1: none is shown
    int channel = 0;           ///< 0 depth, else 1 + channel of the kernel's moments
    std::string_view name;     ///< of that moment
    int mip = 0;               ///< level of it
    glm::ivec2 texels{0};      ///< across what is shown: of the level
};

struct FrameResult {
    Camera camera;
    std::vector<FittedLight> lights;
    std::optional<DepthSpan> seen_m;  ///< depths of all that the camera sees, where a fit asked for them
    std::vector<PassInfo> passes;
    std::vector<std::string> notes;  ///< repairs of settings and other one-line remarks
    std::vector<Pane> panes;  ///< as view.panes says, row by row from the top left; panes of one overlay share images
    Image colour;             ///< the first pane's picture
    /// RGBA8: the mean of FrameRequest::smoothed shadings, each of a camera turned by part of a pixel. Panes without an
    /// overlay show it. Empty: none was asked for, or nothing but the picture itself is to be had.
    Image smooth;
    Image visibility;  ///< R32F
    Image overlay;     ///< the first pane's values
    /// RGBA32F: u and v of the kernel's centre in the map of view.light (v up, after the normal offset, not wrapped),
    /// the layer among that light's views, and 1 where the kernel reads a texel of it, else 0. Empty without a map.
    Image map_coordinates;
    Image
        texels_read;  ///< R32F, a value a texel of the map of view.light and view.face: 1 where some kernel fetches it
    Image surface_ids;                            ///< RG32UI, see SurfaceIds
    Image true_colour;                            ///< RGBA8, as `colour` without overlays
    Image classified;                             ///< RG32F, see classified_pixels()
    std::array<Image, kEvidenceImages> evidence;  ///< RGBA32F each, in the order of CauseEvidence
    bool mask_levels = false;                     ///< of the evidence's CauseContext
    ReferenceNeed reference;
    std::vector<ReferenceNeed> traced;           ///< by light, of those whose source is ray traced; empty where none is
    std::vector<LightMapNeed> light_maps;        ///< by light, of those whose source that is; empty where none is
    std::shared_ptr<const LiveError> error;      ///< null unless asked for and truth.met
    std::shared_ptr<const Precision> precision;  ///< null unless asked for, or where view.light has no map
    int map_resolution = 0;
    bool map_holds_distances = false;        ///< see holds_distances()
    bool maps_are_whole = true;              ///< else they hold no more than look-ups of the picture read
    std::optional<PageFacts> pages;          ///< of virtual maps; empty: maps are whole
    float overlay_min = 0, overlay_max = 1;  ///< the first pane's colour scale
    Image map_view;                          ///< RGBA8: the depth image of view.map_source as view.map shows it
    ShownMap shown_map;                      ///< which depth image that is
    glm::ivec2 map_view_size{0};             ///< of that depth image; the picture of it may be smaller
    DepthCurve map_view_curve;               ///< what its depths mean
    float map_black = 0, map_white = 1;      ///< the grey range in use, as view.map_black and view.map_white count it
    std::string clock;                       ///< what gpu_ms was measured with
    FrameContents contents;
    const PassInfo* pass(std::string_view name) const;
};

/// Pixel values read back, top row first.
struct FloatImage {
    int width = 0, height = 0, channels = 1;
    std::vector<float> data;
    float at(int x, int y, int c = 0) const { return data[(std::size_t(y) * width + x) * channels + c]; }
};
/// Which triangle each pixel shows, top row first. x: 1 + index in Scene::objects, 0 for nothing. y: the triangle's
/// number in its draw; modulo the mesh's triangle count its number in the mesh, as some drivers count on through
/// instances.
struct SurfaceIds {
    int width = 0, height = 0;
    std::vector<glm::uvec2> data;
};
struct ByteImage {
    int width = 0, height = 0;  ///< RGBA
    std::vector<std::uint8_t> data;
    bool operator==(const ByteImage&) const = default;
};

}  // namespace si
