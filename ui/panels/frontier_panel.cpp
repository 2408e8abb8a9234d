// Panel Frontier: a sweep over settings, its cases in a plot of error over cost, and cases better than the present
// settings.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "renderer/base/error.h"
#include "renderer/base/held_memory.h"
#include "renderer/base/lengths_text.h"
#include "renderer/measure/axes.h"
#include "renderer/settings/param.h"
#include "ui/panels/frontier_plot.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/cost_combo.h"
#include "ui/widgets/progress_bar.h"
#include "ui/widgets/quantity_text.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr int kMinSide = 16, kMaxSide = 4096;

/// Axis of a sweep as typed, or the reason why it is invalid.
struct Checked {
    std::string text;  ///< "KEY=VALUES"
    std::size_t values = 0;
    std::string problem;
};

Checked checked(const AxisText& axis) {
    Checked c{axis.key + "=" + axis.values};
    try {
        c.values = parse_axis(c.text).values.size();
    } catch (const UsageError& e) {
        constexpr std::string_view kOption = "--vary ";
        c.problem = e.what();
        if (c.problem.starts_with(kOption)) c.problem.erase(0, kOption.size());
    }
    return c;
}

/// Returns proposed values for a setting that has just been chosen.
std::string first_values(const Settings& settings, const SettingRef& ref) {
    const Param& p = *ref.param;
    if (p.choices || std::holds_alternative<bool>(default_value(ref))) return "*";
    return value_text(p, get_value(settings, ref));
}

void choose_setting(const Settings& settings, AxisText& axis) {
    const auto known = find_setting(axis.key);
    const std::string shown = known ? std::string(known->param->label) : axis.key.empty() ? "setting" : axis.key;
    if (!begin_combo("##key", shown, ImGuiComboFlags_HeightLarge)) {
        if (!axis.key.empty()) wrapped_tooltip(axis.key);
        return;
    }
    std::string_view group;
    for (const Param& p : params()) {
        // Settings of the view, and names, have no effect on errors and times.
        if (p.scope == Scope::Object || p.key.starts_with("view.") || is_text(p)) continue;
        const SettingRef ref{&p, 0, {}};
        const std::string_view prefix = p.key.substr(0, p.key.find('.'));
        if (prefix != group) ImGui::TextDisabled("%s", std::string(setting_group_label(prefix)).c_str());
        group = prefix;
        const std::string key = setting_key(ref);
        if (ImGui::Selectable(fmt::format("{}##{}", p.label, key).c_str(), key == axis.key))
            axis = {key, first_values(settings, ref)};
        wrapped_tooltip(fmt::format("{}\n{}", key, p.help));
    }
    ImGui::EndCombo();
}

/// Draws the varied settings, one per line. Returns the number of combinations; 0 if an axis is invalid.
std::size_t draw_axes(SweepPanel& panel, const Settings& settings, std::vector<std::string>& axes) {
    const float em = ImGui::GetFontSize(), gap = ImGui::GetStyle().ItemSpacing.x;
    std::size_t product = 1;
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < panel.axes.size(); ++i) {
        AxisText& axis = panel.axes[i];
        ImGui::PushID(int(i));
        const float width = ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() - 2 * gap;
        ImGui::SetNextItemWidth(width * 0.42f);
        choose_setting(settings, axis);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(width * 0.58f);
        const Checked c = checked(axis);
        if (!c.problem.empty()) ImGui::PushStyleColor(ImGuiCol_Text, theme::error());
        ImGui::InputTextWithHint("##values", "1,2,4 or 1:4:0.5", &axis.values);
        if (!c.problem.empty()) ImGui::PopStyleColor();
        wrapped_tooltip(c.problem.empty() ? "V1,V2,... or from:to:step (step *2 doubles); * is every choice"
                                          : c.problem);
        ImGui::SameLine();
        if (ImGui::Button("×", {ImGui::GetFrameHeight(), 0})) removed = i;
        wrapped_tooltip("Do not vary this setting");
        ImGui::PopID();
        product *= c.problem.empty() ? c.values : 0;
        axes.push_back(c.text);
    }
    if (removed) panel.axes.erase(panel.axes.begin() + std::ptrdiff_t(*removed));
    if (ImGui::Button("Vary another")) panel.axes.push_back({});
    ImGui::SameLine(0, em);
    return panel.axes.empty() ? 0 : product;
}

