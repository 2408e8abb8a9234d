#include "app/report/health_report.h"

#include <cmath>

#include "renderer/base/error.h"
#include "renderer/reference/error_task.h"

namespace si {

using Json = nlohmann::ordered_json;

std::shared_ptr<const NumericHealth> search_numbers(Renderer& renderer, const Scene& scene, const Settings& settings,
                                                    FrameRequest request, const Workers& workers) {
    request.outputs.health = true;
    request.timing = false;
    ReferenceCache references;
    trace_sources(renderer, scene, settings, request, references, workers);
    return renderer.numeric_health(renderer.render(scene, settings, request));
}

Json health_json(const NumericHealth& health) {
    Json json = {
        {"sound", health.sound()}, {"images", health.images}, {"numbers", health.numbers}, {"findings", Json::array()}};
    const auto or_null = [](int number) { return number < 0 ? Json() : Json(number); };
    for (const NumberFinding& f : health.findings)
        json["findings"].push_back({{"fault", fault_key(f.fault)},
                                    {"place", f.place},
                                    {"light", or_null(f.light)},
                                    {"view", or_null(f.view)},
                                    {"level", f.level},
                                    {"unit", f.unit},
                                    {"count", f.count},
                                    {"first", {f.first.x, f.first.y}},
                                    {"worst", {f.worst.x, f.worst.y}},
                                    {"value", std::isfinite(f.value) ? Json(f.value) : Json()},
                                    {"text", finding_text(f)}});
    return json;
}

void require_sound(const NumericHealth& health) {
    if (!health.sound()) throw Error("--check-numeric: " + health_text(health));
}

}  // namespace si
