#include "ui/panels/effects_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "renderer/base/index_of.h"
#include "renderer/base/lengths_text.h"
#include "renderer/frame/frame.h"
#include "renderer/inspect/effects.h"
#include "renderer/measure/optimisation_times.h"
#include "renderer/optimisations/optimisations.h"
#include "renderer/render/renderer.h"
#include "ui/state/frame_times.h"
#include "ui/widgets/progress_bar.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr int kColumns = 9, kTexts = 3;  ///< the first kTexts columns are texts, the last is a checkbox
enum class Column { State, Effect, Why, Ms, CpuMs, Draws, Triangles, Saved, Force };

std::string grouped(std::uint64_t n) {
    std::string text = fmt::format("{}", n);
    for (int at = int(text.size()) - 3; at > 0; at -= 3) text.insert(std::size_t(at), "\u2009");
    return text;
}

/// Width of the panel, by the columns that fit next to reasons of one to three lines.
enum class Room {
    Least,   ///< reasons are tooltips of the names
    Few,     ///< no column of optimisations: their menu has all that can be forced
    Narrow,  ///< states are shapes alone
    Usual,
    Wide,  ///< for what a pass draws and what the processor does for it
};

Room room_of(float ems) {
    return ems > 80   ? Room::Wide
           : ems > 50 ? Room::Usual
           : ems > 43 ? Room::Narrow
           : ems > 35 ? Room::Few
                      : Room::Least;  // reasons are at least twelve ems wide
}

/// Draws an effect's state as a shape and a word, readable without colours.
void state_cell(EffectState state, Room room) {
    static constexpr const char* kShapes[] = {"\u25cf", "\u25c6", "\u25cb"};
    const std::string shape = kShapes[std::size_t(state)], word(effect_state_label(state));
    const std::string text = room <= Room::Narrow ? shape : fmt::format("{} {}", shape, word);
    coloured_text(text, state == EffectState::NotNeeded ? theme::muted() : theme::text());
    if (room <= Room::Narrow) wrapped_tooltip(word);
}

/// Draws the time that an optimisation saves. @param together number of effects that share the optimisation
void saved_cell(const Spread* ms, std::size_t together, bool current) {
    const std::string shared = together > 1 ? fmt::format(" of {}", together) : "";
    right_aligned(ms ? fmt::format("{:.2f}{}", ms->median, shared) : "–",
                  ms && current ? theme::text() : theme::muted());
    if (ms)
        wrapped_tooltip(fmt::format(
            "{} ms, 95 % interval {} to {} ms, by {} pairs of alternating frames.{}{}", digits_text(ms->median),
            digits_text(ms->median_low), digits_text(ms->median_high), ms->samples,
            together > 1 ? fmt::format(" For all {} effects of this optimisation together, not for each.", together)
                         : "",
            current ? "" : " Of other settings or another size: measure again."));
    else
        wrapped_tooltip("Not measured, or nothing skips it. Times are never estimated.");
}

/// Draws the checkbox that switches an optimisation off.
void force_box(OptimisationSet& forced, Optimisation saving, const char* label) {
    bool on = forced.contains(saving);
    if (ImGui::Checkbox(label, &on)) forced.set(saving, on);
    wrapped_tooltip(fmt::format("Force: do the work that \"{}\" skips. The picture stays the same, byte by byte.\n{}",
                                row_of(saving).label, row_of(saving).help));
}

void measure_button(const EffectsFacts& facts, EffectsRequests& requests) {
    if (facts.measuring_optimisations) {
        const std::string text = fmt::format("{:.0f} %  {}", 100 * facts.measuring_optimisations->progress,
                                             facts.measuring_optimisations->about);
        progress_bar(facts.measuring_optimisations->progress, text, ImGui::GetFontSize() * 14);
        ImGui::SameLine();
        if (ImGui::Button("Cancel##saved")) requests.cancel_measuring = true;
        return;
    }
    if (ImGui::Button("Measure what is saved")) requests.measure_saved_times = true;
    wrapped_tooltip(
        "Draws frames with and without each optimisation alternately, in the background, and prints the difference in "
        "milliseconds with its interval.");
}

void tools(EffectsPanel& panel, const EffectsFacts& facts, EffectsRequests& requests) {
    measure_button(facts, requests);
    OptimisationSet& forced = panel.forced;
    int count = 0;
    for (std::size_t i = 0; i < kOptimisations; ++i) count += forced.contains(Optimisation(i));
    const std::string forced_text = count ? fmt::format("{} forced", count) : "None forced";
    same_line_if_fits(button_width(forced_text.c_str()));
    if (ImGui::Button((forced_text + "###force savings").c_str())) ImGui::OpenPopup("savings");
    wrapped_tooltip("Optimisations that are switched off. A tool: no preset keeps it.");
    if (ImGui::BeginPopup("savings")) {
        for (std::size_t i = 0; i < kOptimisations; ++i)
            force_box(forced, Optimisation(i), std::string(optimisation_rows()[i].label).c_str());
        ImGui::EndPopup();
    }
    same_line_if_fits(button_width("Reset"));
    if (button_if(!forced.empty(), "Reset##forced")) forced = {};
    wrapped_tooltip("Switches all optimisations on again.");
    same_line_if_fits(button_width("Hide what is not needed") + ImGui::GetFrameHeight());
    ImGui::Checkbox("Hide what is not needed", &panel.only_needed);
    if (!facts.saved || facts.saved_times_current) return;
    constexpr const char* kOld = "saved ms are of other settings";
    same_line_if_fits(ImGui::CalcTextSize(kOld).x);
    ImGui::TextDisabled("%s", kOld);
}

