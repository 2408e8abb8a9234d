// What the passes of a frame make and read.
#pragma once

#include <compare>
#include <string_view>

namespace si {

enum class Result {
    PagesWanted,          ///< which pages of virtual maps look-ups read
    DrawnMaps,            ///< the shadow maps as drawn, or the pool of their pages with its page table
    ShadowMaps,           ///< those that are compared, shown and read back: as drawn, or their depths blurred
    Moments,              ///< functions of their depths, averaged
    MapBounds,            ///< their nearest and farthest depths, block by block
    CameraDepth,          ///< of the surfaces that the camera sees
    SurfaceIds,           ///< which triangle each pixel shows
    Blobs,                ///< what blobs leave of each light
    LightMap,             ///< what rays found of lights, on all surfaces
    ShadowVolumes,        ///< where no shadow volume of a light is
    Visibility,           ///< a layer a light: 1 lit, 0 in shadow
    UnfilteredMap,        ///< the maps without polygon offset and with masks at their finest level
    VisibleSurfaces,      ///< position and normals of every pixel
    Reference,            ///< what rays found
    Compared,             ///< which pixels differ from it
    Classified,           ///< and why
    Error,                ///< how far off the picture is, in numbers
    Evidence,             ///< all trials of every pixel
    ReferenceLitPicture,  ///< lit as the truth says
    Precision,            ///< how far look-ups are off by single precision
    Shaded,               ///< the picture
    Smooth,               ///< the mean of pictures from a camera turned by parts of a pixel
    Overlay,              ///< a pane's values
    Composed,             ///< those over the picture
    Slabs,                ///< a pane's picture with texels as slabs in it
    MapCoordinates,       ///< where in the map each pixel's kernel is centred
    TexelsRead,           ///< which texels of the map some kernel fetches
    MapChannel,           ///< one of the moments of the map that the viewer shows
    DepthRange,           ///< smallest and largest depth of what the map viewer shows
    MapView,              ///< the map viewer's picture
    Health,               ///< which numbers of all these are none, or lie where none can
};

/// A result in words: "shadow maps".
std::string_view result_name(Result result);

/// A result; of those that each pane has, one pane's.
struct ResultRef {
    Result what;
    int slot = 0;
    ResultRef(Result result, int pane_slot = 0) : what(result), slot(pane_slot) {}  // NOLINT: a Result is one
    auto operator<=>(const ResultRef&) const = default;
};

}  // namespace si
