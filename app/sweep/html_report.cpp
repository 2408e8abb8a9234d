#include "app/sweep/html_report.h"

#include <fmt/format.h>

#include <set>

#include "app/report/html_page.h"
#include "app/sweep/columns.h"
#include "app/sweep/results.h"
#include "renderer/base/command_text.h"
#include "renderer/base/regular_file.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/settings/param.h"
#include "renderer/settings/starting_values.h"

namespace si {

namespace {

namespace fs = std::filesystem;

/// Returns the report's scripts in the order of their dependencies.
std::string script() {
    std::string text;
    for (const char* name : {"data.js", "axes.js", "plot.js", "table.js", "page.js"}) text += report_asset(name);
    return text;
}

Json columns_json(CostCase cost) {
    static constexpr const char* kPlotted[] = {"as_is", "absolute", "lacking_to_one", "no"};
    return json_list(columns(), [&](const Column& c) -> Json {
        return {{"key", c.key},
                {"label", label_of(c, cost)},
                {"unit", c.unit},
                {"help", c.help},
                {"plotted", kPlotted[std::size_t(c.better)]},
                {"noise", c.noise},
                {"bound", c.bound}};
    });
}

/// Returns labels of the varied settings and of their choices.
Json setting_info(const Json& axes) {
    Json info = Json::object();
    for (const Json& axis : axes) {
        const std::string key = axis.at("key").get<std::string>();
        const auto ref = find_setting(key);
        if (!ref) continue;
        Json& entry = info[key];
        entry = {{"label", ref->param->label}, {"unit", ref->param->unit}, {"help", ref->param->help}};
        if (!ref->param->choices) continue;
        for (const Choice& c : ref->param->choices()) entry["choices"][std::string(c.key)] = c.label;
    }
    return info;
}

/// Returns the command line that opens a case in the editor, from the working directory of the sweep.
/// @param folder folder of the sweep
std::string command_of(const Json& results, const Json& row, const fs::path& folder) {
    std::string text = fmt::format("shadow-inspector edit {} --preset {}",
                                   shell_quoted(results.at("scene").at("name").get<std::string>()),
                                   shell_quoted((folder / kBasePreset).string()));
    Json sets = row.at("settings");
    for (const char* more : {"starts", "own_settings"})
        if (row.contains(more)) sets.update(row[more]);
    // A --set brings starting values along, which the case did not take where the base held the setting.
    const Json named = sets;
    for (const auto& [key, value] : named.items()) {
        const auto varied = find_setting(key);
        if (!varied) continue;
        for (const std::string& held : keys_with_starting_values(*varied)) {
            if (sets.contains(held)) continue;
            const SettingRef ref = *find_setting(held);
            sets[held] = results.at("settings").value(held, value_text(*ref.param, default_value(ref)));
        }
    }
    for (const auto& [key, value] : sets.items())
        text += " --set " + shell_quoted(key + "=" + value.get<std::string>());
    return text;
}

/// Returns a picture file as a data URI; empty without the file.
std::string picture_uri(const fs::path& file, const char* type) {
    constexpr std::size_t kMaxPictureBytes = std::size_t{16} << 20;
    const ReadResult read = read_regular_file(file, kMaxPictureBytes);
    if (!read.error.empty() || read.bytes.size == 0) return {};
    return data_uri(read.bytes.text(), type);
}

/// Embeds pictures up to the size limit: those of the Pareto front first, then all thumbnails, then all artefact
/// pictures.
Json pictures_json(const Json& results, const fs::path& folder, std::size_t most_bytes) {
    const Json& frontier = results.at("frontier").at("cases");
    const std::set<Json> on(frontier.begin(), frontier.end());
    Json pictures = Json::object();
    std::size_t used = 0;
    const auto add = [&](const Json& row, const char* field, const char* name, const char* type) {
        if (!row.at(field).is_string() || used >= most_bytes) return;
        std::string uri = picture_uri(folder / row[field].get<std::string>(), type);
        if (uri.empty() || used + uri.size() > most_bytes) return;
        used += uri.size();
        pictures[row.at("case").dump()][name] = std::move(uri);
    };
    for (const bool frontier_only : {true, false})
        for (const Json& row : results.at("rows"))
            if (on.contains(row.at("case")) == frontier_only) {
                add(row, "picture", "thumbnail", "image/jpeg");
                if (frontier_only) add(row, "artefacts", "artefacts", "image/png");
            }
    for (const Json& row : results["rows"])
        if (!on.contains(row["case"])) add(row, "artefacts", "artefacts", "image/png");
    return pictures;
}

/// Formats JSON for a script element, escaped so that it cannot end the element or begin a comment.
std::string script_json(const Json& json) {
    const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    std::string safe;
    for (const char c : text)
        safe += c == '<' ? "\\u003c" : c == '>' ? "\\u003e" : c == '&' ? "\\u0026" : std::string(1, c);
    return safe;
}

}  // namespace

std::string report_html(const Json& results, const fs::path& folder, const std::string& picture,
                        std::size_t max_picture_bytes) {
    Json data = results;
    data["columns"] = columns_json(parse_cost(results.value("timed", "forced")));
    data["setting_info"] = setting_info(results.at("axes"));
    data["pictures"] = pictures_json(results, folder, max_picture_bytes);
    data["artefact_legend"] = json_list(artefact_styles(), [](const ArtefactStyle& style) -> Json {
        return Json::array({style.label, fmt::format("#{:02x}{:02x}{:02x}", style.rgb[0], style.rgb[1], style.rgb[2])});
    });
    for (Json& row : data["rows"]) row["command"] = command_of(results, row, folder);
    std::string page = report_asset("page.html");
    page = replaced_mark(page, "@STYLE@", report_asset("style.css"));
    page = replaced_mark(page, "@PICTURE@", picture);
    page = replaced_mark(page, "@SCRIPT@", script());
    return replaced_mark(page, "@DATA@", script_json(data));
}

}  // namespace si
