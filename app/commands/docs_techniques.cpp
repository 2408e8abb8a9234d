// Every technique on one scene, compared with the ray-traced reference: docs/techniques.md and its pictures.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <utility>

#include "app/base/interrupt.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/picture_comparison.h"
#include "app/session/session.h"
#include "app/sweep/progress_line.h"
#include "renderer/advise/bias_needs.h"
#include "renderer/base/atomic_file.h"
#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/measure/measure.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 640, kHeight = 360, kShownWidth = 240, kResolution = 1024;

constexpr std::string_view kTechniquesIntro =
    "# Techniques\n\n"
    "`shadow-inspector docs techniques -o docs/techniques.md` writes this page. The command draws and measures every "
    "technique.\nWith the option `--only filter.kernel=pcf` it writes the rows of that choice alone. Do not edit this "
    "page by hand.\n\n"
    "Every technique is drawn on the built-in scene `stage`, with {} x {} pixels and a map of {}² texels. All other "
    "settings have their\ndefaults. Errors are relative to a ray-traced reference for a light without size.\n\n"
    "- In every picture of this page, the left half is the rendered frame. The right half shows the wrong pixels of "
    "that frame, in the colours of the overlay `artefacts`.\n"
    "- *Error* is the mean of |V - R| over the compared pixels. V is the visibility in the picture, and R is the "
    "visibility in the reference.\n"
    "- *Wrong* is the share of compared pixels where one of V and R is above one half and the other is not.\n"
    "- *Taps* are the texels that the kernel fetches for a pixel.\n"
    "- *Maps* is the memory of the maps.\n\n"
    "Times differ between machines and are left out: `shadow-inspector sweep stage --vary filter.kernel='*' -o DIR` "
    "measures them.\n";

/// Row of the page: a choice of a technique, and the settings that draw it.
struct Entry {
    std::string_view key;
    std::string label;
    std::string_view help, paper;
    Settings settings;
    std::string sets = {};     ///< KEY=VALUE of a row whose setting is not the section's; then `key` is empty
    std::string_view of = {};  ///< key of the table's row where `key` is one of its sizes
    std::string shown_key() const { return sets.empty() ? std::string(key) : sets; }
};

/// Table of the page: the rows are the choices of `setting`.
struct PageSection {
    std::string_view title, setting, about;
    std::function<std::vector<Entry>()> make_entries;
    bool has_other_settings = false;  ///< some rows change another setting (Entry::sets)
};

/// Returns an entry for each choice of a setting. @param rows table of the setting's techniques, or its choices
template <typename Rows>
std::vector<Entry> entries_of(const Rows& rows, const Settings& base, std::string_view setting) {
    std::vector<Entry> out;
    for (const auto& row : rows) {
        out.push_back({row.key, std::string(row.label), row.help, {}, base});
        if constexpr (requires { row.paper; }) out.back().paper = row.paper;
        set_setting(out.back().settings, setting, row.key);
    }
    return out;
}

/// Returns an entry for each choice of a setting that has no table of techniques.
std::vector<Entry> choices_of(const Settings& base, std::string_view setting) {
    return entries_of(find_setting(setting)->param->choices(), base, setting);
}

/// Returns an entry for each kernel at each size of the kernel's own short list.
std::vector<Entry> kernel_entries(const Settings& base) {
    std::vector<Entry> out;
    for (const std::string_view name : sweep_kernels()) {
        Settings s = base;
        set_setting(s, "filter.kernel", name);
        const Filter& row = filter_of(s);
        out.push_back({name, kernel_label(s), row.help, row.paper, s, {}, row.key});
    }
    return out;
}

