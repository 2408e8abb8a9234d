// Input and output of one frame: FrameRequest goes in, FrameResult comes out.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/float_image.h"
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

struct ImportedMaps;

struct ReferencePicture;
struct LightMap;
struct LiveError;
struct Precision;
namespace gl {
struct Target;
}

/// Outputs that a frame should produce. Passes that no output depends on do not run.
struct Outputs {
    bool colour = true;            ///< pictures of all panes: shaded, with overlays and texel quads
    bool shadow_map = false;       ///< stored depths, and the map viewer's picture of them
    bool visibility = false;       ///< one float per pixel for view.light, 1 lit, 0 in shadow
    bool overlay = false;          ///< raw values of the panes' overlays
    bool surface_ids = false;      ///< object and triangle behind each pixel
    bool map_coordinates = false;  ///< kernel centre of each pixel in the map of view.light
    bool texels_read = false;      ///< texels of the shown map that kernels of any pixel fetch
    bool error = false;            ///< error metrics of view.light against FrameRequest::reference, which must be set
    bool classified = false;       ///< error class of each pixel; needs FrameRequest::reference
    bool compared = false;         ///< as `classified`, without causes of errors
    bool precision = false;        ///< error of look-ups by single precision: FrameResult::precision
    bool evidence = false;         ///< CauseEvidence of every pixel; uses FrameRequest::reference if set
    bool unfiltered_map = false;   ///< unfiltered map and the kernel's inputs, for trials of a probed pixel
    bool true_colour = false;      ///< picture lit by the ray-traced reference; needs FrameRequest::reference
    bool health = false;           ///< search for NaN and other number faults: Renderer::numeric_health()
    bool operator==(const Outputs&) const = default;
};

/// Camera that shadow maps are fitted to in place of the picture's camera. Used to show the maps of one camera from
/// another place.
struct MapCamera {
    Camera camera;
    /// Measured depth range of the surfaces that this camera sees, metres: FrameResult::seen_m of its own picture.
    std::optional<DepthSpan> seen_m;
    bool operator==(const MapCamera&) const = default;
};

/// Index of one shadow map image: the light, and its view (0 for a single map, else the number of the cube face,
/// cascade or clip level).
struct MapOfLight {
    int light = 0, view = 0;
    bool operator==(const MapOfLight&) const = default;
};

/// Largest value of FrameRequest::smoothed, the number of shadings that are averaged into a smooth picture.
inline constexpr int kMaxSmoothedShadings = 8;
/// Name of the pass that makes FrameResult::smooth, the mean of several shadings of a static view.
inline constexpr std::string_view kSmoothingPass = "smoothing of a static view";

/// Request for one frame: size, outputs, and ray-traced data that its lights need. Input of Renderer::render().
struct FrameRequest {
    int width = 1280, height = 720;  ///< size of each pane's picture, pixels
    Outputs outputs;
    bool timing = false;     ///< measurement of each pass's time; costs time itself
    bool force = false;      ///< true: every pass runs even when its result is cached
    OptimisationSet forced;  ///< optimisations to disable: the same picture by more work
    /// True: shaders read settings and frame data from buffer images in place of uniform blocks. Nullopt:
    /// DriverInfo::blocks_as_images.
    std::optional<bool> blocks_as_images;
    std::optional<MapOfLight> emptied;  ///< map to draw without casters; not for virtual maps
    std::optional<MapSize> map_size;    ///< size of the maps; nullopt: square, map.resolution. Virtual maps are square
    /// Maps by light that are given instead of drawn; null or missing: drawn. May be shorter than the list of lights.
    std::vector<std::shared_ptr<const ImportedMaps>> imported;
    std::optional<MapCamera> map_camera;  ///< camera for fitting maps; nullopt: the picture's own
    /// True: draws with view.look and view.overlay_blend, and leaves empty texels of the map viewer transparent. False:
    /// draws plain pictures.
    bool with_look = false;
    int smoothed = 0;  ///< number of shadings to average in FrameResult::smooth; 0: no smooth picture
    /// Ray-traced reference of this view and light. A reference of another key is ignored: see FrameResult::reference.
    std::shared_ptr<const ReferencePicture> reference;
    /// Ray-traced visibility by light, for lights whose source is ray tracing. May be shorter than the list of lights.
    std::vector<std::shared_ptr<const ReferencePicture>> traced;
    /// Baked light maps by light, for lights whose source is a light map. May be shorter than the list of lights. A map
    /// of another scene, light or setting is ignored: see FrameResult::light_maps.
    std::vector<std::shared_ptr<const LightMap>> light_maps;
};

/// Execution state of a pass in a frame: drawn now, kept from an earlier frame, or not needed.
enum class PassState { Drawn, Cached, Skipped };

