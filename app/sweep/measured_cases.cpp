#include "app/sweep/measured_cases.h"

#include <fmt/format.h>

#include <cmath>

#include "app/sweep/columns.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

using Json = nlohmann::ordered_json;

/// How the setting is called and its value shown, for people.
std::pair<std::string, std::string> words(const std::string& key, const std::string& value) {
    const auto ref = find_setting(key);
    if (!ref) return {key, value};
    Settings settings;
    settings.light_count = std::max(settings.light_count, ref->light + 1);
    return {std::string(ref->param->label), shown_value(settings, *ref->param, parse_value(*ref, value))};
}

Dot dot_of(const Json& row, const Column& cost, const Column& error) {
    const auto noise = [&](const Column& column) {
        const double v = column.noise.empty() ? 0 : number_at(row, column.noise);
        return std::isfinite(v) ? v : 0;
    };
    return {plotted_value(cost, row), plotted_value(error, row), noise(cost), noise(error)};
}

bool is_dot(const Dot& dot) {
    return std::isfinite(dot.cost) && std::isfinite(dot.error);
}

}  // namespace

std::vector<MeasuredColumn> measured_columns() {
    std::vector<MeasuredColumn> out;
    for (const Column& c : columns())
        if (c.plotted != Plotted::No) out.push_back({c.key, c.label, c.unit, c.help, c.key.starts_with("error.")});
    return out;
}

MeasuredCase measured_case(const Json& row) {
    MeasuredCase out;
    if (const auto number = row.find("case"); number != row.end()) out.number = number->get<int>();
    if (const auto failed = row.find("failed"); failed != row.end() && failed->is_string()) out.failed = *failed;
    if (const auto settings = row.find("settings"); settings != row.end())
        for (const auto& [key, value] : settings->items()) {
            const auto [label, text] = words(key, value.get<std::string>());
            out.name += (out.name.empty() ? "" : " \u00b7 ") + text;
            out.settings.emplace_back(key, value.get<std::string>());
            out.setting_texts.push_back(label + ": " + text);
        }
    for (const Column& c : columns())
        if (c.plotted != Plotted::No) out.values.push_back(plotted_value(c, row));
    return out;
}

FrontierView frontier_view(const Json& rows, const Json& present, const std::string& cost, const std::string& error) {
    FrontierView view;
    const Column *x = find_column(cost), *y = find_column(error);
    if (!x || !y) return view;
    std::vector<Dot> dots, exact;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Dot dot = dot_of(rows[i], *x, *y);
        if (!is_dot(dot)) continue;
        view.marks.push_back({.of = i, .dot = dot});
        dots.push_back(dot);
        exact.push_back({.cost = dot.cost, .error = dot.error});
    }
    const std::vector<bool> on = frontier(dots), strict = frontier(exact);
    for (std::size_t i = 0; i < dots.size(); ++i) view.marks[i].on = on[i], view.marks[i].tied = on[i] && !strict[i];
    const Dot here = dot_of(present, *x, *y);
    if (!is_dot(here)) return view;
    view.present = here;
    view.advice = advise(here, dots, on);
    return view;
}

}  // namespace si
