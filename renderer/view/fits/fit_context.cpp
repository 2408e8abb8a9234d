#include "renderer/view/fits/fit_context.h"

#include <fmt/format.h>

#include <cmath>

#include "renderer/base/finite.h"
#include "renderer/settings/fits.h"

namespace si {
namespace {

// Least depth range or width relative to `scale`: 1024 float steps. Smaller ones have no useful resolution.
constexpr double kMinShare = 1024.0 / (1 << 23);

/// Widens the range of `curve` about its middle to at least two texels and 1024 float steps of `scale`.
void widen_range(DepthCurve& curve, double texel, double scale) {
    const double least = std::max({2 * texel, kMinShare * scale, 1e-12});
    if (curve.far - curve.near >= least) return;
    const double middle = 0.5 * (curve.near + curve.far);
    curve.near = middle - 0.5 * least;
    curve.far = middle + 0.5 * least;
    if (curve.perspective && curve.near < kMinNearShare * curve.far) {
        curve.near = kMinNearShare * curve.far;
        curve.far = curve.near + least;
    }
}

/// Applies light.near and light.far where they are valid.
void manual_range(FittedLight& light, const LightSettings& s, DepthCurve& curve) {
    if (!uses_manual_near_far(s)) return;
    const double near = finite_or(s.near, 0), far = finite_or(s.far, 0);
    if (near != 0 && (near > 0 || !curve.perspective)) curve.near = near;
    if (far != 0) curve.far = far;
    if (near < 0 && curve.perspective)
        add_note(light, "a perspective map needs near > 0: light.near is fitted instead");
    if (!(curve.far > curve.near)) {
        add_note(light, fmt::format("near {:.6g} m is not below far {:.6g} m: far is moved behind near", curve.near,
                                    curve.far));
        curve.far = curve.near + std::max(std::abs(curve.near), 1e-6);
    }
}

/// Applies light.stretch.
void stretch_range(const LightSettings& s, DepthCurve& curve) {
    const double by = std::clamp(finite_or(s.stretch, 1), 1.0, 1e5);
    if (by == 1) return;
    if (curve.perspective) {
        curve.near /= by;
        curve.far *= by;
        return;
    }
    const double middle = 0.5 * (curve.near + curve.far), half = 0.5 * by * (curve.far - curve.near);
    curve.near = middle - half;
    curve.far = middle + half;
}

void step_view_forward(LightView& view) {
    DepthCurve& curve = view.curve;
    if (curve.perspective) return;
    const double step = eye_advance_m(curve.near, curve.far);
    view.eye -= view.axes[2] * step;
    curve.near -= step;
    curve.far -= step;
}

}  // namespace

void add_note(PlacedLight& light, std::string text) {
    if (std::find(light.notes.begin(), light.notes.end(), text) == light.notes.end())
        light.notes.push_back(std::move(text));
}

double eye_advance_m(double near, double far) {
    return far - near > kMinShare * std::max(std::abs(near), std::abs(far)) ? 0 : near;
}

double half_extent_with_margin(double half, double scale, int resolution, double margin) {
    const double share = resolution > 4 * margin ? 1 - 2 * margin / resolution : 0.5;
    return std::max(half, kMinShare * scale) / share;
}

void add_finished_view(FittedLight& light, LightView view, const FitContext& c, double reference_z) {
    manual_range(light, c.settings, view.curve);
    stretch_range(c.settings, view.curve);
    // Orthographic depth is affine, so distance matters only through the resolution of doubles.
    const double scale =
        view.curve.perspective ? view.curve.far : std::max(c.shape.radius, 0x1p-30 * std::abs(view.curve.far));
    widen_range(view.curve, view.texel_size(reference_z, c.resolution), scale);
    step_view_forward(view);
    view.update_depth();
    light.views.push_back(view);
}

}  // namespace si
