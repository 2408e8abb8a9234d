#include "ui/panels/improve_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "renderer/advise/autopilot.h"
#include "renderer/advise/least_bias.h"
#include "renderer/advise/waste.h"
#include "renderer/base/lengths_text.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/settings/param.h"
#include "ui/panels/fixes_table.h"
#include "ui/panels/tune_controls.h"
#include "ui/state/editor_ui.h"
#include "ui/state/panels.h"
#include "ui/state/quick_changes.h"
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

/// Row of the table of aims.
struct ModeRow {
    ImproveMode mode;
    const char* label;
    const char* help;
};
constexpr ModeRow kModes[kImproveModes] = {
    {ImproveMode::Pixel, "Fix this pixel", "Finds changes that put the probed pixel right and make nothing worse."},
    {ImproveMode::Picture, "Fix the picture", "Finds the least bias, and changes that put all wrong pixels right."},
    {ImproveMode::Cheaper, "Cheaper, same look",
     "Finds what saves time without a larger error, and work whose absence changes no byte of the picture."},
    {ImproveMode::Limits, "Within a time limit",
     "Finds the most accurate settings within a time, or the cheapest within a mean error."}};

/// Draws the buttons of the aims, two in a row.
void mode_buttons(ImproveMode& mode) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float room = ImGui::GetContentRegionAvail().x - gap;
    float left = 0;  // the buttons on the left are as wide as the longest label needs
    for (const ModeRow& row : kModes) {
        if (index_of(row.mode) % 2 == 0) left = std::max(left, button_width(row.label));
    }
    left = std::floor(std::max(left, room / 2));
    for (const ModeRow& row : kModes) {
        const float width = index_of(row.mode) % 2 == 0 ? left : room - left;
        if (index_of(row.mode) % 2 == 1) ImGui::SameLine(0, gap);
        if (toggle_button(row.label, mode == row.mode, {width, 0})) mode = row.mode;
        wrapped_tooltip(fmt::format("{}\n{}", row.help, with_key("Next aim", Command::NextImprovement)));
    }
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.2f});
}

/// Draws the buttons that apply several changes as one step of undo, and that show them beside the picture before.
/// @param beside true: both buttons share a line
void change_buttons(EditorState& state, ShownChanges changes, bool current, bool beside) {
    const bool possible = current && !changes.empty();
    ImGui::BeginDisabled(!possible);
    if (ImGui::SmallButton("Apply")) {
        set_settings(state.settings, changes);
        hide_tried(state);
    }
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        wrapped_tooltip(
            changes_list(state.settings, changes) +
            (current ? fmt::format("{} takes it back.", key_text(Command::Undo)) : "Of other settings: run again."));
    if (beside) ImGui::SameLine();
    ImGui::BeginDisabled(!possible);
    const bool seen = possible && is_tried(state.settings, state.tried ? &state.tried->settings : nullptr, changes);
    if (ImGui::SmallButton(seen ? "Hide###show" : "Show###show")) {
        Settings with = state.settings;
        set_settings(with, changes);
        if (seen)
            hide_tried(state);
        else
            show_tried(state, with);
    }
    ImGui::EndDisabled();
    wrapped_tooltip("Draws it right of the line in the picture, before it is applied");
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
    if (button_if(ready, "Advice")) requests.find_advice = SearchRequest{.cost = panel.cost};
    wrapped_tooltip(
        "Measures error (against the ray-traced reference) and time of each change that may help, in the background. "
        "Nothing is changed.");
}

/// Draws the limits of error and time, and the two searches within them.
void draw_limits_controls(EditorState& state, const EditorFrame& frame, const std::string& why_not,
                          EditorRequests& requests) {
    ImprovePanel& panel = state.improve;
    limit_field("Time ≤, ms",
                "Of a frame of this picture's size, by the clock that the tab Cost names. Without a bound on the error "
                "the most accurate that is this fast is chosen.",
                panel.bound_ms, panel.max_ms, 1e-3, "%.3g");
    limit_field("Mean error ≤", "Mean error of visibility, 0 to 1. The cheapest that is this accurate is chosen.",
                panel.bound_error, panel.max_error, 1e-6, "%.5f");
    choose_cost("Times", panel.cost);
    ImGui::Checkbox("Area light (soft shadows)", &panel.area);
    wrapped_tooltip(
        "Tune compares with an area light (light.size). Compared with a point or direction, the hardest kernel is "
        "always the most accurate one.");
    if (frame.tuning) {
        draw_tune_progress(*frame.tuning, requests);
    } else {
        if (button_if(panel.any() && why_not.empty(), "Tune")) {
            requests.tune = panel.request();
            requests.tune->area = panel.area;
        }
        plain_tooltip(why_not.empty() ? "Searches kernels and resolutions, each with the bias it needs" : why_not,
                      ImGuiHoveredFlags_AllowWhenDisabled);
    }
    if (frame.advising) {
        requests.cancel_advice |= search_running(*frame.advising, "Cancel");
        return;
    }
    if (!frame.tuning) ImGui::SameLine();
    if (button_if(frame.scene && panel.any(), "Autopilot")) requests.find_advice = panel.request();
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
    if (!current) ImGui::TextDisabled("of other settings: search again");
    coloured_wrapped(waste.summary(), theme::muted());
    if (waste.stopped) ImGui::TextDisabled("Stopped before all work was left out once.");
    if (!begin_table("waste", 0, {{"verdict", 5}, {"triangles", 6}, {"left out"}})) return;
    for (const WasteTrial& t : waste.tried) {
        ImGui::TableNextRow();
        const ImU32 colour = t.changes || !current ? theme::muted() : theme::text();
        text_cell(t.verdict(), colour);
        text_cell(std::to_string(t.triangles), colour);
        ImGui::TableNextColumn();
        coloured_wrapped(t.text(), colour);
    }
    ImGui::EndTable();
}

