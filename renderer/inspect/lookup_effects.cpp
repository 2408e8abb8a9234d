#include "renderer/inspect/lookup_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "renderer/base/lengths_text.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/sources.h"
#include "renderer/view/fits/light_fit.h"

namespace si {
namespace {

/// Method by which a kernel searches for occluders of a pixel.
enum class Search {
    None,
    Places,  ///< a blocker search with taps of its own, before the comparisons
    Taps,    ///< blocker distances from the taps of the comparisons
    Rays     ///< along rays through the map
};

Search search_of(const Filter& row) {
    if (!row.searches_blockers) return row.reads_light_size ? Search::Rays : Search::None;
    return owns_setting(row, "filter.blocker_taps") ? Search::Places : Search::Taps;
}

/// Returns true when Optimisation::BlockerSearch shortens the look-ups of a light.
bool skips_blocker_search(const EffectFacts& f, const FittedLight& light) {
    const Search search = search_of(f.filter());
    return light.size <= 0 && (search == Search::Places || search == Search::Rays);
}

/// Formats "light.0.size is 0" for several lights.
std::string no_size_text(std::span<const std::size_t> lights) {
    std::string out;
    for (const std::size_t i : lights)
        out += fmt::format("{}{}", out.empty() ? "" : ", ", light_setting_key(i, "size"));
    return out + (lights.size() == 1 ? " is 0" : " are 0");
}

/// Returns the reason for the state of a kernel's blocker search. @param no_size reason why no penumbra opens; empty:
/// one does
std::string search_text(const EffectFacts& f, const std::string& no_size) {
    const std::string kernel = f.kernel();
    const Search search = search_of(f.filter());
    const bool forced = f.forced.contains(Optimisation::BlockerSearch);
    if (search == Search::None) return fmt::format("kernel {} has a fixed width: it needs no blocker search", kernel);
    if (search == Search::Rays) {
        if (no_size.empty())
            return fmt::format(
                "kernel {} marches rays from each pixel to points of the light, up to the first occluder", kernel);
        if (forced) return "forced: all rays of a pixel are marched, though they are equal";
        return no_size + ": all rays of a pixel are equal, and none is marched where no occluder is";
    }
    if (search == Search::Taps) {
        if (no_size.empty())
            return fmt::format("kernel {} takes the distance of occluders from the taps that it compares", kernel);
        return fmt::format("{}: no penumbra opens, and the distance of occluders does not change kernel {}", no_size,
                           kernel);
    }
    if (no_size.empty())
        return fmt::format("kernel {} searches the occluders of each pixel, which set the width of the penumbra",
                           kernel);
    if (forced) return "forced: all taps of the search are fetched, though they fall on one point";
    return no_size + ": no penumbra opens, and one tap finds the occluder of a pixel";
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
    std::vector<std::size_t> sized, sizeless;
    for (const std::size_t i : looked_up) (f.frame.lights[i].size > 0 ? sized : sizeless).push_back(i);
    const bool opens = !sized.empty();
    const std::string no_size = opens ? "" : no_size_text(sizeless);
    const std::string but =
        opens && !sizeless.empty() ? ". " + no_size_text(sizeless) + ": no penumbra opens there" : "";
    const Search search = search_of(f.filter());
    const bool all_the_same =
        search == Search::Rays || (search == Search::Places && f.forced.contains(Optimisation::BlockerSearch));
    add("blocker search", search != Search::None && (opens || all_the_same),
        search_text(f, no_size) + (search == Search::None ? "" : but));
    if (!f.filter().reads_light_size)
        add("light's size", false, fmt::format("kernel {} treats each light as a point or a direction", f.kernel()));
    else
        add("light's size", opens,
            opens ? "the kernel's penumbrae follow light.size" + but : no_size + ": no penumbra opens");
}

/// Returns the reason why no texel of a light's maps is read, as the maps' pass reports; empty: texels may be read.
std::string why_unread(const EffectFacts& f, const PassInfo& pass, std::size_t light) {
    // With Optimisation::BackFacingReceivers off, look-ups without effect are made, and no map is skipped for them.
    if (pass.state == PassState::Skipped || f.forced.contains(Optimisation::BackFacingReceivers)) return {};
    std::string why;
    if (f.frame.pages && f.frame.pages->wanted == 0) why = "no pixel requests a page";
    for (const PassInfo& map : f.frame.passes)
        if (map.light == int(light) && map.state == PassState::Skipped && map.name.starts_with("shadow map "))
            why = map.reason;
    return why.empty() ? why : why + ": no texel of its maps is read";
}

std::string lookup_text(const EffectFacts& f, const FittedLight& light) {
    int texels = cost_of(f.settings).texels;
    if (keeps_mips(f.settings))
        return fmt::format("kernel {} fetches {} texels per look-up and mip level", f.kernel(), texels);
    if (search_of(f.filter()) == Search::Places && skips_blocker_search(f, light) &&
        !f.forced.contains(Optimisation::BlockerSearch))
        texels -= disk_point_count(f.filter(), f.settings, f.settings.filter.blocker_taps) - 1;
    return fmt::format("kernel {} fetches up to {} texel{} a look-up", f.kernel(), texels, texels == 1 ? "" : "s");
}

/// Makes the effect of a light without shadows. Shading leaves the light out of its program. A visibility texture has
/// the light only where the optimisation is off.
Effect lit_everywhere(const EffectFacts& f, const PassInfo& pass, std::string name, std::string reason, bool separate) {
    if (!separate) return part_of(pass, std::move(name), false, reason);
    const bool forced = f.forced.contains(Optimisation::DeadPasses);
    return part_of(pass, std::move(name), forced, forced ? "forced: " + reason : reason, Optimisation::DeadPasses);
}

/// Makes the effect of work that an optimisation skips within a pass that runs anyway.
Effect skipped_part(const EffectFacts& f, const PassInfo& pass, std::string name, Optimisation saving,
                    std::string_view why) {
    const bool forced = f.forced.contains(saving);
    return part_of(pass, std::move(name), forced, forced ? "forced: it is done anyway" : why, saving);
}

/// Appends the look-ups of each light, and the work that optimisations skip within them.
void lookup_parts(const EffectFacts& f, const PassInfo& pass, bool separate, Effects& out) {
    bool from_maps = false;
    std::vector<std::size_t> looked_up;
    for (std::size_t i = 0; i < f.frame.lights.size(); ++i) {
        const FittedLight& light = f.frame.lights[i];
        const Source& source = source_of(f.settings, int(i));
        from_maps |= light.casts;
        const std::string name = fmt::format("look-ups of light {}", i);
        const std::string told = fmt::format("{} is {}", light_setting_key(i, "source"), source.key);
        const bool forced = f.forced.contains(Optimisation::DeadPasses);
        if (!separate && light.shadowed && adds_no_light(light, f.settings)) {
            out.push_back(
                part_of(pass, name, forced, (forced ? "forced: " : "") + light.dark, Optimisation::DeadPasses));
            if (forced && light.casts) looked_up.push_back(i);
        } else if (!separate && !forced && is_always_lit(light, f.settings)) {
            out.push_back(part_of(pass, name, false, light.empty, Optimisation::DeadPasses));
        } else if (!light.shadowed) {
            out.push_back(lit_everywhere(f, pass, name, light.reason + ": it casts no shadow", separate));
        } else if (source.file.empty() && !source.needs.reference) {
            out.push_back(lit_everywhere(f, pass, name, told, separate));
        } else if (!source.needs.map) {
            out.push_back(part_of(pass, name, true, told));
        } else {
            const std::string unread = why_unread(f, pass, i);
            out.push_back(part_of(pass, name, unread.empty(), unread.empty() ? lookup_text(f, light) : unread));
            if (unread.empty()) looked_up.push_back(i);
        }
    }
    search_parts(f, pass, looked_up, out);
    if (!from_maps) return;
    out.push_back(skipped_part(
        f, pass, "look-ups where light does not arrive", Optimisation::BackFacingReceivers,
        "surfaces that face away from a light, or lie outside its range or cone, are dark without a look-up"));
    const char* skipped = search_of(f.filter()) == Search::Rays
                              ? "no penumbra opens, and no ray is marched where no occluder is"
                              : "no penumbra opens, and all taps of the search fall on one point";
    for (const std::size_t i : looked_up)
        if (skips_blocker_search(f, f.frame.lights[i]))
            out.push_back(skipped_part(f, pass, fmt::format("search for a penumbra of light {}", i),
                                       Optimisation::BlockerSearch,
                                       fmt::format("{} is 0: {}", light_setting_key(i, "size"), skipped)));
}

void contact_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    for (std::size_t i = 0; i < f.frame.lights.size(); ++i) {
        const double length = f.settings.lights[i].contact;
        const bool shadowed = f.frame.lights[i].shadowed;
        out.push_back(part_of(
            pass, fmt::format("contact shadows of light {}", i), shadowed && length > 0,
            length <= 0 ? light_setting_key(i, "contact") + " is 0"
            : !shadowed ? f.frame.lights[i].reason
                        : fmt::format("{} is {}: a ray is marched so far through the picture's depth, in {} steps",
                                      light_setting_key(i, "contact"), metres_text(length), f.settings.contact.steps)));
    }
}

bool is_separate(const EffectFacts& f) {
    const PassInfo* visibility = f.frame.pass("visibility");
    return visibility && visibility->state != PassState::Skipped;
}

/// Appends effects of shading that do not affect visibility: ground, sky, tone curve.
void look_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    const ShadingSettings& s = f.settings.shading;
    const bool ground = !f.scene.ground_bounds.empty();
    out.push_back(
        part_of(pass, "ground", ground,
                ground ? "scene.ground is auto, and the file has no large level surface: a disc receives the shadows"
                : f.settings.scene.ground == Ground::Off ? "scene.ground is off"
                                                         : "the scene has a ground of its own, or is built in"));
    const bool sky = s.sky == SkyLook::Gradient, filmic = s.curve == ToneCurve::Filmic;
    out.push_back(part_of(pass, "sky and its ambient light", sky,
                          sky ? "shading.sky is gradient: the background is sky, surfaces facing up get its ambient "
                                "light, surfaces facing down that of the ground"
                              : "shading.sky is plain: ambient light is equal from all directions"));
    out.push_back(part_of(pass, "tone curve", filmic || s.exposure != 0,
                          filmic ? fmt::format("shading.curve is filmic, after an exposure of {:g} EV", s.exposure)
                          : s.exposure != 0
                              ? fmt::format("shading.exposure is {:g} EV; values above white are clamped", s.exposure)
                              : "shading.curve is plain: light is encoded without a tone curve"));
}

}  // namespace

