#include "renderer/inspect/effect_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <tuple>

#include "renderer/base/index_of.h"
#include "renderer/base/lengths_text.h"
#include "renderer/optimisations/optimisations.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"
#include "renderer/view/fits/light_fit.h"

namespace si {
namespace {

/// Makes an effect that is a part of a pass. Its state is the state of the pass, or NotNeeded without `needed`.
/// @param reason clause; the pass's own reason replaces it where the pass was skipped but the effect is needed
/// @param optimisation optimisation that skips the effect
Effect part_of(const PassInfo& pass, std::string name, bool needed, std::string_view reason,
               std::optional<Optimisation> optimisation = {}) {
    const bool skipped = pass.state == PassState::Skipped;
    return {.name = std::move(name),
            .state = needed ? state_of(pass.state) : EffectState::NotNeeded,
            .reason = as_sentence(skipped && needed ? pass.reason : reason),
            .optimisation = optimisation,
            .pass = pass.name,
            .part = true};
}

/// Makes the effect of work that an optimisation skips within a pass that runs anyway.
Effect skipped_part(const EffectFacts& f, const PassInfo& pass, std::string name, Optimisation saving) {
    const bool forced = f.forced.contains(saving);
    return part_of(pass, std::move(name), forced, forced ? "forced: it is done anyway" : row_of(saving).help, saving);
}

Effect alpha_test_part(const EffectFacts& f, const PassInfo& pass, std::string name) {
    return part_of(pass, std::move(name), f.masked_casters > 0,
                   f.masked_casters == 0 ? fmt::format("none of {} casters is masked", f.casters)
                                         : fmt::format("masked casters, whose fragments look up the mask: {} of {}",
                                                       f.masked_casters, f.casters));
}

/// Method by which a kernel searches for occluders of a pixel.
enum class Search {
    None,
    Places,  ///< a blocker search with taps of its own, before the comparisons
    Taps,    ///< blocker distances from the taps of the comparisons
    Rays     ///< along rays through the map
};

/// Effect of a kernel's search where a penumbra opens, in the order of Search.
constexpr std::string_view kSearchTexts[] = {
    "has a fixed width: it needs no blocker search",
    "searches the occluders of each pixel, which set the width of the penumbra",
    "takes the distance of occluders from the taps that it compares",
    "marches rays from each pixel to points of the light, up to the first occluder"};

Search search_of(const Filter& row) {
    if (!row.searches_blockers) return row.reads_light_size ? Search::Rays : Search::None;
    return owns_setting(row, "filter.blocker_taps") ? Search::Places : Search::Taps;
}

/// Returns true when Optimisation::BlockerSearch shortens a search for lights of size 0.
bool can_be_shortened(Search search) {
    return search == Search::Places || search == Search::Rays;
}

/// Returns true when Optimisation::BlockerSearch shortens the look-ups of a light.
bool skips_blocker_search(const EffectFacts& f, const FittedLight& light) {
    return light.size <= 0 && can_be_shortened(search_of(f.filter()));
}

/// Appends the effects of blocker search and light size. @param looked_up lights with map look-ups
void search_parts(const EffectFacts& f, const PassInfo& pass, std::span<const std::size_t> looked_up, Effects& out) {
    const auto add = [&](const char* name, bool needed, const std::string& reason) {
        out.push_back(part_of(pass, name, needed, reason));
    };
    if (looked_up.empty()) {
        const bool maps = std::ranges::any_of(f.frame.lights, &FittedLight::casts);
        for (const char* name : {"blocker search", "light's size"})
            add(name, false, maps ? "no map is looked up" : "no light has its shadows from a map");
        return;
    }
    std::vector<std::string> sizeless;
    for (const std::size_t i : looked_up)
        if (!(f.frame.lights[i].size > 0)) sizeless.push_back(light_setting_key(i, "size") + " is 0");
    const bool opens = sizeless.size() < looked_up.size();
    const std::string closed = sizeless.empty() ? "" : fmt::format("{}: no penumbra opens", fmt::join(sizeless, ", "));
    const std::string but = opens && !closed.empty() ? fmt::format(". {} there", closed) : "";
    const Search search = search_of(f.filter());
    const bool forced = can_be_shortened(search) && f.forced.contains(Optimisation::BlockerSearch);
    const std::string way = fmt::format("kernel {} {}", f.kernel(), kSearchTexts[std::size_t(index_of(search))]);
    if (search == Search::None)
        add("blocker search", false, way);
    else
        add("blocker search", opens || forced || search == Search::Rays,
            opens    ? way + but
            : forced ? "forced: it is done anyway"
                     : closed + (search == Search::Rays ? ", and all rays of a pixel are equal" : ""));
    if (!f.filter().reads_light_size)
        add("light's size", false, fmt::format("kernel {} treats each light as a point or a direction", f.kernel()));
    else
        add("light's size", opens, opens ? "the kernel's penumbrae follow light.size" + but : closed);
}

/// Returns the reason why no texel of a light's maps is read, as the maps' pass reports; empty: texels may be read.
std::string why_unread(const EffectFacts& f, const PassInfo& pass, std::size_t light) {
    // With Optimisation::BackFacingReceivers off, look-ups without effect are made, and no map is skipped for them.
    if (pass.state == PassState::Skipped || f.forced.contains(Optimisation::BackFacingReceivers)) return {};
    std::string why;
    if (f.frame.pages && f.frame.pages->wanted == 0) why = "no pixel requests a page";
    for (const PassInfo& map : f.frame.passes)
        if (map.light == int(light) && map.state == PassState::Skipped && map.makes == Result::DrawnMaps)
            why = map.reason;
    return why.empty() ? why : why + ": no texel of its maps is read";
}

std::string lookup_text(const EffectFacts& f, const FittedLight& light) {
    int texels = kernel_cost(f.settings).texels;
    if (keeps_mips(f.settings))
        return fmt::format("kernel {} fetches {} texels per look-up and mip level", f.kernel(), texels);
    if (search_of(f.filter()) == Search::Places && skips_blocker_search(f, light) &&
        !f.forced.contains(Optimisation::BlockerSearch))
        texels -= disk_point_count(f.filter(), f.settings, f.settings.filter.blocker_taps) - 1;
    return fmt::format("kernel {} fetches up to {} texel{} a look-up", f.kernel(), texels, texels == 1 ? "" : "s");
}

/// Appends the look-ups of each light, and the work that optimisations skip within them.
void lookup_parts(const EffectFacts& f, const PassInfo& pass, bool separate, Effects& out) {
    const bool forced = f.forced.contains(Optimisation::DeadPasses);
    std::vector<std::size_t> looked_up;
    for (std::size_t i = 0; i < f.frame.lights.size(); ++i) {
        const FittedLight& light = f.frame.lights[i];
        const Source& source = source_of(f.settings, int(i));
        const std::string name = fmt::format("look-ups of light {}", i);
        const std::string chosen = fmt::format("{} is {}", light_setting_key(i, "source"), source.key);
        // Shading leaves a light without shadows out of its program. A visibility texture has it where it is forced.
        const auto skipped = [&](const std::string& reason, bool can_be_forced) {
            const bool drawn = can_be_forced && forced;
            out.push_back(part_of(pass, name, drawn, (drawn ? "forced: " : "") + reason,
                                  can_be_forced ? std::optional(Optimisation::DeadPasses) : std::nullopt));
        };
        if (!separate && light.shadowed && adds_no_light(light, f.settings)) {
            skipped(light.dark, true);
            if (forced && light.casts) looked_up.push_back(i);
        } else if (!separate && !forced && is_always_lit(light, f.settings)) {
            skipped(light.empty, true);
        } else if (!light.shadowed) {
            skipped(light.reason + ": it casts no shadow", separate);
        } else if (source.file.empty() && !source.needs.reference) {
            skipped(chosen, separate);
        } else if (!source.needs.map) {
            out.push_back(part_of(pass, name, true, chosen));
        } else {
            const std::string unread = why_unread(f, pass, i);
            out.push_back(part_of(pass, name, unread.empty(), unread.empty() ? lookup_text(f, light) : unread));
            if (unread.empty()) looked_up.push_back(i);
        }
    }
    search_parts(f, pass, looked_up, out);
    if (std::ranges::none_of(f.frame.lights, &FittedLight::casts)) return;
    out.push_back(skipped_part(f, pass, "look-ups where light does not arrive", Optimisation::BackFacingReceivers));
    for (const std::size_t i : looked_up)
        if (skips_blocker_search(f, f.frame.lights[i]))
            out.push_back(skipped_part(f, pass, fmt::format("search for a penumbra of light {}", i),
                                       Optimisation::BlockerSearch));
}

void contact_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    for (std::size_t i = 0; i < f.frame.lights.size(); ++i) {
        const double length = f.settings.lights[i].contact;
        const bool shadowed = f.frame.lights[i].shadowed;
        const std::string is = light_setting_key(i, "contact") + " is ";
        out.push_back(part_of(pass, fmt::format("contact shadows of light {}", i), shadowed && length > 0,
                              length <= 0 ? is + "0"
                              : shadowed  ? fmt::format("{}{}: a ray is marched so far through the picture's depth, in "
                                                         "{} steps",
                                                        is, metres_text(length), f.settings.contact.steps)
                                          : f.frame.lights[i].reason));
    }
}

bool is_separate(const EffectFacts& f) {
    const PassInfo* visibility = f.frame.pass(Result::Visibility);
    return visibility && visibility->state != PassState::Skipped;
}

/// Appends effects of shading that do not affect visibility: ground, sky, tone curve.
void look_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    const ShadingSettings& s = f.settings.shading;
    const bool ground = !f.scene.ground_bounds.empty(), off = f.settings.scene.ground == Ground::Off;
    out.push_back(part_of(pass, "ground", ground,
                          ground ? "scene.ground is auto, and the file has no large level surface: a disc receives the "
                                   "shadows"
                          : off  ? "scene.ground is off"
                                 : "the scene has a ground of its own, or is built in"));
    const bool sky = s.sky == SkyLook::Gradient, filmic = s.curve == ToneCurve::Filmic;
    out.push_back(
        part_of(pass, "sky and its ambient light", sky, sky ? "shading.sky is gradient" : "shading.sky is plain"));
    out.push_back(part_of(
        pass, "tone curve", filmic || s.exposure != 0,
        fmt::format("shading.curve is {}, after an exposure of {:g} EV", filmic ? "filmic" : "plain", s.exposure)));
}

}  // namespace

