// Command `scene`: contents of a scene, and parts of its file that were dropped or approximated.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "app/base/json_text.h"
#include "app/base/notes.h"
#include "app/commands/commands.h"
#include "app/report/report.h"
#include "renderer/scene/animation.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

constexpr const char* kAlpha[] = {"opaque", "mask", "blend"};

/// Returns the index of a texture in the printed list.
Json texture_number(int index) {
    return index < 0 ? Json() : Json(index);
}

Json material_json(const Material& m) {
    return {{"name", m.name},
            {"alpha", kAlpha[std::size_t(m.alpha)]},
            {"double_sided", m.double_sided},
            {"unlit", m.unlit},
            {"base_colour", {m.base_colour.r, m.base_colour.g, m.base_colour.b, m.base_colour.a}},
            {"base_colour_texture", texture_number(m.base_colour_texture)},
            {"normal_texture", texture_number(m.normal_texture)}};
}

Json texture_json(const Texture& t) {
    return {{"name", t.name}, {"width", t.width}, {"height", t.height}, {"mipmaps", t.mipmaps}};
}

Json light_json(const SceneLight& l) {
    Json json = {{"name", l.name}, {"type", kLightTypeKeys[std::size_t(l.type)]}};
    json["position"] = vector_json(glm::dvec3(l.world[3]));
    if (l.type != LightType::Point) json["shines_along"] = vector_json(-glm::normalize(glm::dvec3(l.world[2])));
    if (l.type == LightType::Spot) json["cone_deg"] = 2 * l.outer_cone_rad * 180 / std::numbers::pi;
    json["colour"] = vector_json(l.colour);
    json["intensity"] = l.intensity;
    if (l.type != LightType::Directional) json["range"] = l.range > 0 ? Json(l.range) : Json();
    return json;
}

Json camera_json(const SceneCamera& c) {
    return {{"name", c.name},
            {"orthographic", c.orthographic},
            {"position", vector_json(glm::dvec3(c.world[3]))},
            {c.orthographic ? "height" : "fov_y_deg", c.orthographic ? c.height : c.fov_y_deg}};
}

Json animation_json(const Animation& a) {
    return {{"name", a.name}, {"duration_s", a.duration_s}, {"channels", a.channels.size()}};
}

Json facts(const Scene& scene, const std::string& name) {
    const auto count = [&](auto holds) { return std::count_if(scene.meshes.begin(), scene.meshes.end(), holds); };
    Json json = {{"scene", name}, {"about", scene.about}, {"triangles", scene.triangle_count()}};
    json["objects"] = scene.objects.size();
    json["nodes"] = scene.nodes.size();
    json["meshes"] = scene.meshes.size();
    json["skinned_meshes"] = count([](const Mesh& m) { return m.deformer && m.deformer->skin; });
    json["morphed_meshes"] = count([](const Mesh& m) { return m.deformer && !m.deformer->source->targets.empty(); });
    json["extent"] = nullptr;
    if (!scene.bounds.empty())
        json["extent"] = {{"min", vector_json(scene.bounds.lo)},
                          {"max", vector_json(scene.bounds.hi)},
                          {"size", vector_json(scene.bounds.hi - scene.bounds.lo)}};
    json["materials"] = json_list(scene.materials, material_json);
    json["textures"] = json_list(scene.textures, texture_json);
    json["file_scenes"] = scene.file_scenes;
    json["file_scene"] = scene.file_scene;
    json["lights"] = json_list(scene.lights, light_json);
    json["cameras"] = json_list(scene.cameras, camera_json);
    json["animations"] = scene.rig ? json_list(scene.rig->animations, animation_json) : Json::array();
    json["dropped_triangles"] = scene.dropped_triangles;
    json["warnings"] = scene.warnings;
    return json;
}

