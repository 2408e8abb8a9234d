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

bool is_cascaded(const AdviceFacts& f) {
    return f.fitted()->is_cascaded() && f.fitted()->levels.empty();
}

Settings with_kernel(Settings s, std::string_view kernel) {
    set_setting(s, "filter.kernel", kernel);
    return s;
}

/// Returns a change to a kernel.
auto to_kernel(std::string_view kernel) {
    return [=](Settings& s) { set_setting(s, "filter.kernel", kernel); };
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

void no_shadow(const Settings&, const AdviceFacts& f, const Offer& offer) {
    for (std::size_t i = 0; i < f.lights.size(); ++i)
        if (f.lights[i].shadowed && f.shadowed[i] == 0)
            offer(
                fmt::format("no pixel of the picture lies in the shadow of light {}: it needs to cast none", i),
                [=](Settings& s) { s.lights[i].cast = false; }, int(i));
}

void narrow_penumbra(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    const Filter& row = filter_of(s);
    if (!(row.searches_blockers || row.reads_light_size) || f.penumbra_texels > 1) return;
    for (const std::string_view kernel : plain_kernels(s, 1, 2))  // not the hard one
        offer(fmt::format("the penumbra is at most {:.2g} texels wide here: {} has no advantage over {}",
                          f.penumbra_texels, kernel_label(s), kernel_label(with_kernel(s, kernel))),
              to_kernel(kernel));
}

void one_cascade(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (!is_cascaded(f)) return;
    const int now = shown(s, f).cascades;
    for (int n = 1; n < now; n *= 2)
        offer(fmt::format("the picture shows {} of depth ({} to {}): {} of {} cascades {}",
                          metres_text(f.farthest_m - f.nearest_m), metres_text(f.nearest_m), metres_text(f.farthest_m),
                          n, now, n == 1 ? "suffices" : "suffice"),
              [&](Settings& fewer) { shown(fewer, f).cascades = n; });
}

void cascade_overlap(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    const double blend = shown(s, f).cascade_blend;
    if (is_cascaded(f) && blend > 0)
        offer(fmt::format("cascades overlap by {:.0f} % of their depth, where each pixel is looked up twice",
                          100 * blend),
              [&](Settings& hard) { shown(hard, f).cascade_blend = 0; });
}

void measured_depths(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (fit_reads_measured_depths(s, f.light))
        offer(
            "cascades are fitted to depths measured in every frame: the bounding boxes of visible objects give nearly "
            "the same",
            [&](Settings& boxes) { shown(boxes, f).depth_bounds = DepthBounds::Boxes; });
}

void unread_texels_part(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (f.fitted()->views.size() != 1 || f.read_share > 0.25 || f.read_share <= 0) return;
    if ((f.fitted()->type == LightType::Directional) == f.fitted()->is_perspective()) return;
    if (shown(s, f).fit == LightFit::View) return;
    const double halvings = std::floor(std::log2(std::sqrt(1 / f.read_share)) + 1e-9);
    const int n = std::max(64, int(f.map_resolution / std::exp2(halvings)));
    const std::string read = fmt::format("{:.2g} % of the map's texels are read", 100 * f.read_share);
    const auto tighten = [&](Settings& tight) { shown(tight, f).fit = LightFit::View; };
    offer(fmt::format("{}: a tighter fit gives the same sharpness at {}² instead of {}²", read, n, f.map_resolution),
          [&](Settings& tight) {
              tighten(tight);
              tight.map.resolution = n;
          });
    offer(fmt::format("{}: a tighter fit gives finer ones to visible surfaces", read), tighten);
}

void fine_map(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (s.map.paged || !(f.texel_px < 0.5)) return;
    const double halvings = std::floor(std::log2(1 / f.texel_px) + 1e-9);
    for (double times = 1; times <= std::min(halvings, 3.0); ++times) {
        const int n = std::max(64, int(f.map_resolution / std::exp2(times)));
        offer(
            fmt::format(
                "half of all texels are narrower than {:.2g} pixels: the picture cannot resolve {}², and {}² is enough",
                f.texel_px, f.map_resolution, n),
            [=](Settings& coarser) { coarser.map.resolution = n; });
    }
}

/// Returns the width over which the kernel blurs, in pixels of the picture.
double blur_width_px(const Settings& s, const AdviceFacts& f) {
    return 2 * kernel_reach_in_light(s, *f.fitted(), f.map_size).edge * f.texel_px;
}

void unseen_blur(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    const double width_px = blur_width_px(s, f);
    if (!(width_px < 1.5)) return;
    const bool moments = filter_of(s).samples() == Samples::Moments;
    for (const std::string_view kernel : plain_kernels(s, 0, 2))
        if (moments || is_wider(s, kernel))
            offer(fmt::format("{} blurs over {:.2g} pixels, which is invisible: {} is enough{}", kernel_label(s),
                              width_px, kernel_label(with_kernel(s, kernel)),
                              moments ? ", and moments and their blur are not needed" : ""),
                  to_kernel(kernel));
}

void moments_without_blur(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    if (filter_of(s).samples() != Samples::Moments) return;
    for (const std::string_view kernel : plain_kernels(s, 2, 1))
        offer(fmt::format("{} prepares the map to blur {} pixels: direct comparison of depths may be enough",
                          kernel_label(s), digits_text(blur_width_px(s, f))),
              to_kernel(kernel));
}

void least_bias(const Settings&, const AdviceFacts& f, const Offer& offer) {
    const std::size_t acne = f.error.artefacts[std::size_t(Artefact::Acne)];
    for (const BiasStart& start : f.starts) {
        const BiasSettings least = start.row->gives_needed_bias ? start.at_strength(0) : start.least;
        offer(acne > 0 ? fmt::format("pixels that shadow themselves: {}; by theory {} is enough on planes", acne,
                                     bias_text(least))
                       : fmt::format("visible surfaces need no more than {} by theory", bias_text(least)),
              [&](Settings& s) { s.bias = least; });
    }
}

void polygon_offset(const Settings& s, const AdviceFacts&, const Offer& offer) {
    if (s.bias.raster_slope != 0 || s.bias.raster_units != 0)
        offer(
            fmt::format("polygon offset of slope {:g} and {:g} units, in addition to a bias that is enough without it",
                        s.bias.raster_slope, s.bias.raster_units),
            [](Settings& none) { none.bias.raster_slope = none.bias.raster_units = none.bias.raster_clamp = 0; });
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
    if (f.fitted()->is_perspective() || s.map.format == MapFormat::D16) return;
    const MapLimits& limits = f.fitted()->limits;
    const double range_m = depth_range_m(*f.fitted()), step_m = range_m / 65535;
    if (step_m > 0 && step_m <= 0.1 * limits.texel_m)
        offer(fmt::format("{} of depth in 16 bits are steps of {}, 1/{:.0f} of a texel: no more is needed",
                          metres_text(range_m), metres_text(step_m), limits.texel_m / step_m),
              [](Settings& coarse) { coarse.map.format = MapFormat::D16; });
}

void contact_shadows(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    const double contact = shown(s, f).contact;
    if (contact > 0)
        offer(fmt::format("contact shadows of {} march a ray a pixel; pixels that are wrong by them: {}",
                          metres_text(contact), f.error.artefacts[std::size_t(Artefact::Contact)]),
              [&](Settings& none) { shown(none, f).contact = 0; });
}

void whole_map(const Settings&, const AdviceFacts& f, const Offer& offer) {
    if (f.paged_texels == 0) return;
    const int n = std::clamp(int(std::exp2(std::ceil(std::log2(std::sqrt(double(f.paged_texels)))))), 256, 4096);
    offer(fmt::format("the pages that are read hold {}: one map of {}² holds as many",
                      texels_text(double(f.paged_texels)), n),
          [&](Settings& whole) {
              whole.map.paged = false;
              whole.map.resolution = n;
              shown(whole, f).fit = LightFit::View;
          });
}

void depth_blur(const Settings& s, const AdviceFacts&, const Offer& offer) {
    if (s.map.blur_texels != 0)
        offer(fmt::format("blurring depths over {} texels takes a pass and does not filter shadows", s.map.blur_texels),
              [](Settings& none) { none.map.blur_texels = 0; });
}

void map_samples(const Settings& s, const AdviceFacts&, const Offer& offer) {
    if (s.map.samples > 1)
        offer(fmt::format("{} samples a texel cost as many depths", s.map.samples),
              [](Settings& one) { one.map.samples = 1; });
}

void gathers(const Settings& s, const AdviceFacts&, const Offer& offer) {
    if (s.filter.method == FilterMethod::Automatic || kernel_cost(s).gathers == 0) return;
    Settings automatic = s;
    automatic.filter.method = FilterMethod::Automatic;
    offer(fmt::format("{} by {} texture calls a pixel; gathers give the same picture by {}", kernel_label(s),
                      kernel_cost(s).sampler_taps, kernel_cost(automatic).gathers),
          [&](Settings& changed) { changed = automatic; });
}

void separate_visibility(const Settings& s, const AdviceFacts&, const Offer& offer) {
    if (s.shading.separate_visibility)
        offer("visibility has a pass of its own, and only shading reads it",
              [](Settings& fused) { fused.shading.separate_visibility = false; });
}

void fewer_taps(const Settings& s, const AdviceFacts&, const Offer& offer) {
    const Filter& row = filter_of(s);
    if (row.noise.taps.empty() || s.filter.taps < 8) return;
    const SettingRef ref = *find_setting(std::string(row.noise.taps));
    const Value now = get_value(s, ref);
    if (const int* const taps = std::get_if<int>(&now))
        offer(fmt::format("{} samples {} places; half as many are half the work", kernel_label(s), *taps),
              [&](Settings& fewer) { set_value(fewer, ref, std::max(int(ref.param->min), *taps / 2)); });
}

void narrower_kernel(const Settings& s, const AdviceFacts&, const Offer& offer) {
    for (const std::string_view kernel : {adjacent_kernels(s).first, plain_kernels(s, 0, 1).front()})
        if (!kernel.empty() && is_wider(s, kernel))
            offer(fmt::format("{} is narrower and cheaper", kernel_label(with_kernel(s, kernel))), to_kernel(kernel));
}

void half_the_resolution(const Settings& s, const AdviceFacts& f, const Offer& offer) {
    const int n = f.map_resolution / 2;
    if (!s.map.paged && f.map_resolution >= 256)
        offer(fmt::format("{}² are a quarter of the texels", n),
              [=](Settings& coarser) { coarser.map.resolution = n; });
}

constexpr AdviceRule kRules[] = {
    {"no-shadow", "A light without visible shadow", "No pixel that a light reaches lies in its shadow.", Claim::Same,
     no_shadow, false},
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
    {"contact", "Contact shadows", "They are on.", Claim::Same, contact_shadows, false},
    {"whole-map", "Virtual maps", "Maps are virtual, and one map holds as many texels as are read.", Claim::Same,
     whole_map},
    {"depth-blur", "Blurred depths", "map.blur_texels is above 0.", Claim::Right, depth_blur},
    {"map-samples", "Multisampled maps", "map.samples is above 1.", Claim::Same, map_samples},
    {"gathers", "Gathers", "filter.method is not auto, and gathers serve the kernel.", Claim::Same, gathers},
    {"separate-visibility", "Separate visibility", "shading.separate_visibility is on.", Claim::Same,
     separate_visibility, false},
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
    const bool has_map = facts.fitted() && facts.fitted()->casts && facts.pixels > 0;
    for (const AdviceRule& rule : advice_rules()) {
        const auto offer = [&](std::string sentence, const AdviceRule::Change& change, int light) {
            Settings changed = settings;
            change(changed);
            const auto same = [&](const Candidate& c) { return c.claim == rule.claim && c.settings == changed; };
            if (changed == settings || std::ranges::any_of(out, same)) return;
            out.push_back({.name = std::move(sentence),
                           .settings = std::move(changed),
                           .rule = rule.key,
                           .claim = rule.claim,
                           .light = light < 0 ? facts.light : light});
        };
        if (has_map || !rule.reads_map) rule.propose(settings, facts, {offer});
    }
    return out;
}

}  // namespace si
