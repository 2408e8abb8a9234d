// Table of the advice rules: conditions and the setting changes that they propose.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/advise/advice.h"
#include "renderer/base/lengths_text.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"
#include "renderer/view/fits/light_fit.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

using Offer = AdviceRule::Offer;

LightSettings& shown(Settings& s, const AdviceFacts& f) {
    return s.lights[std::size_t(f.light)];
}
const LightSettings& shown(const Settings& s, const AdviceFacts& f) {
    return s.lights[std::size_t(f.light)];
}

bool has_map(const AdviceFacts& f) {
    return f.fitted() && f.fitted()->casts && f.pixels > 0;
}

Settings with_kernel(Settings s, std::string_view kernel) {
    set_setting(s, "filter.kernel", kernel);
    return s;
}

bool is_wider(const Settings& s, std::string_view kernel) {
    return reach_of(s).edge > reach_of(with_kernel(s, kernel)).edge;
}

/// Returns kernels that compare depths over a square of texels, the narrowest first: `count` kernels from `first` on.
std::vector<std::string_view> plain_kernels(const Settings& s, std::size_t first, std::size_t count) {
    std::vector<std::pair<double, std::string_view>> all;
    for (const std::string_view kernel : sweep_kernels()) {
        const Settings with = with_kernel(s, kernel);
        const Filter& row = filter_of(with);
        if (row.square() && row.linear && row.samples() == Samples::Depth && !row.reads_light_size)
            all.emplace_back(reach_of(with).edge, kernel);
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string_view> out;
    for (std::size_t i = first; i < std::min(first + count, all.size()); ++i) out.push_back(all[i].second);
    return out;
}

void no_shadow(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    for (std::size_t i = 0; i < f.lights.size(); ++i) {
        if (!f.lights[i].shadowed || !(f.shadowed[i] == 0)) continue;
        Settings without = s;
        without.lights[i].cast = false;
        offer(fmt::format("no pixel of the picture lies in the shadow of light {}: it needs to cast none", i),
              std::move(without), int(i));
    }
}

void narrow_penumbra(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    const Filter& row = filter_of(s);
    if (!has_map(f) || !(row.searches_blockers || row.reads_light_size) || f.penumbra_texels > 1) return;
    for (const std::string_view kernel : plain_kernels(s, 1, 2))  // not the hard one
        offer(fmt::format("the penumbra is at most {:.2g} texels wide here: {} has no advantage over {}",
                          f.penumbra_texels, kernel_label(s), kernel_label(with_kernel(s, kernel))),
              with_kernel(s, kernel), f.light);
}

void one_cascade(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || !f.fitted()->is_cascaded() || !f.fitted()->levels.empty()) return;
    const int now = shown(s, f).cascades;
    for (int n = 1; n < now; n *= 2) {
        Settings fewer = s;
        shown(fewer, f).cascades = n;
        offer(fmt::format("the picture shows {} of depth ({} to {}): {} of {} cascades {}",
                          metres_text(f.farthest_m - f.nearest_m), metres_text(f.nearest_m), metres_text(f.farthest_m),
                          n, now, n == 1 ? "suffices" : "suffice"),
              std::move(fewer), f.light);
    }
}

void cascade_overlap(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || !f.fitted()->is_cascaded() || !f.fitted()->levels.empty()) return;
    const double blend = shown(s, f).cascade_blend;
    if (!(blend > 0)) return;
    Settings hard = s;
    shown(hard, f).cascade_blend = 0;
    offer(fmt::format("cascades overlap by {:.0f} % of their depth, where each pixel is looked up twice", 100 * blend),
          std::move(hard), f.light);
}

void measured_depths(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || !fit_reads_measured_depths(s, f.light)) return;
    Settings boxes = s;
    shown(boxes, f).depth_bounds = DepthBounds::Boxes;
    offer(
        "cascades are fitted to depths measured in every frame: the bounding boxes of visible objects give nearly the "
        "same",
        std::move(boxes), f.light);
}

