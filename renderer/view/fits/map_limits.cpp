#include "renderer/view/fits/map_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/lengths_text.h"
#include "renderer/bias/theory.h"

namespace si {
namespace {

constexpr double kFlat = 1e-6;  ///< least depth range as a share of the scene's radius

/// Part of the scene between one view's near and far planes.
struct Held {
    double nearest = 0, farthest = 0;  ///< metres along the axis
    double across = 0;                 ///< metres, the larger of width and height
};

Held held_by(const LightView& view, const SceneShape& shape) {
    Held held{view.curve.far, view.curve.near, 0};
    ViewExtent all;
    for (const Box& box : shape.boxes) {
        const ViewExtent e = extent_in_view(box, view);
        const double entry = view.curve.perspective ? pyramid_entry_m(e, view.cross_section()) : e.lo.z;
        if (!std::isfinite(entry)) continue;
        all.add(e);
        held.nearest = std::min(held.nearest, std::max(entry, view.curve.near));
        held.farthest = std::max(held.farthest, std::min(e.hi.z, view.curve.far));
    }
    if (held.farthest > held.nearest) held.across = std::max(all.hi.x - all.lo.x, all.hi.y - all.lo.y);
    return held;
}

/// Returns the largest step of the format between two distances, in metres along the axis.
double step_m(const DepthCurve& curve, MapFormat format, double nearest, double farthest) {
    double coarsest = 0;
    for (const double z : {nearest, farthest})
        coarsest = std::max(coarsest, depth_quantum(format, curve, curve.depth(z)) / curve.slope(z));
    return coarsest;
}

}  // namespace

MapLimits map_limits(const SceneShape& shape, const std::vector<LightView>& views, MapFormat format, int resolution) {
    MapLimits limits;
    bool any = false, one_step = true, one_texel = true;
    for (const LightView& view : views) {
        const Held held = held_by(view, shape);
        const double deep = held.farthest - held.nearest;
        if (!(deep > kFlat * shape.radius)) continue;
        any = true;
        // The last row of a warped view has the coarsest steps and texels.
        const DepthCurve curve = view.curve.curve_at_row(1);
        const double from = curve.depth(held.nearest), to = curve.depth(held.farthest);
        one_step &=
            std::abs(to - from) <= std::max(depth_quantum(format, curve, from), depth_quantum(format, curve, to));
        const double centre_m = glm::dot(view.axes[2], view.eye - shape.centre);
        const double texel = view.warped()
                                 ? view.texel_size_range(resolution).longest
                                 : view.texel_size(std::clamp(centre_m, held.nearest, held.farthest), resolution);
        one_texel &= texel >= held.across;
        limits.step_m = std::max(limits.step_m, step_m(curve, format, held.nearest, held.farthest));
        limits.depth_m = std::max(limits.depth_m, deep);
        limits.texel_m = std::max(limits.texel_m, texel);
        limits.across_m = std::max(limits.across_m, held.across);
    }
    limits.one_depth_step = any && one_step;
    limits.one_texel = any && one_texel;
    return limits;
}

std::vector<std::string> map_limit_notes(const MapLimits& limits, int light) {
    std::vector<std::string> notes;
    if (limits.one_depth_step)
        notes.push_back(fmt::format(
            "light {}: the whole depth of its map ({}) lies in one step of map.format ({}): no bias "
            "separates casters from receivers; bring light.near and light.far to the scene, or take a finer format",
            light, metres_text(limits.depth_m), metres_text(limits.step_m)));
    if (limits.one_texel)
        notes.push_back(
            fmt::format("light {}: one texel ({}) is larger than the scene ({} across): its map resolves no shape; "
                        "raise map.resolution or lower light.extent",
                        light, metres_text(limits.texel_m), metres_text(limits.across_m)));
    return notes;
}

}  // namespace si
