#include "renderer/advise/bias_needs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/scene/placement.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/param.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

/// Bias that one pixel needs, in texels.
struct Need {
    double total = 0;  ///< least bias
    double n_dot_l = 1;
    double gap_per_texel = 0;  ///< contact gap per texel of bias, metres
    double gap(double bias_texels) const { return bias_texels * gap_per_texel; }
};

double worst(const std::vector<Need>& needs, auto&& amount) {
    double most = 0;
    for (const Need& n : needs) most = std::max(most, amount(n));
    return most;
}

/// Makes bias settings of one row without any amount. Rows that act beside bias.kind get the constant kind. Unit and
/// dependence on the angle of a normal offset stay as given: an engine has no other.
BiasSettings without_amounts(const Bias& row, const BiasSettings& given) {
    Settings s;
    set_setting(s, "bias.kind", row.stage == BiasStage::Compare ? row.key : "constant");
    s.bias.unit = BiasUnit::Texels;
    s.bias.constant = s.bias.slope = s.bias.normal = 0;
    s.bias.raster_slope = s.bias.raster_units = s.bias.raster_clamp = 0;
    s.bias.normal_source = NormalSource::Geometric;
    s.bias.normal_unit = given.normal_unit;
    s.bias.normal_by = given.normal_by;
    return s.bias;
}

/// Finds the pair of constant and slope bias with the least mean contact gap among pairs without acne on any plane. The
/// slope term 1 - n.l is small at moderate slopes, so a constant covers those; for each constant the least slope
/// follows.
BiasSettings cheapest_slope(const std::vector<Need>& needs, const BiasSettings& none) {
    const double largest = worst(needs, [](const Need& n) { return n.total; });
    BiasSettings best = none;
    best.constant = largest;
    double least_cost = std::numeric_limits<double>::infinity();
    constexpr int kSteps = 40;
    for (int i = 0; i <= kSteps; ++i) {
        const double constant = largest * std::pow(1e-3, double(i) / kSteps);
        const double slope = worst(needs, [&](const Need& n) {
            return n.total <= constant ? 0 : n.n_dot_l < 1 - 1e-9 ? n.total / (1 - n.n_dot_l) : 1e9;
        });
        double cost = 0;
        BiasSettings pair = none;
        pair.constant = constant;
        pair.slope = slope;
        for (const Need& n : needs) cost += n.gap(slope_amount(pair, n.n_dot_l));
        if (cost < least_cost) {
            least_cost = cost;
            best = pair;
        }
    }
    return best;
}

constexpr double kCleared = 0.999;  // share of pixels; a few almost edge-on ones need any amount
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Leaves out the pixels that need the most, the share above kCleared.
std::vector<Need> cleared(std::vector<Need> needs) {
    std::ranges::sort(needs, {}, &Need::total);
    needs.resize(std::min(needs.size(), std::size_t(std::ceil(kCleared * double(needs.size())))));
    return needs;
}

BiasSettings rounded_up(BiasSettings b) {
    b.constant = round_up_3_digits(b.constant * 1.001);
    b.slope = round_up_3_digits(b.slope * 1.001);
    b.normal = round_up_3_digits(b.normal * 1.001);
    return scale_bias(b, 1);  // clamps to the limits of the settings
}

/// Largest number of pixels from which amounts of bias are computed: only few pixels need much.
constexpr std::size_t kSample = 20000;
/// Largest number of pixels from which percentiles of gaps and shifts are computed.
constexpr std::size_t kGapSample = 4000;

/// Calls `use` with index and receiver of each counted pixel that is lit in the reference and covered by the map.
template <class Use>
void each_lit_receiver(const MeasuredError& measured, Use use) {
    const Reference& reference = *measured.traced.reference;
    const FloatImage& hard = reference.hard();
    for (std::size_t i = 0; i < reference.state.size(); ++i)
        if (reference.state[i] == PixelState::Counted && hard.data[i] >= 0.5f &&
            !measured.classified[i].has(ClassifiedPixel::kOutside))
            use(i, measured.traced.receivers->pixels[i]);
}

/// Returns an even sample of receivers, `most` at most.
std::vector<const Receiver*> even_sample(const std::vector<const Receiver*>& all, std::size_t most) {
    std::vector<const Receiver*> sample;
    for (std::size_t i = 0; i < all.size(); i += all.size() / most + 1) sample.push_back(all[i]);
    return sample;
}

/// Returns true for a normal offset that covers less than the slope of nearly lit planes, at any amount.
bool leaves_flat_planes(const Bias& row, const BiasSettings& bias) {
    return row.stage == BiasStage::LookUp &&
           (bias.normal_by == OffsetBy::OneMinusCosine || bias.normal_by == OffsetBy::Sideways);
}

/// Bias that one pixel needs, and the equivalent depth bias of a unit of two settings.
struct PairNeed {
    double need = 0, by_normal = 0, by_constant = 0;
};