void unread_texels_part(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || f.fitted()->views.size() != 1 || f.read_share > 0.25 || f.read_share <= 0) return;
    if ((f.fitted()->type == LightType::Directional) == f.fitted()->is_perspective()) return;
    const double halvings = std::floor(std::log2(std::sqrt(1 / f.read_share)) + 1e-9);
    Settings tight = s;
    shown(tight, f).fit = LightFit::View;
    tight.map.resolution = std::max(64, int(f.map_resolution / std::exp2(halvings)));
    const std::string read = fmt::format("{:.2g} % of the map's texels are read", 100 * f.read_share);
    if (shown(s, f).fit == LightFit::View) return;
    offer(fmt::format("{}: a tighter fit gives the same sharpness at {}² instead of {}²", read, tight.map.resolution,
                      f.map_resolution),
          tight, f.light);
    tight.map.resolution = s.map.resolution;
    offer(fmt::format("{}: a tighter fit gives finer ones to visible surfaces", read), std::move(tight), f.light);
}

void fine_map(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || s.map.paged || !(f.texel_px < 0.5)) return;
    const double halvings = std::floor(std::log2(1 / f.texel_px) + 1e-9);
    for (double n = 1; n <= std::min(halvings, 3.0); ++n) {
        Settings coarser = s;
        coarser.map.resolution = std::max(64, int(f.map_resolution / std::exp2(n)));
        offer(
            fmt::format(
                "half of all texels are narrower than {:.2g} pixels: the picture cannot resolve {}², and {}² is enough",
                f.texel_px, f.map_resolution, coarser.map.resolution),
            std::move(coarser), f.light);
    }
}

void unseen_blur(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f)) return;
    const double reach = kernel_reach_in_light(s, *f.fitted(), f.map_size).edge, width_px = 2 * reach * f.texel_px;
    if (!(width_px < 1.5)) return;
    const bool moments = filter_of(s).samples() == Samples::Moments;
    for (const std::string_view kernel : plain_kernels(s, 0, 2))
        if (moments || is_wider(s, kernel))
            offer(fmt::format("{} blurs over {:.2g} pixels, which is invisible: {} is enough{}", kernel_label(s),
                              width_px, kernel_label(with_kernel(s, kernel)),
                              moments ? ", and moments and their blur are not needed" : ""),
                  with_kernel(s, kernel), f.light);
}

void moments_without_blur(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || filter_of(s).samples() != Samples::Moments) return;
    const double width_px = 2 * kernel_reach_in_light(s, *f.fitted(), f.map_size).edge * f.texel_px;
    for (const std::string_view kernel : plain_kernels(s, 2, 1))
        offer(fmt::format("{} prepares the map to blur {} pixels: direct comparison of depths may be enough",
                          kernel_label(s), digits_text(width_px)),
              with_kernel(s, kernel), f.light);
}

void least_bias(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f)) return;
    const std::size_t acne = f.error.artefacts[std::size_t(Artefact::Acne)];
    for (const BiasStart& start : f.starts) {
        Settings least = s;
        least.bias = start.row->gives_needed_bias ? start.at_strength(0) : start.least;
        offer(acne > 0 ? fmt::format("pixels that shadow themselves: {}; by theory {} is enough on planes", acne,
                                     bias_text(least.bias))
                       : fmt::format("visible surfaces need no more than {} by theory", bias_text(least.bias)),
              std::move(least), f.light);
    }
}

void polygon_offset(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || (s.bias.raster_slope == 0 && s.bias.raster_units == 0)) return;
    Settings none = s;
    none.bias.raster_slope = none.bias.raster_units = none.bias.raster_clamp = 0;
    offer(fmt::format("polygon offset of slope {:g} and {:g} units, in addition to a bias that is enough without it",
                      s.bias.raster_slope, s.bias.raster_units),
          std::move(none), f.light);
}

