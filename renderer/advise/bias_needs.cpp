#include "renderer/advise/bias_needs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/scene/placement.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Bias that one pixel needs, in texels.
struct Need {
    double total = 0;  ///< least bias
    double step = 0;   ///< part of it that does not grow with the slope
    double n_dot_l = 1;
    double per_normal = 0;     ///< equivalent depth bias of one texel of normal offset: 1 / |n . ray|
    double gap_per_texel = 0;  ///< contact gap per texel of bias, metres
    double gap(double bias_texels) const { return bias_texels * gap_per_texel; }
};

double worst(const std::vector<Need>& needs, auto&& amount) {
    double most = 0;
    for (const Need& n : needs) most = std::max(most, amount(n));
    return most;
}

BiasSettings in_texels(double constant, double slope, double normal) {
    BiasSettings b;
    b.unit = BiasUnit::Texels;
    b.constant = constant;
    b.slope = slope;
    b.normal = normal;
    b.normal_source = NormalSource::Geometric;
    return b;
}

/// Finds the pair of constant and slope bias with the least mean contact gap among pairs without acne on any plane. The
/// slope term 1 - n.l is small at moderate slopes, so a constant covers those; for each constant the least slope
/// follows.
BiasSettings cheapest_slope(const std::vector<Need>& needs, double largest) {
    BiasSettings best = in_texels(largest, 0, 0);
    double least_cost = std::numeric_limits<double>::infinity();
    constexpr int kSteps = 40;
    for (int i = 0; i <= kSteps; ++i) {
        const double constant = largest * std::pow(1e-3, double(i) / kSteps);
        const double slope = worst(needs, [&](const Need& n) {
            return n.total <= constant ? 0 : n.n_dot_l < 1 - 1e-9 ? n.total / (1 - n.n_dot_l) : 1e9;
        });
        double cost = 0;
        const BiasSettings pair = in_texels(constant, slope, 0);
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

/// Lists the settings that set the amount of a row's bias: its own, and bias.constant for rows of the comparison.
std::vector<SettingRef> amounts_of(const Bias& row) {
    std::vector<SettingRef> refs;
    for (const std::string_view key : row.settings) refs.push_back(*find_setting(key));
    if (row.stage == BiasStage::Compare) refs.push_back(*find_setting("bias.constant"));
    return refs;
}

}  // namespace

BiasBreakdown measured_bias_breakdown(const MeasuredError& measured, const Settings& settings, const Receiver& r,
                                      const RasterTraits& driver) {
    return bias_breakdown(measured.lights[std::size_t(measured.light)], settings, measured.map_resolution,
                          {r.position_ws, r.normal_ws, r.normal_ws, counted_from(settings, measured.camera.origin())},
                          driver);
}

const Bias& family_row(BiasFamily family) {
    if (family == BiasFamily::Normal) return bias_of_stage(BiasStage::LookUp);
    if (family == BiasFamily::Slope) return biases()[std::size_t(default_bias())];
    return *std::ranges::find(biases(), "constant", &Bias::key);
}

std::string_view family_label(BiasFamily family) {
    static constexpr std::string_view kLabels[kBiasFamilies] = {"constant bias", "slope bias", "normal offset"};
    return kLabels[std::size_t(family)];
}

BiasSettings scale_bias(const BiasSettings& bias, double factor) {
    BiasSettings out = bias;
    const auto scale = [&](double& value, const char* key) {
        value = std::clamp(value * factor, 0.0, find_setting(key)->param->max);
    };
    scale(out.constant, "bias.constant");
    scale(out.slope, "bias.slope");
    scale(out.normal, "bias.normal");
    return out;
}

BiasNeeds bias_needs(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver) {
    BiasNeeds out;
    const FittedLight& light = measured.lights[std::size_t(measured.light)];
    if (!light.casts) return out;
    Settings searched = settings;  // families use the default kind of bias
    searched.bias.kind = default_bias();
    std::vector<Need> needs;
    std::vector<double> gaps, shifts;
    each_lit_receiver(measured, [&](std::size_t i, const Receiver& r) {
        const BiasBreakdown a = measured_bias_breakdown(measured, settings, r, driver);
        const LeastBias least = a.per_texel ? measured_bias_breakdown(measured, searched, r, driver).least : a.least;
        const double b = least.total();
        const double step = a.amount(least.quantum + least.rounding).texels, total = a.amount(b).texels;
        const LightView& view = light.views[a.receiver.view];
        const double offset_m = least_normal_offset(view, r.position_ws, r.normal_ws, b);
        if (!std::isfinite(total) || !(offset_m > 0)) return;  // edge-on
        needs.push_back({total, step, std::clamp(a.receiver.n_dot_l, 0.0, 1.0), total * a.receiver.texel_m / offset_m,
                         contact_gap(a.receiver.texel_m / a.receiver.axis_per_ray, a.theta_rad)});
        gaps.push_back(a.contact_gap_m());
        shifts.push_back(a.receiver.normal_offset_m * std::tan(std::min(a.theta_rad, 1.57)));
        if (!measured.classified[i].has(ClassifiedPixel::kAnyAcne)) return;
        if (a.equivalent_depth() >= a.least.total())
            out.folds += measured.classified[i].visibility >= 0.5f;
        else
            out.faint_acne += measured.classified[i].visibility >= 0.5f;
    });
    out.pixels = needs.size();
    if (needs.empty()) return out;
    out.gap_median_m = lower_quantile(gaps, 0.5, 0);
    out.gap_p95_m = lower_quantile(std::move(gaps), 0.95, 0);
    out.shift_p95_m = lower_quantile(std::move(shifts), 0.95, 0);
    const double largest = worst(needs, [](const Need& n) { return n.total; });
    const double step = worst(needs, [](const Need& n) { return n.step; });
    out.least[std::size_t(BiasFamily::Constant)] = in_texels(largest, 0, 0);
    out.least[std::size_t(BiasFamily::Slope)] = cheapest_slope(needs, largest);
    out.least[std::size_t(BiasFamily::Normal)] =
        in_texels(step, 0, worst(needs, [&](const Need& n) { return std::max(n.total - step, 0.0) / n.per_normal; }));
    return out;
}

std::optional<BiasSettings> least_bias_of_row(const Bias& row, const MeasuredError& measured, const Settings& settings,
                                              const RasterTraits& driver) {
    if (!measured.lights[std::size_t(measured.light)].casts) return std::nullopt;
    Settings least = settings;
    least.bias = in_texels(0, 0, 0);
    if (row.stage == BiasStage::Compare) set_setting(least, "bias.kind", row.key);
    // The row computes the needed bias itself, up to a clamp for almost edge-on surfaces.
    if (row.gives_needed_bias) return least.bias;
    const std::vector<SettingRef> amounts = amounts_of(row);
    // Amounts add up. Each covers the part that grows with the slope; the last effective one covers the remainder.
    std::vector<double> max_effect(amounts.size());
    std::vector<Settings> one(amounts.size(), least);
    for (std::size_t k = 0; k < amounts.size(); ++k) set_value(one[k], amounts[k], 1.0);
    struct At {
        double need, kernel;
        std::vector<double> effect;
    };
    std::vector<At> pixels;
    each_lit_receiver(measured, [&](std::size_t, const Receiver& r) {
        const BiasBreakdown none = measured_bias_breakdown(measured, least, r, driver);
        At at{none.least.total() - none.equivalent_depth(), none.least.kernel, {}};
        if (!std::isfinite(at.need) || none.plane.edge_on()) return;
        for (std::size_t k = 0; k < amounts.size(); ++k) {
            at.effect.push_back(measured_bias_breakdown(measured, one[k], r, driver).equivalent_depth() -
                                none.equivalent_depth());
            max_effect[k] = std::max(max_effect[k], at.effect.back());
        }
        pixels.push_back(std::move(at));
    });
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
        if (value > amounts[k].param->max) return std::nullopt;
        set_value(least, amounts[k], value);
        for (At& at : pixels) at.need -= value * at.effect[k];
    }
    return least.bias;
}

}  // namespace si
