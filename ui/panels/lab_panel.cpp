#include "ui/panels/lab_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

#include "renderer/base/index_of.h"
#include "renderer/base/lengths_text.h"
#include "renderer/frame/frame.h"
#include "renderer/reference/precision.h"
#include "renderer/scene/placement.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/param.h"
#include "ui/state/light_list.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/progress_bar.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

/// Draws the buttons that show or hide the overlays of the error of single precision.
void precision_overlays(Settings& settings) {
    for (std::size_t i = 0; i < overlays().size(); ++i) {
        const Overlay& row = overlays()[i];
        if (!row.reads_precision) continue;
        const int number = int(i) + 1;
        const bool shown = settings.view.overlay == number;
        if (shown) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyle().Colors[ImGuiCol_ButtonActive]);
        if (ImGui::Button(std::string(row.label).c_str())) settings.view.overlay = shown ? 0 : number;
        if (shown) ImGui::PopStyleColor();
        wrapped_tooltip(std::string(row.help));
    }
}

void place_rows(Settings& settings) {
    heading_text("Where the scene is");
    if (!ImGui::BeginTable("place", 2, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings)) return;
    ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch, 0.44f);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.56f);
    const SceneSettings placed = settings.scene;
    for (const std::string_view key :
         {"scene.distance", "scene.direction", "scene.scale", "light.stretch", "map.origin", "map.transform"}) {
        SettingRef ref = *find_setting(key);
        if (ref.param->scope == Scope::Light) {
            if (settings.light_count <= 0) continue;
            ref.light = std::max(shown_light(settings), 0);
        }
        setting_row(settings, ref);
    }
    carry_settings(settings, placed, settings.scene);
    ImGui::EndTable();
    precision_overlays(settings);
}

/// Draws the button that starts a measurement, or its progress with a button that cancels it.
bool measure_button(const char* label, const char* about, const std::optional<SearchProgress>& running, bool ready,
                    bool& cancel) {
    if (running) {
        if (ImGui::Button("Cancel")) cancel = true;
        ImGui::SameLine();
        progress_bar(running->progress, fmt::format("{}  {}", progress_text(*running), running->about));
        return false;
    }
    const bool pressed = button_if(ready, label);
    wrapped_tooltip(about);
    return pressed;
}

bool begin_numbers(const char* id, std::initializer_list<std::pair<const char*, const char*>> columns) {
    if (!ImGui::BeginTable(id, int(columns.size()),
                           ImGuiTableFlags_RowBg | ImGuiTableFlags_NoSavedSettings | ImGuiTableFlags_SizingStretchProp))
        return false;
    for (const auto& [name, about] : columns) ImGui::TableSetupColumn(name);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    int column = 0;
    for (const auto& [name, about] : columns) {
        ImGui::TableSetColumnIndex(column);
        if (column++ == 0)
            ImGui::TextDisabled("%s", name);
        else
            right_aligned(name, theme::muted());
        wrapped_tooltip(about);
    }
    return true;
}

std::string choice_label(std::string_view key, int value) {
    return std::string(find_setting(key)->param->choices()[std::size_t(value)].label);
}

void pipelines_part(const Settings& settings, bool ready, const FrameResult* result, const LabFacts& facts,
                    LabRequests& requests) {
    heading_text("Single precision against double");
    if (measure_button("Compare precision",
                       "Draws the picture by each way of computing places in the map, in the background, and compares "
                       "each pixel's with double precision.",
                       facts.comparing_pipelines, ready, requests.cancel_pipelines))
        requests.compare_pipelines = true;
    if (result && result->precision && !facts.comparing_pipelines) {
        const Precision& p = *result->precision;
        ImGui::SameLine();
        ImGui::TextDisabled("shown: %s, %s ULP (median)", texels_text(p.texels.median).c_str(),
                            digits_text(p.ulps.median).c_str());
    }
    if (facts.pipelines.empty()) return ImGui::TextDisabled("Not measured yet.");
    if (!begin_numbers("pipelines",
                       {{"Relative to, matrix", "The settings map.origin and map.transform"},
                        {"Texels", "Median distance in the map from the place by double precision"},
                        {"99 %", "of pixels are nearer than this, texels"},
                        {"ULP", "Median distance of the depth from the surface's plane, in steps of a 32-bit float"},
                        {"99 %", "of pixels are nearer than this, steps"},
                        {"Flips", "Pixels on the other side of one half than by the first row"}}))
        return;
    const ImU32 colour = facts.pipelines_current ? theme::text() : theme::muted();
    for (const PipelineError& e : facts.pipelines) {
        const bool used = e.origin == settings.map.origin && e.transform == settings.map.transform;
        ImGui::TableNextRow();
        text_cell(fmt::format("{}{}, {}", used ? "\u25cf " : "", choice_label("map.origin", index_of(e.origin)),
                              choice_label("map.transform", index_of(e.transform))),
                  colour);
        for (const double number : {e.texels.median, e.texels.p99, e.ulps.median, e.ulps.p99})
            right_cell(digits_text(number), colour);
        right_cell(fmt::format("{}", e.flips), colour);
    }
    ImGui::EndTable();
    if (!facts.pipelines_current) ImGui::TextDisabled("Of other settings or another size: compare again.");
}

