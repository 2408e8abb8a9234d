#include "app/report/measure_json.h"

#include "renderer/measure/artefact_picture.h"

namespace si {

using Json = nlohmann::ordered_json;

Json spread_json(const Spread& s) {
    return {{"median", s.median},
            {"p95", s.p95},
            {"low", s.low},
            {"high", s.high},
            {"median_low", s.median_low},
            {"median_high", s.median_high},
            {"noise", 0.5 * (s.median_high - s.median_low)}};
}

Json time_json(const TimeMeasurement& time) {
    Json json = {{"total_ms", spread_json(time.total_ms)},
                 {"shadow_maps_ms", spread_json(time.maps_ms)},
                 {"picture_ms", spread_json(time.picture_ms)},
                 {"frames", time.total_ms.samples},
                 {"bursts", time.total_ms.bursts},
                 {"spread", time.total_ms.relative()},
                 {"settled", time.settled},
                 {"clock", time.clock},
                 {"passes", Json::array()}};
    for (const PassTime& pass : time.passes)
        json["passes"].push_back(
            {{"name", pass.name}, {"gpu_ms", spread_json(pass.gpu_ms)}, {"cpu_ms", spread_json(pass.cpu_ms)}});
    return json;
}

const char* state_key(PixelState state) {
    static constexpr const char* kStates[] = {"counted",      "background",    "faces_away",
                                              "outside_cone", "not_receiving", "beyond_range"};
    static_assert(std::size(kStates) == kPixelStates);
    return kStates[std::size_t(state)];
}

Json truth_quality_json(const Truth& t) {
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
        if (metric.member) json[std::string(metric.key)] = metric.value(m);
    for (std::size_t i = 0; i < kPixelStates; ++i) json["pixels"][state_key(PixelState(i))] = m.pixels[i];
    json["artefacts"]["none"] = m.artefacts[std::size_t(Artefact::None)];
    for (const ArtefactStyle& style : artefact_styles())
        json["artefacts"][std::string(style.key)] = m.artefacts[std::size_t(style.artefact)];
    return json;
}

Json cost_json(const WorkCost& cost) {
    return {{"taps_per_pixel", cost.taps_per_pixel}, {"map_texels", cost.map_texels}, {"map_bytes", cost.map_bytes},
            {"bytes_touched", cost.bytes_touched},   {"draws", cost.draws},           {"triangles", cost.triangles}};
}

}  // namespace si