/// Returns the largest depth range of a light's maps, from near to far plane, metres.
double depth_range_m(const FittedLight& light) {
    double range_m = 0;
    for (const LightView& view : light.views) {
        const DepthCurve curve = view.curve.curve_at_row(1);  // of a warped view the longest
        range_m = std::max(range_m, curve.far - curve.near);
    }
    return range_m;
}

void sixteen_bits(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || f.fitted()->is_perspective() || s.map.format == MapFormat::D16) return;
    const MapLimits& limits = f.fitted()->limits;
    const double range_m = depth_range_m(*f.fitted()), step_m = range_m / 65535;
    if (!(step_m > 0) || step_m > 0.1 * limits.texel_m) return;
    Settings coarse = s;
    coarse.map.format = MapFormat::D16;
    offer(fmt::format("{} of depth in 16 bits are steps of {}, 1/{:.0f} of a texel: no more is needed",
                      metres_text(range_m), metres_text(step_m), limits.texel_m / step_m),
          std::move(coarse), f.light);
}

void contact_shadows(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    const double contact = shown(s, f).contact;
    if (!(contact > 0)) return;
    Settings none = s;
    shown(none, f).contact = 0;
    const std::size_t wrong = f.error.artefacts[std::size_t(Artefact::Contact)];
    offer(fmt::format("contact shadows of {} march a ray a pixel; pixels that are wrong by them: {}",
                      metres_text(contact), wrong),
          std::move(none), f.light);
}

void whole_map(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || f.paged_texels == 0) return;
    const int n = std::clamp(int(std::exp2(std::ceil(std::log2(std::sqrt(double(f.paged_texels)))))), 256, 4096);
    Settings whole = s;
    whole.map.paged = false;
    whole.map.resolution = n;
    shown(whole, f).fit = LightFit::View;
    offer(fmt::format("the pages that are read hold {}: one map of {}² holds as many",
                      texels_text(double(f.paged_texels)), n),
          std::move(whole), f.light);
}

void depth_blur(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || s.map.blur_texels == 0) return;
    Settings none = s;
    none.map.blur_texels = 0;
    offer(fmt::format("blurring depths over {} texels takes a pass and does not filter shadows", s.map.blur_texels),
          std::move(none), f.light);
}

void map_samples(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || s.map.samples <= 1) return;
    Settings one = s;
    one.map.samples = 1;
    offer(fmt::format("{} samples a texel cost as many depths", s.map.samples), std::move(one), f.light);
}

void gathers(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || s.filter.method == FilterMethod::Automatic || cost_of(s).gathers == 0) return;
    Settings automatic = s;
    automatic.filter.method = FilterMethod::Automatic;
    offer(fmt::format("{} by {} texture calls a pixel; gathers give the same picture by {}", kernel_label(s),
                      cost_of(s).sampler_taps, cost_of(automatic).gathers),
          std::move(automatic), f.light);
}

void separate_visibility(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!s.shading.separate_visibility) return;
    Settings fused = s;
    fused.shading.separate_visibility = false;
    offer("visibility has a pass of its own, and only shading reads it", std::move(fused), f.light);
}

void fewer_taps(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    const Filter& row = filter_of(s);
    if (!has_map(f) || row.noise.taps.empty() || s.filter.taps < 8) return;
    const std::string key(row.noise.taps);
    const SettingRef ref = *find_setting(key);
    const Value now = get_value(s, ref);
    if (!std::holds_alternative<int>(now)) return;
    Settings fewer = s;
    set_value(fewer, ref, std::max(int(ref.param->min), std::get<int>(now) / 2));
    offer(fmt::format("{} samples {} places; half as many are half the work", kernel_label(s), std::get<int>(now)),
          std::move(fewer), f.light);
}