/// Category under which reports sum the times of passes.
enum class PassCategory {
    Maps,     ///< draws or prepares shadow maps, or what replaces them
    Picture,  ///< shades the picture, with the shadow look-ups
    Tool,     ///< measures, classifies or shows; no part of a real engine's frame
};

/// Report on one part of a pass, such as a cascade, a cube face, or the casters of a map: state, reason and draw
/// counts.
struct PartInfo {
    std::string name;  ///< "cascade 2 of light 0"
    PassState state = PassState::Skipped;
    std::string reason;
    std::uint64_t draws = 0, triangles = 0;
    std::uint64_t left_out = 0;      ///< number of skipped casters, triangles or taps, see `unit`
    std::string_view unit;           ///< "casters", "triangles", "taps"
    std::optional<Optimisation> by;  ///< optimisation that skipped the casters, triangles or taps; nullopt: none did
};

/// Report on one pass of a frame: state, reason, time and draw counts.
struct PassInfo {
    std::string name;
    PassState state = PassState::Skipped;
    std::string reason;
    double gpu_ms = 0, cpu_ms = 0;  ///< 0 unless FrameRequest::timing
    std::uint64_t draws = 0, triangles = 0;
    PassCategory category = PassCategory::Picture;
    int light = -1;                  ///< light index; below 0: all lights, or none
    std::optional<Result> makes;     ///< result that identifies the pass, the first that it writes
    std::string needs;               ///< request or setting that needs the pass: Pass::needs
    std::optional<Optimisation> by;  ///< optimisation that skips the pass, or that it is a part of
    std::vector<PartInfo> parts;     ///< parts of the pass; empty: it is undivided
    double wall_ms = 0;              ///< elapsed time where gpu_ms is processor time; otherwise 0
};

/// Reference to a texture that a frame drew: its OpenGL name and size. The user interface shows the texture, and the
/// renderer reads it back.
struct Image {
    unsigned texture = 0;
    int width = 0, height = 0;
};

/// One of the pictures that the split view shows side by side (view.panes), with the images drawn for it.
struct Pane {
    Image picture;    ///< RGBA8, sRGB-encoded, bottom row first; the shaded picture when nothing is drawn over it
    Image values;     ///< RGBA32F, x is the value of scalar overlays, a is 0 where nothing was drawn; empty: no overlay
    int overlay = 0;  ///< 0: none; else 1 + row in overlays()
    float overlay_min = 0, overlay_max = 1;  ///< range of the overlay's colour scale
    bool tinted = false;                     ///< the overlay is darkened by the picture: view.overlay_blend
    bool lacks_reference = false;            ///< overlay not drawn, as FrameRequest lacks its reference
};

/// Report on the ray-traced reference that a drawn frame depends on, and whether FrameRequest had that reference. If
/// not, the caller traces the reference and draws again.
struct ReferenceNeed {
    std::uint64_t key = 0;  ///< reference_key() of this frame; 0: not needed, or there is no light
    bool met = false;       ///< true: FrameRequest::reference has the needed key
};

/// Report on the baked light map that a light of a drawn frame depends on, and whether FrameRequest had that map. If
/// not, the caller bakes the map and draws again.
struct LightMapNeed {
    std::uint64_t key = 0;        ///< light_map_key() of this frame; 0: the light's source is another
    bool met = false;             ///< true: FrameRequest::light_maps held the map with the needed key
    int resolution = 0;           ///< required texels along a side
    std::uint64_t bytes = 0;      ///< size of the light map in use
    double texels_per_metre = 0;  ///< texel density of the light map in use
    std::size_t charts = 0;       ///< charts in the light map in use
    std::uint64_t rays = 0;       ///< rays traced to bake the map
    double bake_ms = 0;           ///< wall time of baking or reading from disk, before the frame
    bool from_disk = false;
};

/// Record of the images that a frame left in the renderer, with their cache keys. A later frame may overwrite the
/// images: Renderer::has_images_of() compares the keys.
struct FrameContents {
    /// One result of the frame: its image in the renderer, and the cache key that the image had when the frame ended.
    /// Renderer::has_images_of() compares this key with the image's current key.
    struct Part {
        Result of;
        const gl::Target* image;     ///< first image of the result; owned by the renderer
        const std::uint64_t* place;  ///< address of the image's current key; owned by the renderer
        std::uint64_t key, drawn;    ///< cache key after the frame, and number of the drawing that made the image
    };
    std::uint64_t renderer = 0;  ///< number of the renderer; 0: no frame was drawn
    std::vector<Part> parts;
};

/// Description of the depth image that a frame's map viewer shows: source, light, face, channel and mip level.
struct ShownMap {
    MapSource source = MapSource::Light;
    int light = -1, face = 0;  ///< light -1: none is shown
    int channel = 0;           ///< 0 depth, else 1 + channel of the kernel's moments
    std::string_view name;     ///< name of the shown depth moment
    int mip = 0;               ///< mip level of the shown depth moment
    glm::ivec2 texels{0};      ///< width and height of the shown level
};

