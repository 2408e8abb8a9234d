#include "app/sweep/measured_cases.h"

#include <cmath>

#include "app/sweep/columns.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Formats a varied setting with its label and shown value: "Kernel: PCF 3×3".
std::pair<std::string, std::string> words(const std::string& key, const std::string& value) {
    const auto ref = find_setting(key);
    if (!ref) return {key, value};
    Settings settings;
    settings.light_count = std::max(settings.light_count, ref->light + 1);
    return {std::string(ref->param->label), shown_value(settings, *ref, parse_value(*ref, value))};
}

Dot dot_of(const CaseNumbers& numbers, const Column& cost, const Column& error) {
    return {plotted_value(cost, numbers), plotted_value(error, numbers), noise_of(cost, numbers),
            noise_of(error, numbers)};
}

bool is_dot(const Dot& dot) {
    return std::isfinite(dot.cost) && std::isfinite(dot.error);
}

}  // namespace

std::vector<MeasuredColumn> measured_columns(CostCase cost) {
    std::vector<MeasuredColumn> out;
    for (const Column& c : columns())
        if (c.better != Better::Neither)
            out.push_back({c.key, label_of(c, cost), c.unit, c.help, c.key.starts_with("error.")});
    return out;
}

MeasuredCase measured_case(const CaseNumbers& numbers) {
    MeasuredCase out;
    for (const Column& c : columns())
        if (c.better != Better::Neither)
            out.values.push_back(c.better == Better::NearZero ? c.value(numbers) : plotted_value(c, numbers));
    return out;
}

MeasuredCase measured_case(const SweepRow& row) {
    MeasuredCase out = measured_case(row.numbers);
    out.number = int(row.number);
    out.failed = row.failed;
    out.settings = row.settings;
    out.settings.insert(out.settings.end(), row.starts.begin(), row.starts.end());
    for (const auto& [key, value] : row.settings) {
        const auto [label, text] = words(key, value);
        out.name += (out.name.empty() ? "" : " \u00b7 ") + text;
        out.setting_texts.push_back(label + ": " + text);
    }
    return out;
}

FrontierView frontier_view(const std::vector<SweepRow>& rows, const CaseNumbers* present, const std::string& cost,
                           const std::string& error, const CaseNumbers* before) {
    FrontierView view;
    const Column *x = find_column(cost), *y = find_column(error);
    if (!x || !y) return view;
    std::vector<Dot> dots, exact;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Dot dot = dot_of(rows[i].numbers, *x, *y);
        if (!is_dot(dot)) continue;
        view.marks.push_back({.of = i, .dot = dot});
        dots.push_back(dot);
        exact.push_back({.cost = dot.cost, .error = dot.error});
    }
    const std::vector<bool> on = frontier(dots), strict = frontier(exact);
    for (std::size_t i = 0; i < dots.size(); ++i) {
        view.marks[i].on = on[i];
        view.marks[i].tied = on[i] && !strict[i];
    }
    const Dot here = present ? dot_of(*present, *x, *y) : Dot{};
    if (!present || !is_dot(here)) return view;
    view.present = here;
    if (const Dot there = before ? dot_of(*before, *x, *y) : Dot{}; before && is_dot(there)) view.before = there;
    view.advice = frontier_advice(here, dots, on);
    return view;
}

}  // namespace si
