// The fit `view`: the region in which casters shadow visible receivers. Brabec, Annen, Seidel, Practical Shadow
// Mapping, Journal of Graphics Tools 7(4), 2002, call it the focus of a shadow map.
#include "renderer/view/fits/shadowed.h"

namespace si {

std::optional<MapRegion> fit_view(const FitInput& in) {
    if (!in.camera) return fit_casters(in);
    const DepthSpan depths = in.seen_m.value_or(DepthSpan{in.camera->curve.near, in.camera->curve.far});
    const CameraSlice seen(*in.camera, depths.from_m, depths.to_m);
    std::vector<ViewExtent> receivers(in.shape.boxes.size());
    for (std::size_t i = 0; i < receivers.size(); ++i)
        if (in.receives(i)) receivers[i] = lit_extent(in, i, &seen);
    return shadowed_region(in, receivers);
}

}  // namespace si