/// Result of one frame: images, fitted lights, pass reports and measured numbers.
struct FrameResult {
    Camera camera;
    std::vector<FittedLight> lights;
    /// Maps by light that were given instead of drawn; null or missing: drawn. May be shorter than the list of lights.
    std::vector<std::shared_ptr<const ImportedMaps>> imported;
    std::optional<DepthSpan> seen_m;  ///< measured depth range of visible surfaces, where a fit needs it
    std::vector<PassInfo> passes;
    std::vector<std::string> notes;  ///< repairs of settings and other warnings for the user, one line each
    std::vector<Pane> panes;  ///< panes of view.panes, row by row from the top left; panes of one overlay share images
    bool contacts_darkened = false;  ///< the picture has contact darkening in creases (view.look), which is no shadow
    Image colour;                    ///< the first pane's picture
    /// RGBA8: mean of FrameRequest::smoothed shadings by a jittered camera. Panes without an overlay show it. Empty:
    /// not requested, or not available for this frame.
    Image smooth;
    Image visibility;  ///< R32F: visibility of view.light, 1 lit, 0 in shadow
    Image overlay;     ///< overlay values of the first pane: Pane::values
    /// RGBA32F: u and v of the kernel's centre in the map of view.light (v up, after the normal offset, not wrapped),
    /// the layer among that light's views, and 1 where the kernel reads a texel of the map, else 0. Empty if there is
    /// no map.
    Image map_coordinates;
    /// R32F, one value per texel of the map of view.light and view.face: 1 where some kernel fetches the texel, else 0.
    Image texels_read;
    Image surface_ids;                            ///< RG32UI, see SurfaceIds
    Image true_colour;                            ///< RGBA8: picture lit by the ray-traced reference, without overlays
    Image classified;                             ///< RG32F, see classified_pixels(); also set for Outputs::compared
    std::array<Image, kEvidenceImages> evidence;  ///< RGBA32F each, in the order of CauseEvidence
    bool mask_levels = false;                     ///< CauseContext::mask_levels of the evidence
    ReferenceNeed reference;
    std::vector<ReferenceNeed> traced;           ///< by light, for ray-traced lights; empty without any
    std::vector<LightMapNeed> light_maps;        ///< by light, for lights with a light map; empty without any
    std::shared_ptr<const LiveError> error;      ///< error metrics; null unless requested and reference.met
    std::shared_ptr<const Precision> precision;  ///< null unless requested, or where view.light has no map
    int map_resolution = 0;                      ///< texels along the longer side of a map
    MapSize map_size;                            ///< texels of each map
    bool map_holds_distances = false;            ///< maps store distances in place of depths: holds_distances()
    bool maps_are_whole = true;                  ///< false: maps hold only texels that the picture reads
    std::optional<PageFacts> pages;              ///< statistics of virtual maps; nullopt: no virtual maps
    float overlay_min = 0, overlay_max = 1;      ///< the first pane's colour scale
    Image map_view;                              ///< RGBA8: the depth image of view.map_source as view.map shows it
    ShownMap shown_map;                          ///< description of the depth image that `map_view` shows
    glm::ivec2 map_view_size{0};         ///< size of the map viewer's depth image; the picture of it may be smaller
    DepthCurve map_view_curve;           ///< mapping from distance to stored depth of the map viewer's image
    bool map_fitted = false;             ///< the grey range follows the drawn depths
    float map_black = 0, map_white = 1;  ///< grey range in use, on the scale of view.map_black, view.map_white
    std::string clock;                   ///< clock that measured gpu_ms
    FrameContents contents;
    /// Returns the frame's report on the pass called `name`; null if the frame has no such pass.
    const PassInfo* pass(std::string_view name) const;
    /// Returns the frame's report on the first pass whose main result (PassInfo::makes) is `makes`, such as
    /// Result::ShadowMaps; null if there is none.
    const PassInfo* pass(Result makes) const;
};

/// Object and triangle number of each pixel, read back from the GPU, top row first. x: 1 + index in Scene::objects; 0
/// where no object is visible. y: triangle number in the draw call. Some drivers continue the count through instances.
/// Therefore y modulo the mesh's triangle count is the number in the mesh.
struct SurfaceIds {
    int width = 0, height = 0;
    std::vector<glm::uvec2> data;
};
/// Image with four channels of 8 bits (RGBA), read back from the GPU, top row first.
struct ByteImage {
    int width = 0, height = 0;  ///< pixels
    std::vector<std::uint8_t> data;
    bool operator==(const ByteImage&) const = default;
};

}  // namespace si
