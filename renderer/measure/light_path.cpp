#include "renderer/measure/light_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/base/finite_number.h"
#include "renderer/measure/sun_path.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr const char* kAlongForm =
    "KEY=from:to,KEY=from:to is wanted, such as light.azimuth=0:90,light.elevation=10:60";
constexpr const char* kDayForm =
    "LATITUDE,DAY is wanted: degrees from -90 to 90 (north is positive) and the day of the year, 1 to 365, such as "
    "48,172";
/// Timing of one point. A path has many, and neighbours show the noise.
constexpr TimeSampler::Limits kPathTiming{.least = 5, .most = 15, .bursts = 3, .over_s = 0.2};

/// Returns the next part of a text up to a separator, and takes both from the text.
std::string_view next_part(std::string_view& text, char separator) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return part;
}

/// Formats a number with at most nine decimals, without the rounding errors of sums.
std::string short_number(double value) {
    constexpr double kDecimals = 1e9;
    return fmt::format("{:.12g}", std::round(value * kDecimals) / kDecimals + 0.0);
}

/// Setting that moves along a straight path.
struct PathAxis {
    SettingRef ref;
    double from = 0, to = 0;
};

PathAxis parse_path_axis(std::string_view text, std::string_view whole, const Settings& settings) {
    const auto form = [&] { return UsageError(fmt::format("--along \"{}\": {}", whole, kAlongForm)); };
    const std::size_t equals = text.find('='), colon = text.find(':');
    if (equals == text.npos || colon == text.npos || colon < equals) throw form();
    const std::string key(text.substr(0, equals));
    const auto ref = find_setting(key);
    if (!ref) throw UsageError(fmt::format("--along {}: no such setting{}", key, did_you_mean(nearest_key(key))));
    if (ref->param->scope != Scope::Light || !std::holds_alternative<double>(default_value(*ref)))
        throw UsageError(
            fmt::format("--along {}: a number of a light is wanted, such as light.azimuth or light.elevation", key));
    if (ref->light >= settings.light_count)
        throw UsageError(fmt::format("--along {}: the scene has {} light{} (light.count)", key, settings.light_count,
                                     settings.light_count == 1 ? "" : "s"));
    if (const std::string_view reason = idle_reason(settings, *ref); !reason.empty())
        throw UsageError(fmt::format("--along {}: {}", key, reason));
    const auto from = finite_number(text.substr(equals + 1, colon - equals - 1));
    const auto to = finite_number(text.substr(colon + 1));
    if (!from || !to) throw form();
    for (const double end : {*from, *to}) parse_value(*ref, short_number(end));  // throws where it is out of range
    return {*ref, *from, *to};
}

void require_steps(int steps, int least) {
    if (steps < least || steps > kMaxPathSteps)
        throw UsageError(fmt::format("--steps {}: a path has {} to {} steps", steps, least, kMaxPathSteps));
}

}  // namespace

LightPath straight_path(std::string_view text, int steps, const Settings& settings) {
    require_steps(steps, 2);
    if (text.empty() || text.ends_with(',')) throw UsageError(fmt::format("--along \"{}\": {}", text, kAlongForm));
    LightPath out{.about = std::string(text), .points = {}};
    std::vector<PathAxis> axes;
    for (std::string_view rest = text; !rest.empty();) {
        axes.push_back(parse_path_axis(next_part(rest, ','), text, settings));
        const std::string key = setting_key(axes.back().ref);
        for (std::size_t i = 0; i + 1 < axes.size(); ++i)
            if (setting_key(axes[i].ref) == key) throw UsageError(fmt::format("--along: {} is named twice", key));
    }
    for (int i = 0; i < steps; ++i) {
        PathPoint point;
        for (const PathAxis& axis : axes)
            point.values.emplace_back(setting_key(axis.ref),
                                      short_number(std::lerp(axis.from, axis.to, double(i) / (steps - 1))));
        out.points.push_back(std::move(point));
    }
    return out;
}