void header(Room room) {
    const bool counts = room == Room::Wide, narrow = room <= Room::Narrow, reasons = room > Room::Least,
               saved = room >= Room::Narrow;
    const float em = ImGui::GetFontSize();
    const auto fixed = [em](const char* name, float ems, bool shown = true) {
        ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthFixed | (shown ? 0 : ImGuiTableColumnFlags_Disabled),
                                em * ems);
    };
    ImGui::TableSetupScrollFreeze(0, 1);
    fixed(narrow ? "" : "State", narrow ? 1.2f : 7.5f);
    if (reasons)
        fixed("Effect", narrow ? 13 : 14);
    else  // names get the width that reasons leave
        ImGui::TableSetupColumn("Effect", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("Why", ImGuiTableColumnFlags_WidthStretch | (reasons ? 0 : ImGuiTableColumnFlags_Disabled));
    fixed("Time ms", 4);
    fixed("CPU ms", 4, counts);
    fixed("Draws", 3.2f, counts);
    fixed("Triangles", 5, counts);
    fixed("Saved ms", 5.2f, saved);
    fixed("Force", 2.8f, saved);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (int column = 0; column < kColumns; ++column) {
        if (!ImGui::TableSetColumnIndex(column)) continue;
        ImGui::PushID(column);
        if (column < kTexts)
            ImGui::TextDisabled("%s", ImGui::TableGetColumnName(column));
        else
            right_aligned(ImGui::TableGetColumnName(column), theme::muted());
        ImGui::PopID();
    }
}

/// Cost of one pass, or the sum of all passes.
struct PassCost {
    double gpu_ms = 0, cpu_ms = 0;
    std::uint64_t draws = 0, triangles = 0;
};

void cost_cells(const PassCost& cost) {
    const auto cell = [](Column column, bool known, const std::string& text) {
        if (ImGui::TableSetColumnIndex(int(column)) && known) right_aligned(text);
    };
    cell(Column::Ms, cost.gpu_ms > 0, fmt::format("{:.2f}", cost.gpu_ms));
    if (cost.gpu_ms > 0)
        wrapped_tooltip(fmt::format("CPU {:.2f} ms, {} draws, {} triangles", cost.cpu_ms, grouped(cost.draws),
                                    grouped(cost.triangles)));
    cell(Column::CpuMs, cost.cpu_ms > 0, fmt::format("{:.2f}", cost.cpu_ms));
    cell(Column::Draws, cost.draws > 0, grouped(cost.draws));
    cell(Column::Triangles, cost.triangles > 0, grouped(cost.triangles));
}

/// Draws a bar behind a time: its share of the longest time.
void time_bar(const FrameTimes& times, double ms) {
    double longest = ms;
    for (const auto& [name, last] : times.pass_ms) longest = std::max(longest, last);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x * float(ms / std::max(longest, 1e-9));
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + ImGui::GetTextLineHeight()},
                                              theme::colours().done);
}

/// Draws the last time of a pass that this frame skips, in grey.
void last_time_cell(const FrameTimes& times, const PassInfo& pass) {
    const auto last = times.pass_ms.find(pass.name);
    if (last == times.pass_ms.end() || !ImGui::TableSetColumnIndex(index_of(Column::Ms))) return;
    right_aligned(fmt::format("{:.2f}", last->second), theme::muted());
    wrapped_tooltip("When it was drawn last; this frame skips it");
}

