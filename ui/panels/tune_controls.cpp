#include "ui/panels/tune_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "renderer/advise/tuning.h"
#include "renderer/base/lengths_text.h"
#include "renderer/settings/filters.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/progress_bar.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"

namespace si {
namespace {

std::string shown_length(double m) {
    return m == 0 ? "0" : metres_text(m);
}

}  // namespace

void draw_biases_table(const TunePanelFacts& shown, Settings& settings, const Settings* tried, TuneRequests& requests) {
    const FoundBias* const found = shown.tuned;
    const bool current = shown.tuned_current;
    if (!found || found->tried.empty()) return;
    if (!current) ImGui::TextDisabled("of other settings: search again");
    if (!begin_table("tuned", ImGuiTableFlags_SizingStretchProp,
                     {{.heading = "##take", .share = 1.1f},
                      {.heading = "tried", .share = 2.3f},
                      {.heading = "score", .share = 1},
                      {.heading = "wrong", .share = 1},
                      {.heading = "acne", .share = 0.9f},
                      {.heading = "gap", .share = 1.3f},
                      {.heading = "shift", .share = 0.85f}}))
        return;
    int id = 0;
    for (const auto& [b, least, clean] : found->table()) {
        const BiasTrial& trial = b->trial;
        Settings with = settings;
        with.bias = b->bias;
        const std::string engine = engine_changes_text(setting_changes(settings, with));
        const std::string text = bias_text(b->bias) + (engine.empty() ? "" : "; " + engine);
        ImGui::PushID(id++);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::BeginDisabled(!current);
        if (ImGui::SmallButton("Take")) {
            settings.bias = b->bias;
            requests.hide_tried = true;
        }
        plain_tooltip(fmt::format("Sets {}; {} takes it back", text, key_text(Command::Undo)));
        ImGui::TableNextColumn();
        const bool seen = tried && tried->bias == b->bias;
        if (wrapped_selectable(std::string(b->row->label), seen || settings.bias == b->bias)) {
            if (seen)
                requests.hide_tried = true;
            else
                requests.show_bias = b->bias;
        }
        ImGui::EndDisabled();
        plain_tooltip(
            fmt::format("{}{}{}\n{:.1f} score: pixels wrong by more than a half, and the error of all others\n"
                        "off the shadows' edges; {} px wrong, {} of them by the price of bias; {} px of acne\n"
                        "lit gap at contacts {}, edges moved by {} (95 % of the lit surface)\n"
                        "A click shows it right of the line in the picture; again: hides it",
                        text, least ? ": the least score" : "", clean ? ": the least score without acne" : "",
                        trial.score, wrong_pixels(trial.error), trial.lost(), trial.acne(),
                        shown_length(trial.needs.gap_p95_m), shown_length(trial.needs.shift_p95_m)),
            ImGuiHoveredFlags_AllowWhenDisabled);
        text_cell(fmt::format("{:.0f}{}", trial.score, least ? " *" : ""));
        text_cell(std::to_string(wrong_pixels(trial.error)));
        text_cell(std::to_string(trial.acne()));
        text_cell(shown_length(trial.needs.gap_p95_m));
        text_cell(shown_length(trial.needs.shift_p95_m));
        ImGui::PopID();
    }
    ImGui::EndTable();
}

SearchRequest LimitFields::request() const {
    SearchRequest request{.cost = cost};
    if (bound_error) request.max_error = max_error;
    if (bound_ms) request.max_ms = max_ms;
    return request;
}

void limit_field(const char* label, const char* about, bool& on, double& value, double least, const char* format) {
    ImGui::Checkbox(label, &on);
    wrapped_tooltip(about);
    ImGui::SameLine(ImGui::GetFontSize() * 10);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5);
    ImGui::PushID(label);
    if (ImGui::InputDouble("##value", &value, 0, 0, format)) on = true;
    ImGui::PopID();
    wrapped_tooltip(about);
    value = std::max(value, least);
}

std::string progress_text(const SearchProgress& progress) {
    const std::string share = fmt::format("{:.0f} %", 100 * progress.progress);
    return progress.seconds_left > 0 ? fmt::format("{}, {} left", share, seconds_text(progress.seconds_left)) : share;
}

void draw_tune_progress(const SearchProgress& progress, TuneRequests& requests) {
    const float room = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
    progress_bar(progress.progress, progress_text(progress), std::max(room - button_width("Cancel") - gap, 20.f));
    plain_tooltip("Trying " + progress.about);
    ImGui::SameLine();
    if (ImGui::Button("Cancel##tune")) requests.cancel_tune = true;
    plain_tooltip("Stops with what is there");
}

void draw_tuned_result(const TunePanelFacts& shown, Settings& settings, TuneRequests& requests) {
    const Settings* const found = shown.tuned_current ? shown.tuned_result : nullptr;
    if (!found || (found->filter == settings.filter && found->map.resolution == settings.map.resolution)) return;
    if (ImGui::Button("Take kernel, resolution and bias")) {
        apply_tuning(settings, *found);
        requests.hide_tried = true;
    }
    plain_tooltip(fmt::format("{} at {}², {}", kernel_label(*found), found->map.resolution, bias_text(found->bias)));
}

}  // namespace si