std::string triple(const Json& v) {
    return fmt::format("{:.6g} {:.6g} {:.6g}", v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

std::string label(const Json& text) {
    const std::string name = one_line(text.get<std::string>());
    return name.empty() ? "(no name)" : name;
}

std::string name_or(const Json& named) {
    return label(named["name"]);
}

/// Prints a heading with a count, and a line for each item.
void print_list(const char* heading, const Json& list, const std::function<std::string(const Json&)>& line) {
    fmt::print("{:<12} {}\n", heading, list.size());
    for (const Json& thing : list) fmt::print("  {}\n", line(thing));
}

/// Prints a heading and numbered lines, for things that settings choose by index.
void print_choices(const char* heading, const Json& list, const std::function<std::string(const Json&)>& line) {
    std::size_t i = 0;
    print_list(heading, list, [&](const Json& thing) { return fmt::format("{} {}", i++, line(thing)); });
}

void print_facts(const Json& f) {
    fmt::print("{}\n", one_line(f["scene"].get<std::string>()));
    if (const std::string about = f["about"]; !about.empty()) fmt::print("{}\n", one_line(about));
    fmt::print("\n{:<12} {}\n{:<12} {}\n{:<12} {}\n", "triangles", f["triangles"].get<std::size_t>(), "objects",
               f["objects"].get<std::size_t>(), "nodes", f["nodes"].get<std::size_t>());
    fmt::print("{:<12} {} ({} skinned, {} with morph targets)\n", "meshes", f["meshes"].get<std::size_t>(),
               f["skinned_meshes"].get<int>(), f["morphed_meshes"].get<int>());
    if (!f["extent"].is_null())
        fmt::print("{:<12} {} m, from {} to {}\n", "extent", triple(f["extent"]["size"]), triple(f["extent"]["min"]),
                   triple(f["extent"]["max"]));
    print_list("materials", f["materials"], [](const Json& m) {
        std::string line = fmt::format("{}: {}", name_or(m), m["alpha"].get<std::string>());
        if (m["double_sided"]) line += ", double-sided";
        if (m["unlit"]) line += ", unlit";
        if (!m["base_colour_texture"].is_null()) line += ", textured";
        if (!m["normal_texture"].is_null()) line += ", normal map";
        return line;
    });
    print_list("textures", f["textures"], [](const Json& t) {
        return fmt::format("{}: {} x {}", name_or(t), t["width"].get<int>(), t["height"].get<int>());
    });
    print_list("lights", f["lights"], [](const Json& l) {
        std::string line = fmt::format("{}: {}, intensity {:.6g}, at {}", name_or(l), l["type"].get<std::string>(),
                                       l["intensity"].get<double>(), triple(l["position"]));
        if (l.contains("range") && !l["range"].is_null())
            line += fmt::format(", range {:.6g} m", l["range"].get<double>());
        return line;
    });
    if (f["file_scenes"].size() > 1) {
        print_choices("file scenes", f["file_scenes"], [](const Json& name) { return label(name); });
        fmt::print("  this is {}; scene.index chooses\n", f["file_scene"].get<int>());
    }
    print_choices("cameras", f["cameras"], [](const Json& c) {
        return fmt::format("{}: {}, at {}", name_or(c), c["orthographic"] ? "orthographic" : "perspective",
                           triple(c["position"]));
    });
    print_choices("animations", f["animations"], [](const Json& a) {
        return fmt::format("{}: {:.6g} s, {} channels", name_or(a), a["duration_s"].get<double>(),
                           a["channels"].get<std::size_t>());
    });
    const Json& warnings = f["warnings"];
    if (warnings.empty()) {
        fmt::print("\nNothing was dropped or approximated.\n");
        return;
    }
    fmt::print("\nDropped or approximated:\n");
    for (const Json& w : warnings) fmt::print("  {}\n", one_line(w.get<std::string>()));
}

}  // namespace

void run_scene(const CommandOptions& options) {
    const SessionPlan plan = plan_session(options.session);
    const Json found = facts(load_scene(plan.scene_name, scene_options(plan)), plan.scene_name);
    if (options.json)
        fmt::print("{}", json_text(found));
    else
        print_facts(found);
}

}  // namespace si
