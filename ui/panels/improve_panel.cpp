#include "ui/panels/improve_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "renderer/advise/autopilot.h"
#include "renderer/advise/waste.h"
#include "renderer/base/lengths_text.h"
#include "renderer/settings/param.h"
#include "ui/panels/fixes_table.h"
#include "ui/panels/tune_controls.h"
#include "ui/state/editor_ui.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/changes_text.h"
#include "ui/widgets/cost_combo.h"
#include "ui/widgets/progress_bar.h"
#include "ui/widgets/quantity_text.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

void heading(const char* text) {
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.2f});
    ImGui::TextDisabled("%s", text);
    ImGui::Separator();
}

/// Draws the button that applies several changes as one step of undo.
void apply_button(Settings& settings, ShownChanges changes, bool current) {
    ImGui::BeginDisabled(!current || changes.empty());
    if (ImGui::SmallButton("Apply")) set_settings(settings, changes);
    ImGui::EndDisabled();
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    wrapped_tooltip(changes_list(settings, changes) + (current
                                                           ? fmt::format("{} takes it back.", key_text(Command::Undo))
                                                           : "Of other settings: run again."));
}

/// Draws the progress of a search under its button Cancel. Returns true at a press of the button.
/// @param button label of the button, with an identity where two searches may run
bool search_running(const SearchProgress& progress, const char* button) {
    const bool cancelled = ImGui::Button(button);
    wrapped_tooltip("Stops with what is there");
    progress_bar(progress.progress, progress_text(progress));
    wrapped_tooltip(progress.about);
    wrapped_text(progress.about);
    return cancelled;
}

void draw_advice_controls(ImprovePanel& panel, bool ready, const ImproveFacts& facts, ImproveRequests& requests) {
    if (facts.advising) {
        requests.cancel_advice |= search_running(*facts.advising, "Cancel");
        return;
    }
    choose_cost("Times", panel.cost);
    ImGui::BeginDisabled(!ready);
    if (ImGui::Button("Advice")) requests.find_advice = SearchRequest{.cost = panel.cost};
    wrapped_tooltip(
        "Measures error (against the ray-traced reference) and time of each change that may help, in the background. "
        "Nothing is changed.");
    ImGui::EndDisabled();
    ImGui::Spacing();
    limit_field("Mean error ≤", "Mean error (of visibility, 0 to 1): the cheapest effects that keep it.",
                panel.bound_error, panel.max_error, 1e-6, "%.5f");
    limit_field(
        "Time ≤, ms",
        "Of a frame, in ms of the clock that the tab Effects names: without a bound on the error the most accurate "
        "effects that keep it.",
        panel.bound_ms, panel.max_ms, 1e-3, "%.3g");
    if (button_if(ready && panel.any(), "Autopilot")) requests.find_advice = panel.request();
    wrapped_tooltip(
        "Searches kernels, resolutions and what else the scene leaves open, up to two minutes, in the background.");
}

void draw_waste_controls(bool ready, const ImproveFacts& facts, ImproveRequests& requests) {
    if (facts.wasting) {
        requests.cancel_waste |= search_running(*facts.wasting, "Cancel##waste");
        return;
    }
    if (button_if(ready, "Find waste")) requests.find_waste = true;
    wrapped_tooltip(
        "Leaves out each map, face, cascade and effect in turn, in the background. Work whose absence changes no byte "
        "of the picture is waste. Nothing is changed.");
}

void show_waste(const Waste& waste, bool current) {
    ImGui::TextDisabled(current ? "%s" : "of other settings: search again\n%s", waste.summary().c_str());
    if (waste.stopped) ImGui::TextDisabled("Stopped before all work was left out once.");
    if (!begin_table("waste", 0, {{"verdict", 5}, {"triangles", 6}, {"left out"}})) return;
    for (const WasteTrial& t : waste.tried) {
        ImGui::TableNextRow();
        const ImU32 colour = t.changes || !current ? theme::muted() : theme::text();
        text_cell(t.verdict(), colour);
        text_cell(std::to_string(t.triangles), colour);
        text_cell(t.text(), colour);
    }
    ImGui::EndTable();
}

void findings_list(Settings& settings, const AdviceReport& report, bool current) {
    const ImU32 kColours[] = {theme::error(), theme::warning(), theme::muted()};
    int id = 0;
    for (const Finding& f : report.findings) {
        ImGui::PushID(id++);
        coloured_wrapped(fmt::format("{}: {}", severity_key(f.severity), f.text), kColours[std::size_t(f.severity)]);
        if (!f.fix.empty()) {
            if (!f.settings.empty()) {
                apply_button(settings, f.settings, current);
                ImGui::SameLine();
            }
            wrapped_text(f.fix);
        }
        ImGui::PopID();
    }
}

void advice_row(Settings& settings, const Trial& t, bool current) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (t.why_not.empty()) apply_button(settings, t.changes, current);
    text_cell(time_text(t.ms));
    if (t.ms)
        wrapped_tooltip(
            fmt::format("{} ms a frame, ± {} ms (95 %)", signed_text(t.ms->value), digits_text(t.ms->noise)));
    text_cell(signed_text(t.added_error()));
    wrapped_tooltip(fmt::format("Error {}, was {}", digits_text(t.after.error), digits_text(t.before.error)));
    ImGui::TableNextColumn();
    const std::string text = t.why_not.empty() ? t.candidate.shown_name() : t.candidate.shown_name() + ": " + t.why_not;
    coloured_wrapped(text, t.why_not.empty() && current ? theme::text() : theme::muted());
    if (ImGui::IsItemHovered()) wrapped_tooltip(changes_list(settings, t.changes));
    if (const std::string engine = engine_changes_text(t.changes); !engine.empty())
        ImGui::TextDisabled("%s", engine.c_str());
}

