#include "ui/panels/light_strip.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/base/finite_number.h"
#include "renderer/base/lengths_text.h"
#include "renderer/settings/param.h"
#include "ui/state/light_list.h"
#include "ui/widgets/progress_bar.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr double kOnPathDegrees = 0.05;  ///< largest distance of a setting from the path at which it counts as on it

double number_of(const PathPoint& point, std::size_t i) {
    return finite_number(point.values[i].second).value_or(0);
}

double value_of(const PathStep& step, StripPlots plots) {
    constexpr double kUnknown = NAN;
    switch (plots) {
        case StripPlots::Time:
            return step.time ? step.time->total_ms.median : kUnknown;
        case StripPlots::Shimmer:
            return step.change ? step.change->beyond : kUnknown;
        case StripPlots::Error:
            return step.error.mae;
    }
    return kUnknown;
}

void degrees_field(const char* label, const char* about, double& value, double least, double most) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 3.6f);
    ImGui::InputDouble(label, &value, 0, 0, "%.4g");
    wrapped_tooltip(about);
    value = std::clamp(std::isfinite(value) ? value : least, least, most);
}

void path_fields(LightStripPanel& panel) {
    if (ImGui::RadioButton("from-to", !panel.day)) panel.day = false;
    wrapped_tooltip("The light moves from one direction to another");
    ImGui::SameLine();
    if (ImGui::RadioButton("day", panel.day)) panel.day = true;
    wrapped_tooltip("The sun's path from sunrise to sunset: +z is south, +x is east");
    ImGui::SameLine();
    if (panel.day) {
        degrees_field("latitude", "Degrees, north is positive", panel.latitude, -90, 90);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 3.6f);
        ImGui::InputInt("day of the year", &panel.day_of_year, 0);
        panel.day_of_year = std::clamp(panel.day_of_year, 1, 365);
    } else {
        degrees_field("##azimuth from", "Azimuth at the begin, degrees", panel.azimuth_from, -360, 360);
        ImGui::SameLine();
        degrees_field("azimuth", "Azimuth at the end, degrees", panel.azimuth_to, -360, 360);
        ImGui::SameLine();
        degrees_field("##elevation from", "Elevation at the begin, degrees", panel.elevation_from, -90, 90);
        ImGui::SameLine();
        degrees_field("elevation", "Elevation at the end, degrees", panel.elevation_to, -90, 90);
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 2.6f);
    ImGui::InputInt("steps##path", &panel.steps, 0);
    panel.steps = std::clamp(panel.steps, 2, kMaxPathSteps);
}

void request_path(const LightStripPanel& panel, const Settings& settings, LightStripRequests& requests) {
    const auto light = std::size_t(std::max(shown_light(settings), 0));
    requests.path_steps = panel.steps;
    if (panel.day)
        requests.measure_day = fmt::format("{},{}", panel.latitude, panel.day_of_year);
    else
        requests.measure_along =
            fmt::format("{}={}:{},{}={}:{}", light_setting_key(light, "azimuth"), panel.azimuth_from, panel.azimuth_to,
                        light_setting_key(light, "elevation"), panel.elevation_from, panel.elevation_to);
}

/// Draws the plot with a mark at the present light and one at the worst step. A press or drag sets the light.
void draw_plot(const LightStripPanel& panel, Settings& settings, const LightPathResult& result, ImVec2 size) {
    ImGui::InvisibleButton("path plot", size);
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    const bool active = ImGui::IsItemActive();
    if (active) set_strip_position(result, (ImGui::GetMousePos().x - lo.x) / std::max(size.x, 1.0f), settings);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(lo, hi, theme::well());
    double most = 0;
    for (const PathStep& step : result.steps)
        if (const double v = value_of(step, panel.plots); std::isfinite(v)) most = std::max(most, v);
    const auto count = double(std::max<std::size_t>(result.path.points.size(), 2) - 1);
    std::vector<ImVec2> line;
    for (std::size_t i = 0; i < result.steps.size(); ++i) {
        const double v = value_of(result.steps[i], panel.plots);
        if (!std::isfinite(v)) continue;
        line.emplace_back(lo.x + float(double(i) / count) * size.x,
                          hi.y - 3 - float(most > 0 ? v / most : 0) * (size.y - 8));
    }
    list.AddPolyline(line.data(), int(line.size()), theme::accent(), 0, 1.5f);
    for (const ImVec2& at : line) list.AddCircleFilled(at, 2.5f, theme::accent(), 8);
    const auto stand = [&](double position, ImU32 colour) {
        const float x = lo.x + float(std::clamp(position, 0.0, 1.0)) * size.x;
        list.AddLine({x, lo.y}, {x, hi.y}, colour, 1.5f);
    };
    stand(double(result.worst(metrics().front())) / count, theme::warning());
    if (const auto here = strip_position(result, settings)) stand(*here, theme::text());
    if (!ImGui::IsItemHovered()) return;
    const double share = std::clamp(double((ImGui::GetMousePos().x - lo.x) / std::max(size.x, 1.0f)), 0.0, 1.0);
    const std::size_t near = std::min(std::size_t(std::lround(share * count)), result.steps.size() - 1);
    const PathStep& step = result.steps[near];
    std::string text;
    for (const auto& [key, value] : step.point.values) text += fmt::format("{} {}\n", key, value);
    if (step.point.hour) text += fmt::format("solar time {:.2f} h\n", *step.point.hour);
    text += fmt::format("mean error {:.5f}", step.error.mae);
    if (step.time) text += fmt::format("\n{} ms a frame", digits_text(step.time->total_ms.median));
    if (step.change) text += fmt::format("\nshimmer {:.5f}: change beyond the reference's", step.change->beyond);
    wrapped_tooltip(text);
}