void draw_size(SweepPanel& panel) {
    const float em = ImGui::GetFontSize();
    const auto side = [&](const char* id, int& value) {
        ImGui::SetNextItemWidth(em * 3.4f);
        ImGui::InputInt(id, &value, 0);
        wrapped_tooltip("Size of the picture that is measured, in pixels");
        if (!ImGui::IsItemActive()) value = std::clamp(value, kMinSide, kMaxSide);
    };
    side("##width", panel.width);
    ImGui::SameLine(0, em * 0.2f);
    ImGui::TextUnformatted("×");
    ImGui::SameLine(0, em * 0.2f);
    side("##height", panel.height);
    const char* const area = "Area light (soft shadows)";
    same_line_if_fits(ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize(area).x);
    ImGui::Checkbox(area, &panel.area);
    wrapped_tooltip("Compare with an area light (light.size), not a point or direction");
    choose_cost("Times", panel.timed);
}

void draw_running(const SweepFacts& facts, SweepRequests& requests) {
    if (ImGui::Button("Cancel")) requests.cancel_sweep = true;
    wrapped_tooltip("What is measured stays; sweep again to go on");
    ImGui::SameLine();
    std::string text = facts.timing ? "times" : "errors";
    if (facts.seconds_left > 0) text += fmt::format(", {} left", seconds_text(facts.seconds_left));
    progress_bar(facts.progress, text);
    if (!facts.current.empty()) wrapped_tooltip(facts.current);
}

void draw_controls(SweepPanel& panel, const Settings& settings, const SweepFacts& facts, SweepRequests& requests) {
    std::vector<std::string> axes;
    const std::size_t product = draw_axes(panel, settings, axes);
    draw_size(panel);
    if (facts.running) {
        draw_running(facts, requests);
    } else {
        if (button_if(product > 0, fmt::format("Sweep {} combinations###sweep", product).c_str()))
            requests.start_sweep = SweepRequest{axes, panel.width, panel.height, panel.area, panel.timed};
        wrapped_tooltip(
            "Error against the ray-traced reference and time of every combination, in the background. Settings without "
            "effect in a combination collapse. An interrupted sweep goes on.");
    }
    ImGui::Checkbox("Measure the present settings", &panel.follow);
    wrapped_tooltip(
        "The diamond: measured again when a setting, the camera or the scene changes. Then the pinned settings and the "
        "defaults of the engine that is chosen in the settings, where there are any.");
    const float buttons =
        ImGui::CalcTextSize("SaveOpen").x + 4 * ImGui::GetStyle().FramePadding.x + 2 * ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - buttons);
    ImGui::InputTextWithHint("##folder", "folder of a sweep", &panel.folder);
    wrapped_tooltip("Folder with results.csv, results.json, report.html and pictures");
    ImGui::SameLine();
    if (button_if(!panel.folder.empty() && !facts.cases.empty(), "Save")) requests.save_sweep = panel.folder;
    wrapped_tooltip("Write the sweep that is shown into this folder");
    ImGui::SameLine();
    if (button_if(!panel.folder.empty(), "Open")) requests.open_sweep = panel.folder;
    wrapped_tooltip("Show the sweep in this folder, such as one of `shadow-inspector sweep`");
}

const MeasuredColumn* column_of(const SweepFacts& facts, const std::string& key) {
    const auto at = std::ranges::find(facts.columns, key, &MeasuredColumn::key);
    return at == facts.columns.end() ? nullptr : &*at;
}

/// Returns true for numbers of bytes, which are written as "7.4 MiB".
bool is_bytes(const MeasuredColumn& c) {
    return c.unit == "B";
}

/// Returns true for shares and mean visibilities, which are written without a unit.
bool is_plain(const MeasuredColumn& c) {
    return c.unit.empty() || c.unit.starts_with("of ") || c.unit.starts_with("share");
}

std::string column_title(const MeasuredColumn& c) {
    return is_plain(c) || is_bytes(c) ? c.label : c.label + " [" + c.unit + "]";
}

/// Returns a label with a small first letter: "time of a frame".
std::string within_sentence(std::string label) {
    const auto is_lower = [](char c) { return std::islower(static_cast<unsigned char>(c)) != 0; };
    if (label.size() > 1 && is_lower(label[1])) label[0] = char(std::tolower(static_cast<unsigned char>(label[0])));
    return label;
}

