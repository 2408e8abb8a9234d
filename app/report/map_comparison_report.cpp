#include "app/report/map_comparison_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/labelled_sheet.h"
#include "app/report/measure_json.h"
#include "renderer/base/lengths_text.h"
#include "renderer/measure/measured_error.h"
#include "renderer/reference/reference_picture.h"

namespace si {
namespace {

using Colour = LabelledSheet::Colour;

constexpr Colour kTextColour{230, 230, 230}, kFaintColour{160, 160, 165};
constexpr int kSheetGap = 8, kScaleHeight = 10;

/// Most casters that the text names.
constexpr std::size_t kMaxNamedCasters = 20;

std::string title_of(const MapComparison& map) {
    return map.name.empty() ? fmt::format("light {}", map.light) : fmt::format("light {}, {}", map.light, map.name);
}

/// Shrinks a picture so that its longest side is at most `side`, by leaving out rows and columns: a mean would mix
/// classes of texels.
ByteImage thinned(const ByteImage& picture, int side) {
    const int longest = std::max(picture.width, picture.height);
    if (longest <= side) return picture;
    ByteImage out{std::max(1, picture.width * side / longest), std::max(1, picture.height * side / longest), {}};
    out.data.reserve(std::size_t(4) * std::size_t(out.width) * std::size_t(out.height));
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            const std::size_t row = std::size_t(y) * std::size_t(picture.height) / std::size_t(out.height);
            const std::size_t column = std::size_t(x) * std::size_t(picture.width) / std::size_t(out.width);
            const auto from = picture.data.begin() + std::ptrdiff_t(4 * (row * std::size_t(picture.width) + column));
            out.data.insert(out.data.end(), from, from + 4);
        }
    return out;
}

/// Draws the scale of colours from nearer to farther, and the colours of texels without a difference.
void draw_legend(LabelledSheet& sheet, int x, int y, int width, double scale_m) {
    for (int column = 0; column < width; ++column)
        sheet.fill(x + column, y, 1, kScaleHeight,
                   difference_colour((2.0 * column / (width - 1) - 1) * scale_m, scale_m));
    const int below = y + kScaleHeight + 2;
    sheet.write(fmt::format("-{}, nearer to the light", metres_text(scale_m)), x, below, width / 2, kFaintColour);
    const std::string right = fmt::format("+{}, farther", metres_text(scale_m));
    sheet.write(right, x + width - std::min(width / 2, int(right.size()) * 7), below, width / 2, kFaintColour);
    const MapDifferenceColours colours;
    int at = x;
    for (const auto& [colour, label] : {std::pair(colours.missed, "missed"),
                                        {colours.extra, "extra"},
                                        {colours.masked, "left out"},
                                        {colours.empty, "empty"}}) {
        const int line = below + LabelledSheet::kLineHeight + 3;
        sheet.fill(at, line + 2, kScaleHeight, kScaleHeight, {130, 130, 130});
        sheet.fill(at + 1, line + 3, kScaleHeight - 2, kScaleHeight - 2, colour);
        sheet.write(label, at + kScaleHeight + 4, line, width / 4 - kScaleHeight - 4, kFaintColour);
        at += width / 4;
    }
}

Json differences_json(const DepthDifferences& d) {
    return {
        {"median", d.median}, {"within_99_percent", d.most_of_99}, {"max", d.max}, {"signed_median", d.signed_median}};
}

Json box_json(const TexelBox& box) {
    if (box.is_empty()) return nullptr;
    return {box.from.x, box.from.y, box.to.x - box.from.x, box.to.y - box.from.y};
}

Json caster_json(const LackingCaster& c) {
    return {{"object", c.path}, {"whole", c.is_whole()}, {"texels", c.texels},
            {"empty", c.empty}, {"farther", c.farther},  {"drawn", c.drawn}};
}

}  // namespace

bool all_pass_gate(std::span<const ComparedMap> maps) {
    return std::ranges::all_of(maps, [](const ComparedMap& map) { return map.numbers.gate.passed(); });
}

