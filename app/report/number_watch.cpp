#include "app/report/number_watch.h"

#include <fmt/format.h>

#include <utility>

#include "renderer/advise/fixes.h"
#include "renderer/base/command_text.h"
#include "renderer/base/error.h"

namespace si {

std::string set_options(const Settings& base, const Settings& settings) {
    return set_options_text(setting_changes(base, settings));
}

NumberWatch::NumberWatch(Renderer& renderer, Settings base, bool on)
    : renderer_(renderer), base_(std::move(base)), on_(on) {
    if (!on) return;
    renderer_.set_number_watcher([this](const Settings& settings, const NumericHealth& health) {
        ++frames_;
        if (health.sound() || unsound_++ > 0) return;
        const std::string sets = set_options(base_, settings);
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
