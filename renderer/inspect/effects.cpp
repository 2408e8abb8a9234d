#include "renderer/inspect/effects.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/inspect/lookup_effects.h"
#include "renderer/optimisations/lookup_optimisations.h"
#include "renderer/passes/casters.h"
#include "renderer/scene/animation.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/paging.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

/// Row of the table of effects: the passes of one kind of effect, and the reasons for their states.
struct EffectRow {
    std::string_view pass;  ///< start of the passes' names
    std::string_view name;  ///< name of the effect; empty: the pass's name
    /// Returns the reason why the effect is needed, a clause.
    std::string (*why)(const EffectFacts&, const PassInfo&);
    /// Appends parts of the effect besides those that the pass reports.
    void (*parts)(const EffectFacts&, const PassInfo&, Effects&) = nullptr;
    /// Returns the reason why a frame has no such pass. Null: a missing pass is not listed.
    std::string (*reason_absent)(const EffectFacts&) = nullptr;
    /// Returns the reason why a pass was skipped, in place of the pass's own; empty: the pass's own.
    std::string (*skip_reason)(const EffectFacts&) = nullptr;
};

// Maps ----------------------------------------------------------------------------------------------------------------

std::string why_map(const EffectFacts& f, const PassInfo& pass) {
    return fmt::format("light {} has its shadows from a map, and {} object{} cast{}", pass.light, f.casters,
                       f.casters == 1 ? "" : "s", f.casters == 1 ? "s" : "");
}

std::string masks_text(const EffectFacts& f) {
    if (f.masked_casters == 0) return "no caster is masked: maps are drawn without alpha";
    return fmt::format("{} of {} casters {} masked: each of their fragments looks up the mask", f.masked_casters,
                       f.casters, f.masked_casters == 1 ? "is" : "are");
}

void map_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    const auto number = std::size_t(pass.light);
    if (number >= f.frame.lights.size() || !f.frame.lights[number].casts) return;
    const FittedLight& light = f.frame.lights[number];
    for (std::size_t v = 0; pass.parts.empty() && light.views.size() > 1 && v < light.views.size(); ++v)
        out.push_back(
            part_of(pass, fmt::format("{} of light {}", view_name(light.chooser.choice, v, light.views.size()), number),
                    true, fmt::format("one of {} maps of the light, which are drawn together", light.views.size())));
    out.push_back(
        part_of(pass, fmt::format("alpha test in maps of light {}", number), f.masked_casters > 0, masks_text(f)));
}

std::string why_pages(const EffectFacts& f, const PassInfo&) {
    return fmt::format("map.virtual is on: {}x{} texels a map are drawn by pages, where look-ups read them",
                       f.frame.map_resolution, f.frame.map_resolution);
}

void page_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    if (!f.frame.pages) return;
    const PageFacts& p = *f.frame.pages;
    const long side = p.page_texels > 0 ? f.frame.map_resolution / p.page_texels : 0;
    long maps = 0;
    for (const FittedLight& light : f.frame.lights) maps += light.casts ? long(light.views.size()) : 0;
    const long unread = std::max(maps * side * side - p.wanted, 0L);
    const auto add = [&](const char* name, EffectState state, std::string reason) {
        out.push_back({.name = name, .state = state, .reason = std::move(reason), .pass = pass.name, .part = true});
    };
    if (p.drawn > 0)
        add("pages drawn", EffectState::Drawn,
            fmt::format("{} of {} pages that look-ups may read are drawn for this frame.", p.drawn, p.wanted));
    if (p.kept > 0)
        add("pages kept", EffectState::Cached,
            fmt::format("{} of {} pages that look-ups may read were drawn before, and nothing in them changed.", p.kept,
                        p.wanted));
    if (unread > 0)
        add("pages that no pass reads", EffectState::NotNeeded,
            fmt::format("{} of {} pages are within no visible pixel's kernel.", unread, maps * side * side));
    out.push_back(part_of(pass, "alpha test in pages", f.masked_casters > 0, masks_text(f)));
}

std::string why_moments(const EffectFacts& f, const PassInfo&) {
    return fmt::format("kernel {} reads averages of functions of depth", f.kernel());
}

