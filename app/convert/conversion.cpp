#include "app/convert/conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/base/error.h"
#include "renderer/profiles/bias_numbers.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/param.h"
#include "renderer/view/fits/engine_facts.h"

namespace si {
namespace {

constexpr double kLargestAngleDeg = 89;
constexpr double kEqual = 1e-5;  ///< relative difference up to which two numbers are equal

std::string shown_number(double value) {
    return fmt::format("{:.6g}", value);
}

std::string_view choice_of(const Settings& s, const char* key) {
    static thread_local std::string text;
    const SettingRef ref = *find_setting(key);
    text = value_text(*ref.param, get_value(s, ref));
    return text;
}

/// Line-by-line writer of a comment.
class Head {
public:
    explicit Head(std::string_view mark) : mark_(mark) {}
    /// Adds a line of the program's own text, or of foreign text that comment_text() has cleaned.
    void add(const std::string& line) { text_ += line.empty() ? mark_ + "\n" : mark_ + " " + line + "\n"; }
    const std::string& text() const { return text_; }

private:
    std::string mark_, text_;
};

/// Bias of settings at the reference angle, by term.
struct BiasTerms {
    double constant = 0, slope = 0, normal = 0, raster = 0;  ///< equivalent depth bias, texels
    double total() const { return std::max(constant, slope) + normal + raster; }
};

BiasTerms bias_terms(const Settings& s, const MapFacts& facts) {
    const double angle = facts.angle_deg * std::numbers::pi / 180;
    const double per_unit = s.bias.unit == BiasUnit::Texels   ? 1
                            : s.bias.unit == BiasUnit::Metres ? 1 / facts.texel_m()
                                                              : facts.depth_m / facts.texel_m();
    const Bias& row = bias_of(s);
    BiasTerms out;
    if (reads_setting(row, "bias.constant")) out.constant = s.bias.constant * per_unit;
    if (reads_setting(row, "bias.slope")) out.slope = s.bias.slope * (1 - std::cos(angle)) * per_unit;
    const double offset_texels = s.bias.normal_texels() + s.bias.normal_metres() / facts.texel_m();
    out.normal = offset_texels * offset_equivalent(s.bias.normal_by, facts.angle_deg);
    out.raster = bias_numbers(s, facts).raster_texels(facts);
    return out;
}

/// Returns an amount of texels in three units: "1.5 texels = 0.0146484 m = 0.000366211 depth".
std::string three_units(double texels, const MapFacts& facts) {
    const double metres = texels * facts.texel_m();
    return fmt::format("{} texels = {} m = {} of the depth range", shown_number(texels), shown_number(metres),
                       shown_number(metres / facts.depth_m));
}

nlohmann::ordered_json three_units_json(double texels, const MapFacts& facts) {
    const double metres = texels * facts.texel_m();
    return {{"texels", texels}, {"metres", metres}, {"depth", metres / facts.depth_m}};
}

void add_facts(Head& head, const ConversionInput& in) {
    const MapFacts& f = in.facts;
    head.add(fmt::format("W {} m, N {} texels, D {} m: a texel is {} m wide ({})", shown_number(f.width_m), f.texels,
                         shown_number(f.depth_m), shown_number(f.texel_m()), in.facts_source));
    for (std::size_t i = 0; in.maps.size() > 1 && i < in.maps.size(); ++i)
        head.add(fmt::format("  map {}: W {} m, N {}, D {} m, texel {} m", i, shown_number(in.maps[i].width_m),
                             in.maps[i].texels, shown_number(in.maps[i].depth_m),
                             shown_number(in.maps[i].width_m / in.maps[i].texels)));
    head.add(fmt::format("reference angle {} degrees between normal and light ({})", shown_number(f.angle_deg),
                         in.angle_source));
    if (in.lookup.perspective)
        head.add("The light's rays come from a point: texels grow with the distance, and metres hold at one distance.");
}

void add_bias(Head& head, const ConversionInput& in) {
    const BiasTerms terms = bias_terms(in.settings, in.facts);
    head.add(fmt::format("bias.kind {}, filter.kernel {}", std::string(choice_of(in.settings, "bias.kind")),
                         std::string(choice_of(in.settings, "filter.kernel"))));
    const std::pair<const char*, double> rows[] = {{"constant", terms.constant},
                                                   {"slope", terms.slope},
                                                   {"normal offset", terms.normal},
                                                   {"polygon offset", terms.raster}};
    for (const auto& [name, texels] : rows)
        if (texels != 0) head.add(fmt::format("  {}: {}", name, three_units(texels, in.facts)));
    if (bias_of(in.settings).gives_needed_bias) head.add("  and the bias that the kind computes for each plane");
    if (terms.total() != 0)
        head.add(
            fmt::format("  together as depth bias at the reference angle: {}", three_units(terms.total(), in.facts)));
}

void add_measure(Head& head, const ConversionInput& in) {
    if (!in.measure) return;
    const ConvertedMeasure& m = *in.measure;
    head.add(fmt::format("measured on {} at {}x{} against {}: {:.4f} % of pixels wrong, {} of acne, mean error {}",
                         comment_text(m.scene), m.width, m.height, m.area ? "an area light" : "a hard reference",
                         100 * m.wrong, m.acne_px, shown_number(m.mae)));
    if (m.frame_ms)
        head.add(
            fmt::format("time {:.3g} ms a frame ({}, {})", *m.frame_ms, comment_text(m.driver), comment_text(m.clock)));
}

nlohmann::ordered_json measure_json_of(const ConversionInput& in) {
    if (!in.measure) return nullptr;
    const ConvertedMeasure& m = *in.measure;
    nlohmann::ordered_json out{
        {"scene", m.scene},     {"width", m.width}, {"height", m.height},  {"area", m.area},     {"wrong", m.wrong},
        {"acne_px", m.acne_px}, {"mae", m.mae},     {"frame_ms", nullptr}, {"driver", m.driver}, {"clock", m.clock}};
    if (m.frame_ms) out["frame_ms"] = *m.frame_ms;
    return out;
}

/// Returns the agreement of a number for people. @param bias the number is one of the bias
constexpr std::string_view exactness_text(Exactness exactness, bool bias) {
    if (exactness == Exactness::Missing) return "missing";
    if (exactness == Exactness::Exact) return bias ? "exact at every angle" : "exact";
    return bias ? "equal at the reference angle only" : "approximate";
}

/// Adds the head of an engine's numbers.
void add_engine(Head& head, const EngineProfile& profile, const WrittenValues& values, const MapFacts& facts) {
    head.add("number | metres | texels | agreement");
    for (const ConvertedParameter& p : values.parameters) {
        const bool bias = p.parameter->is_bias;
        std::string line =
            fmt::format("  {} = {}{}{}", p.parameter->key,
                        p.parameter->choices.empty() ? shown_number(p.value) : engine_value_text(*p.parameter, p.value),
                        p.parameter->unit.empty() ? "" : " ", p.parameter->unit);
        if (bias) line += fmt::format(" | {} m | {} texels", shown_number(p.metres), shown_number(p.texels));
        line += fmt::format(" | {}", exactness_text(p.exactness, bias));
        if (bias && std::abs(p.literal - p.value) > kEqual * std::abs(p.value))
            line += fmt::format("; {} without regard to hidden bias", shown_number(p.literal));
        if (!p.note.empty()) line += "; " + comment_text(p.note);
        head.add(line);
    }
    head.add(fmt::format("hidden bias, which {} adds by itself: {}", profile.title,
                         three_units(values.hidden_texels, facts)));
    head.add(fmt::format("wanted {} texels at the reference angle, given {} texels, hidden bias included",
                         shown_number(values.wanted_texels), shown_number(values.given_texels)));
    for (const MissingSetting& m : values.missing)
        head.add(fmt::format("missing: {} {}: {}", m.key, comment_text(m.value), comment_text(m.reason)));
    for (const std::string& note : values.notes) head.add("note: " + comment_text(note));
}

nlohmann::ordered_json engine_json(const EngineProfile& profile, const WrittenValues& values, const MapFacts& facts) {
    auto parameters = nlohmann::ordered_json::array();
    for (const ConvertedParameter& p : values.parameters) {
        nlohmann::ordered_json row{{"key", p.parameter->key}};
        if (p.parameter->choices.empty())
            row["value"] = p.value;
        else
            row["value"] = engine_value_text(*p.parameter, p.value);
        row["unit"] = p.parameter->unit;
        row["exactness"] = kExactnessKeys[std::size_t(p.exactness)];
        row["literal"] = p.literal;
        row["metres"] = p.metres;
        row["texels"] = p.texels;
        row["note"] = p.note;
        parameters.push_back(std::move(row));
    }
    auto missing = nlohmann::ordered_json::array();
    for (const MissingSetting& m : values.missing)
        missing.push_back({{"key", m.key}, {"value", m.value}, {"reason", m.reason}});
    return {{"profile", profile.name},
            {"title", profile.title},
            {"version", profile.version},
            {"parameters", parameters},
            {"missing", missing},
            {"notes", values.notes},
            {"wanted", three_units_json(values.wanted_texels, facts)},
            {"hidden", three_units_json(values.hidden_texels, facts)},
            {"given", three_units_json(values.given_texels, facts)}};
}

/// Returns a sentence on what the engine fits by itself.
constexpr std::string_view kFittedNote =
    "Numbers that are no texels hold for this W, D and N alone: convert again where the engine fits another map.";

}  // namespace

MapFacts facts_of_settings(const Settings& settings, std::string& source) {
    const LightSettings& light = settings.lights[std::size_t(settings.view.light)];
    MapFacts out{.texels = settings.map.resolution,
                 .cascades = light.type == LightType::Directional ? light.cascades : 1,
                 .format = settings.map.format,
                 .reversed_z = settings.map.reversed_z,
                 .light = settings.view.light};
    const bool wide = light.extent > 0, deep = uses_manual_near_far(light) && light.far > light.near;
    if (wide) out.width_m = 2 * light.extent;
    if (deep) out.depth_m = light.far - light.near;
    source = wide && deep ? "by light.extent, light.near and light.far"
             : wide       ? "W by light.extent, D assumed: give --scene, or light.near and light.far"
             : deep       ? "W assumed, D by light.near and light.far: give --scene, or light.extent"
                          : "W and D assumed: give --scene, or light.extent, light.near and light.far";
    return out;
}

std::vector<ConvertedMap> converted_maps(const Settings& settings, const FittedLight& light, MapSize size) {
    std::vector<ConvertedMap> maps;
    for (const LightView& view : light.views) {
        const MapFacts facts = map_facts(view, settings, size);
        maps.push_back({facts.width_m, facts.depth_m, facts.texels});
    }
    return maps;
}

std::optional<double> reference_angle_deg(const FloatImage& cosines, const FloatImage& visibility) {
    constexpr double kQuantile = 0.95;
    constexpr float kLit = 0.5f;
    std::vector<float> lit;
    for (std::size_t i = 0; i < visibility.data.size() && 4 * i + 3 < cosines.data.size(); ++i)
        if (cosines.data[4 * i + 3] > 0 && cosines.data[4 * i] > 0 && visibility.data[i] > kLit)
            lit.push_back(cosines.data[4 * i]);
    if (lit.empty()) return std::nullopt;
    const auto at = lit.begin() + std::ptrdiff_t((1 - kQuantile) * double(lit.size() - 1));
    std::ranges::nth_element(lit, at);
    const double angle = std::acos(std::min(double(*at), 1.0)) * 180 / std::numbers::pi;
    return std::min(angle, kLargestAngleDeg);
}

Conversion convert_settings(const ConvertTarget& target, const ConversionInput& in) {
    require_sound(in.facts);
    Conversion out;
    Head head(target.comment);
    head.add(fmt::format("Shadow settings for {}, by Shadow Inspector", target.title));
    head.add(fmt::format("preset {}{}", in.preset.empty() ? "none" : comment_text(in.preset),
                         in.title.empty() ? "" : ": " + comment_text(in.title)));
    if (!in.scene.empty()) head.add("scene " + comment_text(in.scene));
    add_facts(head, in);
    add_bias(head, in);
    out.json = {{"format", "shadow-inspector-conversion"},
                {"version", 1},
                {"target", target.name},
                {"title", target.title},
                {"preset", in.preset},
                {"preset_title", in.title},
                {"scene", in.scene},
                {"width_m", in.facts.width_m},
                {"texels", in.facts.texels},
                {"depth_m", in.facts.depth_m},
                {"texel_m", in.facts.texel_m()},
                {"facts", in.facts_source},
                {"angle_deg", in.facts.angle_deg},
                {"angle", in.angle_source}};
    std::string code;
    if (target.code) {
        const EngineProfile& profile = engine_profile(target.name);
        const WrittenValues values = write_engine_values(profile, in.settings, in.facts);
        head.add(fmt::format("{}, version: {}", profile.title, profile.version));
        add_engine(head, profile, values, in.facts);
        head.add(std::string(kFittedNote));
        if (!profile.unverified.empty()) head.add(fmt::format("not verified: {}", profile.unverified));
        out.json["not_verified"] = profile.unverified;
        if (in.lookup.type != LightType::Directional)
            out.notes.push_back(
                fmt::format("view.light {}: the numbers are those of a directional light; a spot or point "
                            "light needs others at each distance",
                            in.settings.view.light));
        code = target.code({profile, values, in.facts, in.settings});
        out.json["engine"] = engine_json(profile, values, in.facts);
    } else if (target.name == "glsl") {
        const ExportedCode exported = lookup_glsl(in.settings, in.lookup);
        head.add("exact at every angle: kernel and bias are the shader files of Shadow Inspector");
        code = exported.text;
        out.notes = exported.notes;
    } else {
        head.add("exact: all settings of the shadow map, in their own units");
        code = settings_cpp(in.settings, in.lookup);
    }
    add_measure(head, in);
    for (const std::string& note : out.notes) head.add("note: " + comment_text(note));
    out.json["measured"] = measure_json_of(in);
    out.json["notes"] = out.notes;
    out.json["code"] = code;
    out.text = head.text() + "\n" + code;
    return out;
}

}  // namespace si
