#include "app/sweep/measured_cases.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/sweep/columns.h"
#include "renderer/measure/shadow_time.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr const char* kKernel = "filter.kernel";
constexpr const char* kResolution = "map.resolution";

/// Formats a varied setting with its label and shown value: "Kernel: PCF 3×3".
std::pair<std::string, std::string> words(const std::string& key, const std::string& value) {
    const auto ref = find_setting(key);
    if (!ref) return {key, value};
    Settings settings;
    settings.light_count = std::max(settings.light_count, ref->light + 1);
    if (key == kKernel) {
        set_setting(settings, key, value);
        const bool single = settings.filter.point && filter_of(settings).bilinear;
        return {std::string(ref->param->label), kernel_label(settings) + (single ? ", single texels" : "")};
    }
    return {std::string(ref->param->label), shown_value(settings, *ref, parse_value(*ref, value))};
}

bool is_number(const std::string& text) {
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return !text.empty() && *end == 0;
}

/// Returns the colour of a kernel: kernels of one family, by what they read and how they look it up, share one.
int family_of(const Filter& kernel) {
    if (!kernel.moments.names.empty())
        return kernel.moments.rule == BoundRule::FourMoments ? 6 : kernel.moments.rule == BoundRule::Chebyshev ? 4 : 5;
    if (kernel.searches_blockers || kernel.reads_light_size) return 3;
    if (!kernel.square() && !kernel.noise.taps.empty()) return 2;
    return kernel.square() && kernel.size == 1 ? 0 : 1;
}

/// Varied settings of a frontier plot: those that lines differ in, and the one that runs along a line.
struct LineAxes {
    std::vector<std::string> apart;
    std::string along;  ///< empty: none
    explicit LineAxes(const std::vector<SweepRow>& rows) {
        std::map<std::string, std::set<std::string>> values;
        std::vector<std::string> order;
        for (const SweepRow& row : rows)
            for (const auto& [key, value] : row.settings)
                if (values[key].insert(value).second && values[key].size() == 1) order.push_back(key);
        const auto varies = [&](const std::string& key) {
            return values[key].size() > 1 && std::ranges::all_of(values[key], is_number);
        };
        if (values.contains(kResolution) && varies(kResolution)) along = kResolution;
        for (const std::string& key : order)
            if (along.empty() && varies(key)) along = key;
        for (const std::string& key : order)
            if (key != along && (values[key].size() > 1 || key == kKernel)) apart.push_back(key);
    }
};

/// Names a varied setting in a plot: the choice alone, or a number with its setting's label.
std::string value_in_plot(const std::string& key, const std::string& value) {
    const auto [label, text] = words(key, value);
    if (key == kResolution) return value + "\u00b2";
    return is_number(value) || value == "true" || value == "false" ? label + " " + text : text;
}

PlotCase plot_case(const SweepRow& row, const LineAxes& axes) {
    PlotCase c{.line = {}, .place = {}, .dot = {}};
    for (const auto& [key, value] : row.settings) {
        if (key == axes.along) {
            c.place = value_in_plot(key, value);
            c.along = std::strtod(value.c_str(), nullptr);
        }
        if (std::ranges::find(axes.apart, key) != axes.apart.end())
            c.line += (c.line.empty() ? "" : ", ") + value_in_plot(key, value);
        if (key == kKernel) {
            Settings settings;
            set_setting(settings, key, value);
            c.family = family_of(filter_of(settings));
        }
    }
    if (c.line.empty()) std::swap(c.line, c.place);
    return c;
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
    out.settings.insert(out.settings.end(), row.own_settings.begin(), row.own_settings.end());
    for (const auto& [key, value] : row.settings) {
        const auto [label, text] = words(key, value);
        out.name += (out.name.empty() ? "" : " \u00b7 ") + text;
        out.setting_texts.push_back(label + ": " + text);
    }
    return out;
}