void findings_list(EditorState& state, const AdviceReport& report, bool current) {
    const ImU32 kColours[] = {theme::error(), theme::warning(), theme::muted()};
    int id = 0;
    for (const Finding& f : report.findings) {
        ImGui::PushID(id++);
        coloured_wrapped(fmt::format("{}: {}", severity_key(f.severity), f.text), kColours[std::size_t(f.severity)]);
        if (!f.fix.empty()) {
            if (!f.settings.empty()) {
                change_buttons(state, f.settings, current, true);
                ImGui::SameLine();
            }
            wrapped_text(f.fix);
        }
        ImGui::PopID();
    }
}

void advice_row(EditorState& state, const Trial& t, bool current) {
    const Settings& settings = state.settings;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (t.why_not.empty()) change_buttons(state, t.changes, current, false);
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

void advice_list(EditorState& state, const std::vector<Trial>& list, bool current, const char* id) {
    if (list.empty() ||
        !begin_table(id, 0, {{"##apply", 3.4f}, {"time a frame", 6}, {"error", 4.5f}, {"what, and why"}}))
        return;
    int number = 0;
    for (const Trial& t : list) {
        ImGui::PushID(number++);
        advice_row(state, t, current);
        ImGui::PopID();
    }
    ImGui::EndTable();
}

void show_report(EditorState& state, const AdviceReport& r, bool current) {
    coloured_wrapped(fmt::format("Now {} {}, {} ms a frame {}", r.options.error->label, digits_text(r.before.error),
                                 digits_text(r.time.total_ms.median), cost_row(r.options.cost).when),
                     theme::muted());
    if (!current) ImGui::TextDisabled("of other settings: measure again");
    if (r.holds.empty() && !r.fails.empty()) ImGui::TextDisabled("Nothing that was tried is better.");
    if (r.stopped) ImGui::TextDisabled("Stopped before all changes were tried.");
    if (r.refused > 0) ImGui::TextDisabled("%zu more: the chosen engine lacks them", r.refused);
    advice_list(state, r.holds, current, "advice");
    findings_list(state, r, current);
    if (!r.fails.empty() &&
        ImGui::CollapsingHeader(fmt::format("{} tried, do not hold###fails", r.fails.size()).c_str()))
        advice_list(state, r.fails, current, "fails");
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
void combinations_table(EditorState& state, const AutopilotResult& r, bool current) {
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
        if (holds && !c->changes.empty()) change_buttons(state, c->changes, current, false);
        text_cell(c->ms ? quantity_text(*c->ms, "ms") : "-", colour);
        text_cell(digits_text(c->classified.error), colour);
        ImGui::TableNextColumn();
        coloured_wrapped(c->changes.empty() ? "the present settings" : changes_line(state.settings, c->changes),
                         colour);
        ImGui::PopID();
    }
    ImGui::EndTable();
}

void show_autopilot(EditorState& state, const AutopilotResult& r, bool running, bool current) {
    coloured_wrapped(r.summary, r.goals_met || running ? theme::text() : theme::warning());
    if (!current) ImGui::TextDisabled("of other settings: measure again");
    if (r.goals_met && !running) change_buttons(state, r.best.changes, current, true);
    for (const SettingContribution& d : r.dropped)
        ImGui::BulletText("%s", fmt::format("{}: {} instead of {}, which would have cost {} (error {} with it)", d.key,
                                            d.now, d.before, time_text(d.ms), digits_text(d.error))
                                    .c_str());
    for (const std::string& text : r.untried) ImGui::TextDisabled("%s", text.c_str());
    if (running) return combinations_table(state, r, current);
    if (!r.cases.empty() &&
        ImGui::CollapsingHeader(fmt::format("{} combinations measured###combinations", r.cases.size()).c_str()))
        combinations_table(state, r, current);
}

void pixel_part(EditorState& state, const EditorFrame& frame, bool ready, EditorRequests& requests) {
    if (button_if(ready, "Next wrong pixel")) run_command(Command::NextWrongPixels, state, frame, requests);
    plain_tooltip(with_key("Goes to the next cluster of wrong pixels, and probes it", Command::NextWrongPixels));
    if (!state.probe_pixel) return wrapped_text("Click the pixel that is wrong.");
    const auto at = std::ranges::find(frame.diagnoses, std::max(state.settings.view.light, 0), &PixelDiagnosis::light);
    if (at == frame.diagnoses.end())
        return wrapped_text(frame.tracing_probe ? "The pixel's reference is being traced …" : "No verdict yet.");
    strong_text(fmt::format("Pixel {}, {}", state.probe_pixel->x, state.probe_pixel->y));
    wrapped_text(at->verdict);
    draw_fixes_button(frame.pixel_fixes, requests, state.probe_pixel, ready, at->wants_fix());
    const Settings* const tried = state.tried ? &state.tried->settings : nullptr;
    requests.hide_tried |= draw_fixes_table(frame.pixel_fixes, state.settings, tried, requests, state.probe_pixel);
}

void picture_part(EditorState& state, const EditorFrame& frame, bool ready, const std::string& why_not,
                  EditorRequests& requests) {
    const Settings* const tried = state.tried ? &state.tried->settings : nullptr;
    strong_text("Least bias");
    if (frame.tuning) {
        draw_tune_progress(*frame.tuning, requests);
    } else {
        if (button_if(why_not.empty(), "Auto bias")) requests.tune = SearchRequest{};
        plain_tooltip(why_not.empty()
                          ? "Compares this picture with the ray-traced reference under every kind of bias, at several\n"
                            "strengths. The one with the least score is shown right of the line in the picture."
                          : why_not,
                      ImGuiHoveredFlags_AllowWhenDisabled);
        ImGui::SameLine();
        if (ImGui::Button("No bias")) remove_bias(state.settings);
        plain_tooltip(with_key("Sets all bias to 0, to see what needs how much", Command::RemoveBias));
    }
    draw_biases_table(frame, state.settings, tried, requests);
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.3f});
    strong_text("Wrong pixels");
    draw_fixes_button(frame.fixes, requests, {}, ready, true);
    requests.hide_tried |= draw_fixes_table(frame.fixes, state.settings, tried, requests, {});
}

