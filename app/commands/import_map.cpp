// Command `import-map`: one depth map of another engine becomes a bundle. Conventions that nobody states are found by
// comparing the map with the scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/base/json_text.h"
#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/report/map_import.h"
#include "app/report/report.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/base/printable.h"
#include "renderer/bundle/bundle_members.h"
#include "renderer/bundle/conventions.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kShownFits = 12;
/// Share of texels by which a reading that contradicts the light file has to fit better, to be named.
constexpr double kBetterByShare = 0.1;

constexpr std::pair<std::string_view, bool> kReversedKeys[] = {{"true", true}, {"false", false}};

/// Sets a part of a convention from an option. An empty text leaves it as it is. The command line checks the words.
template <typename Table, typename T>
void set_known(std::optional<T>& part, const std::string& text, const Table& table) {
    for (const auto& [key, value] : table)
        if (key == text) part = value;
}

Json fit_json(const ConventionFit& fit, std::size_t number, bool over_scene, bool has_pair) {
    const Convention& c = fit.convention;
    Json json = {{"number", number},
                 {"depth_range", convention_word(bundle::kRangeKeys, c.depth.zero_to_one)},
                 {"reversed", c.depth.reversed},
                 {"first_row", convention_word(bundle::kFirstRowKeys, c.first_row)},
                 {"matrix", convention_word(kMatrixKeys, c.matrix)},
                 {"product", convention_word(kProductKeys, c.product)},
                 {"stored", convention_word(bundle::kStoredKeys, c.stored)},
                 {"range_m", c.range_m ? Json(*c.range_m) : Json()},
                 {"up", convention_word(bundle::kUpKeys, c.axes.up)},
                 {"mirrored", convention_word(kMirroredKeys, c.axes.mirrored)},
                 {"unit", c.axes.unit},
                 {"options", convention_options(c, has_pair)},
                 {"contradicts_light", !fit.known},
                 {"finding", fit_sentence(fit, over_scene)}};
    if (!fit.refusal.empty()) {
        json["refused"] = fit.refusal;
        return json;
    }
    json["texels"] = fit.texels;
    json["compared"] = fit.samples;
    json["off"] = fit.off;
    json["share_off"] = fit.share_off();
    json["behind"] = fit.behind;
    json["before"] = fit.before;
    json["outside"] = fit.outside;
    json["empty"] = fit.empty;
    const bool has_median = over_scene && fit.samples > 0 && std::isfinite(fit.median_m);
    json["median_m"] = has_median ? Json(fit.median_m) : Json();
    json["median_texels"] = has_median ? Json(fit.median_texels) : Json();
    return json;
}

void print_fits(const ConventionFits& fits, bool has_pair) {
    // Axes and unit stand in a column only where some shown reading changes them.
    bool has_axes = false;
    for (std::size_t i = 0; i < std::min(fits.fits.size(), kShownFits); ++i)
        has_axes |= !(fits.fits[i].convention.axes == LightAxes());
    const std::string axes_title = has_axes ? fmt::format("{:<26}  ", "axes, unit") : std::string();
    fmt::print("{:>3}  {:<5}  {:<8}  {:<9}  {:<7}  {}{:<15}  {}{:>7}  {:>10}  {}\n", "no.", "range", "reversed",
               "first row", "matrix", has_pair ? "product          " : "", "stored", axes_title, "off", "median",
               "remark");
    std::size_t refused = 0, shown = 0;
    for (std::size_t i = 0; i < fits.fits.size(); ++i) {
        const ConventionFit& fit = fits.fits[i];
        refused += !fit.refusal.empty();
        if (!fit.refusal.empty() || shown == kShownFits) continue;
        ++shown;
        const Convention& c = fit.convention;
        const std::string product =
            has_pair ? fmt::format("{:<15}  ", convention_word(kProductKeys, c.product)) : std::string();
        const std::string median = fits.over_scene && fit.samples > 0 && std::isfinite(fit.median_m)
                                       ? fmt::format("{:.3g} m", fit.median_m)
                                       : std::string("-");
        const std::string axes = has_axes ? fmt::format("{:<26}  ", axes_words(c.axes)) : std::string();
        fmt::print("{:>3}  {:<5}  {:<8}  {:<9}  {:<7}  {}{:<15}  {}{:>5.1f} %  {:>10}  {}\n", i + 1,
                   convention_word(bundle::kRangeKeys, c.depth.zero_to_one), c.depth.reversed,
                   convention_word(bundle::kFirstRowKeys, c.first_row), convention_word(kMatrixKeys, c.matrix), product,
                   convention_word(bundle::kStoredKeys, c.stored), axes, 100 * fit.share_off(), median,
                   i < fits.equal ? "fits" : (fit.known ? "" : "contradicts the light file"));
    }
    if (const std::size_t left = fits.fits.size() - refused - shown; left > 0)
        fmt::print("{} more fit worse (--json lists all)\n", left);
    for (const ConventionFit& fit : fits.fits)
        if (!fit.refusal.empty() && shown == 0) fmt::print("refused: {}\n", fit.refusal);
    if (refused > 0 && shown > 0) fmt::print("{} refused, as their matrices are none of this light\n", refused);
}