void draw_result(LightStripPanel& panel, Settings& settings, const LightStripFacts& facts,
                 LightStripRequests& requests) {
    const LightPathResult& result = *facts.path;
    constexpr const char* kNames[] = {"error", "time", "shimmer"};
    for (const StripPlots plots : {StripPlots::Error, StripPlots::Time, StripPlots::Shimmer}) {
        if (ImGui::RadioButton(fmt::format("{}##strip", kNames[int(plots)]).c_str(), panel.plots == plots))
            panel.plots = plots;
        ImGui::SameLine();
    }
    const auto go_to_worst = [&] {
        settings = settings_at(settings, result.steps[result.worst(metrics().front())].point);
    };
    if (ImGui::Button("Go to the worst")) go_to_worst();
    wrapped_tooltip("Sets the light to the point with the largest mean error");
    ImGui::SameLine();
    if (ImGui::Button("Save the worst…")) {
        go_to_worst();
        requests.save_worst = true;
    }
    wrapped_tooltip("Sets the light to the point with the largest mean error, and saves the settings as a preset");
    if (!facts.path_current) {
        ImGui::SameLine();
        ImGui::TextDisabled("of other settings");
    }
    const ImVec2 room = ImGui::GetContentRegionAvail();
    draw_plot(panel, settings, result, {room.x, std::max(room.y, ImGui::GetFontSize() * 4.5f)});
}

}  // namespace

std::optional<double> strip_position(const LightPathResult& result, const Settings& settings) {
    const std::vector<PathPoint>& points = result.path.points;
    std::optional<double> best;
    double least = kOnPathDegrees;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        // Place on the segment nearest the settings, by the sum of squares over all keys.
        double along = 0, length = 0;
        std::vector<double> from, to, here;
        for (std::size_t k = 0; k < points[i].values.size(); ++k) {
            const auto ref = find_setting(points[i].values[k].first);
            if (!ref) return {};
            from.push_back(number_of(points[i], k));
            to.push_back(number_of(points[i + 1], k));
            here.push_back(numeric_value(get_value(settings, *ref)));
            along += (here.back() - from.back()) * (to.back() - from.back());
            length += (to.back() - from.back()) * (to.back() - from.back());
        }
        const double t = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
        double off = 0;
        for (std::size_t k = 0; k < here.size(); ++k)
            off = std::max(off, std::abs(here[k] - std::lerp(from[k], to[k], t)));
        if (off > least) continue;
        least = off;
        best = (double(i) + t) / double(points.size() - 1);
    }
    return best;
}

void set_strip_position(const LightPathResult& result, double position, Settings& settings) {
    const std::vector<PathPoint>& points = result.path.points;
    if (points.empty()) return;
    const double place = std::clamp(position, 0.0, 1.0) * double(points.size() - 1);
    const auto first = std::min(std::size_t(place), points.size() - 1);
    const PathPoint &a = points[first], &b = points[std::min(first + 1, points.size() - 1)];
    for (std::size_t k = 0; k < a.values.size(); ++k)
        if (const auto ref = find_setting(a.values[k].first); ref && ref->light < settings.light_count)
            set_value(settings, *ref, std::lerp(number_of(a, k), number_of(b, k), place - double(first)));
}

void draw_light_strip(LightStripPanel& panel, Settings& settings, const LightStripFacts& facts,
                      LightStripRequests& requests) {
    path_fields(panel);
    if (facts.measuring_path) {
        if (ImGui::Button("Cancel##path")) requests.cancel_path = true;
        ImGui::SameLine();
        progress_bar(facts.measuring_path->progress,
                     fmt::format("{}  {}", progress_text(*facts.measuring_path), facts.measuring_path->about));
    } else if (button_if(shown_light(settings) >= 0, "Measure the path")) {
        request_path(panel, settings, requests);
    }
    wrapped_tooltip("Measures error, time and shimmer of the shown light at each step, in the background");
    if (facts.path && !facts.path->steps.empty()) return draw_result(panel, settings, facts, requests);
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled(
        "Measure the path plots error, time and shimmer over the steps of a moving light. A drag over the plot then "
        "sets the light.");
    ImGui::PopTextWrapPos();
}

}  // namespace si