void narrower_kernel(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f)) return;
    for (const std::string_view kernel : {adjacent_kernels(s).first, plain_kernels(s, 0, 1).front()})
        if (!kernel.empty() && is_wider(s, kernel))
            offer(fmt::format("{} is narrower and cheaper", kernel_label(with_kernel(s, kernel))),
                  with_kernel(s, kernel), f.light);
}

void half_the_resolution(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!has_map(f) || s.map.paged || f.map_resolution < 256) return;
    Settings coarser = s;
    coarser.map.resolution = f.map_resolution / 2;
    offer(fmt::format("{}² are a quarter of the texels", coarser.map.resolution), std::move(coarser), f.light);
}

constexpr AdviceRule kRules[] = {
    {"no-shadow", "A light without visible shadow", "No pixel that a light reaches lies in its shadow.", Claim::Same,
     no_shadow},
    {"narrow-penumbra", "Soft shadows without a penumbra", "The penumbra is no wider than a texel.", Claim::Same,
     narrow_penumbra},
    {"cascades", "Fewer cascades", "There are several; measured down to one.", Claim::Same, one_cascade},
    {"cascade-overlap", "Overlapping cascades", "light.cascade_blend is above 0.", Claim::Same, cascade_overlap},
    {"depth-bounds", "Measured depth bounds", "light.depth_bounds is sdsm.", Claim::Same, measured_depths},
    {"unread-texels", "A tighter fit", "A quarter of the map's texels is read, or less.", Claim::Same,
     unread_texels_part},
    {"fine-map", "A map finer than the picture", "Texels are narrower than half a pixel.", Claim::Same, fine_map},
    {"unseen-blur", "A kernel wider than visible", "The kernel blurs over less than 1.5 pixels.", Claim::Same,
     unseen_blur},
    {"moments", "Moments", "The kernel reads moments.", Claim::Same, moments_without_blur},
    {"bias", "Bias larger or smaller than needed", "Surfaces shadow themselves, or need less than they get.",
     Claim::Right, least_bias},
    {"polygon-offset", "Polygon offset", "Polygon offset is in use.", Claim::Right, polygon_offset},
    {"sixteen-bits", "16 bits of depth", "Their steps are below a tenth of a texel.", Claim::Same, sixteen_bits},
    {"contact", "Contact shadows", "They are on.", Claim::Same, contact_shadows},
    {"whole-map", "Virtual maps", "Maps are virtual, and one map holds as many texels as are read.", Claim::Same,
     whole_map},
    {"depth-blur", "Blurred depths", "map.blur_texels is above 0.", Claim::Right, depth_blur},
    {"map-samples", "Multisampled maps", "map.samples is above 1.", Claim::Same, map_samples},
    {"gathers", "Gathers", "filter.method is not auto, and gathers serve the kernel.", Claim::Same, gathers},
    {"separate-visibility", "Separate visibility", "shading.separate_visibility is on.", Claim::Same,
     separate_visibility},
    {"fewer-taps", "Fewer samples", "The kernel samples eight places or more.", Claim::Trade, fewer_taps},
    {"narrower-kernel", "A narrower kernel", "There is a narrower one.", Claim::Trade, narrower_kernel},
    {"half-resolution", "Half the resolution", "The map has 256 texels a side or more.", Claim::Trade,
     half_the_resolution},
};

}  // namespace

std::span<const AdviceRule> advice_rules() {
    return kRules;
}

std::vector<Candidate> advice_candidates(const Settings& settings, const AdviceFacts& facts) {
    std::vector<Candidate> out;
    for (const AdviceRule& rule : advice_rules())
        rule.propose(settings, facts, [&](std::string sentence, Settings changed, int light) {
            const auto same = [&](const Candidate& c) { return c.claim == rule.claim && c.settings == changed; };
            if (changed == settings || std::ranges::any_of(out, same)) return;
            out.push_back({.name = std::move(sentence),
                           .settings = std::move(changed),
                           .rule = rule.key,
                           .claim = rule.claim,
                           .light = light});
        });
    return out;
}

}  // namespace si
