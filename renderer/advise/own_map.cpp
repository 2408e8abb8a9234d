#include "renderer/advise/own_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "renderer/base/error.h"
#include "renderer/bundle/imported_maps.h"
#include "renderer/inspect/given_map_changes.h"
#include "renderer/inspect/map_comparison.h"

namespace si {
namespace {

/// Returns the reason why a light's own maps do not stand for its imported ones; empty: they do.
/// @param own settings with own maps
std::string why_maps_differ(const SearchTools& tools, const Settings& base, const Settings& own) {
    const FrameRequest request{.width = 16, .height = 16, .outputs = {.colour = false, .shadow_map = true}};
    const auto maps = tools.renderer.render(tools.scene, base, request).imported;
    const auto drawn = tools.renderer.render(tools.scene, own, request).imported;
    const auto light = std::size_t(std::max(base.view.light, 0));
    // The gate draws the bundle's raster state, and settings may have changed it.
    if (light < maps.size() && maps[light] && drawn[light]->raster != maps[light]->raster)
        return fmt::format("{}; bias.raster_* or caster.cull are not as the engine has drawn it", kNeedsAnotherMap);
    // Masks are rarely those of the engine to the texel. What they cover is left out of the gate.
    for (const ComparedMap& map : compare_imported_maps(tools.renderer, tools.scene, base, maps, base.view.light,
                                                        {.leaves_out_masked = true}, tools.workers))
        if (!map.numbers.gate.passed())
            return fmt::format("{}; the inspector's own map from the same light differs{}: {}", kNeedsAnotherMap,
                               map.numbers.name.empty() ? "" : " (" + map.numbers.name + ")", map.numbers.gate.text);
    return {};
}

}  // namespace

OwnMap own_map_of(const SearchTools& tools, const Settings& base, const MeasuredSettings& before,
                  const TrialMeter& meter) {
    OwnMap out{.settings = base, .before = {}, .why_not = {}};
    out.settings.map.bundle_maps = BundleMaps::Drawn;
    out.settings.map.resolution = before.frame->map_resolution;
    try {
        out.why_not = why_maps_differ(tools, base, out.settings);
        if (out.why_not.empty()) out.before = meter.measure(out.settings, base.view.light);
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) {
        out.why_not = fmt::format("{}; there is no own map: {}", kNeedsAnotherMap, error.what());
    }
    return out;
}

Trial try_on_own_map(const Settings& base, const MeasuredSettings& before, const OwnMap& own, Candidate candidate,
                     const TrialMeter& meter, std::optional<std::size_t> pixel, const NeedsCauses& needs_causes) {
    const SettingChanges wanted = setting_changes(base, candidate.settings);
    const auto is_lost = [](const auto& change) {
        return acts_while_drawing(change.first) && !acts_on_redrawn_map(change.first);
    };
    if (std::ranges::any_of(wanted, is_lost))
        candidate.untried = kNeedsAnotherMap;
    else if (!own.why_not.empty())
        candidate.untried = own.why_not;
    // Causes may differ, as a given map cannot be drawn without its polygon offset.
    else if (pixel && pixel_trial(*before.frame, *pixel).right != pixel_trial(*own.before.frame, *pixel).right)
        candidate.untried =
            fmt::format("{}; the inspector's own map does not show this pixel's fault", kNeedsAnotherMap);
    if (candidate.untried.empty()) {
        candidate.label = fmt::format("{} ({})", candidate.shown_name(), kTriedOnOwnMap);
        candidate.settings.map.bundle_maps = BundleMaps::Drawn;
        if (candidate.settings.map.resolution == base.map.resolution)
            candidate.settings.map.resolution = own.settings.map.resolution;
    }
    Trial t = try_candidate(own.settings, own.before, std::move(candidate), meter, pixel, needs_causes);
    t.changes = setting_changes(base, t.candidate.settings);
    t.on_own_map = t.is_drawn();
    return t;
}

}  // namespace si