void visibility_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    if (is_separate(f)) lookup_parts(f, pass, true, out);
    contact_parts(f, pass, out);
}

void shading_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    if (!is_separate(f)) lookup_parts(f, pass, false, out);
    if (f.scene.objects.size() > 1)
        out.push_back(skipped_part(f, pass, "shading of what is hidden", Optimisation::DepthOrder,
                                   "near objects are drawn first, large meshes after small ones that they touch: the "
                                   "depth test drops most fragments that would be shaded and then hidden"));
    look_parts(f, pass, out);
}

std::string why_visibility(const EffectFacts& f, const PassInfo&) {
    if (f.settings.shading.separate_visibility) return "shading.separate_visibility is on";
    for (std::size_t i = 0; i < f.frame.lights.size(); ++i) {
        if (!f.frame.lights[i].shadowed) continue;
        if (f.settings.lights[i].contact > 0)
            return fmt::format("contact shadows darken it ({})", light_setting_key(i, "contact"));
        if (!source_of(f.settings, int(i)).fused)
            return fmt::format("{} is {}, which shading cannot evaluate itself", light_setting_key(i, "source"),
                               source_of(f.settings, int(i)).key);
    }
    for (const Pane& pane : f.frame.panes)
        if (pane.overlay > 0 && (overlays()[std::size_t(pane.overlay - 1)].reads_visibility ||
                                 overlays()[std::size_t(pane.overlay - 1)].reads_reference))
            return fmt::format("overlay {} reads it", overlays()[std::size_t(pane.overlay - 1)].key);
    return f.frame.reference.met ? "it is compared with the reference" : "it is requested";
}

}  // namespace si