void choose_column(const SweepFacts& facts, const char* id, bool error, std::string& key) {
    const MeasuredColumn* now = column_of(facts, key);
    const std::string title = now ? column_title(*now) : "";
    const float em = ImGui::GetFontSize(), room = ImGui::GetWindowWidth();
    const float arrow_width = ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().FramePadding.x;
    // Two combos share a line.
    const float least = em * (room > em * 36 ? 15 : 10.4f), most = std::max(least, 0.5f * room - em * 4);
    const float width = std::clamp(text_width(title, ImGui::GetFont()) + arrow_width, least, most);
    ImGui::SetNextItemWidth(width);
    const std::string shown = beginning_that_fits(title, width - arrow_width, ImGui::GetFont());
    if (!begin_combo(id, shown, ImGuiComboFlags_HeightLarge)) {
        if (now) wrapped_tooltip(now->help);
        return;
    }
    for (const MeasuredColumn& c : facts.columns) {
        if (c.error != error) continue;
        if (ImGui::Selectable(column_title(c).c_str(), c.key == key)) key = c.key;
        wrapped_tooltip(c.help);
    }
    ImGui::EndCombo();
}

std::string number_text(double value, const MeasuredColumn& column) {
    if (value < 0) return "−" + number_text(-value, column);
    if (is_bytes(column) && std::isfinite(value)) return bytes_text(std::uint64_t(std::llround(value)));
    const std::string number = digits_text(value);
    return is_plain(column) ? number : number + " " + column.unit;
}

double value_of(const SweepFacts& facts, const MeasuredCase& c, const MeasuredColumn& column) {
    const auto at = std::size_t(&column - facts.columns.data());
    return at < c.values.size() ? std::abs(c.values[at]) : NAN;
}

/// Applies a case's values of the varied settings, as a step of undo.
void apply_case(SweepPanel& panel, Settings& settings, const MeasuredCase& c) {
    set_settings(settings, c.settings);
    panel.chosen = c.number;
}

void case_tooltip(const SweepFacts& facts, const MeasuredCase& c) {
    ImGui::BeginTooltip();
    for (const std::string& text : c.setting_texts) ImGui::TextUnformatted(text.c_str());
    ImGui::Separator();
    for (std::size_t i = 0; i < facts.columns.size() && i < c.values.size(); ++i)
        if (std::isfinite(c.values[i]))
            ImGui::Text("%s: %s", facts.columns[i].label.c_str(), number_text(c.values[i], facts.columns[i]).c_str());
    if (c.number >= 0) ImGui::TextDisabled("Click to use these settings");
    ImGui::EndTooltip();
}

void spot_tooltip(const SweepFacts& facts, PlotSpot::Kind kind) {
    switch (kind) {
        case PlotSpot::Kind::Present:
            if (facts.present) case_tooltip(facts, *facts.present);
            return;
        case PlotSpot::Kind::Pinned:
            if (facts.before) case_tooltip(facts, *facts.before);
            return;
        case PlotSpot::Kind::Engine:
            if (facts.engine) case_tooltip(facts, *facts.engine);
            return;
    }
}

/// Compares the present settings' numbers with the earlier ones: "18 % less error for 73 % more time".
std::string change_text(const Dot& before, const Dot& now, const MeasuredColumn& cost) {
    const auto share = [](double from, double to) { return from > 0 ? to / from - 1 : 0.0; };
    const auto percent = [](double by) { return fmt::format("{:.0f} %", 100 * std::abs(by)); };
    const double error = share(before.error, now.error), price = share(before.cost, now.cost);
    const bool same_error = std::abs(now.error - before.error) <= before.error_noise + now.error_noise;
    const bool same_cost = std::abs(now.cost - before.cost) <= before.cost_noise + now.cost_noise;
    const std::string what = cost.unit == "ms" ? "time" : "cost";
    const std::string by_error =
        same_error ? std::string("the same error") : percent(error) + (error < 0 ? " less error" : " more error");
    // Different numbers that count as equal need the reason (noise).
    constexpr double kLooksAlike = 0.05;
    if (same_cost && std::abs(price) > kLooksAlike)
        return fmt::format("{}; the {} differs by less than its noise (± {})", by_error, what,
                           number_text(before.cost_noise + now.cost_noise, cost));
    if (same_cost) return fmt::format("{} for the same {}", by_error, what);
    return fmt::format("{} for {} {} {}", by_error, percent(price), price < 0 ? "less" : "more", what);
}

