#include "app/measure_json.h"

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
                 {"spread", time.total_ms.relative()},
                 {"settled", time.settled},
                 {"clock", time.clock},
                 {"passes", Json::array()}};
    for (const PassTime& pass : time.passes)
        json["passes"].push_back(
            {{"name", pass.name}, {"gpu_ms", spread_json(pass.gpu_ms)}, {"cpu_ms", spread_json(pass.cpu_ms)}});
    return json;
}

Json cost_json(const WorkCost& cost) {
    return {{"taps_per_pixel", cost.taps_per_pixel}, {"map_texels", cost.map_texels}, {"map_bytes", cost.map_bytes},
            {"bytes_touched", cost.bytes_touched},   {"draws", cost.draws},           {"triangles", cost.triangles}};
}

}  // namespace si