void advice_list(Settings& settings, const std::vector<Trial>& list, bool current, const char* id) {
    if (list.empty() ||
        !begin_table(id, 0, {{"##apply", 3.4f}, {"time a frame", 6}, {"error", 4.5f}, {"what, and why"}}))
        return;
    int number = 0;
    for (const Trial& t : list) {
        ImGui::PushID(number++);
        advice_row(settings, t, current);
        ImGui::PopID();
    }
    ImGui::EndTable();
}

void show_report(Settings& settings, const AdviceReport& r, bool current) {
    ImGui::TextDisabled("Now %s %s, %s ms a frame %s", std::string(r.options.error->label).c_str(),
                        digits_text(r.before.error).c_str(), digits_text(r.time.total_ms.median).c_str(),
                        std::string(cost_row(r.options.cost).when).c_str());
    if (!current) ImGui::TextDisabled("of other settings: measure again");
    if (r.holds.empty() && !r.fails.empty()) ImGui::TextDisabled("Nothing that was tried is better.");
    if (r.stopped) ImGui::TextDisabled("Stopped before all changes were tried.");
    if (r.refused > 0) ImGui::TextDisabled("%zu more: the chosen engine lacks them", r.refused);
    advice_list(settings, r.holds, current, "advice");
    findings_list(settings, r, current);
    if (!r.fails.empty() &&
        ImGui::CollapsingHeader(fmt::format("{} tried, do not hold###fails", r.fails.size()).c_str()))
        advice_list(settings, r.fails, current, "fails");
}

/// Returns the combinations that a search measured: those within the limits first, then by their error.
std::vector<const AutopilotCase*> ordered_cases(const AutopilotResult& r) {
    std::vector<const AutopilotCase*> cases;
    for (const AutopilotCase& c : r.cases) cases.push_back(&c);
    std::ranges::stable_sort(
        cases, {}, [](const AutopilotCase* c) { return std::pair(!c->holds.value_or(false), c->classified.error); });
    return cases;
}

/// Draws the table of all combinations that a search measured.
void combinations_table(Settings& settings, const AutopilotResult& r, bool current) {
    if (r.cases.empty() ||
        !begin_table("combinations", 0, {{"##apply", 3.4f}, {"time a frame", 6}, {"error", 5}, {"combination"}}))
        return;
    int number = 0;
    for (const AutopilotCase* c : ordered_cases(r)) {
        const bool holds = c->holds.value_or(false);
        const ImU32 colour = holds && current ? theme::text() : theme::muted();
        ImGui::PushID(number++);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (holds && !c->changes.empty()) apply_button(settings, c->changes, current);
        text_cell(c->ms ? quantity_text(*c->ms, "ms") : "-", colour);
        text_cell(digits_text(c->classified.error), colour);
        ImGui::TableNextColumn();
        coloured_wrapped(c->changes.empty() ? "the present settings" : changes_line(settings, c->changes), colour);
        ImGui::PopID();
    }
    ImGui::EndTable();
}

void show_autopilot(Settings& settings, const AutopilotResult& r, bool running, bool current) {
    coloured_wrapped(r.summary, r.goals_met || running ? theme::text() : theme::warning());
    if (!current) ImGui::TextDisabled("of other settings: measure again");
    if (r.goals_met && !running) apply_button(settings, r.best.changes, current);
    for (const DroppedEffect& d : r.dropped)
        ImGui::BulletText("%s", fmt::format("{}: {} instead of {}, which would have cost {} (error {} with it)", d.key,
                                            d.now, d.before, time_text(d.ms), digits_text(d.error))
                                    .c_str());
    for (const std::string& text : r.untried) ImGui::TextDisabled("%s", text.c_str());
    if (running) return combinations_table(settings, r, current);
    if (!r.cases.empty() &&
        ImGui::CollapsingHeader(fmt::format("{} combinations measured###combinations", r.cases.size()).c_str()))
        combinations_table(settings, r, current);
}

}  // namespace

void draw_improve_panel(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    const float em = ImGui::GetFontSize(), room = ImGui::GetContentRegionAvail().x;
    const bool ready = frame.result && frame.scene;
    ImGui::BeginChild("controls", {std::clamp(room * 0.4f, em * 20, em * 30), 0}, false);
    const std::string why_not =
        ready ? reason_without_bias(frame.result->lights, state.settings.view.light) : "there is no picture yet";
    heading("Least bias");
    draw_tune_controls(state.tune, state.settings, state.tried ? &state.tried->settings : nullptr, frame, why_not,
                       requests);
    heading("Wrong pixels of the picture");
    draw_fixes_button(frame.fixes, requests, {}, ready, true);
    heading("Time and error");
    draw_advice_controls(state.improve, frame.scene != nullptr, frame, requests);
    heading("Wasted work");
    draw_waste_controls(ready, frame, requests);
    ImGui::EndChild();
    ImGui::SameLine(0, em);
    ImGui::BeginChild("found", {0, 0}, false);
    draw_fixes_table(frame.fixes, requests, {});
    if (frame.advice)
        show_report(state.settings, *frame.advice, frame.advice_current);
    else if (frame.autopilot)
        show_autopilot(state.settings, *frame.autopilot, frame.advising.has_value(), frame.advice_current);
    else if (!frame.advising && !frame.fixes.table && !frame.waste)
        wrapped_text(
            "Each button draws and measures changes: Auto bias every kind of bias, Find fixes what puts wrong pixels "
            "right, Advice what saves time or lowers the error, Find waste what changes no byte of the picture.");
    if (frame.waste) show_waste(*frame.waste, frame.waste_current);
    ImGui::EndChild();
}

}  // namespace si
