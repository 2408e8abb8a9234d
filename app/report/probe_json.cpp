#include "app/report/probe_json.h"

#include <cmath>

#include "app/report/fixes_json.h"
#include "app/report/measure_json.h"
#include "app/report/report.h"
#include "renderer/reference/artefact_picture.h"

namespace si {
namespace {

Json amount_json(const DepthShift& a) {
    return {{"depth", a.depth}, {"texels", a.texels}, {"metres", a.metres}};
}

Json tap_json(const KernelTap& t) {
    static constexpr const char* kMeets[] = {"nothing", "own surface", "nearer surface", "farther surface"};
    return {{"texel", {t.texel.x, t.texel.y}},
            {"stored", t.stored},
            {"stored_m", t.stored_m},
            {"compared", t.compared},
            {"plane", t.plane},
            {"lit", t.lit},
            {"weight", t.weight},
            {"meets", kMeets[std::size_t(t.meets)]}};
}

Json account_json(const BiasBreakdown& a) {
    return {{"terms",
             {{"constant", amount_json(a.amount(a.constant))},
              {"slope", amount_json(a.amount(a.slope))},
              {"by_itself", amount_json(a.amount(a.bias_of_kind))},
              {"normal", amount_json(a.amount(a.normal))},
              {"raster", amount_json(a.amount(a.raster))}}},
            {"worth", amount_json(a.amount(a.equivalent_depth()))},
            {"lifted", amount_json(a.amount(a.depth_shift))},
            {"least", amount_json(a.amount(a.least.total()))},
            {"least_parts",
             {{"kernel", amount_json(a.amount(a.least.kernel))},
              {"quantum", amount_json(a.amount(a.least.quantum))},
              {"snapping", amount_json(a.amount(a.least.snapping))},
              {"rounding", amount_json(a.amount(a.least.rounding))}}},
            {"gradient", {a.plane.gradient.x, a.plane.gradient.y}},
            {"theta_deg", glm::degrees(a.theta_rad)},
            {"contact_gap_m", a.contact_gap_m()}};
}

Json per_light_json(const Probe::PerLight& p) {
    const LightReceiver& r = p.account.receiver;
    Json json = {{"light", p.light},
                 {"face", p.face},
                 {"view", p.view},
                 {"casts", p.casts},
                 {"clip", {r.clip.x, r.clip.y, r.clip.z, r.clip.w}},
                 {"ndc", vector_json(r.ndc)},
                 {"uvd", vector_json(r.uvd)},
                 {"kernel_centre", vector_json(r.tap)},
                 {"texel", {p.texel.x, p.texel.y}},
                 {"n_dot_l", r.n_dot_l},
                 {"stored", p.stored},
                 {"stored_linear", p.stored_linear},
                 {"stored_m", p.stored_m},
                 {"gap_m", p.gap_m},
                 {"own", p.own},
                 {"own_linear", p.own_linear},
                 {"own_m", r.own_m},
                 {"bias_depth", r.bias_depth},
                 {"bias_texels", p.bias_texels},
                 {"bias_m", r.bias_m},
                 {"normal_offset_m", r.normal_offset_m},
                 {"texel_m", r.texel_m},
                 {"compared", p.compared},
                 {"visibility", p.visibility},
                 {"where", place_name(p.place)},
                 {"verdict", p.verdict}};
    if (!p.casts) return json;
    json["bias"] = account_json(p.account);
    json["taps_across"] = p.taps_size.x;
    json["taps_up"] = p.taps_size.y;
    json["taps"] = json_list(p.taps, tap_json);
    json["kernel"] = {{"texels", p.kernel.texels}};
    if (!std::isnan(p.kernel.blocker_m)) json["kernel"]["blocker_m"] = p.kernel.blocker_m;
    if (!std::isnan(p.kernel.penumbra_texels)) json["kernel"]["penumbra_texels"] = p.kernel.penumbra_texels;
    if (!std::isnan(p.kernel.variance)) json["kernel"]["variance"] = p.kernel.variance;
    if (!std::isnan(p.kernel.bound)) {
        for (const double moment : p.kernel.moments)
            if (!std::isnan(moment)) json["kernel"]["moments"].push_back(moment);
        json["kernel"]["mean"] = p.kernel.mean;
        json["kernel"]["own"] = p.kernel.own;
        json["kernel"]["bound"] = p.kernel.bound;
        json["kernel"]["lines"] = p.kernel.lines;
        if (!std::isnan(p.kernel.margin)) json["kernel"]["margin"] = p.kernel.margin;
    }
    return json;
}

/// @param fix the fix of this light that was drawn; null: none
Json diagnosis_json(const PixelDiagnosis& d, const Trial* fix) {
    Json json = {{"verdict", d.verdict},
                 {"right", d.right},
                 {"engine_bias", engine_bias_key(d.engine_bias)},
                 {"engine_bias_from", engine_bias_source_json(d.engine_bias)},
                 {"artefact", "none"},
                 {"any_leak", d.reference.any_leak},
                 {"truth",
                  {{"state", state_key(d.reference.state)},
                   {"lit", d.reference.lit},
                   {"area_share", d.reference.share},
                   {"area_noise", d.reference.noise},
                   {"gap_m", d.reference.gap_m}}},
                 {"window",
                  {{"least", amount_json(d.least)},
                   {"occluder", amount_json(d.occluder)},
                   {"open", d.window_open()},
                   {"opening_resolution", d.opening_resolution}}},
                 {"remedy", nullptr}};
    for (const ArtefactStyle& style : artefact_styles())
        if (style.artefact == d.reference.cause.artefact) json["artefact"] = style.key;
    if (fix) {
        const auto& [key, value] = fix->changes.front();
        json["remedy"] = {{"key", key},
                          {"value", value},
                          {"text", fix->candidate.shown_name()},
                          {"settings", changes_json(fix->changes)}};
    }
    json["also"] = Json::array();
    for (const ArtefactStyle& style : artefact_styles())
        if (d.cause().also >> int(style.artefact) & 1) json["also"].push_back(style.key);
    if (d.cause().artefact == Artefact::OutsideMap) json["kind"] = d.cause().seam ? "seam" : "outside";
    return json;
}

}  // namespace

Json probe_json(const Probe& probe, std::span<const PixelDiagnosis> diagnoses, const Trial* fix) {
    Json json = {{"hit", probe.hit}, {"x", probe.x}, {"y", probe.y}};
    if (!probe.hit) return json;
    json["object"] = probe.object;
    json["position_ws"] = vector_json(probe.position_ws);
    json["normal_ws"] = vector_json(probe.normal_ws);
    json["lights"] = Json::array();
    for (const auto& light : probe.lights) {
        json["lights"].push_back(per_light_json(light));
        for (const PixelDiagnosis& d : diagnoses)
            if (d.light == light.light)
                json["lights"].back()["dossier"] =
                    diagnosis_json(d, fix && fix->candidate.light == d.light ? fix : nullptr);
    }
    return json;
}

}  // namespace si