void map_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    const auto number = std::size_t(pass.light);
    if (number >= f.frame.lights.size() || !f.frame.lights[number].casts) return;
    const FittedLight& light = f.frame.lights[number];
    const std::size_t views = light.views.size();
    for (std::size_t v = 0; pass.parts.empty() && views > 1 && v < views; ++v)
        out.push_back(part_of(pass, fmt::format("{} of light {}", view_name(light.chooser.choice, v, views), number),
                              true, fmt::format("one of {} maps of the light, which are drawn together", views)));
    out.push_back(alpha_test_part(f, pass, fmt::format("alpha test in maps of light {}", number)));
}

void page_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    if (!f.frame.pages) return;
    const PageFacts& p = *f.frame.pages;
    const long side = p.page_texels > 0 ? f.frame.map_resolution / p.page_texels : 0;
    long maps = 0;
    for (const FittedLight& light : f.frame.lights) maps += light.casts ? long(light.views.size()) : 0;
    const std::tuple<const char*, EffectState, long, const char*> kinds[] = {
        {"pages drawn", EffectState::Drawn, p.drawn, "drawn for this frame"},
        {"pages kept", EffectState::Cached, p.kept, "drawn before, with nothing in them changed"},
        {"pages that no pass reads", EffectState::NotNeeded, maps * side * side - p.wanted,
         "within no visible pixel's kernel"}};
    for (const auto& [name, state, count, what] : kinds)
        if (count > 0)
            out.push_back({.name = name,
                           .state = state,
                           .reason = fmt::format("{} page{} {}.", count, count == 1 ? "" : "s", what),
                           .pass = pass.name,
                           .part = true});
    out.push_back(alpha_test_part(f, pass, "alpha test in pages"));
}

