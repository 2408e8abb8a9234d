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

/// How a kernel finds out what stands before a pixel.
enum class Search {
    None,
    Places,  ///< at places of its own, before it compares
    Taps,    ///< at the places that it compares
    Rays     ///< along rays through the map
};

Search search_of(const Filter& row) {
    if (!row.searches_blockers) return row.reads_light_size ? Search::Rays : Search::None;
    return owns(row, "filter.blocker_taps") ? Search::Places : Search::Taps;
}

/// Whether Saving::Blockers spares look-ups of a light anything.
bool skips_blocker_search(const EffectFacts& f, const FittedLight& light) {
    const Search search = search_of(f.filter());
    return light.size <= 0 && (search == Search::Places || search == Search::Rays);
}

/// "light.size is 0", of all these lights.
std::string no_size_text(std::span<const std::size_t> lights) {
    std::string out;
    for (const std::size_t i : lights)
        out += fmt::format("{}{}", out.empty() ? "" : ", ", light_setting_key(i, "size"));
    return out + (lights.size() == 1 ? " is 0" : " are 0");
}

/// @param no_size why no penumbra opens; empty: one does
std::string search_text(const EffectFacts& f, const std::string& no_size) {
    const std::string kernel = f.kernel();
    const Search search = search_of(f.filter());
    const bool forced = f.forced.contains(Optimisation::Blockers);
    if (search == Search::None)
        return fmt::format("kernel {} is as wide however far off what stands before a pixel is: nothing looks for it",
                           kernel);
    if (search == Search::Rays) {
        if (no_size.empty())
            return fmt::format("kernel {} follows rays from each pixel to places of the light, up to what they meet",
                               kernel);
        if (forced) return "forced: all rays of a pixel are followed, which go one way";
        return no_size + ": all rays of a pixel go one way, and none is followed where nothing stands before it";
    }
    if (search == Search::Taps) {
        if (no_size.empty())
            return fmt::format("kernel {} learns by the taps that it compares how far off their occluders are", kernel);
        return fmt::format("{}: no penumbra opens, and kernel {} compares alike whatever its taps find", no_size,
                           kernel);
    }
    if (no_size.empty())
        return fmt::format("kernel {} looks for what stands before each pixel, to know how wide the penumbra is there",
                           kernel);
    if (forced) return "forced: all places of the search are looked at, which are one";
    return no_size + ": no penumbra opens, and one look tells whether anything stands before a pixel";
}

