#include "renderer/inspect/pixel_diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/base/lengths_text.h"
#include "renderer/inspect/given_map_changes.h"
#include "renderer/inspect/moment_bound.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/param.h"
#include "renderer/view/fits/map_limits.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::string texels(const DepthShift& a) {
    return texels_text(a.texels);
}

/// Sentences on pixels that are not compared, by PixelState.
constexpr std::string_view kUncounted[] = {
    "",
    "nothing there",
    "not compared: the surface faces away from the light, or edge-on to it, and is dark without a map",
    "not compared: outside of the light's cone",
    "not compared: this object receives no shadows",
    "not compared: beyond the light's range",
    "not compared: shadow terminator: the triangle faces away from the light, its smooth normal does not: no bias "
    "cures it",
};
static_assert(std::size(kUncounted) == kPixelStates);

class PixelDiagnoser {
public:
    PixelDiagnoser(const Probe& probe, const Probe::PerLight& p, const FragmentReference& reference,
                   const Settings& settings, const DriverInfo& driver)
        : probe_(probe), p_(p), reference_(reference), settings_(settings), driver_(driver) {}

    PixelDiagnosis diagnose() {
        d_.light = p_.light;
        d_.reference = reference_;
        d_.right = (p_.visibility >= 0.5) == reference_.lit;
        if (p_.casts && reference_.state != PixelState::ShadowTerminator) set_bias_window();
        d_.verdict = sentence();
        if (p_.casts && p_.fitted.is_cascaded() && reference_.state == PixelState::Counted)
            d_.verdict += "; by " + p_.view;
        if (reference_.state == PixelState::Counted && p_.casts && (!d_.right || faint_acne())) d_.fix = fix();
        d_.engine_bias = p_.engine_bias;
        if (p_.engine_bias != EngineBias::Own) speak_of_given_map();
        return d_;
    }

private:
    const Probe& probe_;
    const Probe::PerLight& p_;
    const FragmentReference& reference_;
    const Settings& settings_;
    const DriverInfo& driver_;
    PixelDiagnosis d_;

    const LightView& view() const { return p_.fitted.views[std::size_t(p_.face)]; }
    bool dark() const { return p_.visibility < 0.5; }
    std::string_view state_text() const { return dark() ? "in shadow" : "lit"; }
    std::string_view reference_text() const { return reference_.lit ? "lit" : "in shadow"; }
    bool faint_acne() const { return reference_.cause.faint; }

    /// Rewords the verdict for a map that an engine has drawn. A fix that the given map cannot have becomes a part of
    /// the verdict.
    void speak_of_given_map() {
        if (d_.fix &&
            std::ranges::any_of(d_.fix->settings, [](const auto& s) { return acts_while_drawing(s.first); })) {
            d_.verdict += fmt::format("; a fix {}: {}", kNeedsAnotherMap, d_.fix->text);
            d_.fix_of_map = std::exchange(d_.fix, std::nullopt);
        }
        const bool tested = reference_.state == PixelState::Counted && p_.casts;
        if (p_.engine_bias == EngineBias::Unknown && tested)
            d_.verdict = fmt::format(
                "the engine's bias is unknown, and its map needs {}{}; under bias.* of these "
                "settings: {}",
                p_.account.in_map ? amount_text(d_.least) : "no bias, as " + std::string(not_in_map()),
                std::isfinite(d_.occluder.depth) ? fmt::format(" and may have less than {}", amount_text(d_.occluder))
                                                 : "",
                d_.verdict);
        if (p_.engine_bias == EngineBias::Changed && tested)
            d_.verdict = "under bias.* of these settings, which are not the bias that the bundle states: " + d_.verdict;
    }
    /// Formats an amount of bias in texels, metres and depth.
    static std::string amount_text(const DepthShift& a) {
        if (!std::isfinite(a.depth)) return "infinite bias";
        return fmt::format("{} of bias ({}, {:.3g} of depth)", texels(a), metres_text(a.metres), a.depth);
    }