void motion_widgets(ShimmerOptions& options) {
    const float em = ImGui::GetFontSize();
    std::vector<ComboItem> motions;
    for (const ShimmerMotionRow& row : shimmer_motions())
        motions.push_back({index_of(row.motion), row.label, row.help});
    int motion = index_of(options.motion);
    ImGui::SetNextItemWidth(em * 11);
    if (item_combo("##motion", motions, motion)) options.motion = ShimmerMotion(motion);
    wrapped_tooltip(std::string(motions[std::size_t(motion)].help));
    ImGui::SameLine();
    ImGui::SetNextItemWidth(em * 4);
    ImGui::InputInt("steps", &options.steps, 0);
    options.steps = std::clamp(options.steps, 1, 10'000);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(em * 4);
    ImGui::InputDouble("texels each", &options.step_texels, 0, 0, "%.3g");
    wrapped_tooltip("Length of a step, in texels of the light's first map");
    options.step_texels = std::clamp(options.step_texels, 1e-3, 100.0);
}

void shimmer_part(LabPanel& panel, bool ready, const LabFacts& facts, LabRequests& requests) {
    heading_text("Shimmer");
    motion_widgets(panel.shimmer);
    if (measure_button("Measure shimmer",
                       "Moves the camera that maps are made for, or the light, by parts of a texel while the picture "
                       "stands still, and counts the pixels whose visibility crosses one half.",
                       facts.measuring_shimmer, ready, requests.cancel_shimmer))
        requests.measure_shimmer = panel.shimmer;
    if (facts.shimmer.empty()) return ImGui::TextDisabled("Not measured yet.");
    if (!begin_numbers("shimmer", {{"Map", "The present settings, and the fit stabilised with and without light.snap"},
                                   {"Flips per step", "Pixels whose visibility crosses one half, mean over steps"},
                                   {"At most", "of a step"},
                                   {"Ever flip", "Pixels that flip in any step"},
                                   {"Change", "Mean of |visibility changed by| over pixels and steps"}}))
        return;
    const ImU32 colour = facts.shimmer_current ? theme::text() : theme::muted();
    for (const ShimmerShown& s : facts.shimmer) {
        ImGui::TableNextRow();
        text_cell(s.label, colour);
        right_cell(digits_text(s.shimmer.flips_a_step), colour);
        right_cell(fmt::format("{}", s.shimmer.max_flips), colour);
        right_cell(fmt::format("{}", s.shimmer.flipping_pixels), colour);
        right_cell(digits_text(s.shimmer.change), colour);
    }
    ImGui::EndTable();
    ImGui::TextDisabled("%s: %d steps of %s, %zu pixels%s",
                        std::string(shimmer_motions()[std::size_t(facts.shimmer_of.motion)].label).c_str(),
                        facts.shimmer_of.steps, texels_text(facts.shimmer_of.step_texels).c_str(),
                        facts.shimmer.front().shimmer.places,
                        facts.shimmer_current ? "" : "; of other settings or another size");
}

}  // namespace

void draw_lab(LabPanel& panel, Settings& settings, const Scene* scene, const FrameResult* result, const LabFacts& facts,
              LabRequests& requests) {
    const float gap = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x - 2 * gap;
    const bool narrow = width < 44 * gap;  // one part below the other
    const auto next = [&] { narrow ? ImGui::Dummy({0, gap / 2}) : ImGui::SameLine(0, gap); };
    const auto part = [&](const char* id, float share, const auto& draw) {
        if (narrow) {
            ImGui::PushID(id);
            draw();
            return ImGui::PopID();
        }
        ImGui::BeginChild(id, {share * width, 0}, false);
        draw();
        ImGui::EndChild();
    };
    part("place", 0.28f, [&] { place_rows(settings); });
    next();
    part("ways", 0.40f, [&] { pipelines_part(settings, scene != nullptr, result, facts, requests); });
    next();
    part("crawling", 0.32f, [&] { shimmer_part(panel, scene != nullptr, facts, requests); });
}

}  // namespace si