/// @param looked_up the lights in whose maps the kernel looks
void search_parts(const EffectFacts& f, const PassInfo& pass, std::span<const std::size_t> looked_up, Effects& out) {
    const auto add = [&](const char* name, bool needed, const std::string& reason) {
        out.push_back(part_of(pass, name, needed, reason));
    };
    if (looked_up.empty()) {
        const bool maps = std::ranges::any_of(f.frame.lights, &FittedLight::casts);
        for (const char* name : {"blocker search", "light's size"})
            add(name, false, maps ? "nothing is looked up in a map" : "no light has its shadows from a map");
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
        search == Search::Rays || (search == Search::Places && f.forced.contains(Optimisation::Blockers));
    add("blocker search", search != Search::None && (opens || all_the_same),
        search_text(f, no_size) + (search == Search::None ? "" : but));
    if (!f.filter().reads_light_size)
        add("light's size", false, fmt::format("kernel {} takes each light for a point or a direction", f.kernel()));
    else
        add("light's size", opens,
            opens ? "the kernel's penumbrae follow light.size" + but : no_size + ": no penumbra opens");
}

/// Why no texel of a light's maps is read, as what draws them found out; empty: some may be.
std::string why_unread(const EffectFacts& f, const PassInfo& pass, std::size_t light) {
    // Forced, look-ups that cannot matter are made, and foreseen by nothing that leaves maps undrawn.
    if (pass.state == PassState::Skipped || f.forced.contains(Optimisation::Facing)) return {};
    std::string why;
    if (f.frame.pages && f.frame.pages->wanted == 0) why = "no pixel asks for a page";
    for (const PassInfo& map : f.frame.passes)
        if (map.light == int(light) && map.state == PassState::Skipped && map.name.starts_with("shadow map "))
            why = map.reason;
    return why.empty() ? why : why + ": no texel of its maps is read";
}

std::string lookup_text(const EffectFacts& f, const FittedLight& light) {
    int texels = cost_of(f.settings).texels;
    if (keeps_mips(f.settings))
        return fmt::format("kernel {} fetches {} texels at each place of each mip level that it reads", f.kernel(),
                           texels);
    if (search_of(f.filter()) == Search::Places && skips_blocker_search(f, light) &&
        !f.forced.contains(Optimisation::Blockers))
        texels -= disk_places(f.filter(), f.settings, f.settings.filter.blocker_taps) - 1;
    return fmt::format("kernel {} fetches up to {} texel{} a look-up", f.kernel(), texels, texels == 1 ? "" : "s");
}

/// Of a light without shadows. Shading leaves it out of its program; a texture of its own is drawn where that is
/// forced.
Effect lit_everywhere(const EffectFacts& f, const PassInfo& pass, std::string name, std::string reason, bool separate) {
    if (!separate) return part_of(pass, std::move(name), false, reason);
    const bool forced = f.forced.contains(Optimisation::Uncalled);
    return part_of(pass, std::move(name), forced, forced ? "forced: " + reason : reason, Optimisation::Uncalled);
}

/// Work that a saving spares within a pass which is done anyway.
Effect skipped_part(const EffectFacts& f, const PassInfo& pass, std::string name, Optimisation saving,
                    std::string_view why) {
    const bool forced = f.forced.contains(saving);
    return part_of(pass, std::move(name), forced, forced ? "forced: it is done all the same" : why, saving);
}

/// Of each light, where its visibility is looked up.
void lookup_parts(const EffectFacts& f, const PassInfo& pass, bool separate, Effects& out) {
    bool from_maps = false;
    std::vector<std::size_t> looked_up;
    for (std::size_t i = 0; i < f.frame.lights.size(); ++i) {
        const FittedLight& light = f.frame.lights[i];
        const Source& source = source_of(f.settings, int(i));
        from_maps |= light.casts;
        const std::string name = fmt::format("look-ups of light {}", i);
        const std::string told = fmt::format("{} is {}", light_setting_key(i, "source"), source.key);
        const bool forced = f.forced.contains(Optimisation::Uncalled);
        if (!separate && light.shadowed && shades_nothing(light, f.settings)) {
            out.push_back(part_of(pass, name, forced, (forced ? "forced: " : "") + light.dark, Optimisation::Uncalled));
            if (forced && light.casts) looked_up.push_back(i);
        } else if (!separate && !forced && never_shadows(light, f.settings)) {
            out.push_back(part_of(pass, name, false, light.empty, Optimisation::Uncalled));
        } else if (!light.shadowed) {
            out.push_back(lit_everywhere(f, pass, name, light.reason + ": it is lit wherever it shines", separate));
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
    out.push_back(skipped_part(f, pass, "look-ups where light does not arrive", Optimisation::Facing,
                               "what is turned away from a light, beyond its range or outside of its cone is dark, "
                               "whatever its map holds"));
    const char* spared = search_of(f.filter()) == Search::Rays
                             ? "no penumbra opens, and no ray is followed where nothing stands before its pixel"
                             : "no penumbra opens, and all places of the search are one";
    for (const std::size_t i : looked_up)
        if (skips_blocker_search(f, f.frame.lights[i]))
            out.push_back(skipped_part(f, pass, fmt::format("search for a penumbra of light {}", i),
                                       Optimisation::Blockers,
                                       fmt::format("{} is 0: {}", light_setting_key(i, "size"), spared)));
}

void contact_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    for (std::size_t i = 0; i < f.frame.lights.size(); ++i) {
        const double length = f.settings.lights[i].contact;
        const bool shadowed = f.frame.lights[i].shadowed;
        out.push_back(part_of(
            pass, fmt::format("contact shadows of light {}", i), shadowed && length > 0,
            length <= 0 ? light_setting_key(i, "contact") + " is 0"
            : !shadowed ? f.frame.lights[i].reason
                        : fmt::format("{} is {}: a ray is marched so far through the "
                                      "picture's depth, in {} steps",
                                      light_setting_key(i, "contact"), metres_text(length), f.settings.contact.steps)));
    }
}

bool is_separate(const EffectFacts& f) {
    const PassInfo* visibility = f.frame.pass("visibility");
    return visibility && visibility->state != PassState::Skipped;
}

/// What makes a picture of light, and touches no visibility.
void look_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    const ShadingSettings& s = f.settings.shading;
    const bool ground = !f.scene.ground_bounds.empty();
    out.push_back(part_of(pass, "ground", ground,
                          ground ? "scene.ground is auto, and the file has no large level surface: a disc receives the "
                                   "shadows"
                          : f.settings.scene.ground == Ground::Off
                              ? "scene.ground is off"
                              : "the scene has what its shadows fall on, or is none of a file"));
    const bool sky = s.sky == SkyLook::Gradient, filmic = s.curve == ToneCurve::Filmic;
    out.push_back(part_of(pass, "sky and its ambient light", sky,
                          sky ? "shading.sky is gradient: where nothing stands is sky, and what is turned up gets "
                                "light from it, what is turned down from the ground"
                              : "shading.sky is plain: ambient light is the same from everywhere"));
    out.push_back(
        part_of(pass, "tone curve", filmic || s.exposure != 0,
                filmic ? fmt::format("shading.curve is filmic, after an exposure of {:g} EV", s.exposure)
                : s.exposure != 0
                    ? fmt::format("shading.exposure is {:g} EV; what is brighter than white is cut off", s.exposure)
                    : "shading.curve is plain: light is encoded as it is"));
}

}  // namespace

void visibility_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    if (is_separate(f)) lookup_parts(f, pass, true, out);
    contact_parts(f, pass, out);
}

void shading_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    if (!is_separate(f)) lookup_parts(f, pass, false, out);
    if (f.scene.objects.size() > 1)
        out.push_back(
            skipped_part(f, pass, "shading of what is hidden", Optimisation::Order,
                         "what is near is drawn before what it hides, large meshes after small ones that they "
                         "touch: the depth test drops most of what would be shaded and hidden again"));
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
    return f.frame.reference.met ? "it is compared with the truth" : "it was asked for";
}

}  // namespace si
