// Every technique on one scene, side by side with the truth: docs/techniques.md and its pictures.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/base/interrupt.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/against.h"
#include "app/session/command_line.h"
#include "app/sweep/pictures.h"
#include "app/sweep/progress_line.h"
#include "renderer/measure/bias_needs.h"
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
    "Written by `shadow-inspector docs techniques -o docs/techniques.md`, which draws and measures all of this anew; "
    "do not edit by hand.\n\n"
    "Every row of the tables of techniques on the built-in scene `stage`: {} x {} pixels, a map of {}² texels, all "
    "else by default. Left the picture, right\nwhat of it is wrong by the ray-traced truth of a light without size, in "
    "the "
    "colours of the overlay `artefacts`. *Error* is the mean of |V - R| over the pixels that\ncount, *wrong* the share "
    "on the other side of one half. *Taps* are the texels that the kernel fetches a pixel, *maps* what the maps take. "
    "Times are medians of forced\nframes of this one run, with the 95 % interval of the median, on {} (clock: {}): "
    "compare them with one another, not with other machines.\n";

/// A row of some table of techniques, and the settings that show it.
struct Entry {
    std::string_view key;
    std::string label;
    std::string_view help, paper;
    Settings settings;
    std::string sets = {};  ///< KEY=VALUE of a row that is not the section's; then `key` is empty
    std::string shown_key() const { return sets.empty() ? std::string(key) : sets; }
};

struct PageSection {
    std::string_view title, setting, about;
    std::vector<Entry> entries;
};

/// Each choice of a row's table in turn.
template <typename Rows>
std::vector<Entry> entries_of(const Rows& rows, const Settings& base, std::string_view setting) {
    std::vector<Entry> out;
    for (const auto& row : rows) {
        out.push_back({row.key, std::string(row.label), row.help, row.paper, base});
        set_setting(out.back().settings, setting, row.key);
    }
    return out;
}

/// Each kernel at its own short list of sizes.
std::vector<Entry> kernel_entries(const Settings& base) {
    std::vector<Entry> out;
    for (const std::string_view name : swept_kernels()) {
        Settings s = base;
        set_setting(s, "filter.kernel", name);
        const Filter& row = filter_of(s);
        out.push_back({name, kernel_label(s), row.help, row.paper, s});
    }
    return out;
}

/// Each bias at the least numbers that clear the picture's planes by its own account.
std::vector<Entry> bias_entries(Renderer& renderer, const Scene& scene, const Settings& base) {
    ReferenceCache cache;
    const MeasuredError measured =
        measure_error(renderer, scene, base, {.width = kWidth, .height = kHeight}, 0, {}, cache);
    std::vector<Entry> out;
    for (const Bias& row : biases()) {
        const auto least = least_bias_by(row, measured, base, renderer.driver());
        if (!least) continue;
        out.push_back({row.key, std::string(row.label), row.help, row.paper, base});
        out.back().settings.bias = *least;
    }
    return out;
}

/// Each choice of a setting that is no table of techniques.
std::vector<Entry> choices_of(const Settings& base, std::string_view setting) {
    std::vector<Entry> out;
    for (const Choice& c : find_setting(setting)->param->choices()) {
        out.push_back({c.key, std::string(c.label), c.help, {}, base});
        set_setting(out.back().settings, setting, c.key);
    }
    return out;
}

/// One setting at a value, as a row of its own: "map.reversed_z=true".
Entry with(const Settings& base, std::string_view setting, std::string_view value) {
    const Param& p = *find_setting(setting)->param;
    Entry e{{}, std::string(p.label), p.help, {}, base};
    e.sets = fmt::format("{}={}", setting, value);
    set_setting(e.settings, setting, value);
    return e;
}