    /// Returns the gap to the surface nearest the light, as a difference of depth.
    double occluder_depth() const {
        if (!std::isfinite(reference_.gap_m)) return kInfinite;
        return p_.account.curve.depth_change_towards_light(p_.account.receiver.own_m,
                                                           reference_.gap_m * p_.account.receiver.axis_per_ray);
    }

    void set_bias_window() {
        const BiasBreakdown& a = p_.account;
        d_.least = a.amount(a.least.total());
        d_.has = a.amount(a.equivalent_depth());
        d_.shift = a.amount(a.depth_shift);
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

    std::string too_large(double resolution) const {
        return fmt::format("it would take a map of {:.0f}², more than this driver's {}²", resolution,
                           driver_.max_texture_size);
    }

    std::string opening() const {
        if (d_.opening_resolution == kInfinite)
            return "no resolution opens the window, as steps of the depth format alone are larger than the gap";
        if (d_.opening_resolution > driver_.max_texture_size) return too_large(d_.opening_resolution);
        return fmt::format("{:.0f}² would open the window", d_.opening_resolution);
    }
    std::string no_bias_is_right() const {
        return fmt::format("no depth bias can be right here: the surface needs {}, but the occluder is {} away: {}",
                           texels(d_.least), texels(d_.occluder), opening());
    }

    std::string sentence() const {
        if (reference_.state != PixelState::Counted) return std::string(kUncounted[std::size_t(reference_.state)]);
        if (!p_.casts)
            return d_.right
                       ? fmt::format("correct: {}, as in the reference; {}", state_text(), p_.fitted.reason)
                       : fmt::format("wrong: {}, should be {}; {}", state_text(), reference_text(), p_.fitted.reason);
        if (p_.place == MapPlace::OutsideCasterRegion && !dark())  // contact shadows may darken it
            return d_.right
                       ? "correct: lit, as light.fit has found that nothing can cast a shadow there"
                       : "wrong: lit, should be in shadow, though light.fit has found that nothing can cast a shadow";
        if (reference_.evidence.place == CauseEvidence::kOutside && reference_.cause.artefact != Artefact::Contact)
            return fmt::format("outside the map ({}): {} by map.outside and map.wrap, {}{}", place_name(p_.place),
                               state_text(), d_.right ? "as in the reference" : "should be ",
                               d_.right ? "" : reference_text());
        if (d_.right) return right();
        std::string text = limits() + wrong();
        if (reference_.any_leak)
            text += fmt::format("; no true edge lies within the kernel's reach (± {})", reach_text());
        for (std::size_t a = 1; a < kArtefacts; ++a)
            if (reference_.cause.also >> a & 1) text += fmt::format("; {} too", also(Artefact(a)));
        return text;
    }

    /// Returns limits of the map that no bias or kernel overcomes: too few depth steps or texels for the scene.
    std::string limits() const {
        const MapLimits& l = p_.fitted.limits;
        if (l.one_depth_step)
            return fmt::format("all depth lies in one step of the map's format ({} of {}), which comes first; ",
                               metres_text(l.depth_m), metres_text(l.step_m));
        if (l.one_texel)
            return fmt::format("a texel ({}) is larger than the scene ({}), which comes first; ",
                               metres_text(l.texel_m), metres_text(l.across_m));
        return {};
    }

    /// Returns the reason why the map does not hold the surface's own face.
    std::string_view not_in_map() const {
        if (p_.point.in_map) return "it lies before the near plane";
        return probe_.may_cast ? "its face is culled" : "its object casts nothing";
    }

    std::string right() const {
        const std::string needed = texels(d_.least), given = texels(d_.has);
        // Amounts that differ by rounding alone print alike.
        const std::string bias =
            !p_.account.in_map ? fmt::format("needs no bias, as {}, has {}", not_in_map(), given)
            : d_.has.depth >= d_.least.depth || needed == given
                ? fmt::format("bias {}, needed {}", given, needed)
                : fmt::format("bias {} is less than the needed {}, so neighbours may show acne", given, needed);
        if (faint_acne())
            return fmt::format(
                "faint acne: lit, as in the reference, but {:.0f} % of the kernel is self-shadowed{}; {}",
                100 * (1 - p_.visibility), d_.has.depth < d_.least.depth ? "" : " or by a steeper neighbour", bias);
        if (!dark()) return fmt::format("correct: lit, as in the reference; {}", bias);
        if (reference_.any_leak)
            return fmt::format(
                "faint light: in shadow, as in the reference, but {:.0f} % lit, and no true edge lies within the "
                "kernel's reach (± {}); an occluder is {} nearer to the light; {}",
                100 * p_.visibility, reach_text(), texels(d_.occluder), bias);
        const std::string partly =
            p_.visibility > shared::VISIBLE_ERROR
                ? fmt::format("{:.0f} % lit, since a true edge lies within the kernel's reach (± {}); ",
                              100 * p_.visibility, reach_text())
                : "";
        return fmt::format("correct: in shadow, as in the reference, by a surface {} nearer to the light; {}{}",
                           texels(d_.occluder), partly, bias);
    }

    /// Returns the name of the pixel's cause, as the legend has it.
    std::string_view cause_name() const { return artefact_styles()[std::size_t(reference_.cause.artefact) - 1].label; }

    std::string wrong() const {
        switch (reference_.cause.artefact) {
            case Artefact::None:
                break;
            case Artefact::Acne:
                return acne();
            case Artefact::PeterPanning:
                return fmt::format(
                    "{}: bias moves it {} towards the light, past the surface that shadows it from {} away; "
                    "{} it is in shadow, as in the reference",
                    cause_name(), texels(d_.shift), texels(d_.occluder), less_bias());
            case Artefact::PeterPanningRaster:
                return fmt::format(
                    "{}: bias.raster_* shift the map's depths by {} away from the light, "
                    "past the occluder {} before the surface; without them it is in shadow, as in the reference",
                    cause_name(), texels(p_.account.amount(p_.account.raster)), texels(d_.occluder));
            case Artefact::PeterPanningOffset:
                return fmt::format(
                    "{}: the look-up is moved by {} and misses the shadow; {} it is in "
                    "shadow, as in the reference",
                    cause_name(), metres_text(p_.account.receiver.normal_offset_m),
                    reference_.evidence.own_bare < 0.5f ? "without the offset" : less_bias());
            case Artefact::OffsetShadow:
                return fmt::format(
                    "{}: the look-up is moved by {} into a shadow; without the offset and with {} it is lit, as in the "
                    "reference",
                    cause_name(), metres_text(p_.account.receiver.normal_offset_m),
                    reference_.evidence.least_bare >= 0.5f ? texels(d_.least) + " of bias" : "the nearest texel alone");
            case Artefact::LostCaster:
                return fmt::format(
                    "{}: should be in shadow of {}, {} nearer to the light, which {} left out of the map", cause_name(),
                    reference_.missing ? reference_.missing_path : "a surface", metres_text(reference_.blocker_m),
                    leaves_out());
            case Artefact::Leak:
                if (p_.causes.unfiltered_differs() && reference_.evidence.unfiltered < 0.5f)
                    return fmt::format(
                        "{}: {:.0f} % of the kernel is lit; the same kernel and bias upon the map before its blur "
                        "(map.blur_texels) find shadow, as in the reference",
                        cause_name(), 100 * p_.visibility);
                return fmt::format(
                    "{}: {:.0f} % of the kernel is lit; the nearest texel alone, with the {} of bias that it needs, "
                    "is in shadow, as in the reference{}",
                    cause_name(), 100 * p_.visibility, nearest_need(),
                    d_.window_open() ? "" : "; with this kernel " + no_bias_is_right());
            case Artefact::Filter:
                if (p_.causes.unfiltered_differs() && reference_.evidence.unfiltered >= 0.5f)
                    return fmt::format(
                        "{}: {:.0f} % of the kernel is in shadow; the same kernel and bias upon the map without {} are "
                        "lit, as in the reference",
                        cause_name(), 100 * (1 - p_.visibility), filtered_by());
                return fmt::format(
                    "{}: {:.0f} % of the kernel is in shadow; the nearest texel alone, with the {} of bias that it "
                    "needs, is lit, as in the reference",
                    cause_name(), 100 * (1 - p_.visibility), nearest_need());
            case Artefact::OutsideMap:
                if (reference_.evidence.place == CauseEvidence::kLedOutside)
                    return "outside the map: the normal offset moves the look-up out of the map";
                return "seam: taps reach outside the map, where map.outside and map.wrap decide; with the reference "
                       "there it is right";
            case Artefact::Undersampled:
                return undersampled();
            case Artefact::EdgeAliasing:
                if (p_.fitted.type == LightType::Directional && view().curve.perspective)
                    return fmt::format(
                        "{}, should be {}: this sun is drawn in perspective (light.projection), as if its rays came "
                        "from one place, which moves its shadows",
                        state_text(), reference_text());
                if (p_.fitted.type == LightType::Spot && !view().curve.perspective)
                    return fmt::format(
                        "{}, should be {}: this spot light is drawn without perspective (light.projection), as if its "
                        "rays were parallel, which moves its shadows",
                        state_text(), reference_text());
                return fmt::format(
                    "{}: {}, should be {}; neither {} nor the nearest texel alone changes that: the "
                    "shadow's edge runs between this pixel and the texels that it reads",
                    cause_name(), state_text(), reference_text(), dark() ? "more bias" : "the least bias");
            case Artefact::LightBleeding:
                return light_bleeding();
            case Artefact::Penumbra:
                return fmt::format("{}: right for a light without size", cause_name());
            case Artefact::Contact:
                return fmt::format(
                    "{}: the ray through the depth buffer meets a surface that does not shadow the pixel; without "
                    "contact shadows it is lit, as in the reference",
                    cause_name());
            case Artefact::NoMap:
                break;  // handled above
        }
        return d_.right ? "correct" : "wrong";
    }

    /// Returns the distance across the light within which the kernel reads the map.
    std::string reach_text() const {
        return metres_text(edge_reach_texels(settings_, p_.fitted, probe_.map_size) * p_.account.receiver.texel_m);
    }

    std::string light_bleeding() const {
        const Filter& row = filter_of(settings_);
        FilterSettings used = settings_.filter;
        used.exponent = std::min(used.exponent, safe_exponent(settings_));
        used.negative_exponent = std::min(used.negative_exponent, safe_exponent(settings_));
        const MomentBound bound = moment_bound(row, used, p_.kernel);
        std::string text = fmt::format("{}: upper bound {:.2g}", cause_name(), p_.kernel.bound);
        if (!std::isnan(bound.floor_spread))
            text +=
                fmt::format(": the floor of the variance counts as depths spread by ± {}, and the occluder is {} away",
                            metres_text(bound.floor_spread * (view().curve.far - view().curve.near)),
                            metres_text(d_.occluder.metres));
        else
            text += fmt::format(": occluder and receiver within the blur (± {})", reach_text());
        text += fmt::format("; it is {}", bound.formula);
        if (!bound.clamp.empty()) text += "; " + bound.clamp;
        if (row.moments.reduces_bleeding && settings_.filter.bleed > 0 && p_.kernel.bound < 1)
            text += fmt::format("; {:.2g} after filter.bleed {:g}", p_.visibility, settings_.filter.bleed);
        return text + "; the nearest texel alone is in shadow, as in the reference";
    }

    std::string also(Artefact a) const {
        switch (a) {
            case Artefact::PeterPanning:
                return "so much bias would lose it";
            case Artefact::PeterPanningOffset:
                return "the normal offset would lose it";
            case Artefact::Leak:
            case Artefact::Filter:
                return "the kernel contributes";
            case Artefact::LostCaster:
                if (reference_.evidence.gap_all > reference_.evidence.gap_drawn)
                    return fmt::format("a caster nearer to the light, which {} left out of the map, contributes",
                                       leaves_out());
                return "the masks' mip levels contribute";
            case Artefact::Acne:
                return "its bias is less than it needs,";
            default:
                return "another cause contributes";
        }
    }

    std::string acne() const {
        if (!p_.account.in_map)
            return fmt::format(
                "acne by another surface: the map does not hold the pixel's own face, as {}, but one within the "
                "kernel's reach lies before it; {} of bias would light it",
                not_in_map(), texels(p_.account.amount(reference_.evidence.curing)));
        if (d_.has.depth < d_.least.depth)
            return fmt::format("acne: needs {} of bias here, has {}", texels(d_.least), texels(d_.has));
        return fmt::format(
            "acne of a bent surface: the triangle's own plane needs {} of bias and has {}, but a surface within the "
            "kernel's reach rises above it; {} would light it",
            texels(d_.least), texels(d_.has), texels(p_.account.amount(reference_.evidence.curing)));
    }

    /// Returns the trial with less bias that made a lit pixel dark, in words.
    std::string less_bias() const {
        const CauseEvidence& e = reference_.evidence;
        if (e.least_kept < 0.5f) return "with " + texels(d_.least);
        if (e.least_bare < 0.5f) return fmt::format("with {} and without the normal offset", texels(d_.least));
        if (p_.causes.raster_bias && e.unfiltered < 0.5f) return "without polygon offset";
        return "with the least bias of one nearest texel and without the normal offset";
    }
    /// Returns the rule that kept a caster out of the map, in words.
    std::string leaves_out() const {
        if (!reference_.missing) return p_.causes.mask_levels ? "a mask's mip level" : "culling or the near plane";
        if (!reference_.missing->culled) return fmt::format("the near plane (at {})", metres_text(view().curve.near));
        return missing_is_inherited() ? "culling (caster.cull)" : "the object's own culling";
    }
    /// Returns true when caster.cull decides the culling of the missing caster.
    bool missing_is_inherited() const {
        const auto own = settings_.objects.find(reference_.missing_path);
        return own == settings_.objects.end() || own->second.cull == ObjectCull::Inherit;
    }
    /// Lists the filters that the unfiltered map lacks.
    std::string filtered_by() const {
        std::vector<std::string> out;
        if (p_.causes.depth_blur) out.push_back("depth blur (map.blur_texels)");
        if (p_.causes.raster_bias) out.push_back("polygon offset");
        if (p_.causes.mask_levels) out.push_back("coarser levels of masks");
        return fmt::format("{}", fmt::join(out, ", "));
    }
    std::string nearest_need() const { return texels(p_.account.amount(reference_.evidence.least_nearest)); }

    std::string undersampled() const {
        const CauseEvidence& e = reference_.evidence;
        if (e.gap_all < e.least_nearest && !dark())
            return fmt::format(
                "{}: no depth bias can be right here: even one nearest texel needs {}, but the occluder is {} away; a "
                "finer map opens the window",
                cause_name(), nearest_need(), texels(p_.account.amount(e.gap_all)));
        return fmt::format("{}: the true shadow or light here is {} wide, a texel {}; {}", cause_name(),
                           metres_text(e.run_m), metres_text(p_.account.receiver.texel_m), sampling_text());
    }
    /// Returns the least power of two of map.resolution at which a texel is no wider than the strip of light or shadow.
    double sampling_resolution() const {
        const double needed =
            probe_.map_resolution * p_.account.receiver.texel_m / std::max(double(reference_.evidence.run_m), 1e-300);
        return std::exp2(std::ceil(std::log2(needed * (1 - 1e-6))));
    }
    std::string sampling_text() const {
        const double n = sampling_resolution();
        if (!(n < 1e7)) return "no map has texels as narrow";
        if (n > driver_.max_texture_size) return too_large(n);
        return fmt::format("a map of {:.0f}² has texels as narrow", n);
    }

    /// Computes the pixel's bias under other settings, with an unchanged map.
    BiasBreakdown under(const Settings& s) const {
        // The sides keep their ratio.
        const MapSize size = probe_.map_size;
        const auto side = [&](int texels) {
            return std::max(1, int(std::int64_t(texels) * s.map.resolution / std::max(size.longest(), 1)));
        };
        return bias_breakdown(p_.fitted, s, {side(size.width), side(size.height)}, p_.point, driver_);
    }
    bool fixes(const Settings& s) const {
        const BiasBreakdown a = under(s);
        return a.equivalent_depth() >= a.least.total() && (reference_.lit || a.depth_shift < d_.occluder.depth);
    }

    /// Lists the keys of the bias settings, the ones in use first.
    std::vector<std::string_view> bias_keys() const {
        std::vector<std::string_view> keys;
        if (settings_.bias.normal > 0) keys.push_back("bias.normal");
        if (p_.account.slope > 0) keys.push_back("bias.slope");
        if (p_.account.constant > 0) keys.push_back("bias.constant");
        for (const std::string_view key : {"bias.normal", "bias.slope", "bias.constant"})
            if (std::find(keys.begin(), keys.end(), key) == keys.end() && acts(key)) keys.push_back(key);
        return keys;
    }
    /// Returns true when bias.kind reads a setting.
    bool acts(std::string_view key) const { return reads_setting(bias_of(settings_), key); }
    static double& value_of(Settings& s, std::string_view key) {
        return key == "bias.normal" ? s.bias.normal : key == "bias.slope" ? s.bias.slope : s.bias.constant;
    }
    std::string unit_of(std::string_view key) const {
        if (key == "bias.normal") return settings_.bias.normal_unit == OffsetUnit::Texels ? "texels" : "m";
        if (settings_.bias.unit == BiasUnit::Texels) return "texels";
        return settings_.bias.unit == BiasUnit::Metres ? "m" : "of depth";
    }

    /// Finds the least value of one setting under which the surface does not shadow itself, if that makes the pixel
    /// right.
    std::optional<double> least_value(Settings s, std::string_view key) const {
        s.map.resolution = probe_.map_resolution;
        double& value = value_of(s, key);
        const double most = find_setting(key)->param->max;
        const auto enough = [&](double v) {
            value = v;
            const BiasBreakdown a = under(s);
            return a.equivalent_depth() >= a.least.total();
        };
        if (!enough(most)) return {};
        double lo = 0, hi = enough(0) ? 0 : most;
        for (int i = 0; i < 60 && hi - lo > 1e-4 * hi; ++i) (enough(0.5 * (lo + hi)) ? hi : lo) = 0.5 * (lo + hi);
        value = round_up_3_digits(hi * (1 + 1e-3));
        if (value > most || !fixes(s)) return {};
        return value;
    }

    SuggestedFix set(std::string_view key, double value) const {
        const std::string text = fmt::format("{:g}", value);
        return {{{std::string(key), text}}, fmt::format("set {} to {} {}", key, text, unit_of(key))};
    }
    /// Makes a fix that sets one key, with the equivalent depth bias of the pixel.
    SuggestedFix set_to_be_worth(Settings s, std::string_view key, double value) const {
        SuggestedFix r = set(key, value);
        s.map.resolution = probe_.map_resolution;
        value_of(s, key) = value;
        const BiasBreakdown a = under(s);
        r.equivalent_bias_texels = a.amount(a.equivalent_depth()).texels;
        return r;
    }

    std::optional<SuggestedFix> fix() const {
        switch (reference_.cause.artefact) {
            case Artefact::LostCaster:
                if (!reference_.missing) return {};
                if (reference_.missing->culled) {
                    const std::string key = fmt::format("object.{}.cull", reference_.missing_path);
                    return SuggestedFix{{{key, "none"}}, fmt::format("set {} to none", key)};
                }
                if (const std::string key = fmt::format("light.{}.near_far", p_.light);
                    settings_.lights[std::size_t(p_.light)].near_far != NearFar::Fitted)
                    return SuggestedFix{{{key, "fitted"}}, fmt::format("set {} to fitted", key)};
                return {};
            case Artefact::PeterPanningOffset:
            case Artefact::OffsetShadow: {
                Settings bare = settings_;
                bare.bias.normal = 0;
                for (const std::string_view key : {"bias.slope", "bias.constant"}) {
                    if (!acts(key) || (value_of(bare, key) <= 0 && key == "bias.slope")) continue;
                    const auto value = least_value(bare, key);
                    if (!value) continue;
                    SuggestedFix r = set_to_be_worth(bare, key, *value);
                    r.settings.insert(r.settings.begin(), {"bias.normal", "0"});
                    r.text = "set bias.normal to 0 and " + r.text.substr(4);
                    return r;
                }
                return {};
            }
            case Artefact::PeterPanningRaster:
                return SuggestedFix{{{"bias.raster_slope", "0"}, {"bias.raster_units", "0"}},
                                    "set bias.raster_slope and bias.raster_units to 0"};
            case Artefact::Undersampled: {
                const double n = reference_.evidence.run_m < reference_.evidence.texel_m ? sampling_resolution()
                                                                                         : d_.opening_resolution;
                if (!(n > probe_.map_resolution) || n > driver_.max_texture_size) return {};
                return SuggestedFix{{{"map.resolution", fmt::format("{:.0f}", n)}},
                                    fmt::format("set map.resolution to {:.0f}", n)};
            }
            case Artefact::None:
                if (!faint_acne()) return {};
                break;
            case Artefact::Acne:
            case Artefact::PeterPanning:
                break;
            default:
                return {};
        }
        if (d_.has.depth >= d_.least.depth && reference_.lit) return dark() ? bent_fix() : std::nullopt;
        for (const std::string_view key : bias_keys()) {
            if (!d_.window_open()) break;
            if (const auto value = least_value(settings_, key)) return set_to_be_worth(settings_, key, *value);
        }
        if (d_.window_open() || d_.opening_resolution > driver_.max_texture_size) return {};
        Settings s = settings_;
        s.map.resolution = int(d_.opening_resolution);
        if (!fixes(s)) return {};
        return SuggestedFix{{{"map.resolution", fmt::format("{}", s.map.resolution)}},
                            fmt::format("set map.resolution to {}", s.map.resolution)};
    }

    /// Makes a fix for acne of a bent surface: more constant bias, by the amount that the trial found missing.
    std::optional<SuggestedFix> bent_fix() const {
        if (!acts("bias.constant")) return {};
        const double missing = reference_.evidence.curing - d_.has.depth;
        const BiasBreakdown& a = p_.account;
        const DepthShift wanted = a.amount(std::max(a.constant, a.slope) + missing);
        const double value = round_up_3_digits((settings_.bias.unit == BiasUnit::Texels   ? wanted.texels
                                                : settings_.bias.unit == BiasUnit::Metres ? wanted.metres
                                                                                          : wanted.depth) *
                                               (1 + 1e-3));
        if (!(value > 0) || value > find_setting("bias.constant")->param->max) return {};
        return set("bias.constant", value);
    }
};

}  // namespace