void moment_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    if (f.filter().samples() != Samples::Moments) return;
    const bool summed = f.filter().moments.summed, mips = keeps_mips(f.settings);
    const int blur = f.settings.filter.blur, samples = f.settings.map.samples;
    const bool of_blurred_depths = samples > 1 && f.settings.map.blur_texels > 0;
    out.push_back(
        part_of(pass, "blur of the moments", !summed && blur > 0,
                summed ? "the kernel averages by sums, at the look-up" : fmt::format("filter.blur is {}", blur)));
    out.push_back(part_of(pass, "mip levels of the moments", mips,
                          mips ? "filter.mips is on" : "filter.mips is off, or the kernel has none"));
    out.push_back(part_of(pass, "several samples a texel", samples > 1 && !of_blurred_depths,
                          of_blurred_depths ? "map.blur_texels blurs depths, which have one sample a texel"
                                            : fmt::format("map.samples is {}", samples)));
}

void visibility_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    if (is_separate(f)) lookup_parts(f, pass, true, out);
    contact_parts(f, pass, out);
}

void shading_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    if (!is_separate(f)) lookup_parts(f, pass, false, out);
    if (f.scene.objects.size() > 1)
        out.push_back(skipped_part(f, pass, "shading of what is hidden", Optimisation::DepthOrder));
    look_parts(f, pass, out);
}

}  // namespace si