/// Returns an entry for each kind of bias, with the least numbers that avoid acne on planes by its own formula.
std::vector<Entry> bias_entries(Renderer& renderer, const Scene& scene, const Settings& base) {
    ReferenceCache cache;
    const MeasuredError measured =
        measure_error(renderer, scene, base, {.width = kWidth, .height = kHeight}, 0, {}, cache);
    std::vector<Entry> out;
    for (const Bias& row : biases()) {
        const auto least = least_bias_of_row(row, measured, base, renderer.driver());
        if (!least) continue;
        out.push_back({row.key, std::string(row.label), row.help, row.paper, base});
        out.back().settings.bias = *least;
    }
    return out;
}

/// Returns the entry of one setting at a value: "map.reversed_z=true".
Entry with(const Settings& base, std::string_view setting, std::string_view value) {
    const Param& p = *find_setting(setting)->param;
    Entry e{{}, std::string(p.label), p.help, {}, base};
    e.sets = fmt::format("{}={}", setting, value);
    set_setting(e.settings, setting, value);
    return e;
}

Settings changed(Settings s, std::initializer_list<std::pair<std::string_view, std::string_view>> sets) {
    set_settings(s, sets);
    return s;
}

std::vector<Entry> storage_entries(const Settings& base) {
    std::vector<Entry> out = choices_of(base, "map.format");
    out.push_back(with(base, "map.reversed_z", "true"));
    const auto moments = std::ranges::find(filters(), Samples::Moments, &Filter::samples);
    out.push_back(with(changed(base, {{"filter.kernel", moments->key}}), "filter.moment_format", "16-bit"));
    out.push_back(with(base, "map.transform", "eye"));
    out.push_back(with(base, "map.virtual", "true"));
    return out;
}

std::vector<Entry> cascade_entries(const Settings& base) {
    const Settings four = changed(base, {{"light.cascades", "4"}, {"light.fit", "view"}});
    std::vector<Entry> out = choices_of(four, "light.split");
    out.push_back(with(four, "light.cascade_choice", "map"));
    out.push_back(with(four, "light.depth_bounds", "sdsm"));
    out.push_back(with(four, "light.fit", "stabilised"));
    return out;
}

std::vector<Entry> lighting_entries(const Settings& base) {
    std::vector<Entry> out = choices_of(base, "shading.composition");
    out.push_back(with(base, "light.contact", "0.3"));
    return out;
}

std::vector<PageSection> all_sections(Renderer& renderer, const Scene& scene, const Settings& base) {
    return {{"Filter kernels", "filter.kernel", "The filter of the shadow test.", [&] { return kernel_entries(base); }},
            {"Biases", "bias.kind",
             "Each alone, at the least numbers without acne by its own theory. A constant bias has to suffice for the "
             "steepest lit faces, and detaches the shadows of all others.",
             [&] { return bias_entries(renderer, scene, base); }},
            {"Sources", "light.source", "The technique that makes a light's shadows.",
             [&] { return entries_of(sources(), base, "light.source"); }},
            {"Fits", "light.fit", "The region of a map.", [&] { return entries_of(fits(), base, "light.fit"); }},
            {"Between which depths", "light.near_far", "The depth range of a map.",
             [&] { return choices_of(base, "light.near_far"); }},
            {"Cascades", "light.split", "Four maps of the view frustum, by the split; then as the rows say.",
             [&] { return cascade_entries(base); }, true},
            {"Storage", "map.format", "The storage of depth; then one setting changed, as the rows say.",
             [&] { return storage_entries(base); }, true},
            {"Composition", "shading.composition", "The combination of light and shadow in the picture.",
             [&] { return lighting_entries(base); }, true}};
}

std::string picture_name(const PageSection& s, const Entry& e) {
    std::string name = fmt::format("{}.{}", s.setting, e.sets.empty() ? e.key : std::string_view(e.sets));
    std::ranges::replace(name, '.', '-');
    std::ranges::replace(name, '=', '-');
    return name + ".png";
}

