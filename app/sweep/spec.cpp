#include "app/sweep/spec.h"

#include <fmt/format.h>

#include <charconv>
#include <set>

#include "renderer/base/error.h"
#include "renderer/base/key.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/scene/animation.h"
#include "renderer/settings/param.h"
#include "renderer/settings/starting_values.h"

namespace si {

namespace {

constexpr int kMaxShards = 100'000;
constexpr int kFirstWithStartingValues = 3;  ///< version of settings; earlier sweeps assign bias.kind plainly

/// Adds the elements of a std::vector or SharedArray to a key.
template <typename List>
void add_array(Key& key, const List& values) {
    key.add(values.size()).bytes(values.data(), values.size() * sizeof(typename List::value_type));
}

void add_deformer(Key& key, const Deformer& deformer) {
    const DeformSource& source = *deformer.source;
    add_array(key, source.positions);
    add_array(key, source.normals);
    add_array(key, source.tangents);
    add_array(key, source.indices);
    for (const DeformSource::Target& t : source.targets) {
        add_array(key, t.positions);
        add_array(key, t.normals);
        add_array(key, t.tangents);
    }
    add_array(key, source.influences);
    key.add(source.influence_sets).add(deformer.node).add(deformer.placement);
    if (!deformer.skin) return;
    add_array(key, deformer.skin->joints);
    add_array(key, deformer.skin->inverse_bind);
}

/// Adds to a key all that other poses of a scene depend on. Adds nothing for a scene without animations.
void add_animations(Key& key, const Scene& scene) {
    if (!scene.rig || scene.rig->animations.empty()) return;
    for (const Animation& a : scene.rig->animations) {
        key.add(a.duration_s).add(a.channels.size());
        for (const AnimationChannel& c : a.channels) {
            key.add(c.node).add(c.property).add(c.interpolation).add(c.width);
            add_array(key, c.times_s);
            add_array(key, c.values);
        }
    }
    for (const NodeRestPose& r : scene.rig->rest) {
        key.add(r.has_trs).add(r.translation).add(r.scale);
        key.add(r.rotation.x).add(r.rotation.y).add(r.rotation.z).add(r.rotation.w);
        add_array(key, r.weights);
    }
    add_array(key, scene.rig->camera_nodes);
    add_array(key, scene.rig->light_nodes);
    for (const Mesh& m : scene.meshes)
        if (m.deformer) add_deformer(key, *m.deformer);
}

/// Returns a hash of the imported shadow maps of the bundle that the settings name (map.bundle); 0: they name none.
/// @throws Error for a bundle that cannot be read
std::uint64_t maps_content_key(const Settings& settings) {
    if (settings.map.bundle.empty()) return 0;
    const std::shared_ptr<const GivenMaps> given = given_maps(settings.map.bundle);
    Key key;
    for (const auto& maps : given->lights) key.add(maps ? maps->key : std::uint64_t(0));
    return key.value();
}

std::string hash_text(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

std::uint64_t hash_from_text(const std::string& text) {
    return std::stoull(text, nullptr, 16);
}

std::string shown(const Json& value) {
    if (value.is_null()) return "the default";
    return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Returns all values of the settings in a sweep: shared values and those of the axes.
std::vector<SettingValue> values_named(const Json& settings, const std::vector<SweepAxis>& axes) {
    std::vector<SettingValue> values;
    const auto add = [&](const std::string& key, const std::string& text) {
        const auto ref = find_setting(key);
        if (!ref) throw Error(fmt::format("{}: no such setting", key));
        values.emplace_back(*ref, parse_value(*ref, text));
    };
    for (const auto& [key, value] : settings.items()) add(key, value.get<std::string>());
    for (const SweepAxis& axis : axes)
        for (const std::string& value : axis.values) add(axis.key, value);
    return values;
}

std::set<std::string> held_keys(const Json& axis) {
    return axis.value("held", std::set<std::string>());
}

std::string axes_text(const Json& axes) {
    std::vector<std::string> texts;
    for (const Json& axis : axes) {
        texts.push_back(fmt::format("{}={}", axis.at("key").get<std::string>(),
                                    fmt::join(axis.at("values").get<std::vector<std::string>>(), ",")));
        for (const std::string& key : held_keys(axis)) texts.push_back(fmt::format("with --set {}", key));
    }
    return texts.empty() ? "nothing" : fmt::format("{}", fmt::join(texts, " "));
}

}  // namespace

Shard parse_shard(std::string_view text) {
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, shard.index);
    const bool has_slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
    const auto second = has_slash ? std::from_chars(first.ptr + 1, end, shard.count) : first;
    const bool whole = has_slash && second.ec == std::errc() && second.ptr == end;
    if (!whole || shard.count < 1 || shard.count > kMaxShards || shard.index < 1 || shard.index > shard.count)
        throw UsageError(fmt::format("--shard {}: must be I/N, I from 1 to N, such as 2/8", text));
    return shard;
}

std::uint64_t scene_content_key(const Scene& scene) {
    Key key;
    for (const Texture& t : scene.textures) {
        key.add(t.width).add(t.height).add(t.srgb).add(t.wrap_s).add(t.wrap_t);
        key.add(t.nearest_mag).add(t.nearest_min).add(t.mipmaps);
        add_array(key, t.rgba);
    }
    for (const Material& m : scene.materials) {
        key.add(m.base_colour).add(m.base_colour_texture).add(m.normal_texture).add(m.normal_scale);
        key.add(m.alpha).add(m.alpha_cutoff).add(m.double_sided).add(m.unlit);
    }
    for (const Mesh& m : scene.meshes) {
        add_array(key, m.positions);
        add_array(key, m.normals);
        add_array(key, m.uv);
        add_array(key, m.uv_normal);
        add_array(key, m.tangents);
        add_array(key, m.colours);
        add_array(key, m.indices);
        key.add(m.material);
    }
    for (const Node& n : scene.nodes) key.add(std::string_view(n.path)).add(n.world);
    for (const Object& o : scene.objects) key.add(o.node).add(o.mesh).add(o.world);
    for (const SceneCamera& c : scene.cameras)
        key.add(c.world).add(c.orthographic).add(c.fov_y_deg).add(c.height).add(c.near).add(c.far);
    add_animations(key, scene);
    return key.value();
}

SweepSpec sweep_spec(const std::string& scene_name, const Scene& scene, const Settings& settings,
                     std::vector<SweepAxis> axes, int width, int height) {
    return {.scene = scene_name,
            .scene_content = scene_content_key(scene),
            .maps_content = maps_content_key(settings),
            .triangles = scene.triangle_count(),
            .base = measured_settings(settings),
            .axes = std::move(axes),
            .width = width,
            .height = height,
            .area = settings.truth.area};
}

Json spec_json(const SweepSpec& spec) {
    Json json;
    json["scene"] = {{"name", spec.scene}, {"triangles", spec.triangles}, {"content", hash_text(spec.scene_content)}};
    if (spec.maps_content != 0) json["maps"] = hash_text(spec.maps_content);
    json["picture"] = {{"width", spec.width}, {"height", spec.height}};
    json["truth"] = spec.area ? "area" : "hard";
    json["settings"] = Json::object();
    for (const SettingRef& ref : changed_settings(spec.base))
        json["settings"][setting_key(ref)] = value_text(*ref.param, get_value(spec.base, ref));
    json["axes"] = Json::array();
    for (const SweepAxis& axis : spec.axes) {
        json["axes"].push_back({{"key", axis.key}, {"values", axis.values}});
        if (!axis.held.empty()) json["axes"].back()["held"] = axis.held;
    }
    json["shard"] = fmt::format("{}/{}", spec.shard.index, spec.shard.count);
    return json;
}

SweepSpec spec_from_json(const Json& json, int settings_version) {
    try {
        SweepSpec spec;
        spec.scene = json.at("scene").at("name").get<std::string>();
        spec.triangles = json["scene"].at("triangles").get<std::size_t>();
        spec.scene_content = hash_from_text(json["scene"].at("content").get<std::string>());
        if (json.contains("maps")) spec.maps_content = hash_from_text(json["maps"].get<std::string>());
        spec.width = json.at("picture").at("width").get<int>();
        spec.height = json["picture"].at("height").get<int>();
        spec.area = json.at("truth") == "area";
        for (const Json& axis : json.at("axes")) {
            spec.axes.push_back({axis.at("key").get<std::string>(), axis.at("values").get<std::vector<std::string>>(),
                                 held_keys(axis)});
            if (spec.axes.back().values.empty()) throw Error(fmt::format("{} has no values", spec.axes.back().key));
        }
        if (settings_version < kFirstWithStartingValues)
            for (SweepAxis& axis : spec.axes)
                if (const auto ref = find_setting(axis.key)) axis.held = keys_with_starting_values(*ref);
        spec.base =
            defaults_of_version(settings_version, configured_light_count(values_named(json.at("settings"), spec.axes)));
        for (const auto& [key, value] : json["settings"].items()) set_setting(spec.base, key, value.get<std::string>());
        spec.shard = parse_shard(json.at("shard").get<std::string>());
        return spec;
    } catch (const Json::exception&) {
        throw Error("what the sweep is of cannot be read: a member is missing or of another kind");
    } catch (const std::exception& e) {
        throw Error(fmt::format("what the sweep is of cannot be read: {}", e.what()));
    }
}

std::string plan_key(const SweepPlan& plan) {
    Key key;
    for (const SweepCase& c : plan.cases) key.add(std::string_view(c.id));
    return fmt::format("{:016x}", key.value());
}

std::string spec_difference(const Json& there, const Json& here, bool with_shard) {
    if (there.at("scene").at("content") != here.at("scene").at("content")) {
        const auto &a = there["scene"], &b = here["scene"];
        if (a.at("name") == b.at("name")) return fmt::format("the scene {} has changed since", shown(a["name"]));
        return fmt::format("scene {} there, {} here", shown(a["name"]), shown(b["name"]));
    }
    const auto size = [](const Json& s) {
        return fmt::format("{}x{}", s.at("picture").at("width").get<int>(), s.at("picture").at("height").get<int>());
    };
    if (size(there) != size(here)) return fmt::format("--size {} there, {} here", size(there), size(here));
    if (there.at("truth") != here.at("truth"))
        return fmt::format("{} reference there, {} here", shown(there["truth"]), shown(here["truth"]));
    if (there.at("axes") != here.at("axes"))
        return fmt::format("--vary {} there, {} here", axes_text(there["axes"]), axes_text(here["axes"]));
    Json keys = there.at("settings");
    keys.update(here.at("settings"));
    for (const auto& [key, unused] : keys.items()) {
        const Json a = there["settings"].value(key, Json()), b = here["settings"].value(key, Json());
        if (a != b) return fmt::format("{}: {} there, {} here", key, shown(a), shown(b));
    }
    if (there.value("maps", Json()) != here.value("maps", Json()))
        return fmt::format("the shadow maps of {} have changed since", shown(keys.value("map.bundle", Json())));
    if (with_shard && there.at("shard") != here.at("shard"))
        return fmt::format("--shard {} there, {} here", shown(there["shard"]), shown(here["shard"]));
    return {};
}

}  // namespace si
