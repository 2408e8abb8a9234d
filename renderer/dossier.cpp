#include "renderer/dossier.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/param.h"

namespace si {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::string texels(const DepthAmount& a) {
    return std::isfinite(a.texels) ? fmt::format("{:.3g} texels", a.texels) : "infinitely many texels";
}

/// Rounded up to three digits, so that what was just enough stays so.
double rounded_up(double v) {
    if (!(v > 0)) return 0;
    const double unit = std::pow(10.0, std::floor(std::log10(v)) - 2);
    return std::ceil(v / unit * (1 - 1e-12)) * unit;
}

class Explainer {
public:
    Explainer(const Probe& probe, const Probe::PerLight& p, const FragmentTruth& truth, const Settings& settings,
              const DriverInfo& driver)
        : probe_(probe), p_(p), truth_(truth), settings_(settings), driver_(driver) {}

    Dossier explain() {
        d_.light = p_.light;
        d_.truth = truth_;
        d_.right = (p_.visibility >= 0.5) == truth_.lit;
        if (p_.casts) weigh();
        d_.verdict = sentence();
        if (truth_.state == PixelState::Counted && (!d_.right || faint_acne())) d_.remedy = remedy();
        return d_;
    }

private:
    const Probe& probe_;
    const Probe::PerLight& p_;
    const FragmentTruth& truth_;
    const Settings& settings_;
    const DriverInfo& driver_;
    Dossier d_;

    const LightView& view() const { return p_.fitted.views[std::size_t(p_.face)]; }
    bool sees_surface() const { return p_.casts && p_.where != "behind"; }
    bool dark() const { return p_.visibility < 0.5; }
    /// Lit, but some of the kernel meets the surface itself.
    bool faint_acne() const {
        return truth_.lit && p_.visibility < 1 - kRightVisibility && d_.has.depth < d_.least.depth &&
               std::any_of(p_.taps.begin(), p_.taps.end(), [](const KernelTap& t) {
                   return !t.lit && t.weight > 0 && t.meets == KernelTap::Meets::Own;
               });
    }

    /// The gap to the surface nearest the light, as a difference of depth.
    double occluder_depth() const {
        if (!std::isfinite(truth_.gap_m)) return kInfinite;
        return view().curve.depth_nearer(p_.own_m, truth_.gap_m * p_.account.receiver.axis_per_ray);
    }

    void weigh() {
        const BiasAccount& a = p_.account;
        d_.least = a.amount(a.least.total());
        d_.has = a.amount(a.clears());
        d_.lifted = a.amount(a.lifts);
        d_.occluder = a.amount(occluder_depth());
        if (d_.window_open()) return;
        const double fixed = a.least.quantum + a.least.rounding, room = d_.occluder.depth - fixed;
        if (!(room > 0)) {
            d_.opening_resolution = kInfinite;
            return;
        }
        const double needed = probe_.map_resolution * (a.least.kernel + a.least.snapping) / room;
        d_.opening_resolution = std::exp2(std::ceil(std::log2(needed * (1 + 1e-9))));
    }

    std::string opening() const {
        if (d_.opening_resolution == kInfinite)
            return "no resolution opens the window, as steps of the depth format alone are larger than the gap";
        if (d_.opening_resolution > driver_.max_texture_size)
            return fmt::format("it would take a map of {:.0f}², more than this driver's {}²", d_.opening_resolution,
                               driver_.max_texture_size);
        return fmt::format("{:.0f}² would open the window", d_.opening_resolution);
    }
    std::string no_bias_is_right() const {
        return fmt::format("no bias can be right here: the surface needs {}, but what shadows it lies {} away: {}",
                           texels(d_.least), texels(d_.occluder), opening());
    }

    std::string sentence() const {
        switch (truth_.state) {
            case PixelState::Background: return "nothing there";
            case PixelState::NotReceiving: return "not compared: this object receives no shadows";
            case PixelState::FacesAway: return "not compared: the surface faces away from the light, or edge-on to it, and is dark without a map";
            case PixelState::OutsideCone: return "not compared: outside of the light's cone";
            case PixelState::BeyondRange: return "not compared: beyond the light's range";
            case PixelState::Counted: break;
        }
        if (!p_.casts) return d_.right ? "right: lit, as no map is drawn for this light" : "wrong: dark in truth, but this light has no map";
        if (truth_.artefact == Artefact::OutsideMap)
            return fmt::format("outside the map ({}): {} by map.outside and map.wrap, {}", p_.where, dark() ? "dark" : "lit",
                               d_.right ? "and so it is in truth" : dark() ? "lit in truth" : "dark in truth");
        if (d_.right) return right();
        if (truth_.artefact == Artefact::EdgeAliasing)
            return fmt::format("edge aliasing: {} though {}, within the kernel's reach of a true shadow's edge; smaller "
                               "texels bring it nearer, bias does not",
                               dark() ? "dark" : "lit", dark() ? "lit" : "dark");
        if (dark()) return acne();
        return leak();
    }

