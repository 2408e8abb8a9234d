// Fits of cascades: maps of a directional light for slices of the view frustum, tight or stabilised.
#include <algorithm>

#include "renderer/base/directions.h"
#include "renderer/base/finite.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/splits.h"
#include "renderer/view/cascades/cascades.h"
#include "renderer/view/fits/fit_context.h"
#include "renderer/view/fits/near_far.h"

namespace si {
namespace {

bool is_stabilised(const FitContext& c) {
    return c.settings.fit == LightFit::Stabilised;
}

/// Returns the camera depths in metres at which the cascades end; the last one is `all.to_m`.
std::vector<double> cascade_ends(FittedLight& light, const FitContext& c, const Camera& camera, const DepthSpan& all,
                                 int count) {
    const auto split = c.settings.split;
    if (split == Split::Manual) {
        std::vector<double> ends;
        for (int i = 0; i + 1 < count; ++i) {
            const double share = std::clamp(finite_or(manual_splits(c.settings)[std::size_t(i)], 1), 0.0, 1.0);
            ends.push_back(
                std::max(all.from_m + share * (all.to_m - all.from_m), ends.empty() ? all.from_m : ends.back()));
        }
        ends.push_back(all.to_m);
        return ends;
    }
    double lambda = split == Split::Uniform       ? 0
                    : split == Split::Logarithmic ? 1
                                                  : std::clamp(finite_or(c.settings.split_lambda, 0.5), 0.0, 1.0);
    // An orthographic camera sees all depths at one size, so cascades of equal depth are best.
    if (camera.orthographic) {
        if (split == Split::Logarithmic)
            add_note(light,
                     "light.split logarithmic: an orthographic camera sees all depths at one size, so they are "
                     "divided evenly");
        lambda = 0;
    }
    const double nearest = camera.orthographic ? all.from_m : std::max(all.from_m, kMinSeenDepthShare * all.to_m);
    return split_depths(nearest, all.to_m, count, lambda);
}

/// Fits the map of one slice. Across the light it contains the visible receivers of the slice; towards the light it
/// reaches to the first caster.
void fit_slice(FittedLight& light, LightView view, const FitContext& c, const Camera& camera, const DepthSpan& span,
               double margin) {
    std::vector<glm::dvec3> points, on_ground;
    const CameraSlice slice(camera, span.from_m, span.to_m);
    for (std::size_t i = 0; i < c.shape.boxes.size(); ++i) {
        if (!c.shape.box_receives[i]) continue;
        const std::vector<glm::dvec3> part = slice.visible_points(c.shape, i);
        std::vector<glm::dvec3>& all = i == c.shape.ground ? on_ground : points;
        all.insert(all.end(), part.begin(), part.end());
    }
    if (points.empty()) points.swap(on_ground);
    if (points.empty())  // no visible receiver
        for (std::size_t i = 0; i < c.shape.boxes.size(); ++i)
            if (i != c.shape.ground) points.insert(points.end(), c.shape.boxes[i].begin(), c.shape.boxes[i].end());
    if (fit_row(c.settings.fit).warps) return fit_warped(light, view, c, camera, points, on_ground, margin);
    ViewExtent seen = extent_in_view(points, view);
    if (!on_ground.empty()) widen_for_ground_shadow(seen, extent_in_view(on_ground, view));
    const DepthSpan receivers{seen.lo.z, seen.hi.z};
    const glm::dvec3 middle = 0.5 * (seen.lo + seen.hi);
    const double half = half_extent_with_margin(0.5 * std::max(seen.hi.x - seen.lo.x, seen.hi.y - seen.lo.y),
                                                c.shape.radius, c.resolution, margin);
    view.set_half_extents(glm::dvec2(half));
    for (std::size_t i = 0; i < c.shape.boxes.size(); ++i) {
        if (!c.shape.box_casts[i]) continue;
        const ViewExtent e = extent_in_view(c.shape.boxes[i], view);
        const bool beside = e.hi.x < middle.x - half || e.lo.x > middle.x + half || e.hi.y < middle.y - half ||
                            e.lo.y > middle.y + half;
        if (!beside) seen.lo.z = std::min(seen.lo.z, e.lo.z);
    }
    view.eye += view.axes * glm::dvec3(middle.x, middle.y, 0);
    set_parallel_range(view, c, {seen.lo.z, seen.hi.z}, &receivers);
    add_finished_view(light, view, c, 1);
}

/// Fits a map to the sphere around a slice, never larger than the sphere around the scene. The map keeps its size and
/// texel grid as the camera turns. As the camera moves the map moves by whole texels.
void fit_sphere(FittedLight& light, LightView view, const FitContext& c, const Camera& camera, const DepthSpan& span,
                double margin) {
    Sphere sphere = bounding_sphere(camera, span);
    if (!(sphere.radius < c.shape.radius)) sphere = {c.shape.centre, c.shape.radius};
    view.set_half_extents(glm::dvec2(half_extent_with_margin(sphere.radius, c.shape.radius, c.resolution, margin + 1)));
    const double texel = view.texel_size(1, c.resolution);
    // Positions relative to the scene's centre, so that a scene far from the origin loses no digits.
    const glm::dmat3 to_view = glm::transpose(view.axes);
    const glm::dvec3 away = to_view * (sphere.centre - c.shape.centre) / texel;
    const glm::dvec3 steps = c.settings.snap ? glm::round(away) : away;
    const double along = (to_view * (view.eye - c.shape.centre)).z;
    view.eye = c.shape.centre + view.axes * glm::dvec3(steps.x * texel, steps.y * texel, along);
    const ViewExtent all = extent_in_view(c.shape, view);
    set_parallel_range(view, c, {all.lo.z, all.hi.z});
    add_finished_view(light, view, c, 1);
}

}  // namespace

void fit_cascades(FittedLight& light, const FitContext& c, const Camera& camera) {
    const int count = std::clamp(c.settings.cascades, 1, kMaxCascades);
    const double blend = std::clamp(finite_or(c.settings.cascade_blend, 0), 0.0, 1.0);
    LightView view;
    view.axes = orthonormal_basis(light.to_light);
    view.eye = light.position;
    DepthSpan all = visible_depths(camera, c.shape.boxes, c.shape.box_receives)
                        .value_or(DepthSpan{camera.curve.near, camera.curve.far});
    if (is_stabilised(c))
        all = rotation_stable_depths(camera, c.shape.centre, c.shape.radius);
    else if (c.seen_m)
        all = *c.seen_m;
    const std::vector<double> ends = cascade_ends(light, c, camera, all, count);
    const double margin = lookup_reach_texels(c.all_settings);
    const bool by_map = c.settings.cascade_choice == CascadeChoice::Map;
    if (count > 1) light.chooser = {by_map ? ViewChoice::Map : ViewChoice::Interval, camera.eye, -camera.axes[2], {}};
    double begins = all.from_m, holds_from = begins;
    for (int i = 0; i < count; ++i) {
        const double end = ends[std::size_t(i)], blends_from = i + 1 < count ? end - blend * (end - begins) : end;
        (is_stabilised(c) ? fit_sphere : fit_slice)(light, view, c, camera, {holds_from, end}, margin);
        // Distance from the map's centre to the end of the part that the fit covers, without its margin.
        const double rim = std::max(0.5 - (margin - 0.5) / c.resolution, 0.3);
        if (count > 1 && by_map)
            light.chooser.spans.push_back({rim, i + 1 < count ? rim * (1 - blend) : rim});
        else if (count > 1)
            light.chooser.spans.push_back({end, blends_from});
        begins = end;
        holds_from = blends_from;
    }
}

}  // namespace si
