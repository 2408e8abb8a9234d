#include "app/report/report.h"

#include <algorithm>

#include "app/session/setting_json.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"

namespace si {

namespace {

Json scene_json(const Session& session) {
    const Scene& s = session.scene;
    const std::size_t ground =
        s.objects.size() - s.object_count();  // the added ground is one mesh, one node and one material
    Json bounds = nullptr;
    if (!s.bounds.empty()) bounds = {{"min", vector_json(s.bounds.lo)}, {"max", vector_json(s.bounds.hi)}};
    return {{"name", session.scene_name},
            {"triangles", s.triangle_count()},
            {"meshes", s.meshes.size() - ground},
            {"nodes", s.nodes.size() - ground},
            {"objects", s.object_count()},
            {"materials", s.materials.size() - ground},
            {"textures", s.textures.size()},
            {"bounds", bounds},
            {"warnings", s.warnings}};
}

/// Converts the settings that act on this frame to JSON: lights that are on, objects with an override.
Json settings_json(const Settings& settings) {
    Json json = Json::object();
    for (const SettingRef& ref : all_settings(settings)) {
        if (ref.param->scope == Scope::Light && ref.light >= settings.light_count) continue;
        json[setting_key(ref)] = setting_to_json(ref, get_value(settings, ref));
    }
    return json;
}

Json view_json(const LightView& view) {
    const glm::dmat4 clip_from_world = view.clip_from_relative(glm::dvec3(0));
    glm::dmat4 light_from_world(glm::transpose(view.axes));
    light_from_world[3] = glm::dvec4(-(glm::transpose(view.axes) * view.eye), 1);
    return {{"view", matrix_json(light_from_world)},
            {"projection", matrix_json(view.projection)},
            {"clip_from_world", matrix_json(clip_from_world)}};
}

Json light_json(const Session& session, const FrameResult& frame, std::size_t i) {
    const FittedLight& light = frame.lights[i];
    Json json = {{"light", i},
                 {"type", kLightTypeKeys[std::size_t(light.type)]},
                 {"source", source_of(session.settings, int(i)).key},
                 {"casts", light.casts},
                 {"reason", light.reason},
                 {"notes", light.notes},
                 {"clipped_casters", light.clipped_casters},
                 {"position", vector_json(light.position)},
                 {"to_light", vector_json(light.to_light)}};
    json["lost_casters"] = lost_casters_json(session.scene, lost_casters(session.scene, session.settings, light));
    if (light.views.empty()) return json;
    const LightView& first = light.views.front();
    const double centre_m = glm::dot(first.axes[2], first.eye - session.scene.bounds.centre());
    const double at = first.curve.perspective ? std::clamp(centre_m, first.curve.near, first.curve.far) : centre_m;
    json["projection"] = first.curve.perspective ? "perspective" : first.warped() ? "warped" : "orthographic";
    json["matrices"] = view_json(first);
    if (first.warped()) {
        const TexelSize sizes = first.texel_size_range(frame.map_size);
        json["texel_sizes_m"] = {sizes.shortest, sizes.longest};
        json["texel_size_m"] = first.texel_size_at(session.scene.bounds.centre(), frame.map_size).longest;
    } else {
        json["texel_size_m"] = first.texel_size(at, frame.map_size);
    }
    json["texel_size_at_m"] = at;
    json["depth_range_m"] = {first.curve.near, first.curve.far};
    json["depth_zero_to_one"] = first.curve.convention.zero_to_one;
    json["depth_reversed"] = first.curve.convention.reversed;
    if (light.views.size() > 1 && !light.is_cascaded())
        for (const LightView& view : light.views) json["faces"].push_back(view_json(view));
    for (std::size_t v = 0; light.is_cascaded() && v < light.views.size(); ++v) {
        Json cascade = view_json(light.views[v]);
        cascade["texel_size_m"] = light.views[v].texel_size_range(frame.map_size).longest;
        cascade["depth_range_m"] = {light.views[v].curve.near, light.views[v].curve.far};
        const ViewSpan& span = light.chooser.spans[v];
        if (light.chooser.choice == ViewChoice::Interval) {
            cascade["ends_m"] = span.ends;
            cascade["blends_from_m"] = span.blends_from;
        }
        json["cascades"].push_back(std::move(cascade));
    }
    return json;
}

Json pass_json(const PassInfo& pass) {
    static constexpr const char* kStates[] = {"ran", "reused", "skipped"};
    return {{"name", pass.name},          {"state", kStates[std::size_t(pass.state)]},
            {"reason", pass.reason},      {"gpu_ms", pass.gpu_ms},
            {"cpu_ms", pass.cpu_ms},      {"draws", pass.draws},
            {"triangles", pass.triangles}};
}

}  // namespace

Json matrix_json(const glm::dmat4& m) {
    Json rows = Json::array();
    for (int r = 0; r < 4; ++r) rows.push_back({m[0][r], m[1][r], m[2][r], m[3][r]});
    return rows;
}

Json vector_json(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json pages_json(const PageFacts& p) {
    return {{"page_texels", p.page_texels},
            {"requested", p.wanted},
            {"drawn", p.drawn},
            {"cached", p.kept},
            {"coarser", p.coarser},
            {"evicted", p.evicted},
            {"held", p.held},
            {"pool", p.pool},
            {"requested_by_level", p.by_level},
            {"finest_texel_m", p.smallest_texel_m},
            {"drawn_texels", p.drawn_texels()},
            {"read_texels", p.read_texels()},
            {"fixed_map_texels", p.fixed_map_texels}};
}

Json light_map_json(const LightMapNeed& n) {
    return {{"baked", n.met},       {"resolution", n.resolution}, {"texels_per_metre", n.texels_per_metre},
            {"charts", n.charts},   {"bytes", n.bytes},           {"rays", n.rays},
            {"bake_ms", n.bake_ms}, {"from_disk", n.from_disk}};
}

Json driver_json(const DriverInfo& d) {
    Json offsets = Json::object();
    const auto formats = find_setting("map.format")->param->choices();
    for (std::size_t i = 0; i < formats.size(); ++i) {
        const PolygonOffset& o = d.offset[i];
        offsets[std::string(formats[i].key)] = {{"unit_depth", o.unit_depth},
                                                {"unit_steps", o.unit_steps},
                                                {"slope", o.slope_is_length ? "length" : "larger"},
                                                {"slope_gain", o.slope_gain}};
    }
    return {{"vendor", d.vendor},
            {"renderer", d.renderer},
            {"version", d.version},
            {"glsl", d.glsl},
            {"software", d.software},
            {"max_texture_size", d.max_texture_size},
            {"subpixel_bits", d.subpixel_bits},
            {"max_samples", d.max_samples},
            {"polygon_offset_clamp", d.polygon_offset_clamp},
            {"polygon_offset", offsets},
            {"anisotropy", d.anisotropy},
            {"clock", d.clock},
            {"query_share", d.query_share}};
}

Json memory_json(const MemoryReport& facts) {
    const auto holder_json = [](const MemoryUse& h) -> Json {
        return {{"holder", h.holder}, {"bytes", h.bytes}, {"most", h.most}, {"count", h.count}};
    };
    const ProcessMemory& p = facts.process;
    return {{"resident", p.resident},   {"peak", p.peak},       {"heap", p.heap},
            {"heap_free", p.heap_free}, {"held", facts.held()}, {"holders", json_list(facts.holders, holder_json)}};
}

Json lost_casters_json(const Scene& scene, const std::vector<LostCaster>& lost) {
    return json_list(lost, [&](const LostCaster& l) -> Json {
        const Object& object = scene.objects[std::size_t(l.object)];
        return {{"object", scene.nodes[std::size_t(object.node)].path},
                {"by", lost_by_key(l.by)},
                {"culled", l.by != LostBy::Culling ? Json() : Json(l.cull == Cull::Front ? "front" : "back")},
                {"triangles", l.triangles}};
    });
}

Json report_json(const Session& session, const std::string& view, const FrameRequest& request, const FrameResult& frame,
                 const DriverInfo& driver) {
    Json json;
    json["format"] = "shadow-inspector-report";
    json["version"] = 1;
    json["scene"] = scene_json(session);
    json["picture"] = {{"view", view}, {"width", request.width}, {"height", request.height}};
    json["settings"] = settings_json(session.settings);
    json["camera"] = {{"eye", vector_json(frame.camera.eye)},
                      {"near", frame.camera.curve.near},
                      {"far", frame.camera.curve.far},
                      {"clip_from_world", matrix_json(frame.camera.clip_from_relative(glm::dvec3(0)))}};
    json["map_resolution"] = frame.map_resolution;
    if (frame.pages) json["pages"] = pages_json(*frame.pages);
    for (const LightMapNeed& n : frame.light_maps)
        json["light_maps"].push_back(n.key == 0 ? Json(nullptr) : light_map_json(n));
    json["fit"] = Json::array();
    for (std::size_t i = 0; i < frame.lights.size(); ++i) json["fit"].push_back(light_json(session, frame, i));
    json["passes"] = json_list(frame.passes, pass_json);
    json["notes"] = frame.notes;
    json["clock"] = frame.clock;
    json["driver"] = driver_json(driver);
    return json;
}

std::string json_text(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace si