/// Finds the pair of normal offset and constant with the least mean equivalent depth bias among pairs without acne.
BiasSettings cheapest_offset(const std::vector<PairNeed>& needs, const BiasSettings& none) {
    std::vector<double> values;
    for (const PairNeed& n : needs) values.push_back(n.need > 0 ? n.need / n.by_constant : 0);
    const double largest = lower_quantile(std::move(values), kCleared, 0);
    const double most = find_setting("bias.normal")->param->max;
    BiasSettings best = none;
    best.constant = largest;
    double least_cost = kNever;
    constexpr int kSteps = 40;
    for (int i = 0; i <= kSteps; ++i) {
        BiasSettings pair = none;
        pair.constant = largest * std::pow(1e-3, double(i) / kSteps);
        values.clear();
        for (const PairNeed& n : needs) {
            const double left = n.need - pair.constant * n.by_constant;
            values.push_back(!(left > 0) ? 0 : n.by_normal > 0 ? left / n.by_normal : kNever);
        }
        pair.normal = lower_quantile(std::move(values), kCleared, 0);
        if (!(pair.normal <= most)) continue;
        double cost = 0;
        for (const PairNeed& n : needs) cost += pair.constant + pair.normal * n.by_normal / n.by_constant;
        if (cost < least_cost) {
            least_cost = cost;
            best = pair;
        }
    }
    return best;
}

/// Lists the settings that set the amount of a row's bias. The first ones cover the part that grows with the slope.
std::vector<SettingRef> amounts_of(const Bias& row) {
    switch (row.stage) {
        case BiasStage::Compare:
            return {*find_setting("bias.constant")};
        case BiasStage::LookUp:
            return {*find_setting("bias.normal"), *find_setting("bias.constant")};
        case BiasStage::Raster:
            return {*find_setting("bias.raster_slope"), *find_setting("bias.raster_units")};
    }
    return {};
}

}  // namespace

bool has_lit_receivers(const MeasuredError& measured) {
    bool any = false;
    each_lit_receiver(measured, [&](std::size_t, const Receiver&) { any = true; });
    return any;
}

double depth_along_axis_m(const Camera& camera, const glm::dvec3& position_ws) {
    return glm::dot(camera.eye - position_ws, camera.axes[2]);
}

double pixel_m(const Camera& camera, double depth_m, int lines) {
    return (camera.orthographic ? camera.height : 2 * depth_m * std::tan(0.5 * camera.fov_y_rad)) / lines;
}

LightReceiver receiver_in_light(const MeasuredError& measured, const Settings& settings, const Receiver& r) {
    return light_receiver(measured.lights[std::size_t(measured.light)], settings.bias, measured.map_size, r.position_ws,
                          r.normal_ws, r.normal_ws);
}

MeasuredBias::MeasuredBias(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver)
    : measured_(measured),
      settings_(settings),
      driver_(driver),
      origin_ws_(shader_origin(settings, measured.camera.origin())),
      kernel_reach_texels_(
          kernel_reach_in_light(settings, measured.lights[std::size_t(measured.light)], measured.map_size).bias) {}

BiasBreakdown MeasuredBias::breakdown(const Receiver& r) const {
    const ReferenceGeometry& geometry = measured_.traced.scene->geometry();
    const Cull cull = measured_.traced.reference->traits[r.object].cull;
    const SurfacePoint point{.position_ws = r.position_ws,
                             .geometric = r.normal_ws,
                             .bias_normal = r.normal_ws,
                             .origin_ws = origin_ws_,
                             .in_map = geometry.objects[r.object].casts && cull != (r.front ? Cull::Front : Cull::Back),
                             .corners_ws = geometry.triangle(r.object, r.primitive)};
    return bias_breakdown(measured_.lights[std::size_t(measured_.light)], settings_, measured_.map_size, point, driver_,
                          kernel_reach_texels_);
}

BiasSettings scale_bias(const BiasSettings& bias, double factor) {
    BiasSettings out = bias;
    const auto scale = [&](double& value, const char* key) {
        const Param& p = *find_setting(key)->param;
        value = std::clamp(value * factor, p.min, p.max);
    };
    scale(out.constant, "bias.constant");
    scale(out.slope, "bias.slope");
    scale(out.normal, "bias.normal");
    scale(out.raster_slope, "bias.raster_slope");
    scale(out.raster_units, "bias.raster_units");
    return out;
}