/// Returns the names of the options that tell readings apart which fit equally well.
std::string differing_options(const ConventionFits& fits) {
    const auto differs = [&](const auto& part) {
        return std::any_of(fits.fits.begin(), fits.fits.begin() + std::ptrdiff_t(fits.equal),
                           [&](const ConventionFit& f) { return part(f.convention) != part(fits.fits[0].convention); });
    };
    std::vector<std::string_view> out;
    if (differs([](const Convention& c) { return c.depth.zero_to_one; })) out.push_back("--depth-range");
    if (differs([](const Convention& c) { return c.depth.reversed; })) out.push_back("--reversed");
    if (differs([](const Convention& c) { return c.first_row; })) out.push_back("--first-row");
    if (differs([](const Convention& c) { return c.matrix; })) out.push_back("--matrix");
    if (differs([](const Convention& c) { return c.product; })) out.push_back("--product");
    if (differs([](const Convention& c) { return c.stored; })) out.push_back("--stored");
    if (differs([](const Convention& c) { return c.axes.up; })) out.push_back("--up");
    if (differs([](const Convention& c) { return c.axes.mirrored; })) out.push_back("--mirrored");
    if (differs([](const Convention& c) { return c.axes.unit; })) out.push_back("--unit");
    return fmt::format("{}", fmt::join(out, ", "));
}

/// Returns the index of the reading to take. @throws Error where none or several fit
std::size_t chosen_fit(const ConventionFits& fits, const ImportMapOptions& options, bool has_pair) {
    const std::string& light = options.light;
    if (options.pick > 0) {
        if (std::size_t(options.pick) > fits.fits.size())
            throw UsageError(fmt::format("--pick {}: there are {} readings", options.pick, fits.fits.size()));
        const ConventionFit& fit = fits.fits[std::size_t(options.pick) - 1];
        if (!fit.refusal.empty()) throw Error(fmt::format("--pick {}: {}", options.pick, fit.refusal));
        return std::size_t(options.pick) - 1;
    }
    const ConventionFit* other = nullptr;
    for (const ConventionFit& fit : fits.fits)
        if (!fit.known && fit.refusal.empty() && (!other || fit.share_off() < other->share_off())) other = &fit;
    const auto first_read = std::ranges::find_if(fits.fits, [](const ConventionFit& f) { return f.refusal.empty(); });
    const ConventionFit& best = fits.fits.front();
    if (other && fits.over_scene &&
        other->share_off() + kBetterByShare < (best.refusal.empty() ? best.share_off() : 1) && other->share_off() < 0.4)
        throw Error(fmt::format("{}: {}; another reading fits at {:.1f} % of the texels: {}", printable(light),
                                fit_sentence(best, true), 100 * (1 - other->share_off()),
                                convention_options(other->convention, has_pair)));
    if (first_read == fits.fits.end())
        throw Error(
            fmt::format("{}: no reading of the matrix is that of the light: {}", printable(light), best.refusal));
    if (fits.equal == 0)
        throw Error(
            fmt::format("{}: no reading of the map fits; correct matrix or image, or take a row of the list by "
                        "--pick N; the best one: {}",
                        printable(light), fit_sentence(*first_read, fits.over_scene)));
    if (fits.equal > 1)
        throw Error(fmt::format("{}: {} readings fit equally well; take one by --pick N, or state {}", printable(light),
                                fits.equal, differing_options(fits)));
    return 0;
}