double round_up_3_digits(double v) {
    if (!(v > 0)) return 0;
    // Powers of ten below one are no floating-point numbers: dividing by their inverse gives the nearest decimal.
    const double digits = 2 - std::floor(std::log10(v));
    const double unit = std::pow(10.0, std::abs(digits));
    return digits >= 0 ? std::ceil(v * unit * (1 - 1e-12)) / unit : std::ceil(v / unit * (1 - 1e-12)) * unit;
}

std::string fix_text(const SuggestedFix& fix, const Settings& settings) {
    std::string text;
    for (const auto& [key, value] : fix.settings) {
        const SettingRef ref = *find_setting(key);
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", ref.param->label,
                            shown_value(settings, ref, parse_value(ref, value)));
    }
    return text;
}

std::string equivalent_bias_text(const SuggestedFix& fix) {
    if (!(fix.equivalent_bias_texels > 0) || !std::isfinite(fix.equivalent_bias_texels)) return {};
    return fmt::format(" (equivalent depth bias {})", texels_text(fix.equivalent_bias_texels));
}

PixelDiagnosis diagnose_pixel(const Probe& probe, const Probe::PerLight& light, const FragmentReference& reference,
                              const Settings& settings, const DriverInfo& driver) {
    return PixelDiagnoser(probe, light, reference, settings, driver).diagnose();
}

}  // namespace si