void effect_row(EffectsPanel& panel, const FrameTimes& times, const FrameResult& result, const EffectsFacts& facts,
                const Effect& effect, Room room, PassCost& sum) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(index_of(Column::State));
    state_cell(effect.state, room);
    ImGui::TableSetColumnIndex(index_of(Column::Effect));
    const bool needed = effect.state != EffectState::NotNeeded;
    const float indent = effect.part ? ImGui::GetFontSize() * 0.8f : 0;
    if (indent > 0) ImGui::Indent(indent);
    coloured_text(effect.name, needed ? theme::text() : theme::muted());
    if (room == Room::Least && !effect.reason.empty()) wrapped_tooltip(effect.reason);
    if (indent > 0) ImGui::Unindent(indent);
    if (ImGui::TableSetColumnIndex(index_of(Column::Why))) coloured_wrapped(effect.reason, theme::muted());
    const PassInfo* pass = effect.part || effect.pass.empty() ? nullptr : result.pass(effect.pass);
    if (pass && pass->state != PassState::Drawn) last_time_cell(times, *pass);
    if (pass && pass->state == PassState::Drawn) {
        if (pass->gpu_ms > 0 && ImGui::TableSetColumnIndex(index_of(Column::Ms))) time_bar(times, pass->gpu_ms);
        cost_cells({pass->gpu_ms, pass->cpu_ms, pass->draws, pass->triangles});
        sum.gpu_ms += pass->gpu_ms;
        sum.cpu_ms += pass->cpu_ms;
        sum.draws += pass->draws;
        sum.triangles += pass->triangles;
    }
    if (ImGui::TableSetColumnIndex(index_of(Column::Saved)))
        saved_cell(facts.saved ? facts.saved->saved_ms(effect) : nullptr,
                   sharing_optimisation_count(facts.effects, effect), facts.saved_times_current);
    if (effect.optimisation && ImGui::TableSetColumnIndex(index_of(Column::Force)))
        force_box(panel.forced, *effect.optimisation, "##force");
}

/// Returns true for rows that are hidden. Forced effects stay visible, so that they can be switched on again.
bool left_out(const EffectsPanel& panel, const Effect& effect) {
    const bool forced = effect.optimisation && panel.forced.contains(*effect.optimisation);
    return panel.only_needed && effect.state == EffectState::NotNeeded && !forced;
}

void sum_row(const PassCost& sum) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(index_of(Column::Effect));
    ImGui::PushFont(theme::strong());
    ImGui::TextUnformatted("Frame");
    cost_cells(sum);
    ImGui::PopFont();
}

/// Draws the frames timed in the last seconds as bars over time.
void history(const FrameTimes& times) {
    if (times.frames.size() < 2) return;
    const double now = ImGui::GetTime();
    const double longest = std::ranges::max(times.frames, {}, &TimedFrame::ms).ms;
    const float em = ImGui::GetFontSize(), wide = em * 9, high = ImGui::GetTextLineHeight();
    ImGui::SameLine(0, em);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({wide, high});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + wide, at.y + high}, theme::well());
    for (const TimedFrame& f : times.frames) {
        const float x = at.x + wide * float(1 - (now - f.at_s) / FrameTimes::kKept_s);
        list.AddRectFilled({std::max(x - em * 0.1f, at.x), at.y + high * float(1 - f.ms / longest)}, {x, at.y + high},
                           theme::colours().done);
    }
    const std::string text = fmt::format("{} frames in the last {:.0f} s, at most {} ms", times.frames.size(),
                                         FrameTimes::kKept_s, digits_text(longest));
    wrapped_tooltip(text);
    ImGui::SameLine();
    if (ImGui::CalcTextSize(text.c_str()).x <= ImGui::GetContentRegionAvail().x)
        ImGui::TextDisabled("%s", text.c_str());
}

void clock_line(const FrameResult& result, const DriverInfo* driver) {
    if (result.pages) ImGui::TextDisabled("%s", page_facts_text(*result.pages).c_str());
    std::string clock = result.clock.empty() ? std::string() : "Clock: " + result.clock;
    if (driver && driver->software)
        clock = clock.empty() ? "CPU rasteriser: times do not predict a GPU" : clock + ", no prediction of a GPU";
    if (driver) clock += fmt::format("{}{}", clock.empty() ? "" : "   ", driver->renderer);
    const std::string shown = beginning_that_fits(clock, ImGui::GetContentRegionAvail().x, ImGui::GetFont());
    ImGui::TextDisabled("%s", shown.c_str());
    if (shown != clock) wrapped_tooltip(clock);
}

}  // namespace

void draw_effects(EffectsPanel& panel, const FrameTimes& times, const FrameResult* result, const DriverInfo* driver,
                  const EffectsFacts& facts, EffectsRequests& requests) {
    requests.want_effects = true;
    if (!result) return ImGui::TextDisabled("No frame yet.");
    tools(panel, facts, requests);
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_BordersInnerH |
                                      ImGuiTableFlags_NoSavedSettings;
    const float footer = ImGui::GetTextLineHeightWithSpacing() * (result->pages ? 2 : 1) + ImGui::GetFontSize() * 0.2f;
    const Room room = room_of(ImGui::GetContentRegionAvail().x / ImGui::GetFontSize());
    PassCost sum;
    if (ImGui::BeginTable("effects", kColumns, flags, {0, -footer})) {
        header(room);
        int id = 0;
        for (const Effect& effect : facts.effects) {
            ImGui::PushID(id++);
            if (!left_out(panel, effect)) effect_row(panel, times, *result, facts, effect, room, sum);
            ImGui::PopID();
        }
        sum_row(sum);
        ImGui::EndTable();
    }
    clock_line(*result, driver);
    history(times);
}

}  // namespace si
