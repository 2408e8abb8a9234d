#include <fmt/format.h>

#include <map>

#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/session/preset_schema.h"
#include "app/session/setting_json.h"
#include "renderer/base/error.h"
#include "renderer/bundle/bundle_schema.h"
#include "renderer/reference/metrics.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr std::string_view kSettingsIntro =
    "# Settings\n"
    "\n"
    "Printed by `shadow-inspector docs settings -o docs/settings.md` from the table of settings. Do not edit it by "
    "hand.\n"
    "\n"
    "Every setting has a control in the editor. On the command line a setting is given as `--set KEY=VALUE`, and a "
    "preset saves it. The key `light.X` means `light.0.X`. Each of the lights 0 to 15 has these settings. The key "
    "`object.PATH.X` belongs to the object at the node path `PATH`, such as `object.Root/Fence.cull`.\n";

std::string allowed(const SettingRef& ref) {
    const Param& p = *ref.param;
    if (p.choices) {
        std::vector<std::string> keys;
        for (const Choice& c : p.choices()) keys.push_back(fmt::format("`{}`", c.key));
        return fmt::format("{}", fmt::join(keys, ", "));
    }
    if (setting_type(ref) == "bool") return "`true`, `false`";
    if (setting_type(ref) == "text") return fmt::format("a text of at most {} bytes", p.max);
    return fmt::format("{} to {}{}{}", value_text(p, p.min), value_text(p, p.max), p.unit.empty() ? "" : " ", p.unit);
}

std::string setting_section(const Param& p) {
    static const std::map<Cost, std::string_view> kCosts = {
        {Cost::Uniform, ""},
        {Cost::Program, " A change of the value compiles shaders."},
        {Cost::Target, " A change of the value allocates the maps again."}};
    const SettingRef ref{&p, 0, p.scope == Scope::Object ? "PATH" : ""};
    const std::string preset = value_text(p, default_value(ref));
    std::string text = fmt::format(
        "\n### {0}\n\nLabel in the editor: {1}. Allowed values: {2}. Default value: {3}.{4}\n\n`{0}`: {5}\n",
        setting_key(ref), p.label, allowed(ref), preset.empty() ? "none" : "`" + preset + "`", kCosts.at(p.cost),
        p.help);
    if (!p.also.empty())
        text += fmt::format("\nNames for `{}` in engines and other programs: {}.\n", setting_key(ref), p.also);
    if (!p.choices) return text;
    text += "\n| choice | name | meaning |\n|---|---|---|\n";
    for (const Choice& c : p.choices())
        text += fmt::format("| `{}` | {} | {} |\n", c.key, markdown_cell(c.label), markdown_cell(c.help));
    return text;
}

constexpr std::string_view kMetricsIntro =
    "# Metrics\n"
    "\n"
    "Printed by `shadow-inspector docs metrics -o docs/metrics.md` from the table of metrics. Do not edit it by hand.\n"
    "\n"
    "Each metric is a number that says how wrong the shadows of a picture are. `shadow-inspector measure --json` "
    "prints the metrics as fields of `error`. A sweep has them as columns `error.…`, and the editor as rows of the tab "
    "*Error*. The option `--error` of `tune` names the metric that `--max-error` limits.\n"
    "\n"
    "In the formulas, V is the visibility of a pixel by the shadow map, R is the visibility by the ray-traced "
    "reference, and n is the number of counted pixels. [accuracy.md](accuracy.md#errors) defines a *wrong* pixel and "
    "its causes. A share of pixels is relative to n, and 0 if n is 0.\n"
    "\n"
    "| key | name | unit | formula | reads as | part of | source |\n"
    "|---|---|---|---|---|---|---|\n";

}  // namespace

std::string markdown_cell(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '|') out += '\\';
        out += c;
    }
    return out;
}

std::string metrics_page() {
    std::string text(kMetricsIntro);
    for (const Metric& m : metrics())
        text +=
            fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", m.key, m.label, m.unit, markdown_cell(m.formula),
                        markdown_cell(m.help), m.part_of.empty() ? "" : fmt::format("`{}`", m.part_of), m.paper);
    return text;
}

std::string settings_page() {
    std::string text(kSettingsIntro), group;
    for (const Param& p : params()) {
        const std::string this_group(p.key.substr(0, p.key.find('.')));
        if (this_group != group) text += fmt::format("\n## {}\n", group = this_group);
        text += setting_section(p);
    }
    return text;
}

void run_docs(const DocsOptions& options) {
    const std::string &what = options.what, &output = options.output;
    if (what == "techniques") {
        if (output.empty()) throw UsageError("docs techniques: -o FILE is missing; pictures go next to it");
        return run_docs_techniques(options);
    }
    if (!options.only.empty())
        throw UsageError(fmt::format("docs {} --only: only the page of techniques has rows", what));
    const std::map<std::string, std::string (*)()> pages = {
        {"settings", settings_page},     {"presets", presets_page},        {"metrics", metrics_page},
        {"hard-cases", hard_cases_page}, {"bundle-schema", bundle_schema}, {"preset-schema", preset_schema}};
    const auto wanted = pages.find(what);
    if (wanted == pages.end())
        throw UsageError(
            fmt::format("docs {}: the pages are settings, presets, metrics, hard-cases, techniques, bundle-schema and "
                        "preset-schema",
                        what));
    const std::string page = wanted->second();
    if (options.check) {
        if (read_text_file(output) == page) return;
        throw Error(fmt::format("{}: is out of date; write it with `docs {} -o {}`", output, what, output));
    }
    if (output.empty())
        fmt::print("{}", page);
    else
        write_file(output, page);
}

}  // namespace si
