#include "app/sweep/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace si {
namespace {

constexpr std::string_view kErrorNoise = "error.noise";

constexpr auto kColumns = std::to_array<Column>({
    {"error.mae", "Mean error", "of visibility", "Mean of |V - truth| over the counted pixels.", Plotted::AsIs,
     kErrorNoise},
    {"error.rmse", "RMS error", "of visibility", "Root of the mean of (V - truth)^2: large errors weigh more.",
     Plotted::AsIs, kErrorNoise},
    {"error.signed_mean", "Signed mean", "of visibility",
     "Mean of V - truth: negative is too dark. Plotted without sign.", Plotted::Absolute, kErrorNoise},
    {"error.false_shadow", "False shadow", "share of pixels",
     "Lit in truth, dark in the picture: the sum of its causes."},
    {"error.false_light", "False light", "share of pixels",
     "In shadow in truth, bright in the picture: the sum of its causes."},
    {"error.acne", "Acne", "share of pixels", "False shadow that more bias puts right."},
    {"error.any_acne", "Any acne", "share of pixels", "Wholly lit in truth, at all darker, and more bias lights it."},
    {"error.offset_false_shadow", "Shadow by normal offset", "share of pixels",
     "False shadow that is right without the normal offset."},
    {"error.boundary_false_shadow", "False shadow at edges", "share of pixels",
     "False shadow that no bias puts right: edge aliasing, undersampled, filter, penumbra, no map."},
    {"error.outside_false_shadow", "False shadow outside", "share of pixels",
     "False shadow where the map holds nothing, or taps reach beyond its sides."},
    {"error.bias_false_light", "Peter-panning", "share of pixels",
     "False light that less bias, or no normal offset, puts right."},
    {"error.lost_false_light", "Lost casters", "share of pixels",
     "False light where culling, the near plane or a mask's mip level left the caster out of the map."},
    {"error.leak", "Leaks", "share of pixels",
     "False light where the nearest texel alone, unfiltered and at its own least bias, is right."},
    {"error.boundary_false_light", "False light at edges", "share of pixels",
     "False light that neither bias nor filter puts right: edge aliasing, undersampled, penumbra, no map."},
    {"error.outside_false_light", "False light outside", "share of pixels",
     "False light where the map holds nothing, or taps reach beyond its sides."},
    {"error.artefacts.filter", "Filter", "px", "False shadow where the nearest texel alone is right."},
    {"error.artefacts.edge_aliasing", "Edge aliasing", "px", "Wrong by where the map's texels lie; smaller ones help."},
    {"error.artefacts.undersampled", "Undersampled", "px",
     "As edge aliasing, where a shadow or the light between shadows is narrower than a texel."},
    {"error.artefacts.penumbra", "Penumbra", "px", "Right for a light without size."},
    {"error.artefacts.no_map", "Not by a map", "px", "Wrong under a light whose source is no map (light.source)."},
    {"error.within_noise", "Within the noise", "share of pixels",
     "On the other side of one half than a truth that is too noisy to call them wrong.", Plotted::No},
    {"error.iou", "1 - IoU of shadows", "", "Intersection over union of both shadows: 1 is perfect. Plotted from 1.",
     Plotted::LackingToOne},
    {"error.boundary_px_mean", "Edge displacement", "px", "Mean distance between both shadows' edges."},
    {"error.boundary_px_p95", "Edge displacement, 95 %", "px", "Nineteen edge pixels of twenty lie nearer."},
    {"error.boundary_px_max", "Edge displacement, most", "px", "The largest distance (Hausdorff)."},
    {"error.outside_map", "Outside the map", "share of pixels", "No texel of the map holds them, right or wrong.",
     Plotted::No},
    {"error.meaning", "Meaning of the errors", "", "2: the causes of docs/accuracy.md. Other meanings do not compare.",
     Plotted::No},
    {"time.total_ms.median", "Time of a frame", "ms", "Median over the frames of whole rounds.", Plotted::AsIs,
     "time.total_ms.noise"},
    {"time.total_ms.p95", "Time of a frame, 95 %", "ms", "Nineteen frames of twenty take less.", Plotted::AsIs,
     "time.total_ms.noise"},
    {"time.shadow_maps_ms.median", "Time of shadow maps", "ms",
     "Median of the passes that draw maps, or shadow volumes.", Plotted::AsIs, "time.shadow_maps_ms.noise"},
    {"time.picture_ms.median", "Time of the picture", "ms", "Median of all other passes: visibility and shading.",
     Plotted::AsIs, "time.picture_ms.noise"},
    {"time.spread", "Spread of the time", "of the median", "Half the 95 % interval of the median over the median.",
     Plotted::No},
    {"time.frames", "Frames", "", "Timed frames.", Plotted::No},
    {"cost.bytes_touched", "Bytes touched", "B", "Of the maps, and what the kernel fetches for each pixel and light."},
    {"cost.taps_per_pixel", "Taps a pixel", "", "Texels that the kernel fetches per light."},
    {"cost.map_texels", "Map texels", "", "Of all shadow maps."},
    {"cost.map_bytes", "Map bytes", "B", "Of all shadow maps."},
    {"cost.draws", "Draws", "", "Draw calls of all passes."},
    {"cost.triangles", "Triangles", "", "Of all passes."},
});

}  // namespace

std::span<const Column> columns() {
    return kColumns;
}

const Column* find_column(std::string_view key) {
    const auto it = std::find_if(kColumns.begin(), kColumns.end(), [&](const Column& c) { return c.key == key; });
    return it == kColumns.end() ? nullptr : &*it;
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
