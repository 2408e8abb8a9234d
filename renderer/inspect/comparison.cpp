#include "renderer/inspect/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/base/lengths_text.h"

namespace si {
namespace {

/// Returns the reason why a light does not reach a position even without occluders; empty: it does.
std::string unreached(const FittedLight& light, const glm::dvec3& position_ws) {
    if (light.type == LightType::Directional) return {};
    const glm::dvec3 away = light.position - position_ws;
    const double distance = glm::length(away);
    if (light.type == LightType::Spot && !(glm::dot(away, light.to_light) > light.cos_cone_outer * distance))
        return "no light: outside of the light's cone";
    if (within_range(distance, light.range_m)) return {};
    return fmt::format("no light: {} away, beyond the light's range of {}", metres_text(distance),
                       metres_text(light.range_m));
}

std::string verdict(const Settings& settings, const Probe::PerLight& p) {
    if (!p.receives) return "lit: this object receives no shadows";
    if (!faces_light(p.account.receiver.n_dot_l))
        return fmt::format("no shadow test: the surface faces away (N·L = {}{:.2f})",
                           p.account.receiver.n_dot_l <= -0.005 ? "−" : "", std::abs(p.account.receiver.n_dot_l));
    if (p.place == MapPlace::Behind) return "outside the map: behind the light";
    if (p.place == MapPlace::OutsideCasterRegion)
        return "lit: where light.fit has found that nothing can cast a shadow";
    if (p.place == MapPlace::BeyondFar && settings.map.far_guard)
        return fmt::format("{}: beyond the light's far plane, the far-plane test decides",
                           p.visibility > 0.5 ? "lit" : "unlit");
    const double gap = p.gap_m;
    const DepthShift all = p.account.amount(p.account.equivalent_depth());
    const std::string bias =
        std::isfinite(all.texels)
            ? fmt::format("bias and normal offset equal {} ({}) of depth bias", metres_text(all.metres),
                          texels_text(all.texels))
            : "bias and normal offset shift it past everything, as the surface is edge-on to the light";
    const std::string texel =
        gap > 0 ? fmt::format("the map stores a surface {} nearer to the light", metres_text(gap))
                : fmt::format("nothing nearer in the map; the surface lies {} in front of the stored depth",
                              metres_text(-gap));
    if (p.visibility >= 1) return fmt::format("lit: {}, {}", texel, bias);
    if (p.visibility <= 0) return fmt::format("in shadow: {}, {}", texel, bias);
    return fmt::format("partly lit ({:.0f} %): {}, {}; the kernel's taps disagree", p.visibility * 100, texel, bias);
}

/// Stored depths of a map as look-ups find them, under map.wrap and map.outside.
class StoredDepths {
public:
    StoredDepths(const FloatImage& map, const Settings& settings, MapSize size, const DepthCurve& curve)
        : map_(map), wrap_(settings.map.wrap), n_(size.sides()) {
        const double far_depth = curve.convention.far_depth();
        border_ = settings.map.outside == Outside::Lit ? far_depth : 1 - far_depth;
    }
    double at(glm::ivec2 texel) const {
        if (wrap_ == MapWrap::Repeat) texel = ((texel % n_) + n_) % n_;
        if (wrap_ == MapWrap::Border && !inside(texel)) return border_;
        texel = glm::clamp(texel, glm::ivec2(0), n_ - 1);
        return map_.at(texel.x, n_.y - 1 - texel.y);  // the image's first row is the map's top
    }
    double border() const { return border_; }
    /// Returns true when a texel lies inside the map.
    bool inside(glm::ivec2 t) const { return t.x >= 0 && t.y >= 0 && t.x < n_.x && t.y < n_.y; }

private:
    const FloatImage& map_;
    MapWrap wrap_;
    glm::ivec2 n_;
    double border_ = 1;
};

/// Returns a depth as the GPU compares it: clamped to [0,1] for fixed-point formats.
double as_compared(const Settings& s, double depth) {
    const bool fixed = s.map.format == MapFormat::D16 || s.map.format == MapFormat::D24;
    return fixed ? std::clamp(depth, 0.0, 1.0) : depth;
}

bool passes(const Settings& s, double own, double stored) {
    // Single precision, as in shaders.
    const float a = float(own), b = float(stored);
    const bool nearer = s.map.reversed_z ? a > b : a < b;
    return nearer || (s.map.compare == Compare::LessEqual && a == b);
}

KernelTap::Meets met(const BiasBreakdown& account, const DepthConvention& convention, double stored, double plane) {
    if (stored == convention.far_depth()) return KernelTap::Meets::Nothing;
    if (account.plane.edge_on()) return KernelTap::Meets::Own;
    const double behind = (convention.reversed ? -1 : 1) * (stored - plane);
    if (!account.in_map) return behind < 0 ? KernelTap::Meets::Nearer : KernelTap::Meets::Farther;
    const double slack = account.least.quantum + account.least.snapping + account.least.rounding;
    // In float formats a unit of polygon offset follows the farthest depth of a triangle, so nearer points get more.
    if (behind < -slack + std::min(2 * account.raster, 0.0)) return KernelTap::Meets::Nearer;
    if (behind > slack + std::max(2 * account.raster, 0.0)) return KernelTap::Meets::Farther;
    return KernelTap::Meets::Own;
}

/// Merges repeated taps: each texel once with the sum of its weights, row by row from the lowest.
std::vector<RecordedTap> merged(const std::vector<RecordedTap>& taps) {
    std::map<std::pair<int, int>, RecordedTap> by_place;
    for (const RecordedTap& t : taps)
        by_place.try_emplace({t.texel.y, t.texel.x}, RecordedTap{t.texel, t.stored, 0}).first->second.weight +=
            t.weight;
    std::vector<RecordedTap> out;
    for (const auto& [place, tap] : by_place) out.push_back(tap);
    return out;
}

void enclose_taps(Probe::PerLight& p) {
    if (p.taps.empty()) return;
    glm::ivec2 lo = p.taps.front().texel, hi = lo;
    for (const KernelTap& t : p.taps) {
        lo = glm::min(lo, t.texel);
        hi = glm::max(hi, t.texel);
    }
    p.taps_first = lo;
    p.taps_size = hi - lo + 1;
}

}  // namespace

Probe::PerLight test_light_at_pixel(const TestedPixel& pixel, const FittedLight& light, const Settings& settings,
                                    MapSize size, const FloatImage& map, const RasterTraits& driver) {
    Probe::PerLight p;
    p.light = pixel.light;
    p.fitted = light;
    p.point = pixel.point;
    p.casts = light.casts;
    p.receives = pixel.receives;
    p.visibility = pixel.visibility;
    p.kernel = pixel.kernel;
    const std::string dark = unreached(light, p.point.position_ws);
    if (!light.casts) {
        p.verdict = dark.empty() ? (p.visibility < 0.5 ? "dark: " : "lit: ") + light.reason : dark;
        return p;
    }
    p.account = bias_breakdown(light, settings, size, p.point, driver);
    const LightReceiver& r = p.account.receiver;
    const LightView& view = light.views[r.view];
    const DepthCurve& range = view.curve;
    const auto linear = [&](double metres) { return (metres - range.near) / (range.far - range.near); };
    const auto row_of = [&](const glm::ivec2& texel) { return (double(texel.y) + 0.5) / double(size.height); };
    p.face = int(r.view);
    p.view = view_name(light.chooser.choice, r.view, light.views.size());
    if (r.blend > 0)
        p.view += fmt::format(", {:.0f} % of {} blended in", 100 * r.blend,
                              view_name(light.chooser.choice, r.other_view, light.views.size()));
    p.own = r.uvd.z;
    p.own_linear = linear(r.own_m);
    p.bias_texels = r.bias_m / r.texel_m;
    p.offset_position_ws = p.point.position_ws + r.normal_offset_ws;
    p.compared = as_compared(settings, r.compared);
    const glm::dvec2 centre = glm::dvec2(r.tap) * size.texels();
    p.texel = glm::ivec2(glm::clamp(glm::floor(centre), glm::dvec2(-1e9), glm::dvec2(1e9)));
    p.compared_nearest =
        as_compared(settings, p.account.compared_depth_at((glm::dvec2(p.texel) + 0.5) / size.texels()));
    p.place = r.place;
    const StoredDepths depths(map, settings, size, view.curve);
    const bool guarded = settings.map.wrap == MapWrap::Range && !depths.inside(p.texel);
    p.stored = guarded ? depths.border() : depths.at(p.texel);
    p.stored_m = range.curve_at_row(row_of(p.texel)).distance(p.stored);
    p.stored_linear = linear(p.stored_m);
    p.gap_m = (r.own_m - p.stored_m) / r.axis_per_ray;
    if (r.place != MapPlace::Behind && r.place != MapPlace::OutsideCasterRegion) {
        const auto compared = [&](const RecordedTap& recorded) {
            KernelTap tap{.texel = recorded.texel, .weight = recorded.weight, .stored = recorded.stored};
            tap.stored_m = range.curve_at_row(row_of(tap.texel)).distance(tap.stored);
            const glm::dvec2 at = (glm::dvec2(tap.texel) + 0.5) / size.texels();
            tap.plane = p.account.plane.depth_at(at);
            tap.compared = as_compared(settings, p.account.compared_depth_at(at));
            tap.lit = passes(settings, tap.compared, tap.stored);
            tap.meets = depths.inside(tap.texel) ? met(p.account, view.curve.convention, tap.stored, tap.plane)
                                                 : KernelTap::Meets::Nothing;
            return tap;
        };
        for (const RecordedTap& recorded : merged(pixel.taps)) p.taps.push_back(compared(recorded));
        for (int axis = 0; axis < 2; ++axis)
            for (int along = -kProbeRowReachTexels; along <= kProbeRowReachTexels; ++along) {
                glm::ivec2 texel = p.texel;
                texel[axis] += along;
                const auto tap = std::ranges::find(p.taps, texel, &KernelTap::texel);
                p.rows[std::size_t(axis)].push_back(tap != p.taps.end() ? *tap
                                                                        : compared({texel, depths.at(texel), 0}));
            }
        enclose_taps(p);
    }
    p.verdict = dark.empty() ? verdict(settings, p) : dark;
    if (light.is_cascaded()) p.verdict += "; by " + p.view;
    return p;
}

}  // namespace si