BiasNeeds bias_needs(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver) {
    BiasNeeds out;
    if (!measured.lights[std::size_t(measured.light)].casts) return out;
    const MeasuredBias bias(measured, settings, driver);
    std::vector<const Receiver*> lit;
    lit.reserve(measured.classified.size());
    each_lit_receiver(measured, [&](std::size_t i, const Receiver& r) {
        lit.push_back(&r);
        const ClassifiedPixel& pixel = measured.classified[i];
        if (!pixel.has(ClassifiedPixel::kAnyAcne) || pixel.visibility < 0.5f) return;
        const BiasBreakdown a = bias.breakdown(r);
        if (!a.in_map) return;  // needs no bias
        ++(a.equivalent_depth() >= a.least.total() ? out.folds : out.faint_acne);
    });
    std::vector<double> gaps, shifts;
    out.pixels = lit.size();
    for (const Receiver* r : even_sample(lit, kGapSample)) {
        const BiasBreakdown a = bias.breakdown(*r);
        if (a.plane.edge_on()) continue;
        gaps.push_back(a.contact_gap_m());
        shifts.push_back(a.offset_shift_m());
    }
    out.gap_median_m = lower_quantile(gaps, 0.5, 0);
    out.gap_p95_m = lower_quantile(std::move(gaps), 0.95, 0);
    out.shift_p95_m = lower_quantile(std::move(shifts), 0.95, 0);
    return out;
}

std::optional<BiasSettings> least_bias_of_row(const Bias& row, const MeasuredError& measured, const Settings& settings,
                                              const RasterTraits& driver) {
    if (!measured.lights[std::size_t(measured.light)].casts) return std::nullopt;
    Settings least = settings;
    least.bias = without_amounts(row, settings.bias);
    // The row computes the needed bias itself, up to a clamp for almost edge-on surfaces.
    if (row.gives_needed_bias) return least.bias;
    const MeasuredBias without(measured, least, driver);
    std::vector<const Receiver*> lit;
    each_lit_receiver(measured, [&](std::size_t, const Receiver& r) { lit.push_back(&r); });
    const std::vector<const Receiver*> receivers = even_sample(lit, kSample);
    if (std::ranges::find(row.settings, "bias.slope") != row.settings.end()) {
        std::vector<Need> needs;
        for (const Receiver* r : receivers) {
            const BiasBreakdown a = without.breakdown(*r);
            const double total = a.amount(a.least.total()).texels;
            if (a.in_map && std::isfinite(total) && !a.plane.edge_on())
                needs.push_back({total, std::clamp(a.receiver.n_dot_l, 0.0, 1.0),
                                 contact_gap(a.receiver.texel_m / a.receiver.axis_per_ray, a.theta_rad)});
        }
        return rounded_up(cheapest_slope(cleared(std::move(needs)), least.bias));
    }
    const std::vector<SettingRef> amounts = amounts_of(row);
    // Amounts add up. Each covers the part that grows with the slope; the last effective one covers the remainder.
    std::vector<double> max_effect(amounts.size());
    std::vector<Settings> one(amounts.size(), least);
    for (std::size_t k = 0; k < amounts.size(); ++k) set_value(one[k], amounts[k], 1.0);
    std::vector<MeasuredBias> with_one;
    for (const Settings& s : one) with_one.emplace_back(measured, s, driver);
    struct At {
        double need, kernel;
        std::vector<double> effect;
    };
    std::vector<At> pixels;
    for (const Receiver* r : receivers) {
        const BiasBreakdown none = without.breakdown(*r);
        At at{none.least.total() - none.equivalent_depth(), none.least.kernel, {}};
        if (!none.in_map || !std::isfinite(at.need) || none.plane.edge_on()) continue;
        for (std::size_t k = 0; k < amounts.size(); ++k) {
            at.effect.push_back(with_one[k].breakdown(*r).equivalent_depth() - none.equivalent_depth());
            max_effect[k] = std::max(max_effect[k], at.effect.back());
        }
        pixels.push_back(std::move(at));
    }
    if (leaves_flat_planes(row, settings.bias)) {
        std::vector<PairNeed> needs;
        for (const At& at : pixels) needs.push_back({at.need, at.effect[0], at.effect[1]});
        return rounded_up(cheapest_offset(needs, least.bias));
    }
    const auto last = std::ranges::find_if(max_effect.rbegin(), max_effect.rend(), [](double w) { return w > 0; });
    const bool needed = std::ranges::any_of(pixels, [](const At& at) { return at.need > 0; });
    if (needed && last == max_effect.rend()) return std::nullopt;
    for (std::size_t k = 0; k < amounts.size(); ++k) {
        if (!(max_effect[k] > 0)) continue;
        const bool is_last = &max_effect[k] == &*last;
        std::vector<double> values;
        for (const At& at : pixels) {
            const double share = is_last ? at.need : std::min(at.kernel, at.need);
            values.push_back(!(share > 0) ? 0 : at.effect[k] > 0 ? share / at.effect[k] : kNever);
        }
        const double value = round_up_3_digits(lower_quantile(std::move(values), kCleared, 0) * 1.001);
        set_value(least, amounts[k], std::min(value, amounts[k].param->max));
        for (At& at : pixels) at.need -= value * at.effect[k];
    }
    return least.bias;
}

}  // namespace si