    std::string right() const {
        const std::string bias = d_.has.depth >= d_.least.depth
                                     ? fmt::format("needs {} of bias, has {}", texels(d_.least), texels(d_.has))
                                     : fmt::format("needs {} of bias and has only {}, so neighbours may show acne",
                                                   texels(d_.least), texels(d_.has));
        if (faint_acne())
            return fmt::format("faint acne: lit, as in truth, but {:.0f} % of the kernel is dark by the surface itself; {}",
                               100 * (1 - p_.visibility), bias);
        if (!dark()) return fmt::format("right: lit, as in truth; {}", bias);
        if (!d_.window_open()) return fmt::format("right: dark, as in truth, but {}", no_bias_is_right());
        return fmt::format("right: dark, as in truth, by a surface {} nearer to the light; {}", texels(d_.occluder), bias);
    }

    std::string acne() const {
        if (d_.has.depth < d_.least.depth)
            return fmt::format("acne: needs {} of bias here, has {}", texels(d_.least), texels(d_.has));
        return fmt::format("acne: the triangle's own plane needs {} of bias and has {}, but a steeper surface within the "
                           "kernel's reach rises above it",
                           texels(d_.least), texels(d_.has));
    }

    std::string leak() const {
        if (truth_.artefact == Artefact::LostCaster)
            return fmt::format("lost caster: dark in truth, but {} left out of the map what casts here",
                               settings_.caster.cull != int(Cull::None) ? "culling (caster.cull) or the near plane"
                                                                        : "the near plane or an object's own culling");
        if (!d_.window_open()) return fmt::format("{}: {}", error_word(), no_bias_is_right());
        if (truth_.artefact == Artefact::PeterPanning)
            return fmt::format("peter-panning: bias moves it {} towards the light, past the surface that shadows it from {} "
                               "away; {} would do",
                               texels(d_.lifted), texels(d_.occluder), texels(d_.least));
        return "leak: dark in truth, and the bias is smaller than the gap; what casts here is thinner than a texel, or the "
               "normal offset moves the look-up past it";
    }
    std::string error_word() const {
        return truth_.artefact == Artefact::PeterPanning ? "peter-panning" : "leak";
    }

    /// What the pixel gets under other settings, the map's place unchanged.
    BiasAccount under(const Settings& s) const {
        return bias_account(p_.fitted, s, s.map.resolution, p_.point, driver_.subpixel_bits);
    }
    bool fixes(const Settings& s) const {
        const BiasAccount a = under(s);
        return a.clears() >= a.least.total() && (truth_.lit || a.lifts < d_.occluder.depth);
    }

    /// The settings of the bias, the one that acts first.
    std::vector<std::string_view> bias_keys() const {
        std::vector<std::string_view> keys;
        if (settings_.bias.normal > 0) keys.push_back("bias.normal");
        if (p_.account.slope > 0) keys.push_back("bias.slope");
        if (p_.account.constant > 0) keys.push_back("bias.constant");
        for (const std::string_view key : {"bias.normal", "bias.slope", "bias.constant"})
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
        return keys;
    }
    static double& value_of(Settings& s, std::string_view key) {
        return key == "bias.normal" ? s.bias.normal : key == "bias.slope" ? s.bias.slope : s.bias.constant;
    }
    std::string unit_of(std::string_view key) const {
        if (key == "bias.normal" || settings_.bias.unit == int(BiasUnit::Texels)) return "texels";
        return settings_.bias.unit == int(BiasUnit::Metres) ? "m" : "of depth";
    }

    /// The least value of one setting under which the surface does not shadow itself, if that puts the pixel right.
    std::optional<double> least_value(std::string_view key) const {
        Settings s = settings_;
        s.map.resolution = probe_.map_resolution;
        double& value = value_of(s, key);
        const double most = find_setting(key)->param->max;
        const auto enough = [&](double v) {
            value = v;
            const BiasAccount a = under(s);
            return a.clears() >= a.least.total();
        };
        if (!enough(most)) return {};
        double lo = 0, hi = most;
        for (int i = 0; i < 60 && hi - lo > 1e-4 * hi; ++i) (enough(0.5 * (lo + hi)) ? hi : lo) = 0.5 * (lo + hi);
        value = rounded_up(hi * (1 + 1e-3));
        if (value > most || !fixes(s)) return {};
        return value;
    }

    std::optional<Remedy> remedy() const {
        const bool bias_errs =
            truth_.artefact == Artefact::Acne || truth_.artefact == Artefact::PeterPanning || faint_acne();
        if (truth_.artefact == Artefact::LostCaster && settings_.caster.cull != int(Cull::None))
            return Remedy{"caster.cull", "none", "set caster.cull to none"};
        if (!bias_errs || (dark() && d_.has.depth >= d_.least.depth)) return {};
        for (const std::string_view key : bias_keys()) {
            if (!d_.window_open()) break;
            if (const auto value = least_value(key)) {
                const std::string text = fmt::format("{:g}", *value);
                return Remedy{std::string(key), text, fmt::format("set {} to {} {}", key, text, unit_of(key))};
            }
        }
        if (d_.window_open() || d_.opening_resolution > driver_.max_texture_size) return {};
        Settings s = settings_;
        s.map.resolution = int(d_.opening_resolution);
        if (!fixes(s)) return {};
        return Remedy{"map.resolution", fmt::format("{}", s.map.resolution),
                      fmt::format("set map.resolution to {}", s.map.resolution)};
    }
};

}  // namespace

Dossier explain(const Probe& probe, const Probe::PerLight& light, const FragmentTruth& truth, const Settings& settings,
                const DriverInfo& driver) {
    return Explainer(probe, light, truth, settings, driver).explain();
}

}  // namespace si
