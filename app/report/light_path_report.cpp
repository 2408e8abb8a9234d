#include "app/report/light_path_report.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>

#include "app/base/output.h"
#include "app/report/html_page.h"
#include "app/report/measure_json.h"
#include "app/report/plot_svg.h"
#include "app/report/xml_text.h"
#include "renderer/reference/artefact_picture.h"

namespace si {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Number of each point: column of the table, and plot of the page.
struct PathColumn {
    std::string key, label;
    std::function<double(const PathStep&)> value;  ///< NaN: not known
    bool plotted = false;
};

std::vector<PathColumn> path_columns(const LightPathReport& report) {
    const Metric& metric = *report.metric;
    std::vector<PathColumn> out;
    out.push_back({"error." + std::string(metric.key), std::string(metric.label),
                   [&metric](const PathStep& s) { return metric.value(s.error); }, true});
    for (const Metric& m : metrics())
        if (&m != &metric && m.member)
            out.push_back({"error." + std::string(m.key), std::string(m.label),
                           [&m](const PathStep& s) { return m.value(s.error); }});
    out.push_back(
        {"time.total_ms.median",
         fmt::format("Time of a frame {}, {}", cost_row(report.measured.cost).when, time_unit(report.measured.clock)),
         [](const PathStep& s) { return s.time ? s.time->total_ms.median : kUnknown; }, true});
    out.push_back({"time.total_ms.noise", "Half its 95 % interval, ms",
                   [](const PathStep& s) { return s.time ? s.time->total_ms.noise() : kUnknown; }});
    out.push_back({"shimmer.beyond", "Shimmer: change of visibility beyond the reference's",
                   [](const PathStep& s) { return s.change ? s.change->beyond : kUnknown; }, true});
    out.push_back({"shimmer.change", "Change of visibility",
                   [](const PathStep& s) { return s.change ? s.change->drawn : kUnknown; }});
    out.push_back({"shimmer.reference_change", "Change of the reference's visibility",
                   [](const PathStep& s) { return s.change ? s.change->reference : kUnknown; }});
    out.push_back({"shimmer.flips", "Pixels that cross one half while the reference does not",
                   [](const PathStep& s) { return s.change ? double(s.change->flips) : kUnknown; }});
    out.push_back({"cost.map_texels", "Texels of maps", [](const PathStep& s) { return double(s.cost.map_texels); }});
    out.push_back({"cost.draws", "Draws", [](const PathStep& s) { return double(s.cost.draws); }});
    out.push_back({"cost.triangles", "Triangles", [](const PathStep& s) { return double(s.cost.triangles); }});
    return out;
}

/// Returns the place of a point on the axis across: its hour, else its number.
double place_of(const PathStep& step, std::size_t number) {
    return step.point.hour.value_or(double(number));
}

/// Returns true if the path is that of a day.
bool is_day(const LightPathReport& report) {
    return !report.measured.steps.empty() && report.measured.steps.front().point.hour.has_value();
}

std::string point_text(const PathPoint& point) {
    std::string text;
    for (const auto& [key, value] : point.values) text += (text.empty() ? "" : ", ") + key + "=" + value;
    if (point.hour) text += fmt::format(", {:.2f} h", *point.hour);
    return text;
}

Json change_json(const PathChange& c) {
    return {{"pixels", c.pixels},
            {"change", c.drawn},
            {"reference_change", c.reference},
            {"beyond", c.beyond},
            {"flips", c.flips}};
}

Json step_json(const PathStep& step) {
    Json settings = Json::object();
    for (const auto& [key, value] : step.point.values) settings[key] = value;
    return {{"settings", settings},
            {"hour", step.point.hour ? Json(*step.point.hour) : Json()},
            {"error", error_json(step.error)},
            {"cost", cost_json(step.cost)},
            {"time", step.time ? time_json(*step.time) : Json()},
            {"shimmer", step.change ? change_json(*step.change) : Json()}};
}

std::string table_of(const LightPathReport& report, const std::vector<PathColumn>& columns) {
    std::string html = "<div class=\"scroll\"><table>\n<thead><tr>";
    for (const auto& [key, value] : report.measured.steps.front().point.values)
        html += fmt::format("<th class=\"number\">{}</th>", xml_text(key));
    if (is_day(report)) html += "<th class=\"number\">hour</th>";
    for (const PathColumn& c : columns)
        if (c.plotted) html += fmt::format("<th class=\"number\">{}</th>", xml_text(c.label));
    html += "</tr></thead>\n<tbody>\n";
    for (const PathStep& step : report.measured.steps) {
        html += "<tr>";
        for (const auto& [key, value] : step.point.values)
            html += fmt::format("<td class=\"number\">{}</td>", xml_text(value));
        if (step.point.hour) html += fmt::format("<td class=\"number\">{:.2f}</td>", *step.point.hour);
        for (const PathColumn& c : columns) {
            if (!c.plotted) continue;
            const double v = c.value(step);
            html += std::isfinite(v) ? fmt::format("<td class=\"number\">{:.4g}</td>", v)
                                     : std::string("<td class=\"number\">–</td>");
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

}  // namespace

Json light_path_json(const LightPathReport& report) {
    const LightPathResult& r = report.measured;
    Json json = {{"format", kLightPathFormat},
                 {"version", 1},
                 {"scene", report.scene},
                 {"width", report.width},
                 {"height", report.height},
                 {"area", report.area},
                 {"path", r.path.about},
                 {"renderer", report.renderer},
                 {"clock", r.clock},
                 {"timed", cost_row(r.cost).key},
                 {"steps", json_list(r.steps, step_json)}};
    const std::size_t worst = r.worst(*report.metric);
    if (!r.steps.empty())
        json["worst"] = {
            {"step", worst}, {"error", report.metric->key}, {"value", report.metric->value(r.steps[worst].error)}};
    return json;
}

std::string light_path_csv(const LightPathReport& report) {
    const std::vector<PathColumn> columns = path_columns(report);
    std::string csv = "step";
    if (!report.measured.steps.empty())
        for (const auto& [key, value] : report.measured.steps.front().point.values) csv += "," + key;
    csv += ",hour";
    for (const PathColumn& c : columns) csv += "," + c.key;
    csv += "\n";
    for (std::size_t i = 0; i < report.measured.steps.size(); ++i) {
        const PathStep& step = report.measured.steps[i];
        csv += std::to_string(i);
        for (const auto& [key, value] : step.point.values) csv += "," + value;
        csv += step.point.hour ? fmt::format(",{}", *step.point.hour) : ",";
        for (const PathColumn& c : columns) {
            const double v = c.value(step);
            csv += std::isfinite(v) ? fmt::format(",{}", v) : ",";
        }
        csv += "\n";
    }
    return csv;
}

std::string light_path_html(const LightPathReport& report) {
    const LightPathResult& r = report.measured;
    const std::vector<PathColumn> columns = path_columns(report);
    const std::size_t worst = r.worst(*report.metric);
    const std::string title = "Light path: " + report.scene;
    std::string body = fmt::format("<header>\n<h1>{}</h1>\n", xml_text(title));
    body += fmt::format("<p>{}; {} steps; {} × {} pixels, {} reference; {}{}</p>\n", xml_text(r.path.about),
                        r.steps.size(), report.width, report.height, report.area ? "area" : "hard",
                        xml_text(report.renderer), r.clock.empty() ? "" : "; times by " + xml_text(r.clock));
    body += fmt::format("<p>Worst step: {}.</p>\n</header>\n<main>\n", xml_text(point_text(r.steps[worst].point)));
    for (const PathColumn& c : columns) {
        if (!c.plotted) continue;
        Plot plot{.title = c.label + " along the path",
                  .x_label = is_day(report) ? "solar time, hours" : "step of the path",
                  .y_label = {},
                  .points = {},
                  .x_whole = !is_day(report),
                  .x_from_zero = !is_day(report),
                  .mark = worst};
        for (std::size_t i = 0; i < r.steps.size(); ++i)
            plot.points.push_back({.x = place_of(r.steps[i], i), .y = c.value(r.steps[i])});
        body += fmt::format("<section>\n<h2>{}</h2>\n<figure class=\"plot\">\n{}</figure>\n</section>\n",
                            xml_text(c.label), plot_svg(plot));
    }
    if (report.worst_picture.width > 0)
        body += fmt::format(
            "<section>\n<h2>The worst step</h2>\n<div class=\"pair\">\n<figure><img class=\"whole\" alt=\"The lit "
            "picture\" src=\"{}\"></figure>\n<figure><img class=\"whole\" alt=\"Wrong pixels by cause\" "
            "src=\"{}\"></figure>\n</div>\n<pre>{}</pre>\n</section>\n",
            data_uri(png_bytes(report.worst_picture), "image/png"),
            data_uri(png_bytes(report.worst_artefacts), "image/png"), xml_text(report.worst_command));
    body += "<section>\n<h2>All steps</h2>\n" + table_of(report, columns) + "</section>\n";
    body += fmt::format("<section>\n<h2>Command that measures it again</h2>\n<pre>{}</pre>\n</section>\n</main>",
                        xml_text(report.command));
    return still_page(title, body);
}

}  // namespace si
