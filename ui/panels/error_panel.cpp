// How far the shown light's shadows are from the ray-traced truth: numbers that follow every setting at once, and
// causes.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <cmath>
#include <string>

#include "renderer/measure/artefact_picture.h"
#include "renderer/reference/live_error.h"
#include "ui/panels/cures_table.h"
#include "ui/state/panels.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

struct Row {
    const char* name;
    double ErrorMetrics::*value;
    enum { Share, Number, Signed } kind;
    const char* about;  ///< formula, and how it reads
    bool rare = false;  ///< not shown while it is nothing
};

// V: what the map gives, R: the truth, n: counted pixels.
constexpr Row kRows[] = {
    {"False shadow", &ErrorMetrics::false_shadow, Row::Share,
     "#{R >= 1/2 and V < 1/2} / n\nDark though lit: acne, and shadows that are too large. The sum of the rows below."},
    {"   acne", &ErrorMetrics::acne, Row::Share, "Surfaces that shadow themselves: more bias puts these pixels right."},
    {"   by normal offset", &ErrorMetrics::offset_false_shadow, Row::Share,
     "Without the normal offset these pixels are right."},
    {"   at edges", &ErrorMetrics::boundary_false_shadow, Row::Share,
     "Bias puts none of these right: edge aliasing, undersampled, filter and penumbra."},
    {"   outside the map", &ErrorMetrics::outside_false_shadow, Row::Share,
     "The map holds nothing where these are looked up, or taps reach beyond its sides.", true},
    {"False light", &ErrorMetrics::false_light, Row::Share,
     "#{R < 1/2 and V >= 1/2} / n\nLit though dark: shadows that are lost or too small. The sum of the rows below."},
    {"   by bias", &ErrorMetrics::bias_false_light, Row::Share,
     "Peter-panning: less bias, or no normal offset, puts these pixels right."},
    {"   lost casters", &ErrorMetrics::lost_false_light, Row::Share,
     "Culling, the near plane or a mask's mip level left out of the map what casts here."},
    {"   leak", &ErrorMetrics::leak, Row::Share,
     "The nearest texel, unfiltered and at its own least bias, is right here."},
    {"   at edges", &ErrorMetrics::boundary_false_light, Row::Share,
     "Neither bias nor filter puts these right: edge aliasing, undersampled and penumbra."},
    {"   outside the map", &ErrorMetrics::outside_false_light, Row::Share,
     "The map holds nothing where these are looked up, or taps reach beyond its sides.", true},
    {"Any acne", &ErrorMetrics::any_acne, Row::Share,
     "#{R = 1, V < 1 - 0.001, and more bias lights them wholly} / n\nAlso the faint acne that a wide kernel hides."},
    {"Outside the map", &ErrorMetrics::outside_map, Row::Share,
     "Pixels beside the map, beyond its far plane or behind the light, right or wrong, / n"},
    {"Within the noise", &ErrorMetrics::within_noise, Row::Share,
     "V and R on different sides of 1/2, but no further apart than three times the truth's own noise, / n:\nnot called "
     "wrong. "
     "A smaller truth.noise decides them.",
     true},
    {"Mean |V - R|", &ErrorMetrics::mae, Row::Number, "sum |V - R| / n, of visibility: 0 to 1"},
    {"Root mean square", &ErrorMetrics::rmse, Row::Number, "sqrt(sum (V - R)^2 / n), of visibility: 0 to 1"},
    {"Mean V - R", &ErrorMetrics::signed_mean, Row::Signed, "sum (V - R) / n: above 0 too light, below too dark"},
    {"Overlap of shadows", &ErrorMetrics::iou, Row::Number,
     "#{in shadow by both} / #{in shadow by either}: 1 is perfect"},
};
constexpr int kCauses = 11;  ///< rows of false shadow and false light

std::string text_of(const Row& row, double value) {
    if (!std::isfinite(value)) return "-";
    if (row.kind == Row::Share)
        return value == 0 ? "0 %" : fmt::format("{:.{}f} %", 100 * value, value < 0.0095 ? 4 : 2);
    return row.kind == Row::Signed ? fmt::format("{:+.5f}", value) : fmt::format("{:.5f}", value);
}

void right_cell(const std::string& text, ImU32 colour = theme::kText) {
    ImGui::TableNextColumn();
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (free > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + free);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

void metrics_table(const ErrorMetrics& m, int first, int end, const char* id) {
    constexpr ImGuiTableFlags flags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings;
    if (!ImGui::BeginTable(id, 2, flags)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 6);
    for (int i = first; i < end; ++i) {
        const Row& row = kRows[i];
        if (row.rare && !(m.*row.value > 0)) continue;
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushStyleColor(ImGuiCol_Text, row.name[0] == ' ' ? theme::kMuted : theme::kText);
        ImGui::TextUnformatted(row.name);
        ImGui::PopStyleColor();
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", row.about);
        right_cell(text_of(row, m.*row.value), m.*row.value == 0 ? theme::kMuted : theme::kText);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", row.about);
    }
    ImGui::EndTable();
}

void cause_row(ImU32 colour, std::string_view label, std::size_t pixels, std::size_t counted, bool with_share) {
    const float em = ImGui::GetFontSize();
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + em * 0.2f}, {at.x + em * 0.7f, at.y + em * 0.9f}, colour);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + em * 1.1f);
    ImGui::TextUnformatted(label.data(), label.data() + label.size());
    right_cell(fmt::format("{}", pixels), pixels == 0 ? theme::kMuted : theme::kText);
    const std::string share = counted == 0 ? "-" : fmt::format("{:.3f} %", 100.0 * double(pixels) / double(counted));
    if (with_share)
        right_cell(share, theme::kMuted);
    else if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s of the pixels compared", share.c_str());
}