void moment_parts(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    const FilterSettings& s = f.settings.filter;
    if (f.filter().samples != Samples::Moments) return;
    const bool summed = f.filter().moments.summed;
    out.push_back(part_of(pass, "blur of the moments", !summed && s.blur > 0,
                          summed        ? "the kernel averages by sums, at the look-up"
                          : s.blur == 0 ? std::string("filter.blur is 0")
                                        : fmt::format("filter.blur is {}: each texel is a mean of {} x {}", s.blur,
                                                      2 * s.blur + 1, 2 * s.blur + 1)));
    out.push_back(part_of(pass, "mip levels of the moments", keeps_mips(f.settings),
                          keeps_mips(f.settings) ? "filter.mips is on" : "filter.mips is off, or the kernel has none"));
    const int samples = f.settings.map.samples;
    out.push_back(part_of(pass, "several samples a texel", samples > 1 && f.settings.map.blur_texels == 0,
                          samples > 1 && f.settings.map.blur_texels > 0
                              ? "map.blur_texels blurs depths, which have one sample a texel"
                              : fmt::format("map.samples is {}", samples)));
}

// Skipped passes
// -------------------------------------------------------------------------------------------------------

bool skips(const EffectFacts& f, std::string_view name) {
    const PassInfo* pass = f.frame.pass(name);
    return !pass || pass->state == PassState::Skipped;
}

std::string reference_unrequested(const EffectFacts& f) {
    return f.frame.reference.key == 0 && !f.frame.lights.empty() ? "nothing in the frame needs the reference" : "";
}

std::string viewer_unasked(const EffectFacts& f) {
    const PassInfo* viewer = f.frame.pass("map viewer");
    return viewer && viewer->state == PassState::Skipped ? viewer->reason : "";
}

std::string causes_unasked(const EffectFacts& f) {
    return skips(f, "causes found") && skips(f, "trials of all pixels") ? "not needed: causes are not shown" : "";
}

// The table -----------------------------------------------------------------------------------------------------------

#define SI_WHY(text) [](const EffectFacts&, const PassInfo&) { return std::string(text); }
#define SI_ABSENT(text) [](const EffectFacts&) { return std::string(text); }

