#include "renderer/view/cascades/clip_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/base/directions.h"
#include "renderer/projection/camera.h"
#include "renderer/view/bounds/scene_shape.h"
#include "renderer/view/cascades/cascades.h"
#include "renderer/view/lights/light.h"

namespace si {
namespace {

constexpr double kDepthPad = 1e-3;              // share of the depth range added at each end
constexpr double kDepthSteps = 16;              // steps in a power of two of metres, on which the ends of the range lie
constexpr double kUnlimitedEnd_m = 1e30;        // metres; end of the coarsest level
constexpr double kMinUsedWidthShare = 1.0 / 8;  // least share of a map's width around its centre that is used

double power_above(double x) {
    return std::exp2(std::ceil(std::log2(std::max(x, 1e-12))));
}

/// Depth range of the scene along the light, widened to steps that small moves do not cross.
struct DepthRange {
    double towards = 0, away = 0, step = 1;  ///< metres along the axis that points to the light
};

DepthRange depth_range(const SceneShape& shape, const glm::dvec3& back) {
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (const Box& box : shape.boxes)
        for (const glm::dvec3& p : box) {
            lo = std::min(lo, glm::dot(back, p));
            hi = std::max(hi, glm::dot(back, p));
        }
    const double range = std::max(hi - lo, 1e-6 * std::max({shape.radius, std::abs(lo), std::abs(hi)}));
    const double pad = kDepthPad * range, step = power_above(range) / kDepthSteps;
    return {std::ceil((hi + pad) / step) * step, std::floor((lo - pad) / step) * step, step};
}

/// Extent of visible receivers across the light, and their largest distance from the camera.
struct SeenExtent : Bounds2 {
    double farthest_m = 0;
};

SeenExtent seen_extent(const SceneShape& shape, const Camera& camera, const glm::dmat3& axes) {
    SeenExtent seen;
    const CameraSlice slice(camera, camera.curve.near, camera.curve.far);
    for (std::size_t i = 0; i < shape.boxes.size(); ++i) {
        if (!shape.box_receives[i]) continue;
        for (const glm::dvec3& p : slice.visible_points(shape.boxes[i])) {
            seen.add({glm::dot(axes[0], p), glm::dot(axes[1], p)});
            seen.farthest_m = std::max(seen.farthest_m, glm::distance(p, camera.eye));
        }
    }
    return seen;
}

}  // namespace

glm::dvec3 page_origin(const SceneShape& shape) {
    const double step = power_above(shape.radius);
    return glm::round(shape.centre / step) * step;
}

ClipLevels clip_levels(const ClipLevelRequest& q, const SceneShape& shape, const Camera& camera) {
    ClipLevels out;
    const glm::dmat3 axes = orthonormal_basis(q.to_light);
    const DepthRange range = depth_range(shape, axes[2]);
    const double n = q.resolution, page = q.page_texels;
    // Texels around the camera that a level is sure to contain, since it is placed by whole pages.
    const double held = std::max(0.5 * n - 0.5 * page - q.margin_texels, kMinUsedWidthShare * n);

    glm::dvec2 centre(glm::dot(axes[0], camera.eye), glm::dot(axes[1], camera.eye));
    SeenExtent seen = seen_extent(shape, camera, axes);
    if (seen.empty()) seen = {{centre - shape.radius, centre + shape.radius}, 0};  // no visible receiver
    if (camera.orthographic) centre = 0.5 * (seen.lo + seen.hi);
    const glm::dvec2 farthest = glm::max(glm::abs(seen.lo - centre), glm::abs(seen.hi - centre));
    const double reach = std::max({farthest.x, farthest.y, 1e-9 * shape.radius});
    const double pixel =
        camera.orthographic ? camera.height / q.picture_lines : 2 * std::tan(0.5 * camera.fov_y_rad) / q.picture_lines;
    const double widest = pixel * std::exp2(q.bias);  // largest texel: metres, or metres per metre from the camera

    // The coarsest level contains all visible receivers, with texels no finer than the farthest one needs. An
    // orthographic camera sees all places at one size.
    const double asked = camera.orthographic ? widest * std::exp2(q.count - 1) : widest * seen.farthest_m;
    int coarsest = int(std::ceil(std::log2(std::max(reach / held, 0.5 * asked))));
    // Page numbers stay exact, and doubles resolve single texels.
    const double far_off = std::max({std::abs(centre.x), std::abs(centre.y), std::abs(range.towards)}) + reach;
    coarsest = std::max(coarsest, int(std::ceil(std::log2(far_off))) - 44 + q.count);

    out.chooser.choice = camera.orthographic ? ViewChoice::Map : ViewChoice::Distance;
    out.chooser.from_ws = camera.eye;
    for (int i = 0; i < q.count; ++i) {
        ClipLevel level{coarsest - (q.count - 1) + i, {}, range.towards + range.step};
        const double texel = level.texel_m(), page_m = page * texel;
        const glm::dvec2 corner = glm::round((centre - 0.5 * n * texel) / page_m);
        level.corner = {glm::i64(corner.x), glm::i64(corner.y)};
        const glm::dvec2 middle = corner * page_m + 0.5 * n * texel;
        LightView view;
        view.axes = axes;
        view.eye = axes * glm::dvec3(middle, level.eye_m);
        view.curve = {false, range.step, range.step + (range.towards - range.away), q.convention};
        view.set_half_extents(glm::dvec2(0.5 * n * texel));
        out.views.push_back(view);
        out.levels.push_back(level);
        const bool last = i + 1 == q.count;
        double ends = last ? kUnlimitedEnd_m : std::min(2 * texel / widest, held * texel);
        if (camera.orthographic) ends = std::max(0.5 - q.margin_texels / n, 0.3);
        out.chooser.spans.push_back({ends, ends});
    }
    return out;
}

LightView block_view(const LightView& of_level, const ClipLevel& level, int page_texels, const glm::i64vec2& grid_page,
                     glm::ivec2& page) {
    const glm::i64vec2 block(floor_div(grid_page.x, kBlockPages), floor_div(grid_page.y, kBlockPages));
    page = glm::ivec2(grid_page - block * glm::i64(kBlockPages));
    const double block_m = double(kBlockPages) * page_texels * level.texel_m();
    LightView view = of_level;
    const glm::dvec2 middle = (glm::dvec2(block) + 0.5) * block_m;
    view.eye = view.axes * glm::dvec3(middle, level.eye_m);
    view.set_half_extents(glm::dvec2(0.5 * block_m));
    return view;
}

}  // namespace si