std::string map_comparison_text(std::span<const ComparedMap> maps) {
    std::string out = fmt::format("{:<26} {:>11} {:>9} {:>8} {:>8} {:>22} {:>22} {:>10}\n", "map", "size", "covered",
                                  "missed", "extra", "depth: median", "99 % within", "largest");
    const auto amount = [](double steps, double metres) {
        return fmt::format("{} steps, {}", digits_text(steps), metres_text(metres));
    };
    for (const ComparedMap& map : maps) {
        const MapComparison& n = map.numbers;
        out += fmt::format("{:<26} {:>11} {:>9} {:>8} {:>8} {:>22} {:>22} {:>10}\n", title_of(n),
                           fmt::format("{}x{}", n.size.width, n.size.height), n.covered, n.missed, n.extra,
                           amount(n.steps.median, n.metres.median), amount(n.steps.most_of_99, n.metres.most_of_99),
                           metres_text(n.metres.max));
    }
    for (const ComparedMap& map : maps) {
        const MapComparison& n = map.numbers;
        out += fmt::format("\n{}: {}\n", title_of(n), n.gate.text);
        if (!n.gate.hint.empty()) out += fmt::format("  {}\n", n.gate.hint);
        if (n.both > 0 && n.metres.signed_median != 0)
            out += fmt::format("  the imported depths lie {} ({}, {:.3g} of depth) {} the light than the drawn ones\n",
                               metres_text(std::abs(n.metres.signed_median)),
                               texels_text(std::abs(n.texels.signed_median)), std::abs(n.depth.signed_median),
                               n.metres.signed_median > 0 ? "farther from" : "nearer to");
        if (n.invalid > 0)
            out += fmt::format("  {} texels hold no depth (NaN, or outside 0 to 1) and count as empty\n", n.invalid);
        if (n.masked > 0) out += fmt::format("  {} texels of masked casters are left out of both\n", n.masked);
        if (n.extra_border > 0) out += fmt::format("  {} extra texels at the border do not count\n", n.extra_border);
        if (n.missed + n.nearer > 0)
            out += fmt::format("  no caster of the scene explains {} texels: x {} to {}, y {} to {} from the top\n",
                               n.missed + n.nearer, n.unexplained.from.x, n.unexplained.to.x - 1, n.unexplained.from.y,
                               n.unexplained.to.y - 1);
        for (std::size_t i = 0; i < std::min(map.lacking.size(), kMaxNamedCasters); ++i)
            out += fmt::format("  {}\n", lacking_caster_text(map.lacking[i]));
        if (map.lacking.size() > kMaxNamedCasters)
            out += fmt::format("  and {} more casters\n", map.lacking.size() - kMaxNamedCasters);
    }
    return out;
}

Json map_comparison_json(std::span<const ComparedMap> maps) {
    return json_list(maps, [](const ComparedMap& map) -> Json {
        const MapComparison& n = map.numbers;
        Json json = {{"light", n.light},
                     {"map", n.view},
                     {"name", n.name},
                     {"width", n.size.width},
                     {"height", n.size.height},
                     {"covered", n.covered},
                     {"drawn", n.drawn},
                     {"both", n.both},
                     {"missed", n.missed},
                     {"extra", n.extra},
                     {"extra_at_border", n.extra_border},
                     {"left_out", n.masked},
                     {"invalid", n.invalid},
                     {"nearer", n.nearer},
                     {"farther", n.farther},
                     {"unexplained_box", box_json(n.unexplained)},
                     {"lacking_box", box_json(n.lacking)},
                     {"step", n.step},
                     {"steps", differences_json(n.steps)},
                     {"depth", differences_json(n.depth)},
                     {"metres", differences_json(n.metres)},
                     {"texels", differences_json(n.texels)},
                     {"gate",
                      {{"passed", n.gate.passed()},
                       {"missed", n.gate.missed},
                       {"extra", n.gate.extra},
                       {"median", n.gate.median},
                       {"within_99_percent", n.gate.most},
                       {"text", n.gate.text},
                       {"hint", n.gate.hint}}}};
        json["lacking"] = json_list(map.lacking, caster_json);
        return json;
    });
}

MapBias map_bias(Renderer& renderer, const Scene& scene, const Settings& settings,
                 const std::vector<std::shared_ptr<const ImportedMaps>>& maps, int light, glm::ivec2 pixels,
                 const Workers& workers) {
    const ImportedMaps& given = *maps.at(std::size_t(light));
    MapBias out{.light = light, .knowledge = engine_bias(&given, settings), .engine = settings.bias, .enough = {}};
    if (out.knowledge == EngineBias::Changed) out.engine = *given.bias;
    out.texel_m.shortest = std::numeric_limits<double>::infinity();
    for (const LightView& view : given.views->views) {
        const TexelSize size = view.texel_size_range(given.size());
        out.texel_m = {std::max(out.texel_m.longest, size.longest), std::min(out.texel_m.shortest, size.shortest)};
    }
    const DepthCurve& curve = given.views->views.front().curve;
    out.depth_per_m = curve.slope(0.5 * (curve.near + curve.far));
    Settings shown = settings;
    shown.view.light = light;
    FrameRequest request{.width = pixels.x, .height = pixels.y};
    request.imported = maps;
    ReferenceCache cache;
    const MeasuredError measured =
        measure_error(renderer, scene, shown, request, light, reference_options(shown), cache, workers);
    out.enough = bias_starts(measured, shown, renderer.driver());
    return out;
}

