#include "ui/panels/tune_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "renderer/advise/tuner.h"
#include "renderer/base/lengths_text.h"
#include "ui/state/quick_changes.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/cost_combo.h"
#include "ui/widgets/text.h"

namespace si {
namespace {

void limit(const char* label, const char* about, bool& on, double& value, double step, const char* format) {
    ImGui::Checkbox(label, &on);
    plain_tooltip(about);
    ImGui::SameLine(ImGui::GetFontSize() * 11);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 6);
    ImGui::PushID(label);
    if (ImGui::InputDouble("##value", &value, 0, 0, format)) on = true;
    ImGui::PopID();
    value = std::max(value, step);
}

void limits_popup(TunePanel& panel, TuneRequests& requests) {
    if (!ImGui::BeginPopup("tune limits")) return;
    ImGui::TextUnformatted("Search kernels and resolutions, each with the bias it needs");
    limit("Error at most", "Mean error over the pixels that count. The cheapest that is this accurate is chosen.",
          panel.bound_error, panel.max_error, 1e-6, "%.5f");
    limit("Time at most, ms",
          "Of a frame of this picture's size, by the clock that the tab Effects names. Without a bound on the error "
          "the most accurate that is\n"
          "this fast is chosen.",
          panel.bound_ms, panel.max_ms, 1e-3, "%.3g");
    choose_cost("Time", panel.cost);
    ImGui::Checkbox("Area light (soft shadows)", &panel.area);
    plain_tooltip(
        "Compare with an area light (light.size). Compared with a point or direction, the hardest kernel\n"
        "is always the most accurate one.");
    if (button_if(panel.bound_error || panel.bound_ms, "Search")) {
        requests.tune = TuneRequest{.area = panel.area, .cost = panel.cost};
        if (panel.bound_error) requests.tune->max_error = panel.max_error;
        if (panel.bound_ms) requests.tune->max_ms = panel.max_ms;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

std::string shown_length(double m) {
    return m == 0 ? "0" : metres_text(m);
}

/// Draws the table of all kinds of bias that the search tried.
void families_table(std::span<const TunedFamily> families, bool current, Settings& settings) {
    if (families.empty()) return;
    if (!current) ImGui::TextDisabled("of other settings: search again");
    if (!begin_table("tuned", ImGuiTableFlags_SizingStretchProp,
                     {{.heading = "tried", .share = 2}, {"wrong px"}, {"strip"}, {"shift"}}))
        return;
    for (const TunedFamily& f : families) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const bool taken = settings.bias == f.bias;
        ImGui::BeginDisabled(!current);
        if (ImGui::Selectable(f.name.c_str(), taken, ImGuiSelectableFlags_SpanAllColumns)) settings.bias = f.bias;
        ImGui::EndDisabled();
        plain_tooltip(
            fmt::format("{}{}\n{} pixels wrong, {} of them by the price of bias; {} px of acne\n"
                        "lit strip at contacts {}, edges moved by {} (95 % of the lit surface)\nA click takes it; {} "
                        "takes it back.",
                        f.bias_text, f.chosen ? ": chosen, as it loses the fewest pixels" : "", f.wrong, f.lost, f.acne,
                        shown_length(f.gap_p95_m), shown_length(f.shift_p95_m), key_text(Command::Undo)),
            ImGuiHoveredFlags_AllowWhenDisabled);
        ImGui::TableNextColumn();
        if (f.acne > 0)
            ImGui::TextDisabled("acne");
        else
            ImGui::Text("%zu", f.wrong);
        text_cell(shown_length(f.gap_p95_m));
        text_cell(shown_length(f.shift_p95_m));
    }
    ImGui::EndTable();
}

}  // namespace

void draw_tune_controls(TunePanel& panel, Settings& settings, const TunePanelFacts& shown, const std::string& why_not,
                        TuneRequests& requests) {
    const float room = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
    if (shown.tuning) {
        const std::string text = fmt::format("{:.0f} %", 100 * shown.tuning->progress);
        ImGui::ProgressBar(float(shown.tuning->progress), {std::max(room - button_width("Cancel") - gap, 20.f), 0},
                           text.c_str());
        plain_tooltip("Trying " + shown.tuning->about);
        ImGui::SameLine();
        if (ImGui::Button("Cancel")) requests.cancel_tune = true;
        return;
    }
    ImGui::BeginDisabled(!why_not.empty());
    ImGui::BeginGroup();
    const float others = button_width("No bias") + button_width("Tune...") + 2 * gap;
    const bool narrow = room - others < button_width("Auto bias");
    if (ImGui::Button("Auto bias", {narrow ? room : room - others, 0})) requests.tune = TuneRequest{};
    plain_tooltip(
        "Compares this picture with the ray-traced reference and sets the smallest constant bias, slope bias or\n"
        "normal offset under which nothing in it shadows itself: the one that makes the fewest pixels wrong.\n"
        "One step of undo; the log says what it costs.");
    if (!narrow) ImGui::SameLine();
    if (ImGui::Button("No bias")) remove_bias(settings);
    plain_tooltip(with_key("Sets all bias to 0, to see what needs how much", Command::RemoveBias));
    ImGui::SameLine();
    if (ImGui::Button("Tune...")) ImGui::OpenPopup("tune limits");
    plain_tooltip("Search kernel and resolution, too, within limits of error and time");
    ImGui::EndGroup();
    ImGui::EndDisabled();
    if (!why_not.empty()) plain_tooltip(why_not, ImGuiHoveredFlags_AllowWhenDisabled);
    limits_popup(panel, requests);
    families_table(shown.tuned, shown.tuned_current, settings);
}

}  // namespace si
