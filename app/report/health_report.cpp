#include "app/report/health_report.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "renderer/advise/fixes.h"
#include "renderer/base/command_text.h"
#include "renderer/base/error.h"
#include "renderer/render/reference_frames.h"

namespace si {

std::shared_ptr<const NumericHealth> search_numbers(Renderer& renderer, const Scene& scene, const Settings& settings,
                                                    FrameRequest request, const Workers& workers) {
    request.outputs.health = true;
    request.timing = false;
    ReferenceCache references;
    trace_sources(renderer, scene, settings, request, references, workers);
    return renderer.numeric_health(renderer.render(scene, settings, request));
}

Json health_json(const NumericHealth& health) {
    const auto or_null = [](int number) { return number < 0 ? Json() : Json(number); };
    const auto finding_json = [&](const NumberFinding& f) -> Json {
        return {{"fault", fault_key(f.fault)},
                {"place", f.place},
                {"light", or_null(f.light)},
                {"view", or_null(f.view)},
                {"level", f.level},
                {"unit", f.unit},
                {"count", f.count},
                {"first", {f.first.x, f.first.y}},
                {"worst", {f.worst.x, f.worst.y}},
                {"value", std::isfinite(f.value) ? Json(f.value) : Json()},
                {"text", finding_text(f)}};
    };
    return {{"sound", health.sound()},
            {"images", health.images},
            {"numbers", health.numbers},
            {"findings", json_list(health.findings, finding_json)}};
}

void require_sound(const NumericHealth& health) {
    if (!health.sound()) throw Error("--check-numeric: " + health_text(health));
}

NumberWatch::NumberWatch(Renderer& renderer, Settings base, bool on)
    : renderer_(renderer), base_(std::move(base)), on_(on) {
    if (!on) return;
    renderer_.set_number_watcher([this](const Settings& settings, const NumericHealth& health) {
        ++frames_;
        if (health.sound() || unsound_++ > 0) return;
        const std::string sets = set_options_text(setting_changes(base_, settings));
        first_ = fmt::format("{}: {}", sets.empty() ? "the settings as given" : "with " + sets, health_text(health));
    });
}

NumberWatch::~NumberWatch() {
    if (on_) renderer_.set_number_watcher({});
}

void NumberWatch::require_sound() const {
    if (unsound_ == 0) return;
    throw Error(fmt::format("--check-numeric: {}{}", first_,
                            unsound_ == 1 ? "" : fmt::format("; {} of {} pictures have faults", unsound_, frames_)));
}

}  // namespace si