/// Returns the parts of a convention that the options state.
KnownConvention stated_convention(const ImportMapOptions& options) {
    KnownConvention out;
    set_known(out.zero_to_one, options.depth_range, bundle::kRangeKeys);
    set_known(out.reversed, options.reversed, kReversedKeys);
    set_known(out.first_row, options.first_row, bundle::kFirstRowKeys);
    set_known(out.matrix, options.matrix, kMatrixKeys);
    set_known(out.product, options.product, kProductKeys);
    set_known(out.stored, options.stored, bundle::kStoredKeys);
    set_known(out.up, options.up, bundle::kUpKeys);
    set_known(out.mirrored, options.mirrored, kMirroredKeys);
    if (options.unit > 0) out.unit = options.unit;
    return out;
}

}  // namespace

void run_import_map(const ImportMapOptions& options) {
    const fs::path image_path = options.image;
    require_bundle_name(options.output);
    std::vector<fs::path> inputs = {image_path, options.light};
    const bool reads_scene = !options.scene.empty() && !is_builtin_scene(options.scene);
    if (reads_scene) inputs.emplace_back(options.scene);
    require_outputs_not_read(std::vector<fs::path>{options.output}, inputs);
    require_bundle_not_read(options.output, inputs);

    const MapImport map = read_map_import(image_path, options.light, options.scene, stated_convention(options));
    const ConventionFits& fits = map.fits;
    const bool has_pair = map.has_pair();
    std::vector<std::string> notes;
    if (map.row)
        notes.push_back(
            fmt::format("without a scene the first row is taken as the {} of the map, as in other {} files; "
                        "--first-row changes it",
                        convention_word(bundle::kFirstRowKeys, *map.row), lower_extension(image_path)));
    if (fits.other_axes > 0)
        notes.push_back(
            fmt::format("{} readings in other axes or units fit as well: the scene looks the same in them; "
                        "--up, --mirrored and --unit state the right ones",
                        fits.other_axes));

    std::optional<std::size_t> chosen;
    std::string failure;
    try {
        chosen = chosen_fit(fits, options, has_pair);
    } catch (const UsageError&) {
        throw;
    } catch (const Error& error) {
        failure = error.what();
    }
    if (options.json) {
        Json json = {{"format", "shadow-inspector-map-import"},
                     {"version", 1},
                     {"image", options.image},
                     {"width", map.width},
                     {"height", map.height},
                     {"scene", options.scene.empty() ? Json() : Json(options.scene)},
                     {"bundle", chosen ? Json(options.output) : Json()},
                     {"chosen", chosen ? Json(*chosen + 1) : Json()},
                     {"equal", fits.equal},
                     {"other_axes", fits.other_axes}};
        json["readings"] = Json::array();
        for (std::size_t i = 0; i < fits.fits.size(); ++i)
            json["readings"].push_back(fit_json(fits.fits[i], i + 1, fits.over_scene, has_pair));
        fmt::print("{}", json_text(json));
    } else {
        print_fits(fits, has_pair);
    }
    if (!chosen) throw Error(failure);

    const ConventionFit& fit = fits.fits[*chosen];
    std::vector<std::string> remarks = write_map_import(map, *chosen, options.output);
    if (!options.json) {
        fmt::print("taken: {}\n", convention_options(fit.convention, has_pair));
        fmt::print("{}\n", fit_sentence(fit, fits.over_scene));
        print_wrote(options.output);
    }
    // The first remark is the reading.
    notes.insert(notes.end(), remarks.begin() + 1, remarks.end());
    print_notes(notes);
}

}  // namespace si