/// Table of effects; the first row that matches the start of a pass's name counts.
const EffectRow kRows[] = {
    {.pass = "visible depths",
     .why = SI_WHY("light.depth_bounds is sdsm where the maps follow the camera"),
     .reason_absent = SI_ABSENT("no map is fitted to the depths that the camera sees (light.depth_bounds)")},
    {.pass = "pages requested", .why = SI_WHY("map.virtual is on: there are the pages that look-ups read")},
    {.pass = "pages of shadow maps",
     .why = why_pages,
     .parts = page_parts,
     .reason_absent =
         [](const EffectFacts& f) {
             return std::string(f.settings.map.paged ? "no light has a map that is drawn by pages"
                                                     : "map.virtual is off");
         }},
    {.pass = "shadow maps", .why = why_map},
    {.pass = "shadow map ", .why = why_map, .parts = map_parts},
    {.pass = "depth blur",
     .why = [](const EffectFacts& f,
               const PassInfo&) { return fmt::format("map.blur_texels is {}", f.settings.map.blur_texels); }},
    {.pass = "moments", .why = why_moments, .parts = moment_parts},
    {.pass = "camera depth", .why = SI_WHY("a pass reads the depth buffer of the camera")},
    {.pass = "surface ids", .why = SI_WHY("a request needs the triangle of each pixel")},
    {.pass = "shadow volumes",
     .why =
         [](const EffectFacts& f, const PassInfo& pass) {
             const auto light = std::size_t(pass.light);
             return fmt::format("{} is {}", light_setting_key(light, "source"), source_of(f.settings, int(light)).key);
         },
     .reason_absent = SI_ABSENT("no light's source is shadow volumes")},
    {.pass = "visible surfaces", .why = SI_WHY("pixels are evaluated outside the picture, too")},
    {.pass = "blobs",
     .why = SI_WHY("light.source of a light is blob"),
     .reason_absent = SI_ABSENT("no light's source is blob")},
    {.pass = "light map",
     .why = SI_WHY("light.source of a light is light-map"),
     .reason_absent = SI_ABSENT("no light's source is a light map that is baked")},
    {.pass = "visibility", .name = "visibility texture", .why = why_visibility, .parts = visibility_parts},
    {.pass = "unfiltered map",
     .why = SI_WHY("wrong pixels are requested, and polygon offset or masks with mip levels change the map"),
     .skip_reason = causes_unasked},
    {.pass = "reference uploaded",
     .name = "reference on the GPU",
     .why = SI_WHY("the picture shows or uses the ray-traced reference"),
     .skip_reason = reference_unrequested},
    {.pass = "pixels compared", .why = SI_WHY("wrong pixels are requested"), .skip_reason = reference_unrequested},
    {.pass = "causes found",
     .why = SI_WHY("causes of wrong pixels are requested"),
     .skip_reason = reference_unrequested},
    {.pass = "error metrics",
     .name = "metrics",
     .why = SI_WHY("error metrics of the picture are requested"),
     .skip_reason = reference_unrequested},
    {.pass = "trials of all pixels", .why = SI_WHY("the trials of all pixels are requested")},
    {.pass = "shading by the reference",
     .why = SI_WHY("the picture is compared with one lit by the reference"),
     .skip_reason = reference_unrequested},
    {.pass = "shading", .why = SI_WHY("the picture is requested"), .parts = shading_parts},
    {.pass = "smoothing", .why = SI_WHY("the view is static, and view.smooth is on")},
    {.pass = "overlay values", .why = SI_WHY("an overlay is shown")},
    {.pass = "overlay over picture", .why = SI_WHY("an overlay is shown over the picture")},
    {.pass = "texel slabs",
     .name = "stored-depth quads",
     .why = SI_WHY("view.slabs shows stored-depth quads in the scene")},
    {.pass = "map coordinates", .why = SI_WHY("the texels that pixels read are requested")},
    {.pass = "texels read", .why = SI_WHY("exact numbers of read texels are requested")},
    {.pass = "map channel",
     .why = SI_WHY("view.map_channel shows a moment instead of depth"),
     .skip_reason = viewer_unasked},
    {.pass = "drawn depth range",
     .why = SI_WHY("view.map_fit fits the greys of the map viewer to the drawn depths"),
     .skip_reason = viewer_unasked},
    {.pass = "numeric health", .why = SI_WHY("a search for unsound numbers is requested")},
    {.pass = "map viewer", .why = SI_WHY("the map viewer is open")},
};

#undef SI_WHY
#undef SI_ABSENT

const EffectRow* effect_row(const PassInfo& pass) {
    for (const EffectRow& row : kRows)
        if (pass.name.starts_with(row.pass)) return &row;
    return nullptr;
}

std::string part_reason(const PartInfo& part) {
    const std::string reason = as_sentence(part.reason);
    if (part.left_out == 0) return reason;
    std::string_view unit = part.unit;
    if (part.left_out == 1 && unit.ends_with('s')) unit.remove_suffix(1);
    return fmt::format("{}{}{} {} {} left out.", reason, reason.empty() ? "" : " ", part.left_out, unit,
                       part.left_out == 1 ? "is" : "are");
}

/// Returns the name of a pass's effect, with the pane if the pass belongs to one: "stored-depth quads (n-dot-l)".
std::string effect_name(const EffectRow* row, const PassInfo& pass) {
    if (!row || row->name.empty()) return pass.name;
    const std::string end = pass.name.substr(row->pass.size());
    return std::string(row->name) + (end.starts_with(" (") ? end : "");
}