FrontierPlot frontier_plot(const std::vector<SweepRow>& rows, const std::string& cost, const std::string& error,
                           CostCase timed) {
    FrontierPlot plot;
    const Column *x = find_column(cost), *y = find_column(error);
    if (!x || !y) return plot;
    plot.cost_title = label_of(*x, timed);
    plot.error_title = y->label;
    plot.cost_unit = x->unit;
    plot.bytes = x->unit == "B";
    const LineAxes axes(rows);
    std::map<std::string, int> families;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const CaseNumbers& numbers = rows[i].numbers;
        const Dot dot = dot_of(numbers, *x, *y);
        if (!is_dot(dot)) continue;
        PlotCase c = plot_case(rows[i], axes);
        c.of = i;
        c.dot = dot;
        c.bound = is_bound(*x, numbers);
        const bool of_kernel = std::ranges::find(axes.apart, kKernel) != axes.apart.end();
        if (!of_kernel) c.family = families.emplace(c.line, int(families.size()) % kPlotFamilies).first->second;
        if (x->unit == "ms" && numbers.time) plot.cost_unit = time_unit(numbers.time->clock);
        if (cost == kMovingShadowColumn && numbers.shadow && numbers.shadow->forced_ms)
            plot.forced.push_back({.cost = time_or_bound(*numbers.shadow->forced_ms), .error = dot.error});
        plot.cases.push_back(std::move(c));
    }
    const std::vector<Dot> dots = dots_of(plot);
    const std::vector<bool> on = frontier(dots);
    const std::vector<std::size_t> strict = strict_front(dots);
    for (std::size_t i = 0; i < dots.size(); ++i)
        plot.cases[i].tied = on[i] && std::ranges::find(strict, i) == strict.end();
    return plot;
}

void add_base(FrontierPlot& plot, const SweepResults& results, const std::string& cost) {
    plot.base_name = base_of_costs_name();
    const Column* x = find_column(cost);
    plot.base_cost.reset();
    if (!x) return;
    CaseNumbers numbers{.error = {}, .cost = {}, .time = {}, .shadow = results.base};
    for (const SweepRow& row : results.rows)
        if (row.number == results.base_case) numbers = row.numbers;
    const double value = plotted_value(*x, numbers);
    if (std::isfinite(value) && value > 0 && !is_bound(*x, numbers)) plot.base_cost = value;
}

void add_spot(FrontierPlot& plot, PlotSpot::Kind kind, const std::string& label, const CaseNumbers& numbers,
              const std::string& cost, const std::string& error) {
    const Column *x = find_column(cost), *y = find_column(error);
    const Dot dot = x && y ? dot_of(numbers, *x, *y) : Dot{};
    // Spots are drawn in their order: the present settings stay on top.
    if (x && y && is_dot(dot)) plot.spots.insert(plot.spots.begin(), {kind, label, dot});
}

FrontierPlot frontier_plot(const SweepResults& results) {
    FrontierPlot plot = frontier_plot(results.rows, results.x, results.y, results.cost);
    add_base(plot, results, results.x);
    return plot;
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
        view.marks.push_back({.of = i, .dot = dot, .bound = is_bound(*x, rows[i].numbers)});
        dots.push_back(dot);
        exact.push_back({.cost = dot.cost, .error = dot.error});
    }
    const std::vector<bool> on = frontier(dots), strict = frontier(exact);
    for (std::size_t i = 0; i < dots.size(); ++i) {
        view.marks[i].on = on[i];
        view.marks[i].tied = on[i] && !strict[i];
    }
    view.plot = frontier_plot(rows, cost, error);
    const Dot here = present ? dot_of(*present, *x, *y) : Dot{};
    if (!present || !is_dot(here)) return view;
    view.present = here;
    add_spot(view.plot, PlotSpot::Kind::Present, "now", *present, cost, error);
    if (const Dot there = before ? dot_of(*before, *x, *y) : Dot{}; before && is_dot(there)) {
        view.before = there;
        add_spot(view.plot, PlotSpot::Kind::Pinned, "before", *before, cost, error);
    }
    view.advice = frontier_advice(here, dots, on);
    return view;
}

}  // namespace si
