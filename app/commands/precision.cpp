#include <fmt/format.h>

#include <algorithm>

#include "app/base/json_text.h"
#include "app/base/notes.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/report.h"
#include "app/sweep/progress_line.h"
#include "renderer/base/index_of.h"
#include "renderer/measure/pipelines.h"
#include "renderer/scene/placement.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Series of `precision --over`: a setting with the values it takes.
struct SeriesRow {
    std::string_view name, key;
    std::vector<double> values;
};

const SeriesRow kSeries[] = {{"distance", "scene.distance", {0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7}},
                             {"scale", "scene.scale", {1e-3, 1e-2, 1e-1, 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}},
                             {"stretch", "light.stretch", {1, 10, 100, 1e3, 1e4, 1e5}}};

struct Point {
    double value = 0;
    std::vector<PipelineError> errors;
};

std::string word_of(std::string_view key, int value) {
    return std::string(find_setting(key)->param->choices()[std::size_t(value)].key);
}

Json spread_json(const PrecisionSpread& s) {
    return {{"median", s.median}, {"p99", s.p99}, {"worst", s.worst}, {"worst_at", {s.worst_at.x, s.worst_at.y}}};
}

Json errors_json(const std::vector<PipelineError>& errors) {
    return json_list(errors, [](const PipelineError& e) -> Json {
        return {{"map.origin", word_of("map.origin", index_of(e.origin))},
                {"map.transform", word_of("map.transform", index_of(e.transform))},
                {"pixels", e.pixels},
                {"texels", spread_json(e.texels)},
                {"ulp", spread_json(e.ulps)},
                {"flips", e.flips}};
    });
}

void print_errors(const std::vector<PipelineError>& errors, const std::string& before) {
    for (const PipelineError& e : errors)
        fmt::print("{}{:<10} {:<10} {:>10.3g} {:>10.3g} {:>10.3g}   {:>9.3g} {:>9.3g} {:>9.3g}   {:>7}\n", before,
                   word_of("map.origin", index_of(e.origin)), word_of("map.transform", index_of(e.transform)),
                   e.texels.median, e.texels.p99, e.texels.worst, e.ulps.median, e.ulps.p99, e.ulps.worst, e.flips);
}

void print_head(const std::string& before) {
    fmt::print("{}{:<10} {:<10} {:>10} {:>10} {:>10}   {:>9} {:>9} {:>9}   {:>7}\n", before, "origin", "transform",
               "texels", "99 %", "worst", "ULP", "99 %", "worst", "flips");
}

}  // namespace

std::vector<std::string_view> precision_series() {
    std::vector<std::string_view> out;
    for (const SeriesRow& row : kSeries) out.push_back(row.name);
    return out;
}

void run_precision(const PrecisionOptions& options) {
    Session session = open_session(options.session);
    const HeadlessContext context;
    Renderer renderer;
    const auto compare = [&](const Scene& scene, const Settings& settings) {
        return compare_pipelines(renderer, scene, settings, options.size.width, options.size.height);
    };
    std::vector<Point> series;
    if (options.over.empty()) {
        series.push_back({0, compare(session.scene, session.settings)});
    } else {
        const auto row = std::ranges::find(kSeries, options.over, &SeriesRow::name);
        const std::string key =
            row->key.starts_with("light.")
                ? fmt::format("light.{}.{}", std::max(session.settings.view.light, 0), row->key.substr(6))
                : std::string(row->key);
        ProgressLine line;
        for (const double value : row->values) {
            line.show(fmt::format("{} {:g}", key, value), false);
            Settings s = session.settings;
            set_setting(s, key, fmt::format("{}", value));
            pose_scene(session.scene, s.scene);
            carry_settings(s, session.settings.scene, s.scene);
            series.push_back({value, compare(session.scene, s)});
        }
    }
    if (options.json) {
        Json json = {{"format", "shadow-inspector-precision"},
                     {"version", 1},
                     {"scene", session.scene_name},
                     {"width", options.size.width},
                     {"height", options.size.height},
                     {"light", session.settings.view.light}};
        if (options.over.empty()) {
            json["pipelines"] = errors_json(series.front().errors);
        } else {
            json["over"] = options.over;
            json["series"] = json_list(series, [](const Point& p) -> Json {
                return {{"value", p.value}, {"pipelines", errors_json(p.errors)}};
            });
        }
        json["driver"] = driver_json(renderer.driver());
        fmt::print("{}", json_text(json));
    } else if (options.over.empty()) {
        print_head("");
        print_errors(series.front().errors, "");
    } else {
        print_head(fmt::format("{:>9}  ", options.over));
        for (const Point& p : series) print_errors(p.errors, fmt::format("{:>9g}  ", p.value));
    }
    if (!options.json)
        fmt::print(
            "places in the map and depths by single precision against double, of {} pixels; flips: pixels on the other "
            "side of one half than by the first row\n",
            series.front().errors.front().pixels);
    print_notes(session.notes);
}

}  // namespace si
