#include "app/report/measure_json.h"

#include <cmath>
#include <limits>

#include "renderer/reference/artefact_picture.h"

namespace si {

namespace {

Json or_null(double v) {
    return std::isfinite(v) ? Json(v) : Json();
}

template <typename Count>
void read_count(Count& to, const Json& json, std::string_view field) {
    if (const auto at = json.find(field); at != json.end() && at->is_number()) to = at->get<Count>();
}

}  // namespace

Json engine_bias_source_json(EngineBias bias) {
    const std::string_view source = engine_bias_source_key(bias);
    return source.empty() ? Json() : Json(source);
}

Json spread_json(const Spread& s) {
    return {{"median", s.median},
            {"p95", s.p95},
            {"low", s.low},
            {"high", s.high},
            {"median_low", s.median_low},
            {"median_high", s.median_high},
            {"noise", s.noise()}};
}

Json time_json(const TimeMeasurement& time) {
    const auto pass_json = [](const PassTime& pass) -> Json {
        return {{"name", pass.name}, {"gpu_ms", spread_json(pass.gpu_ms)}, {"cpu_ms", spread_json(pass.cpu_ms)}};
    };
    return {{"total_ms", spread_json(time.total_ms)},
            {"shadow_maps_ms", spread_json(time.maps_ms)},
            {"picture_ms", spread_json(time.picture_ms)},
            {"wall_ms", time.wall_ms ? spread_json(*time.wall_ms) : Json()},
            {"frames", time.total_ms.samples},
            {"bursts", time.total_ms.bursts},
            {"spread", time.total_ms.relative()},
            {"settled", time.settled},
            {"clock", time.clock},
            {"timed", cost_row(time.cost).key},
            {"passes", json_list(time.passes, pass_json)}};
}

const char* state_key(PixelState state) {
    static constexpr const char* kStates[] = {"counted",       "background",   "faces_away",       "outside_cone",
                                              "not_receiving", "beyond_range", "shadow_terminator"};
    static_assert(std::size(kStates) == kPixelStates);
    return kStates[std::size_t(state)];
}

Json reference_quality_json(const Reference& t) {
    Json json = {{"area", t.is_area()},
                 {"step", t.step},
                 {"noise", t.noise},
                 {"noise_unknown_px", t.noise_unknown},
                 {"samples_used", nullptr}};
    if (t.is_area())
        json["samples_used"] = {{"least", t.samples.least}, {"mean", t.samples.mean}, {"most", t.samples.most}};
    return json;
}

Json error_json(const ErrorMetrics& m) {
    Json json = {{"meaning", kErrorMeaning}};
    for (const Metric& metric : metrics())
        if (metric.member) json[std::string(metric.key)] = or_null(metric.value(m));
    for (std::size_t i = 0; i < kPixelStates; ++i) json["pixels"][state_key(PixelState(i))] = m.pixels[i];
    json["pixels"]["ground"] = m.ground_pixels;
    json["artefacts"]["none"] = m.artefacts[std::size_t(Artefact::None)];
    for (const ArtefactStyle& style : artefact_styles())
        json["artefacts"][std::string(style.key)] = m.artefacts[std::size_t(style.artefact)];
    return json;
}

Json error_json(const ErrorMetrics& m, double noise) {
    Json json = error_json(m);
    json["noise"] = or_null(noise);
    return json;
}

Json cost_json(const WorkCost& cost) {
    return {{"taps_per_pixel", cost.taps_per_pixel}, {"map_texels", cost.map_texels}, {"map_bytes", cost.map_bytes},
            {"bytes_touched", cost.bytes_touched},   {"draws", cost.draws},           {"triangles", cost.triangles}};
}

double number_or_nan(const Json& json, std::string_view field) {
    const auto at = json.find(field);
    return at != json.end() && at->is_number() ? at->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

ErrorMetrics error_from_json(const Json& json) {
    ErrorMetrics m;
    for (const Metric& metric : metrics())
        if (metric.member) m.*metric.member = number_or_nan(json, metric.key);
    if (const auto pixels = json.find("pixels"); pixels != json.end()) {
        for (std::size_t i = 0; i < kPixelStates; ++i) read_count(m.pixels[i], *pixels, state_key(PixelState(i)));
        read_count(m.ground_pixels, *pixels, "ground");
    }
    m.counted = m.pixels[std::size_t(PixelState::Counted)];
    if (const auto artefacts = json.find("artefacts"); artefacts != json.end()) {
        read_count(m.artefacts[std::size_t(Artefact::None)], *artefacts, "none");
        for (const ArtefactStyle& style : artefact_styles())
            read_count(m.artefacts[std::size_t(style.artefact)], *artefacts, style.key);
    }
    return m;
}

WorkCost cost_from_json(const Json& json) {
    WorkCost c;
    read_count(c.taps_per_pixel, json, "taps_per_pixel");
    read_count(c.map_texels, json, "map_texels");
    read_count(c.map_bytes, json, "map_bytes");
    read_count(c.bytes_touched, json, "bytes_touched");
    read_count(c.draws, json, "draws");
    read_count(c.triangles, json, "triangles");
    return c;
}

}  // namespace si
