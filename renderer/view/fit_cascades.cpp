// Several maps of a sun, each for an interval of the camera's depth.
#include <algorithm>
#include <cmath>

#include "renderer/base/finite.h"
#include "renderer/settings/filters.h"
#include "renderer/view/cascades.h"
#include "renderer/view/fit_context.h"

namespace si {
namespace {

constexpr double kNearestSplit = 1e-3;  // of the farthest depth: a camera within the scene sees surfaces at 0 m

/// How far from where a surface lies in the map a look-up of it may lead: the kernel's reach, the normal offset, what
/// depth blur brings from aside, and half a texel of each end.
double reach_of_lookups(const Settings& s) {
    return reach_of(s).read + std::max(s.bias.normal, 0.0) + s.map.blur_texels + 1;
}

/// The map of one cascade: what it holds across the light is what the camera sees of receivers in its depths; towards
/// the light it reaches to the first caster.
void fit_cascade(FittedLight& light, LightView view, const FitContext& c, const Camera& camera, const DepthSpan& span,
                 double margin) {
    ViewExtent seen;
    const CameraSlice slice(camera, span.from_m, span.to_m);
    for (std::size_t i = 0; i < c.shape.boxes.size(); ++i) {
        if (!c.shape.box_receives[i]) continue;
        seen.add(extent_of(slice.seen_of(c.shape.boxes[i]), view));
    }
    if (!(seen.lo.x <= seen.hi.x)) seen = extent_of(c.shape, view);  // nothing will be looked up in it
    const glm::dvec3 middle = 0.5 * (seen.lo + seen.hi);
    view.half_width =
        with_margin(0.5 * std::max(seen.hi.x - seen.lo.x, seen.hi.y - seen.lo.y), c.shape.radius, c.resolution, margin);
    for (std::size_t i = 0; i < c.shape.boxes.size(); ++i) {
        if (!c.shape.box_casts[i]) continue;
        const ViewExtent e = extent_of(c.shape.boxes[i], view);
        const bool beside = e.hi.x < middle.x - view.half_width || e.lo.x > middle.x + view.half_width ||
                            e.hi.y < middle.y - view.half_width || e.lo.y > middle.y + view.half_width;
        if (!beside) seen.lo.z = std::min(seen.lo.z, e.lo.z);
    }
    view.eye += view.axes * glm::dvec3(middle.x, middle.y, 0);
    view.curve.perspective = false;
    view.curve.convention = c.convention;
    const double pad = kDepthMargin * (seen.hi.z - seen.lo.z);
    view.curve.near = seen.lo.z - pad;
    view.curve.far = seen.hi.z + pad;
    finish_view(light, view, c, 1);
}

}  // namespace

bool has_cascades(const LightSettings& s) {
    return s.cascades > 1 && s.type == int(LightType::Directional) && s.fit != int(LightFit::Manual) &&
           s.projection != int(LightProjection::Perspective);
}

void fit_cascades(FittedLight& light, const FitContext& c, const Camera& camera) {
    const int count = std::clamp(c.settings.cascades, 1, kMaxCascades);
    const double blend = std::clamp(finite_or(c.settings.cascade_blend, 0), 0.0, 1.0);
    LightView view;
    view.axes = orthonormal_basis(light.to_light);
    view.eye = light.position;
    const DepthSpan all = seen_depths(camera, c.shape.boxes, c.shape.box_receives)
                              .value_or(DepthSpan{camera.curve.near, camera.curve.far});
    // Parallel rays of the camera see all depths at one size, for which even cascades are right.
    const double lambda = camera.orthographic ? 0 : std::clamp(finite_or(c.settings.split_lambda, 0.5), 0.0, 1.0);
    const double nearest = camera.orthographic ? all.from_m : std::max(all.from_m, kNearestSplit * all.to_m);
    const std::vector<double> ends = split_depths(nearest, all.to_m, count, lambda);
    const double margin = reach_of_lookups(c.all_settings);
    const bool by_map = c.settings.cascade_choice == int(CascadeChoice::Map);
    light.chooser = {by_map ? ViewChoice::Map : ViewChoice::Interval, camera.eye, -camera.axes[2], {}};
    double begins = all.from_m, holds_from = begins;
    for (int i = 0; i < count; ++i) {
        const double end = ends[std::size_t(i)], blends_from = i + 1 < count ? end - blend * (end - begins) : end;
        fit_cascade(light, view, c, camera, {holds_from, end}, margin);
        const double rim = std::max(0.5 - (margin - 0.5) / c.resolution, 0.3);  // holds what the fit was for
        if (by_map)
            light.chooser.spans.push_back({rim, i + 1 < count ? rim * (1 - blend) : rim});
        else
            light.chooser.spans.push_back({end, blends_from});
        begins = end, holds_from = blends_from;
    }
}

}  // namespace si