void add_pass(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    const EffectRow* row = effect_row(pass);
    Effect effect{.name = effect_name(row, pass), .state = state_of(pass.state), .pass = pass.name};
    const bool skipped = pass.state == PassState::Skipped;
    if (row && !skipped) effect.reason = as_sentence(row->why(f, pass)) + " ";
    const std::string skip_reason = row && row->skip_reason && skipped ? row->skip_reason(f) : std::string();
    effect.reason += as_sentence(skip_reason.empty() ? pass.reason : skip_reason);
    const auto looked_up = [](const FittedLight& light) { return light.shadowed; };
    if (row && row->parts == visibility_parts && (skipped || f.forced.contains(Optimisation::FusedVisibility)) &&
        std::ranges::any_of(f.frame.lights, looked_up))
        effect.optimisation = Optimisation::FusedVisibility;
    const bool waits_for_maps = pass.reason == kMapBoundsWaitReason;
    if (pass.name == "map bounds" && (!skipped || waits_for_maps || f.forced.contains(Optimisation::EarlyOut)))
        effect.optimisation = Optimisation::EarlyOut;
    out.push_back(std::move(effect));
    for (const PartInfo& part : pass.parts)
        out.push_back({.name = part.name,
                       .state = state_of(part.state),
                       .reason = part_reason(part),
                       .optimisation = part.by,
                       .pass = pass.name,
                       .part = true});
    if (row && row->parts) row->parts(f, pass, out);
}

/// Adds the effect of cached static casters where no pass reports one, since nothing has moved yet.
void add_static(const EffectFacts& f, int animation, Effects& out) {
    for (const PassInfo& pass : f.frame.passes)
        for (const PartInfo& part : pass.parts)
            if (part.by == Optimisation::StaticCasterCache) return;
    const auto has_map = [](const FittedLight& light) { return light.casts; };
    std::string_view why = "nothing has moved since the frame before: maps are cached, or drawn whole";
    if (std::ranges::none_of(f.frame.lights, has_map))
        why = "no light has its shadows from a map";
    else if (!is_animated(f.scene, animation))
        why = "nothing moves in the scene: maps are cached, or drawn whole";
    out.push_back(
        {.name = "static casters", .reason = as_sentence(why), .optimisation = Optimisation::StaticCasterCache});
}

void count_casters(EffectFacts& f) {
    for (const Object& object : f.scene.objects) {
        if (!can_cast(f.scene, f.settings, object)) continue;
        const int material = f.scene.meshes[std::size_t(object.mesh)].material;
        ++f.casters;
        f.masked_casters += material >= 0 && f.scene.materials[std::size_t(material)].alpha != AlphaMode::Opaque;
    }
}

}  // namespace

Effect posing_effect(const Scene& scene, const SceneSettings& settings, bool again) {
    Effect effect{.name = "posing"};
    if (!scene.rig || scene.rig->animations.empty()) {
        effect.reason = "Nothing moves: the scene has no animation.";
    } else if (settings.animation < 0) {
        effect.reason = "scene.animation is -1: the scene is in its rest pose.";
    } else {
        const auto skins =
            std::count_if(scene.meshes.begin(), scene.meshes.end(), [](const Mesh& m) { return m.deformer; });
        effect.state = again ? EffectState::Drawn : EffectState::Cached;
        effect.reason =
            fmt::format("The scene is posed at {:.4g} s, with {} skinned or morphed mesh{}, {}.", settings.time, skins,
                        skins == 1 ? "" : "es", again ? "once for all passes and rays" : "as before");
    }
    return effect;
}

std::size_t sharing_optimisation_count(std::span<const Effect> effects, const Effect& effect) {
    if (!effect.optimisation) return 1;
    return std::size_t(std::ranges::count(effects, effect.optimisation, &Effect::optimisation));
}

std::vector<Effect> frame_effects(const Scene& scene, const Settings& settings, const FrameResult& frame,
                                  OptimisationSet forced) {
    EffectFacts facts{.scene = scene, .settings = settings, .frame = frame, .forced = forced};
    sanitise(facts.settings);
    count_casters(facts);
    Effects out;
    for (const PassInfo& pass : frame.passes) add_pass(facts, pass, out);
    add_static(facts, settings.scene.animation, out);
    for (const EffectRow& row : kRows) {
        const auto is_it = [&](const PassInfo& pass) { return pass.name.starts_with(row.pass); };
        if (!row.reason_absent || std::any_of(frame.passes.begin(), frame.passes.end(), is_it)) continue;
        out.push_back({.name = std::string(row.name.empty() ? row.pass : row.name),
                       .state = EffectState::NotNeeded,
                       .reason = as_sentence(row.reason_absent(facts))});
    }
    return out;
}

}  // namespace si