/// Draws the earlier measurement next to the present one, and which of them is better.
void draw_before(const SweepFacts& facts, const MeasuredColumn& cost, const MeasuredColumn& error) {
    const FrontierView& view = facts.view;
    if (!view.before || facts.measuring_present) return;
    const std::string name = facts.before_is_pinned ? "A" : "Before";
    const std::string text =
        fmt::format("{} {} at {}.  {}: {}", name, number_text(view.before->error, error),
                    number_text(view.before->cost, cost), facts.change, change_text(*view.before, *view.present, cost));
    wrapped_text(text);
    wrapped_tooltip(with_key("Other settings of the same picture: those pinned as A", Command::PinSettings) +
                    ", else those measured last. The hollow diamond.");
}

void draw_advice(SweepPanel& panel, Settings& settings, const SweepFacts& facts, const MeasuredColumn& cost,
                 const MeasuredColumn& error) {
    if (!facts.present_problem.empty())
        return coloured_wrapped("The present settings cannot be measured: " + facts.present_problem, theme::error());
    const FrontierView& view = facts.view;
    if (!view.present) {
        if (!facts.measuring_present) return;
        const double known = facts.present ? value_of(facts, *facts.present, error) : NAN;
        const std::string what =
            std::isfinite(known) ? fmt::format("Now {}; {} is being measured …", number_text(known, error), cost.label)
                                 : std::string("Measuring the present settings …");
        ImGui::TextDisabled("%s", what.c_str());
        return;
    }
    ImGui::AlignTextToFramePadding();
    coloured_text(fmt::format("{} {} at {}", facts.present_is_old ? "Before" : "Now",
                              number_text(view.present->error, error), number_text(view.present->cost, cost)),
                  theme::accent());
    if (facts.measuring_present) {
        ImGui::SameLine();
        ImGui::TextDisabled(facts.present_is_old ? "the shown settings are being measured …" : "(measuring its time)");
    }
    const auto offer = [&](const char* id, const std::string& text, std::size_t mark) {
        const MeasuredCase& c = facts.cases[view.marks[mark].of];
        const std::string button = text + "##" + id;
        same_line_if_fits(button_width(text.c_str()));
        if (ImGui::Button(button.c_str())) apply_case(panel, settings, c);
        if (ImGui::IsItemHovered()) case_tooltip(facts, c);
    };
    if (view.advice.better)
        offer("better", fmt::format("The next better costs +{}", number_text(view.advice.extra_cost, cost)),
              *view.advice.better);
    if (view.advice.cheaper)
        offer("cheaper", fmt::format("The same error for −{}", number_text(view.advice.saved_cost, cost)),
              *view.advice.cheaper);
    if (!view.marks.empty() && !view.advice.better && !view.advice.cheaper) {
        ImGui::SameLine();
        ImGui::TextDisabled("on the Pareto front");
    }
    draw_before(facts, cost, error);
}

/// Writes the sentence on the knee, with the best cases for multiples of the base's cost as its tooltip.
void draw_knee(const FrontierPlot& plot) {
    const std::string sentence = knee_sentence(plot);
    if (sentence.empty()) return;
    wrapped_text(sentence);
    std::string best;
    for (const BestRow& row : best_rows(plot))
        best += fmt::format("{}{} × base: {}", best.empty() ? "" : "\n", quantity_text(row.multiple),
                            row.best ? plot.cases[*row.best].name() : "nothing costs so little");
    if (!best.empty())
        wrapped_tooltip(fmt::format("Best cases by cost\n{}\nBase: {}, {}", best, plot.base_name,
                                    plot_cost_text(plot, *plot.base_cost, false)));
}

void draw_state(const SweepFacts& facts, SweepRequests& requests) {
    if (!facts.problem.empty()) coloured_wrapped("The sweep ended: " + facts.problem, theme::error());
    if (facts.other_scene) {
        ImGui::TextDisabled("The sweep is of another scene.");
    } else if (!facts.other_settings.empty()) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("%zu other setting%s since the sweep.", facts.other_settings.size(),
                            facts.other_settings.size() == 1 ? " changed" : "s changed");
        wrapped_tooltip(fmt::format("{}", fmt::join(facts.other_settings, "\n")));
        same_line_if_fits(button_width("Set them back"));
        if (ImGui::Button("Set them back")) requests.apply_sweep_base = true;
        wrapped_tooltip("To what all cases of the sweep share; undo gives the present ones back");
    }
}

}  // namespace