void cheaper_part(EditorState& state, const EditorFrame& frame, bool ready, EditorRequests& requests) {
    draw_advice_controls(state.improve, frame.scene != nullptr, frame, requests);
    if (frame.advice) show_report(state, *frame.advice, frame.advice_current);
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.3f});
    strong_text("Wasted work");
    draw_waste_controls(ready, frame, requests);
    if (frame.waste) show_waste(*frame.waste, frame.waste_current);
}

void limits_part(EditorState& state, const EditorFrame& frame, const std::string& why_not, EditorRequests& requests) {
    draw_limits_controls(state, frame, why_not, requests);
    draw_tuned_result(frame, state.settings, requests);
    if (frame.autopilot) show_autopilot(state, *frame.autopilot, frame.advising.has_value(), frame.advice_current);
}

}  // namespace

void open_improve(EditorState& state, ImproveMode mode) {
    state.improve.mode = mode;
    state.window.open_page = Page::Improve;
    if (state.window.maximised && *state.window.maximised != Panel::Inspector) state.window.maximised.reset();
}

void draw_improve_panel(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    const bool ready = frame.result && frame.scene;
    const std::string why_not =
        ready ? reason_without_bias(frame.result->lights, state.settings.view.light) : "there is no picture yet";
    ImproveMode& mode = state.improve.mode;
    mode_buttons(mode);
    ImGui::BeginChild("found", {0, 0}, false, ImGuiWindowFlags_NavFlattened);
    coloured_wrapped(kModes[index_of(mode)].help, theme::muted());
    switch (mode) {
        case ImproveMode::Pixel:
            pixel_part(state, frame, ready, requests);
            break;
        case ImproveMode::Picture:
            picture_part(state, frame, ready, why_not, requests);
            break;
        case ImproveMode::Cheaper:
            cheaper_part(state, frame, ready, requests);
            break;
        case ImproveMode::Limits:
            limits_part(state, frame, why_not, requests);
            break;
    }
    ImGui::EndChild();
}

}  // namespace si
