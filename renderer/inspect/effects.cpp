#include "renderer/inspect/effects.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/inspect/effect_parts.h"
#include "renderer/passes/casters.h"
#include "renderer/scene/animation.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Row of the table of effects: one kind of pass. State, further reasons and optimisation are those that it reports.
struct EffectRow {
    Result pass;             ///< result that identifies the pass
    std::string_view needs;  ///< request or setting that needs the pass, a clause; empty: the pass reports it
    /// Appends parts of the effect besides those that the pass reports.
    void (*parts)(const EffectFacts&, const PassInfo&, Effects&) = nullptr;
    std::string_view absent = {};  ///< reason why a frame has no such pass; empty: a missing pass is not listed
};

const EffectRow kRows[] = {
    {.pass = Result::VisibleDepths,
     .needs = "light.depth_bounds is sdsm where the maps follow the camera",
     .absent = "no map is fitted to the depths that the camera sees (light.depth_bounds)"},
    {.pass = Result::PagesWanted, .needs = "map.virtual is on: there are the pages that look-ups read"},
    {.pass = Result::Pages,
     .needs = "map.virtual is on: maps are drawn by pages, where look-ups read them",
     .parts = page_parts,
     .absent = "map.virtual is off, or no light has a map"},
    {.pass = Result::DrawnMaps, .needs = "the light has its shadows from a map", .parts = map_parts},
    {.pass = Result::ShadowMaps, .needs = "map.blur_texels is above 0"},
    {.pass = Result::Moments, .needs = "filter.kernel reads averages of functions of depth", .parts = moment_parts},
    {.pass = Result::CameraDepth, .needs = "a pass reads the depth buffer of the camera"},
    {.pass = Result::SurfaceIds, .needs = "a request needs the triangle of each pixel"},
    {.pass = Result::ShadowVolumes, .needs = {}, .absent = "no light's source is shadow volumes"},
    {.pass = Result::VisibleSurfaces, .needs = "pixels are evaluated outside the picture, too"},
    {.pass = Result::Blobs, .needs = "light.source of a light is blob", .absent = "no light's source is blob"},
    {.pass = Result::LightMap,
     .needs = "light.source of a light is light-map",
     .absent = "no light's source is a light map that is baked"},
    {.pass = Result::Visibility, .needs = {}, .parts = visibility_parts},
    {.pass = Result::UnfilteredMap,
     .needs = "wrong pixels are requested, and polygon offset or masks with mip levels change the map"},
    {.pass = Result::Reference, .needs = "the picture shows or uses the ray-traced reference"},
    {.pass = Result::Compared, .needs = "wrong pixels are requested"},
    {.pass = Result::Classified, .needs = "causes of wrong pixels are requested"},
    {.pass = Result::Error, .needs = "error metrics of the picture are requested"},
    {.pass = Result::Evidence, .needs = "the trials of all pixels are requested"},
    {.pass = Result::ReferenceLitPicture, .needs = "the picture is compared with one lit by the reference"},
    {.pass = Result::Shaded, .needs = "the picture is requested", .parts = shading_parts},
    {.pass = Result::Creases, .needs = "view.look is studio, and the picture is drawn with its look"},
    {.pass = Result::Smooth, .needs = "the view is static, and view.smooth is on"},
    {.pass = Result::Overlay, .needs = "an overlay is shown"},
    {.pass = Result::Composed, .needs = "an overlay is shown over the picture"},
    {.pass = Result::Slabs, .needs = "view.slabs shows texels in the scene"},
    {.pass = Result::MapCoordinates, .needs = "the texels that pixels read are requested"},
    {.pass = Result::TexelsRead, .needs = "exact numbers of read texels are requested"},
    {.pass = Result::MapChannel, .needs = "view.map_channel shows a moment instead of depth"},
    {.pass = Result::DepthRange, .needs = "view.map_fit fits the greys of the map viewer to the drawn depths"},
    {.pass = Result::Health, .needs = "a search for unsound numbers is requested"},
    {.pass = Result::MapView, .needs = "the map viewer is open"},
};

std::string part_reason(const PartInfo& part) {
    const std::string reason = as_sentence(part.reason);
    if (part.left_out == 0) return reason;
    std::string_view unit = part.unit;
    if (part.left_out == 1 && unit.ends_with('s')) unit.remove_suffix(1);
    return fmt::format("{}{}{} {} {} left out.", reason, reason.empty() ? "" : " ", part.left_out, unit,
                       part.left_out == 1 ? "is" : "are");
}

void add_pass(const EffectFacts& f, const PassInfo& pass, Effects& out) {
    const auto row = std::ranges::find_if(kRows, [&](const EffectRow& r) { return pass.makes == r.pass; });
    const bool known = row != std::end(kRows);
    std::string needs = as_sentence(pass.needs.empty() && known ? row->needs : pass.needs);
    needs = pass.state == PassState::Skipped || needs.empty() ? "" : needs + " ";
    out.push_back({.name = pass.name,
                   .state = state_of(pass.state),
                   .reason = needs + as_sentence(pass.reason),
                   .optimisation = pass.by,
                   .pass = pass.name});
    for (const PartInfo& part : pass.parts)
        out.push_back({.name = part.name,
                       .state = state_of(part.state),
                       .reason = part_reason(part),
                       .optimisation = part.by,
                       .pass = pass.name,
                       .part = true});
    if (known && row->parts) row->parts(f, pass, out);
}

/// Adds the effect of cached static casters where no pass reports one, since nothing has moved yet.
void add_static(const EffectFacts& f, int animation, Effects& out) {
    if (std::ranges::find(out, Optimisation::StaticCasterCache, &Effect::optimisation) != out.end()) return;
    std::string_view why = "nothing has moved since the frame before: maps are cached, or drawn whole";
    if (std::ranges::none_of(f.frame.lights, &FittedLight::casts))
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
        const auto skins = std::ranges::count_if(scene.meshes, [](const Mesh& m) { return bool(m.deformer); });
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
    for (const EffectRow& row : kRows)
        if (!row.absent.empty() && !frame.pass(row.pass))
            out.push_back({.name = std::string(result_name(row.pass)), .reason = as_sentence(row.absent)});
    return out;
}

}  // namespace si
