// Results that passes of a frame write and read.
#pragma once

#include <compare>
#include <string_view>

namespace si {

/// Kind of image or buffer that one pass of a frame writes and others read.
enum class Result {
    VisibleDepths,        ///< depth range of visible surfaces, measured before the plan
    PagesWanted,          ///< pages of virtual maps that look-ups read
    Pages,                ///< identifies the pass that draws pages; its images are those of DrawnMaps
    DrawnMaps,            ///< shadow maps as drawn, or the page pool with its page table
    ShadowMaps,           ///< maps to compare, show and read back: as drawn, or with blurred depths
    Moments,              ///< averaged functions of the maps' depths (VSM, ESM, MSM)
    MapBounds,            ///< two planes that bound the depths of each block of map texels
    CameraDepth,          ///< depth of visible surfaces
    SurfaceIds,           ///< triangle number of each pixel
    Blobs,                ///< visibility by blob shadows
    LightMap,             ///< baked light maps
    ShadowVolumes,        ///< visibility by stencil shadow volumes
    Visibility,           ///< visibility, one layer per light: 1 lit, 0 in shadow
    UnfilteredMap,        ///< the maps without polygon offset and with masks at their finest level
    VisibleSurfaces,      ///< position and normals of every pixel
    Reference,            ///< ray-traced reference
    Compared,             ///< pixels that differ from the reference
    Classified,           ///< causes of the wrong pixels
    Error,                ///< error metrics of the picture
    Evidence,             ///< CauseEvidence of every pixel
    ReferenceLitPicture,  ///< picture with the reference's visibility
    Precision,            ///< look-up errors by single precision
    Shaded,               ///< shaded picture
    Creases,              ///< shaded picture with contact darkening: view.look
    Flip,                 ///< difference between Shaded and ReferenceLitPicture as a person sees it
    Smooth,               ///< mean of pictures by a jittered camera
    Overlay,              ///< overlay values of one pane
    Composed,             ///< picture with the overlay of one pane
    Slabs,                ///< picture of one pane with map texels as quads
    MapCoordinates,       ///< kernel centre of each pixel in the map
    TexelsRead,           ///< map texels that some kernel fetches
    MapChannel,           ///< one depth moment of the shown map
    DepthRange,           ///< smallest and largest depth in the map viewer
    MapView,              ///< picture of the map viewer
    Health,               ///< invalid numbers in all other results
};

/// Returns a short name of a pass's result for reports, such as "shadow maps".
std::string_view result_name(Result result);

/// Reference to a result: an image or buffer that one pass writes and others read. `slot` is the index of the pane of
/// the split view, from 0, for a result that each pane has of its own (ShownPane::slot); 0 for other results.
struct ResultRef {
    Result what;
    int slot = 0;
    ResultRef(Result result, int pane_slot = 0) : what(result), slot(pane_slot) {}  // NOLINT: a Result is one
    auto operator<=>(const ResultRef&) const = default;
};

}  // namespace si