std::string row_text(const Entry& e, const std::string& picture, const Classification& classified) {
    const ErrorMetrics& m = classified.error;
    return fmt::format("| ![{}]({}) | **{}** `{}`<br>{}{} | {:.4f} | {:.2f} % | {:g} | {:.1f} MiB |\n",
                       markdown_cell(e.label), picture, markdown_cell(e.label), e.shown_key(), markdown_cell(e.help),
                       e.paper.empty() ? "" : fmt::format("<br>*{}*", markdown_cell(e.paper)), m.mae,
                       100 * (m.false_shadow + m.false_light), classified.cost.taps_per_pixel,
                       double(classified.cost.map_bytes) / (1 << 20));
}

constexpr std::string_view kTableHead =
    "| picture, what is wrong | technique | error | wrong | taps | maps |\n"
    "|---|---|---|---|---|---|\n";

/// Draws and measures rows of the page, and keeps their pictures as PNG bytes by file name.
class PagePainter {
public:
    PagePainter(Renderer& renderer, const Scene& scene, std::string folder, std::size_t count)
        : scene_(scene), folder_(std::move(folder)), count_(count), measurer_(renderer, kWidth, kHeight) {}

    /// Returns the row's line of its table.
    std::string draw_row(const PageSection& section, const Entry& e) {
        if (interrupt_.stop_requested()) interrupt_.end();
        line_.show(fmt::format("{} of {}  {}", ++done_, count_, e.label), false);
        const Classification classified = measurer_.classify(scene_, e.settings);
        const std::string file = picture_name(section, e);
        pictures_[file] = png_bytes(
            side_by_side_image(shrunk(classified.picture, kShownWidth), shrunk(classified.artefacts, kShownWidth)));
        return row_text(e, folder_ + "/" + file, classified);
    }

    const std::map<std::string, std::string>& pictures() const { return pictures_; }

private:
    const Scene& scene_;
    const std::string folder_;
    std::size_t count_, done_ = 0;
    Measurer measurer_;
    ProgressLine line_;
    InterruptGuard interrupt_;
    std::map<std::string, std::string> pictures_;
};

/// Rows of one section that are drawn: indices into its entries.
struct ChosenRows {
    PageSection section;
    std::vector<Entry> entries;
    std::vector<std::size_t> rows;
};

/// Returns the rows that `only` names, "filter.kernel=pcf": a row of a table, one of its sizes, or a row of that text.
/// Returns all rows if it is empty.
/// @throws UsageError naming the nearest row
std::vector<ChosenRows> chosen_rows(const std::vector<PageSection>& sections, const std::string& only) {
    const std::string setting = only.substr(0, only.find('='));
    std::vector<ChosenRows> out;
    std::vector<std::string> names, settings;
    for (const PageSection& s : sections) {
        settings.emplace_back(s.setting);
        if (!only.empty() && s.setting != setting && !s.has_other_settings) continue;
        ChosenRows chosen{s, s.make_entries(), {}};
        for (std::size_t i = 0; i < chosen.entries.size(); ++i) {
            const Entry& e = chosen.entries[i];
            const std::string name = e.sets.empty() ? fmt::format("{}={}", s.setting, e.key) : e.sets;
            names.push_back(name);
            if (!e.sets.empty()) settings.push_back(e.sets.substr(0, e.sets.find('=')));
            if (only.empty() || name == only || (!e.of.empty() && fmt::format("{}={}", s.setting, e.of) == only))
                chosen.rows.push_back(i);
        }
        if (!chosen.rows.empty()) out.push_back(std::move(chosen));
    }
    if (!out.empty()) return out;
    if (std::ranges::find(settings, setting) == settings.end())
        throw UsageError(fmt::format("docs techniques --only {}: the page has no rows of {}{}", only, setting,
                                     did_you_mean(nearest_name(setting, settings))));
    throw UsageError(fmt::format("docs techniques --only {}: the page has no such row{}", only,
                                 did_you_mean(nearest_name(only, names))));
}

