#include "app/sweep/columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/reference/metrics.h"

namespace si {
namespace {

constexpr const char* kErrorNoise = "error.noise";

Plotted plotted_as(Better better) {
    switch (better) {
        case Better::Less:
            return Plotted::AsIs;
        case Better::NearZero:
            return Plotted::Absolute;
        case Better::More:
            return Plotted::LackingToOne;
        case Better::Neither:
            break;
    }
    return Plotted::No;
}

Column column_of(const Metric& m) {
    return {"error." + std::string(m.key), (m.better == Better::More ? "1 - " : "") + std::string(m.label),
            std::string(m.unit),           std::string(m.help),
            plotted_as(m.better),          m.unit == kOfVisibility ? kErrorNoise : ""};
}

std::vector<Column> make_columns() {
    std::vector<Column> all;
    for (const Metric& m : metrics()) all.push_back(column_of(m));
    const Column others[] = {
        {"error.meaning", "Meaning of the errors", "",
         "2: the causes of docs/accuracy.md. Other meanings do not compare.", Plotted::No},
        {"time.total_ms.median", "Time of a frame", "ms", "Median over the frames of whole rounds.", Plotted::AsIs,
         "time.total_ms.noise"},
        {"time.total_ms.p95", "Time of a frame, 95 %", "ms", "Nineteen frames of twenty take less.", Plotted::AsIs,
         "time.total_ms.noise"},
        {"time.shadow_maps_ms.median", "Time of shadow maps", "ms", "Median of the passes that draw maps.",
         Plotted::AsIs, "time.shadow_maps_ms.noise"},
        {"time.picture_ms.median", "Time of the picture", "ms", "Median of all other passes: visibility and shading.",
         Plotted::AsIs, "time.picture_ms.noise"},
        {"time.spread", "Spread of the time", "of the median", "Half the 95 % interval of the median over the median.",
         Plotted::No},
        {"time.frames", "Frames", "", "Timed frames.", Plotted::No},
        {"cost.bytes_touched", "Bytes touched", "B",
         "Of the maps, and what the kernel fetches for each pixel and light."},
        {"cost.taps_per_pixel", "Taps a pixel", "", "Texels that the kernel fetches per light."},
        {"cost.map_texels", "Map texels", "", "Of all shadow maps."},
        {"cost.map_bytes", "Map bytes", "B", "Of all shadow maps."},
        {"cost.draws", "Draws", "", "Draw calls of all passes."},
        {"cost.triangles", "Triangles", "", "Of all passes."},
    };
    all.insert(all.end(), std::begin(others), std::end(others));
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

double number_at(const nlohmann::ordered_json& row, std::string_view key) {
    const nlohmann::ordered_json* at = &row;
    while (!key.empty()) {
        const auto dot = key.find('.');
        const auto field = at->is_object() ? at->find(std::string(key.substr(0, dot))) : at->end();
        if (!at->is_object() || field == at->end()) return std::numeric_limits<double>::quiet_NaN();
        at = &*field;
        key = dot == std::string_view::npos ? std::string_view() : key.substr(dot + 1);
    }
    return at->is_number() ? at->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

double plotted_value(const Column& column, const nlohmann::ordered_json& row) {
    const double v = number_at(row, column.key);
    switch (column.plotted) {
        case Plotted::AsIs:
            return v;
        case Plotted::Absolute:
            return std::abs(v);
        case Plotted::LackingToOne:
            return 1 - v;
        case Plotted::No:
            break;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace si