/// @param first, end of artefact_styles() @param shares there is room for them
void causes_table(const LiveError& error, std::size_t first, std::size_t end, bool shares) {
    constexpr ImGuiTableFlags flags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings;
    ImGui::PushID(int(first));
    if (ImGui::BeginTable("causes", shares ? 3 : 2, flags)) {
        const float em = ImGui::GetFontSize();
        ImGui::TableSetupColumn("cause", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("pixels", ImGuiTableColumnFlags_WidthFixed, em * 4.5f);
        if (shares) ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthFixed, em * 5.5f);
        const ErrorMetrics& m = error.metrics;
        for (const ArtefactStyle& style : artefact_styles().subspan(first, end - first))
            cause_row(theme::rgb(style.rgb), style.label, m.artefacts[std::size_t(style.artefact)], m.counted, shares);
        ImGui::EndTable();
    }
    ImGui::PopID();
}

void save_button(EditorState& state, const EditorFrame& frame, EditorActions& actions) {
    const bool there = frame.error != nullptr;
    ImGui::BeginDisabled(!there);
    if (ImGui::Button("Save…")) ImGui::OpenPopup("save error");
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Writes all numbers as JSON, distances between the edges included (as `measure --json`)");
    if (!ImGui::BeginPopup("save error")) return;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 18);
    const bool entered =
        ImGui::InputTextWithHint("##file", "file.json", &state.error_path, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if ((ImGui::Button("Write") || entered) && !state.error_path.empty()) {
        actions.save_error = state.error_path;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

}  // namespace

void draw_error(EditorState& state, const EditorFrame& frame, EditorActions& actions) {
    const float em = ImGui::GetFontSize();
    Settings& s = state.settings;
    if (!frame.truth) {
        ImGui::TextDisabled("No frame yet.");
        return;
    }
    const auto labelled = [&](const char* label, const char* key, float width) {
        flow(ImGui::CalcTextSize(label).x + ImGui::GetStyle().ItemSpacing.x + width);
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("%s", label);
        ImGui::SameLine();
        setting_widget(s, key, width);
    };
    ImGui::Dummy({0, 0});
    labelled("Light with its size", "truth.area", ImGui::GetFrameHeight());
    if (s.truth.area) labelled("Noise", "truth.noise", em * 5);
    labelled("Pixel step", "truth.step", em * 4);
    flow(em * 4);
    save_button(state, frame, actions);
    flow(em * 6);
    cures_button(frame, actions, {},
                 frame.error && frame.error->metrics.false_shadow + frame.error->metrics.false_light > 0);
    flow(em * 12);
    ImGui::AlignTextToFramePadding();
    const bool busy = !frame.truth->doing.empty();
    ImGui::TextDisabled("%s", truth_status(frame).c_str());
    if (busy && !frame.truth->current) {
        ImGui::SameLine();
        if (ImGui::SmallButton("Cancel")) actions.cancel_truth = true;
    }
    cures_table(state, frame, actions, {});
    if (!frame.error) return;
    const LiveError& error = *frame.error;
    const float width = ImGui::GetContentRegionAvail().x;
    const int columns = width > em * 56 ? 4 : width > em * 34 ? 2 : 1;
    const ImVec2 padding = ImGui::GetStyle().CellPadding;
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {padding.x, padding.y * 0.6f});
    if (!ImGui::BeginTable("error blocks", columns,
                           ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_NoSavedSettings)) {
        ImGui::PopStyleVar();
        return;
    }
    constexpr int kRowCount = int(std::size(kRows));
    ImGui::TableNextColumn();
    metrics_table(error.metrics, 0, kCauses, "causes of each side");
    if (columns > 1) ImGui::TableNextColumn();
    metrics_table(error.metrics, kCauses, kRowCount, "means");
    ImGui::TextDisabled("%zu pixels compared", error.metrics.counted);
    if (ImGui::IsItemHovered()) {
        const auto& p = error.metrics.pixels;
        std::size_t others = 0;
        for (std::size_t i = 1; i < p.size(); ++i) others += p[i];
        ImGui::SetTooltip("n: they show a surface that faces the light, in its cone and range.\n%zu do not", others);
    }
    const std::size_t all = artefact_styles().size(), half = (all + 1) / 2;
    if (columns > 2) ImGui::TableNextColumn();
    causes_table(error, 0, half, columns < 3);
    if (columns > 2) ImGui::TableNextColumn();
    causes_table(error, half, all, columns < 3);
    ImGui::EndTable();
    ImGui::PopStyleVar();
}

}  // namespace si