Settings changed(Settings s, std::initializer_list<std::pair<std::string_view, std::string_view>> sets) {
    for (const auto& [key, value] : sets) set_setting(s, key, value);
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
    return {
        {"Filter kernels", "filter.kernel", "How the shadow test is filtered.", kernel_entries(base)},
        {"Biases", "bias.kind",
         "Each alone, at the least numbers that leave no acne by its own theory. A constant has to serve the steepest "
         "lit faces, and takes the shadows of the rest with it.",
         bias_entries(renderer, scene, base)},
        {"Sources", "light.source", "Where a light's shadows come from.", entries_of(sources(), base, "light.source")},
        {"Fits", "light.fit", "What a map covers.", entries_of(fits(), base, "light.fit")},
        {"Between which depths", "light.near_far", "What a map stores along the light.",
         choices_of(base, "light.near_far")},
        {"Cascades", "light.split", "Four maps of what the camera sees, by where they part; then as the rows say.",
         cascade_entries(base)},
        {"Storage", "map.format", "How depths are stored; then one setting changed, as the rows say.",
         storage_entries(base)},
        {"Composition", "shading.composition", "How light and shadow meet in the picture.", lighting_entries(base)}};
}

std::string picture_name(const PageSection& s, const Entry& e) {
    std::string name = fmt::format("{}.{}", s.setting, e.sets.empty() ? e.key : std::string_view(e.sets));
    std::ranges::replace(name, '.', '-');
    std::ranges::replace(name, '=', '-');
    return name + ".png";
}

std::string row_text(const Entry& e, const std::string& picture, const Judgement& classified,
                     const TimeMeasurement& time) {
    const ErrorMetrics& m = classified.error;
    const Spread& t = time.total_ms;
    return fmt::format(
        "| ![{}]({}) | **{}** `{}`<br>{}{} | {:.4f} | {:.2f} % | {:g} | {:.1f} MiB | {:.0f} ({:.0f}-{:.0f}) |\n",
        markdown_cell(e.label), picture, markdown_cell(e.label), e.shown_key(), markdown_cell(e.help),
        e.paper.empty() ? "" : fmt::format("<br>*{}*", markdown_cell(e.paper)), m.mae, 100 * (m.false_shadow + m.false_light),
        classified.cost.taps_per_pixel, double(classified.cost.map_bytes) / (1 << 20), t.median, t.median_low,
        t.median_high);
}

}  // namespace

void run_docs_techniques(const std::string& output) {
    require_writable(output);
    const fs::path pictures = fs::path(output).parent_path() / fs::path(output).stem();
    fs::create_directories(pictures);
    const HeadlessContext context;
    Renderer renderer;
    Measurer measurer(renderer, kWidth, kHeight);
    const Scene scene = load_scene("stage");
    Settings base = base_settings(scene);
    base.map.resolution = kResolution;
    const std::vector<PageSection> sections = all_sections(renderer, scene, base);
    std::size_t count = 0, done = 0;
    for (const PageSection& s : sections) count += s.entries.size();
    ProgressLine line;
    InterruptGuard interrupt;
    std::string text;
    for (const PageSection& s : sections) {
        text += fmt::format("\n## {}\n\n`{}`. {}\n\n", s.title, s.setting, s.about) +
                "| picture, what is wrong | technique | error | wrong | taps | maps | ms a frame |\n"
                "|---|---|---|---|---|---|---|\n";
        for (const Entry& e : s.entries) {
            if (interrupt.stop_requested()) interrupt.end();
            line.show(fmt::format("{} of {}  {}", ++done, count, e.label), false);
            const Judgement classified = measurer.judge(scene, e.settings);
            const TimeMeasurement time =
                measurer.time(scene, e.settings, CostCase::Forced, {.least = 5, .most = 15, .bursts = 3});
            const std::string file = picture_name(s, e);
            write_png(pictures / file,
                      side_by_side(shrunk(classified.picture, kShownWidth), shrunk(classified.artefacts, kShownWidth)));
            text += row_text(e, (pictures.filename() / file).generic_string(), classified, time);
        }
    }
    const DriverInfo& driver = renderer.driver();
    write_file(output, fmt::format(fmt::runtime(kTechniquesIntro), kWidth, kHeight, kResolution, driver.renderer,
                                   driver.clock) +
                           text);
}

}  // namespace si