LightPath day_path(std::string_view text, int steps, const Settings& settings) {
    require_steps(steps, 1);
    std::string_view rest = text;
    const auto latitude = finite_number(next_part(rest, ','));
    const auto day = finite_number(rest);
    if (!latitude || std::abs(*latitude) > 90 || !day || *day != std::round(*day) || *day < 1 || *day > 365)
        throw UsageError(fmt::format("--day \"{}\": {}", text, kDayForm));
    const auto light = std::size_t(settings.view.light_index());
    if (int(light) >= settings.light_count || settings.lights[light].type != LightType::Directional)
        throw UsageError(
            fmt::format("--day {}: light {} is no directional light; choose one by view.light, or set {} "
                        "to directional",
                        text, light, light_setting_key(light, "type")));
    LightPath out{.about = fmt::format("the sun at latitude {:g}, day {:g}", *latitude, *day), .points = {}};
    for (const SunPosition& sun : sun_path(*latitude, int(*day), steps))
        out.points.push_back({{{light_setting_key(light, "azimuth"), short_number(sun.azimuth_deg)},
                               {light_setting_key(light, "elevation"), short_number(sun.elevation_deg)}},
                              sun.hour});
    if (out.points.empty())
        throw UsageError(fmt::format("--day {}: the sun does not rise; choose another day or latitude", text));
    return out;
}

Settings settings_at(Settings settings, const PathPoint& point) {
    set_settings(settings, point.values);
    return settings;
}

PathChange path_change(const std::vector<ClassifiedPixel>& before, const Reference& reference_before,
                       const std::vector<ClassifiedPixel>& now, const Reference& reference_now) {
    if (before.size() != now.size() || reference_before.state.size() != before.size() ||
        reference_now.state.size() != now.size())
        throw Error("points of pictures of different sizes cannot be compared");
    PathChange out;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (reference_before.state[i] != PixelState::Counted || reference_now.state[i] != PixelState::Counted) continue;
        const double v0 = before[i].visibility, v1 = now[i].visibility;
        const double r0 = reference_before.visibility.data[i], r1 = reference_now.visibility.data[i];
        const double drawn = std::abs(v1 - v0), reference = std::abs(r1 - r0);
        ++out.pixels;
        out.drawn += drawn;
        out.reference += reference;
        out.beyond += std::max(drawn - reference, 0.0);
        out.flips += (v0 < 0.5) != (v1 < 0.5) && (r0 < 0.5) == (r1 < 0.5);
    }
    for (double* mean : {&out.drawn, &out.reference, &out.beyond})
        if (out.pixels > 0) *mean /= double(out.pixels);
    return out;
}

std::size_t LightPathResult::worst(const Metric& metric) const {
    std::size_t worst = 0;
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double distance = distance_from_best(metric.better, metric.value(steps[i].error));
        if (!(distance > largest)) continue;  // also NaN: such a step has no value to compare
        largest = distance;
        worst = i;
    }
    return worst;
}

LightPathResult measure_light_path(Renderer& renderer, const Scene& scene, const Settings& settings, int width,
                                   int height, const LightPath& path, const LightPathOptions& options,
                                   const Workers& workers,
                                   const std::function<void(double, const std::string&)>& report,
                                   const std::function<void(const LightPathResult&)>& show) {
    LightPathResult out{.path = path, .steps = {}, .clock = {}, .cost = options.cost};
    Measurer measurer(renderer, width, height, workers);
    Classification before;
    for (const PathPoint& point : path.points) {
        if (workers.stop.stop_requested()) throw Cancelled();
        std::string about;
        for (const auto& [key, value] : point.values) about += (about.empty() ? "" : ", ") + key + "=" + value;
        report(double(out.steps.size()) / double(path.points.size()), about);
        const Settings now = settings_at(settings, point);
        PathStep step{.point = point, .error = {}, .cost = {}, .time = {}, .change = {}};
        Classification classified = measurer.classify(scene, now);
        step.error = classified.error;
        step.cost = classified.cost;
        if (before.reference)
            step.change =
                path_change(before.classified, *before.reference, classified.classified, *classified.reference);
        if (options.time) {
            step.time = measurer.time(scene, now, options.cost, kPathTiming);
            out.clock = step.time->clock;
        }
        before = std::move(classified);
        out.steps.push_back(std::move(step));
        if (show) show(out);
    }
    return out;
}

}  // namespace si