/// Returns the key of a row's line, "pcf5" or "map.virtual=true". Empty for other lines.
std::string_view key_of_line(std::string_view line) {
    const std::size_t from = line.find("** `");
    if (!line.starts_with("| ![") || from == std::string_view::npos) return {};
    const std::string_view rest = line.substr(from + 4);
    return rest.substr(0, rest.find('`'));
}

/// Replaces the line of a row in its section of the page, or inserts it after the nearest row that precedes it in the
/// table. All other lines stay as they are. @throws Error where the page has no such section
void put_row(std::string& page, const ChosenRows& chosen, std::size_t row, const std::string& line) {
    const std::size_t head = page.find(fmt::format("\n`{}`. ", chosen.section.setting));
    const std::size_t rule = head == std::string::npos ? head : page.find("\n|---", head);
    if (rule == std::string::npos)
        throw Error(fmt::format("the page has no table of {}; write the whole page first: docs techniques -o FILE",
                                chosen.section.setting));
    const std::size_t first = std::min(page.find('\n', rule + 1), page.size() - 1) + 1;
    std::map<std::string_view, std::pair<std::size_t, std::size_t>> lines;  // key to offset and size
    for (std::size_t at = first; at < page.size() && page[at] == '|';) {
        const std::size_t end = std::min(page.find('\n', at), page.size() - 1) + 1;
        const std::string_view text = std::string_view(page).substr(at, end - at);
        lines[key_of_line(text)] = {at, text.size()};
        at = end;
    }
    if (const auto same = lines.find(chosen.entries[row].shown_key()); same != lines.end()) {
        page.replace(same->second.first, same->second.second, line);
        return;
    }
    std::size_t at = first;
    for (std::size_t i = 0; i < row; ++i)
        if (const auto before = lines.find(chosen.entries[i].shown_key()); before != lines.end())
            at = before->second.first + before->second.second;
    page.insert(at, line);
}

void compare_page(const std::string& output, const std::string& page, const fs::path& folder,
                  const std::map<std::string, std::string>& pictures) {
    const auto out_of_date = [&](const std::string& file) {
        return Error(fmt::format("{}: is out of date; write it with `docs techniques -o {}`", file, output));
    };
    if (read_text_file(output) != page) throw out_of_date(output);
    for (const auto& [file, bytes] : pictures)
        if (read_text_file(folder / file) != bytes) throw out_of_date((folder / file).string());
}

}  // namespace

void run_docs_techniques(const DocsOptions& options) {
    const std::string& output = options.output;
    if (!options.check) require_writable(output);
    const fs::path folder = fs::path(output).parent_path() / fs::path(output).stem();
    const bool whole = options.only.empty();
    if (!whole && !fs::exists(output))
        throw Error(fmt::format("{}: there is no such page to put a row into; write it without --only", output));
    std::string page =
        whole ? fmt::format(fmt::runtime(kTechniquesIntro), kWidth, kHeight, kResolution) : read_text_file(output);
    const HeadlessContext context;
    Renderer renderer;
    const Scene scene = load_scene("stage");
    Settings base = base_settings(scene);
    base.map.resolution = kResolution;
    const std::vector<ChosenRows> all = chosen_rows(all_sections(renderer, scene, base), options.only);
    std::size_t count = 0;
    for (const ChosenRows& chosen : all) count += chosen.rows.size();
    PagePainter painter(renderer, scene, folder.filename().generic_string(), count);
    for (const ChosenRows& chosen : all) {
        const PageSection& s = chosen.section;
        if (whole) page += fmt::format("\n## {}\n\n`{}`. {}\n\n{}", s.title, s.setting, s.about, kTableHead);
        for (const std::size_t row : chosen.rows) {
            const std::string line = painter.draw_row(s, chosen.entries[row]);
            if (whole)
                page += line;
            else
                put_row(page, chosen, row, line);
        }
    }
    if (options.check) return compare_page(output, page, folder, painter.pictures());
    make_folders(folder);
    for (const auto& [file, bytes] : painter.pictures()) write_file(folder / file, bytes);
    write_file(output, page);
}

}  // namespace si
