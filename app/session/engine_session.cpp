#include "app/session/engine_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/base/finite_number.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/settings/param.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/engine_facts.h"
#include "renderer/view/fits/light_fit.h"

namespace si {
namespace {

constexpr double kAspect = 16.0 / 9;
constexpr std::string_view kAngleKey = "angle";

double parse_angle(std::string_view text) {
    const std::optional<double> value = finite_number(text);
    constexpr double kMaxAngle = 89;
    if (!value || *value < 0 || *value > kMaxAngle)
        throw UsageError(
            fmt::format("engine.angle: \"{}\" is not a number of degrees from 0 to {:g}", text, kMaxAngle));
    return *value;
}

/// Returns true for parameters whose defaults apply to a session without preset: of bias, filter, casters and format.
bool applies_by_default(const EngineParameter& parameter) {
    const auto of = [&](std::string_view topic) { return parameter.setting.starts_with(topic); };
    return parameter.is_bias || of("filter.") || of("caster.") || of("map.format");
}

bool is_of_bias(const ConvertedSetting& setting) {
    return setting.key.starts_with("bias.");
}

/// Sets the settings that engine values give. @param bias sets those of the bias, else all others
void set_read(const EngineSession& engine, const EngineValues& values, const MapFacts& facts, bool bias,
              Settings& settings, std::vector<std::string>* notes) {
    for (const ConvertedSetting& setting : read_engine_values(*engine.profile, values, facts)) {
        if (is_of_bias(setting) != bias) continue;
        set_setting(settings, setting.key, setting.value);
        if (!notes) continue;
        const std::string note = setting.note.empty() ? std::string() : ": " + setting.note;
        if (setting.exactness == Exactness::EqualAtAngle)
            notes->push_back(fmt::format("{}: equal to {} at {:g} degrees only{}", setting.key, engine.profile->title,
                                         facts.angle_deg, note));
        else if (!note.empty())
            notes->push_back(setting.key + note);
    }
}

/// Lets double-sided materials cast with both faces where the culling of casters is the engine's. An object with other
/// materials beside keeps the scene's culling.
void keep_double_sided(const EngineSession& engine, const EngineValues& values, const Scene& scene,
                       const std::set<std::string>& assigned, Settings& settings) {
    if (settings.caster.cull == Cull::None || assigned.contains("caster.cull")) return;
    const bool is_engines = std::ranges::any_of(engine.profile->parameters, [&](const EngineParameter& parameter) {
        return parameter.setting == "caster.cull" && values.contains(parameter.key) &&
               !(parameter.holds_for_double_sided && engine.values.contains(parameter.key));
    });
    if (!is_engines) return;
    std::map<int, bool> double_sided;  // by node
    for (const Object& object : scene.objects) {
        const int material = scene.meshes[std::size_t(object.mesh)].material;
        const bool both = material >= 0 && scene.materials[std::size_t(material)].double_sided;
        const auto [at, is_first] = double_sided.try_emplace(object.node, both);
        if (!is_first) at->second = at->second && both;
    }
    for (const auto& [node, both] : double_sided) {
        if (!both) continue;
        ObjectSettings& object = settings.objects[scene.nodes[std::size_t(node)].path];
        if (object.cull == ObjectCull::Inherit) object.cull = ObjectCull::None;
    }
}

}  // namespace

EngineSession take_engine_sets(const std::string& profile, std::vector<std::string>& sets) {
    EngineSession out;
    if (!profile.empty()) {
        out.profile = &engine_profile(profile);
        if (!out.profile->read_bias)
            throw UsageError(
                fmt::format("--profile {}: no conversion is known. {}; `list profile {}` prints what is known", profile,
                            out.profile->unverified, profile));
    }
    std::vector<std::string> rest;
    for (std::string& assignment : sets) {
        const auto equals = assignment.find('=');
        if (!assignment.starts_with(kEnginePrefix) || equals == std::string::npos) {
            const ForcedSetting* forced =
                out.profile ? forced_setting(*out.profile, assignment.substr(0, equals)) : nullptr;
            if (forced && equals != std::string::npos) {
                const auto ref = find_setting(forced->key);
                if (parse_value(*ref, assignment.substr(equals + 1)) != parse_value(*ref, forced->value))
                    throw UsageError(fmt::format("--set {}: {} fixes it at {}, since {}; leave it out", assignment,
                                                 out.profile->title, forced->value, forced->reason));
            }
            rest.push_back(std::move(assignment));
            continue;
        }
        const std::string key = assignment.substr(kEnginePrefix.size(), equals - kEnginePrefix.size());
        const std::string text = assignment.substr(equals + 1);
        if (!out.profile)
            throw UsageError(
                fmt::format("--set {}: parameters of an engine need --profile NAME (`list profiles`)", assignment));
        if (key == kAngleKey) {
            out.angle_deg = parse_angle(text);
            continue;
        }
        const EngineParameter& parameter = engine_parameter(*out.profile, key);
        out.values[std::string(parameter.key)] = parse_engine_value(*out.profile, parameter, text);
        out.gives_bias = out.gives_bias || parameter.is_bias;
    }
    sets = std::move(rest);
    return out;
}

MapFacts map_facts(const Scene& scene, const Settings& settings) {
    const auto index = std::size_t(settings.view.light_index());
    if (!settings.map.bundle.empty()) {
        const auto given = given_maps(settings.map.bundle);
        if (index < given->lights.size() && given->lights[index]) {
            const auto maps = placed_maps(given->lights[index], scene.placement);
            if (maps->views && !maps->images.empty())
                return map_facts(maps->views->views.front(), settings,
                                 MapSize(maps->images.front().width, maps->images.front().height));
        }
    }
    const Camera camera = make_camera(scene, settings, kAspect);
    const std::vector<FittedLight> lights = fit_lights(scene, settings, &camera);
    return map_facts(index < lights.size() ? &lights[index] : nullptr, settings, MapSize(settings.map.resolution));
}

std::vector<std::string> apply_engine(const EngineSession& engine, const Scene& scene, bool has_preset,
                                      std::span<const std::string> sets, Settings& settings) {
    std::vector<std::string> notes;
    if (!engine.profile) return notes;
    const EngineProfile& profile = *engine.profile;
    const std::set<std::string> assigned = assigned_keys(sets);
    const bool own_bias =
        std::ranges::any_of(assigned, [](const std::string& key) { return key.starts_with("bias."); });
    EngineValues values = engine.values;
    if (!has_preset)
        for (const EngineParameter& parameter : profile.parameters)
            if (applies_by_default(parameter)) values.try_emplace(std::string(parameter.key), parameter.standard);
    const bool reads_bias = engine.gives_bias || (!has_preset && !own_bias);
    notes = apply_forced_settings(profile, settings);
    MapFacts facts;
    if (engine.angle_deg) facts.angle_deg = *engine.angle_deg;
    const auto reset_own = [&] {
        for (const std::string& assignment : sets) apply_set(settings, assignment);
        apply_forced_settings(profile, settings);
    };
    // Cascades share the map of some engines: the second round has the number of cascades that the first gave.
    const int rounds = profile.cascades_share_map ? 2 : 1;
    for (int round = 0; round < rounds; ++round) {
        const MapFacts drawn = map_facts(scene, settings);
        facts.cascades = drawn.cascades;
        facts.light = drawn.light;
        set_read(engine, values, facts, false, settings, round + 1 == rounds ? &notes : nullptr);
        reset_own();
    }
    if (reads_bias) {
        // A normal offset widens the margin of a fit, and so the map: the second round has the width that is drawn.
        constexpr int kRounds = 2;
        for (int round = 0; round < kRounds; ++round) {
            const double angle_deg = facts.angle_deg;
            facts = map_facts(scene, settings);
            facts.angle_deg = angle_deg;
            set_read(engine, values, facts, true, settings, round + 1 == kRounds ? &notes : nullptr);
            reset_own();
        }
    }
    keep_double_sided(engine, values, scene, assigned, settings);
    for (const LackingSetting& row : profile.lacking)
        if (lacking_setting(profile, settings, row.key) == &row)
            notes.push_back(fmt::format("{}: {} lacks it: {}", row.key, profile.title, row.reason));
    if (!profile.unverified.empty())
        notes.push_back(fmt::format("{}: not verified: {}", profile.title, profile.unverified));
    for (std::string& repair : sanitise(settings)) notes.push_back(std::move(repair));
    return notes;
}

}  // namespace si