void draw_frontier(SweepPanel& panel, Settings& settings, const SweepFacts* shown, SweepRequests& requests) {
    static const SweepFacts kNothing;
    const SweepFacts& facts = shown ? *shown : kNothing;
    const float em = ImGui::GetFontSize();
    requests.want_present = panel.follow;
    const float room = ImGui::GetContentRegionAvail().x, controls = std::clamp(room * 0.36f, em * 15, em * 24);
    // Side by side both would be cut, so that they stand one below the other and the panel scrolls.
    const bool stacked = room < em * 40;
    if (!stacked) ImGui::BeginChild("controls", {controls, 0}, false);
    draw_controls(panel, settings, facts, requests);
    if (!stacked) {
        ImGui::EndChild();
        ImGui::SameLine(0, em);
    }
    const float height = stacked ? std::max(ImGui::GetContentRegionAvail().y, em * 16) : 0;
    ImGui::BeginChild("plot and advice", {0, height}, false, ImGuiWindowFlags_NoScrollbar);
    choose_column(facts, "##error", true, panel.error);
    ImGui::SameLine();
    ImGui::TextUnformatted("over");
    ImGui::SameLine();
    const std::string across = facts.cost.empty() ? panel.cost : facts.cost;
    std::string chosen = across;
    choose_column(facts, "##cost", false, chosen);
    if (chosen != across) panel.cost = chosen;
    if (const MeasuredColumn* wanted = column_of(facts, panel.cost); wanted && across != panel.cost) {
        const std::string text =
            fmt::format("Not measured{}: {}", facts.running ? " yet" : "", within_sentence(wanted->label));
        same_line_if_fits(ImGui::CalcTextSize(text.c_str()).x);
        ImGui::TextDisabled("%s", text.c_str());
        wrapped_tooltip(facts.running ? "The plot goes over to it when all cases have a value"
                                      : "No case of this sweep has a value of it");
    }
    if (facts.total > 0) {
        const std::string count =
            facts.failed > 0 ? fmt::format("{} of {} cases, {} failed", facts.cases.size(), facts.total, facts.failed)
                             : fmt::format("{} of {} cases", facts.cases.size(), facts.total);
        same_line_if_fits(ImGui::CalcTextSize(count.c_str()).x);
        ImGui::TextDisabled("%s", count.c_str());
        if (ImGui::IsItemHovered()) {
            std::string text = facts.about;
            if (facts.software) text += "\nThe times are a CPU rasteriser's, not a GPU's";
            for (const MeasuredCase& c : facts.cases)
                if (!c.failed.empty()) text += "\n" + c.name + ": " + c.failed;
            wrapped_tooltip(text);
        }
        if (facts.software) {
            same_line_if_fits(ImGui::CalcTextSize("CPU rasteriser").x);
            coloured_text("CPU rasteriser", theme::warning());
            wrapped_tooltip(
                "OpenGL runs on the processor here: times say nothing of a GPU. Costs in bytes and taps hold "
                "anywhere.");
        }
    }
    const MeasuredColumn *cost = column_of(facts, across), *error = column_of(facts, panel.error);
    if (cost && error) {
        draw_state(facts, requests);
        draw_advice(panel, settings, facts, *cost, *error);
        if (facts.view.marks.empty() && !facts.view.present) {
            ImGui::TextDisabled(facts.running ? "The first cases are being measured."
                                              : "Sweep over settings to see which pay for their time.");
        } else {
            draw_knee(facts.view.plot);
            const ImVec2 size = ImGui::GetContentRegionAvail();
            const FrontierPlotResult r = draw_frontier_plot(facts, panel.chosen, {size.x, std::max(size.y, em * 5)});
            if (r.hovered) case_tooltip(facts, facts.cases[*r.hovered]);
            if (r.hovered_spot) spot_tooltip(facts, *r.hovered_spot);
            if (r.clicked) apply_case(panel, settings, facts.cases[*r.clicked]);
        }
    }
    ImGui::EndChild();
}

}  // namespace si
