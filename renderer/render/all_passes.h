// List of all passes of a renderer.
#pragma once

#include <vector>

#include "renderer/passes/blobs.h"
#include "renderer/passes/camera_images.h"
#include "renderer/passes/depth_blur.h"
#include "renderer/passes/flip.h"
#include "renderer/passes/light_depth.h"
#include "renderer/passes/light_map.h"
#include "renderer/passes/map_bounds.h"
#include "renderer/passes/map_view.h"
#include "renderer/passes/moments.h"
#include "renderer/passes/numeric_health.h"
#include "renderer/passes/pages.h"
#include "renderer/passes/panes.h"
#include "renderer/passes/precision.h"
#include "renderer/passes/reference.h"
#include "renderer/passes/shade.h"
#include "renderer/passes/shadow_volumes.h"
#include "renderer/passes/texels_read.h"
#include "renderer/passes/visibility.h"

namespace si {

/// All pass objects of a renderer. A pass that uses another pass gets a reference to it in its constructor.
struct AllPasses {
    PagePasses pages;
    LightDepthPasses light_depth;
    DepthBlurPass depth_blur;
    MomentsPass moments;
    MapBoundsPass map_bounds;
    CameraDepthPass camera_depth;
    SurfaceIdsPass surface_ids;
    ShadowVolumePasses shadow_volumes;
    VisibleSurfacesPass seen_surfaces;
    BlobPass blobs;
    LightMapPass light_map;
    VisibilityPass visibility{shadow_volumes, light_map};
    UnfilteredMapPass unfiltered_map{light_depth, pages};
    ReferencePasses reference;
    ReferenceShadePass reference_shade;
    ShadePasses shade;
    FlipPass flip;
    PrecisionPass precision;
    PanePasses panes{pages};
    MapCoordinatesPass map_coordinates;
    TexelsReadPass texels_read;
    MapViewPasses map_view;
    NumericHealthPass numeric_health{pages};

    /// Returns all passes in the order of declaration: each after those whose results it reads.
    /// @param paged true: virtual maps find their pages by the visible surfaces, whose pass then comes first
    std::vector<FramePass*> in_order(bool paged) {
        std::vector<FramePass*> out;
        if (paged) out.push_back(&seen_surfaces);
        out.insert(out.end(), {&pages, &light_depth, &depth_blur, &moments, &map_bounds, &camera_depth, &surface_ids,
                               &shadow_volumes});
        if (!paged) out.push_back(&seen_surfaces);
        out.insert(out.end(), {&blobs, &light_map, &visibility, &unfiltered_map, &reference, &reference_shade, &shade,
                               &flip, &precision, &panes, &map_coordinates, &texels_read, &map_view, &numeric_health});
        return out;
    }
};

}  // namespace si
