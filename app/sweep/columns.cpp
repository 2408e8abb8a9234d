#include "app/sweep/columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/report/measure_json.h"
#include "renderer/reference/metrics.h"

namespace si {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Column metric_column(const Metric& m) {
    Column c{.key = "error." + std::string(m.key),
             .label = (m.better == Better::More ? "1 - " : "") + std::string(m.label),
             .unit = std::string(m.unit),
             .help = std::string(m.help) + (m.better == Better::NearZero ? " Plotted without sign."
                                            : m.better == Better::More   ? " Plotted from 1."
                                                                         : ""),
             .value = [&m](const CaseNumbers& n) { return n.error ? m.value(n.error->metrics) : kNone; },
             .better = m.better};
    if (m.unit == kOfVisibility) {
        c.noise = "error.noise";
        c.noise_value = [](const CaseNumbers& n) { return n.error ? n.error->noise : kNone; };
    }
    return c;
}

/// Makes a column of a distribution of times: the chosen statistic, with the noise of the median.
Column time_column(const char* field, const char* of, const char* label, const char* help,
                   Spread TimeMeasurement::*spread, double Spread::*number) {
    const std::string group = std::string("time.") + of;
    return {.key = group + "." + field,
            .label = label,
            .unit = "ms",
            .help = help,
            .value = [=](const CaseNumbers& n) { return n.time ? (*n.time).*spread.*number : kNone; },
            .noise = group + ".noise",
            .noise_value = [=](const CaseNumbers& n) { return n.time ? ((*n.time).*spread).noise() : kNone; }};
}

/// Makes a column of a time of the shadows.
Column shadow_column(const char* of, const char* label, const char* help, Spread ShadowTime::*spread) {
    const std::string group = std::string("shadow.") + of;
    return {.key = group + ".median",
            .label = label,
            .unit = "ms",
            .help = help,
            .value = [=](const CaseNumbers& n) { return n.shadow ? ((*n.shadow).*spread).median : kNone; },
            .noise = group + ".noise",
            .noise_value = [=](const CaseNumbers& n) { return n.shadow ? ((*n.shadow).*spread).noise() : kNone; },
            .bound = group,
            .bounded = [=](const CaseNumbers& n) { return n.shadow ? &((*n.shadow).*spread) : nullptr; }};
}

template <typename Number>
Column cost_column(const char* field, const char* label, const char* unit, const char* help, Number WorkCost::*number) {
    return {.key = std::string("cost.") + field,
            .label = label,
            .unit = unit,
            .help = help,
            .value = [=](const CaseNumbers& n) { return n.cost ? double((*n.cost).*number) : kNone; }};
}

std::vector<Column> make_columns() {
    using T = TimeMeasurement;
    using C = WorkCost;
    std::vector<Column> all;
    for (const Metric& m : metrics()) all.push_back(metric_column(m));
    all.push_back({.key = "error.meaning",
                   .label = "Meaning of the errors",
                   .help = "4: the causes of docs/accuracy.md. Other meanings do not compare.",
                   .value = [](const CaseNumbers& n) { return n.error ? double(kErrorMeaning) : kNone; },
                   .better = Better::Neither});
    all.push_back(shadow_column("moving_ms", "Time of the shadow while the light moves",
                                "Maps, preparation and look-ups: the frame minus the same frame without shadows, in "
                                "alternation.",
                                &ShadowTime::moving_ms));
    all.push_back(shadow_column("still_ms", "Time of the shadow under a still light",
                                "The camera moves and maps are kept: the frame minus the same frame without shadows, "
                                "in alternation.",
                                &ShadowTime::still_ms));
    const auto forced = [](const CaseNumbers& n) {
        return n.shadow && n.shadow->forced_ms ? &*n.shadow->forced_ms : nullptr;
    };
    all.push_back({.key = "shadow.forced_ms.median",
                   .label = "Time of the shadow with every effect forced",
                   .unit = "ms",
                   .help = "As while the light moves, with all optimisations off: all work is drawn that they skip.",
                   .value = [=](const CaseNumbers& n) { return forced(n) ? forced(n)->median : kNone; },
                   .noise = "shadow.forced_ms.noise",
                   .noise_value = [=](const CaseNumbers& n) { return forced(n) ? forced(n)->noise() : kNone; },
                   .bound = "shadow.forced_ms",
                   .bounded = forced});
    all.push_back({.key = kOfBaseColumn,
                   .label = "Multiple of the base",
                   .unit = "\u00d7",
                   .help = "Time of the shadow while the light moves, over that of the hard kernel with 1024 texels. "
                           "None within the noise.",
                   .value = [](const CaseNumbers& n) { return n.shadow ? n.shadow->of_base : kNone; }});
    all.push_back(time_column("median", "total_ms", "Time of a frame", "Median over the frames of whole rounds.",
                              &T::total_ms, &Spread::median));
    all.push_back(time_column("p95", "total_ms", "Time of a frame, 95 %", "Nineteen frames of twenty take less.",
                              &T::total_ms, &Spread::p95));
    all.push_back(time_column("median", "shadow_maps_ms", "Time of shadow maps",
                              "Median of the passes that draw maps, or shadow volumes.", &T::maps_ms, &Spread::median));
    all.push_back(time_column("median", "picture_ms", "Time of the picture",
                              "Median of all other passes: visibility and shading.", &T::picture_ms, &Spread::median));
    all.push_back({.key = "time.spread",
                   .label = "Spread of the time",
                   .unit = "of the median",
                   .help = "Half the 95 % interval of the median over the median.",
                   .value = [](const CaseNumbers& n) { return n.time ? n.time->total_ms.relative() : kNone; },
                   .better = Better::Neither});
    all.push_back({.key = "time.frames",
                   .label = "Frames",
                   .help = "Timed frames.",
                   .value = [](const CaseNumbers& n) { return n.time ? double(n.time->total_ms.samples) : kNone; },
                   .better = Better::Neither});
    all.push_back(cost_column("bytes_touched", "Bytes touched", "B",
                              "Of the maps, and what the kernel fetches for each pixel and light.", &C::bytes_touched));
    all.push_back(cost_column("taps_per_pixel", "Taps a pixel", "", "Texels that the kernel fetches per light.",
                              &C::taps_per_pixel));
    all.push_back(cost_column("map_texels", "Map texels", "", "Of all shadow maps.", &C::map_texels));
    all.push_back(cost_column("map_bytes", "Map bytes", "B", "Of all shadow maps.", &C::map_bytes));
    all.push_back(cost_column("draws", "Draws", "", "Draw calls of all passes.", &C::draws));
    all.push_back(cost_column("triangles", "Triangles", "", "Of all passes.", &C::triangles));
    return all;
}

}  // namespace

std::span<const Column> columns() {
    static const std::vector<Column> all = make_columns();
    return all;
}

const Column* find_column(std::string_view key) {
    const auto it = std::find_if(columns().begin(), columns().end(), [&](const Column& c) { return c.key == key; });
    return it == columns().end() ? nullptr : &*it;
}

std::string label_of(const Column& column, CostCase cost) {
    return column.unit == "ms" && column.bound.empty() ? column.label + " " + std::string(cost_row(cost).when)
                                                       : column.label;
}

bool is_bound(const Column& column, const CaseNumbers& numbers) {
    const Spread* time = column.bounded ? column.bounded(numbers) : nullptr;
    return time && below_noise(*time);
}

double plotted_value(const Column& column, const CaseNumbers& numbers) {
    if (is_bound(column, numbers)) return time_or_bound(*column.bounded(numbers));
    return distance_from_best(column.better, column.value(numbers));
}

double noise_of(const Column& column, const CaseNumbers& numbers) {
    const double v = column.noise_value ? column.noise_value(numbers) : 0;
    return std::isfinite(v) ? v : 0;
}

}  // namespace si