std::string map_bias_text(const MapBias& bias) {
    std::string out = fmt::format(
        "light {}: a texel is {}{} wide\n", bias.light, metres_text(bias.texel_m.shortest),
        bias.texel_m.longest > 1.01 * bias.texel_m.shortest ? " to " + metres_text(bias.texel_m.longest) : "");
    out += bias.knowledge == EngineBias::Unknown
               ? std::string(
                     "  the engine's bias is unknown: set bias.* to its values and map.bundle_bias to entered, "
                     "before a pixel is called wrong\n")
               : fmt::format("  the engine's bias: {}; {}\n", bias_text(bias.engine), engine_bias_text(bias.knowledge));
    if (bias.enough.empty()) return out + "  no pixel of the picture is lit within the maps, so none needs bias\n";
    out += "  bias that is enough on these maps, for what the camera sees:\n";
    for (const BiasStart& start : bias.enough) {
        if (start.row->gives_needed_bias) continue;
        const BiasSettings& b = start.least;
        const bool is_constant = b.constant > 0 && b.slope == 0 && b.normal == 0 && b.unit == BiasUnit::Texels;
        const double metres = b.constant * bias.texel_m.longest;
        const std::string amounts =
            is_constant ? fmt::format("   = {} = {:.3g} of depth", metres_text(metres), metres * bias.depth_per_m) : "";
        out += fmt::format("    {:<14} {}{}\n", start.row->key, bias_text(start.least), amounts);
    }
    return out;
}

Json map_bias_json(const MapBias& bias) {
    Json json = {{"light", bias.light},
                 {"engine_bias", bias.knowledge == EngineBias::Unknown ? Json() : Json(bias_text(bias.engine))},
                 {"engine_bias_from", engine_bias_source_json(bias.knowledge)},
                 {"texel_m", {bias.texel_m.shortest, bias.texel_m.longest}},
                 {"depth_per_m", bias.depth_per_m}};
    json["enough"] = json_list(bias.enough, [](const BiasStart& start) -> Json {
        return {{"kind", start.row->key},
                {"constant", start.least.constant},
                {"slope", start.least.slope},
                {"normal", start.least.normal},
                {"text", bias_text(start.least)}};
    });
    return json;
}

ByteImage map_comparison_sheet(std::span<const ComparedMap> maps, int side) {
    constexpr int kLine = LabelledSheet::kLineHeight, kLeastColumn = 240;
    struct Row {
        const ComparedMap* map;
        std::array<ByteImage, 3> pictures;
        double scale_m;
    };
    std::vector<Row> rows;
    int column = kLeastColumn, height = kSheetGap;
    for (const ComparedMap& map : maps) {
        const double scale_m = difference_scale_m(map.numbers);
        rows.push_back(
            {&map,
             {thinned(linear_picture(map, map.imported), side), thinned(linear_picture(map, map.drawn), side),
              thinned(difference_picture(map.numbers, scale_m), side)},
             scale_m});
        column = std::max(column, rows.back().pictures[0].width);
        height += rows.back().pictures[0].height + kScaleHeight + 5 * kLine + 3 * kSheetGap;
    }
    LabelledSheet sheet(3 * column + 4 * kSheetGap, height);
    int y = kSheetGap;
    for (const Row& row : rows) {
        const MapComparison& n = row.map->numbers;
        sheet.write(fmt::format("{}: {}", title_of(n), n.gate.text), kSheetGap, y, 3 * column + 2 * kSheetGap,
                    kTextColour);
        y += kLine + 4;
        const char* titles[] = {"imported", "drawn by this program", "difference"};
        int x = kSheetGap;
        for (std::size_t i = 0; i < 3; ++i) {
            sheet.write(titles[i], x, y, column, kFaintColour);
            sheet.place(row.pictures[i], x, y + kLine + 4);
            x += column + kSheetGap;
        }
        y += kLine + 4 + row.pictures[0].height + kSheetGap;
        draw_legend(sheet, 2 * column + 3 * kSheetGap, y, column, row.scale_m);
        y += kScaleHeight + 2 * kLine + 2 * kSheetGap;
    }
    return sheet.image();
}

}  // namespace si
