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
constexpr float kBarEms = 0.13f;         ///< height of the bar under a time
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
        const SearchProgress& now = *facts.measuring_optimisations;
        progress_bar(now.progress, progress_text(now), ImGui::GetFontSize() * 14);
        wrapped_tooltip(now.about);
        ImGui::SameLine();
        if (ImGui::Button("Cancel##saved")) requests.cancel_measuring = true;
        wrapped_tooltip("Stops with what is there");
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
    const std::string forced_text = count ? fmt::format("{} forced", count) : "Run everything";
    same_line_if_fits(button_width(forced_text.c_str()));
    if (ImGui::Button((forced_text + "###force savings").c_str())) ImGui::OpenPopup("savings");
    wrapped_tooltip("Switches optimisations off, all or each alone, so that their work is done. No preset keeps it.");
    if (ImGui::BeginPopup("savings")) {
        bool all = count == int(kOptimisations);
        if (ImGui::Checkbox("Everything", &all))
            for (std::size_t i = 0; i < kOptimisations; ++i) forced.set(Optimisation(i), all);
        wrapped_tooltip("Does all work that any optimisation skips. The picture stays the same, byte by byte.");
        ImGui::Separator();
        for (std::size_t i = 0; i < kOptimisations; ++i)
            force_box(forced, Optimisation(i), std::string(optimisation_rows()[i].label).c_str());
        ImGui::EndPopup();
    }
    same_line_if_fits(button_width("Reset"));
    if (button_if(!forced.empty(), "Reset##forced")) forced = {};
    wrapped_tooltip("Switches all optimisations on again.");
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
    ImGui::TableSetupScrollFreeze(0, 2);  // the headings and the sum
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

/// Draws a bar under a time: its share of the longest time.
void time_bar(const FrameTimes& times, double ms) {
    double longest = ms;
    for (const auto& [name, last] : times.pass_ms) longest = std::max(longest, last);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x * float(ms / std::max(longest, 1e-9));
    const float foot = at.y + ImGui::GetTextLineHeight(), thick = ImGui::GetFontSize() * kBarEms;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, foot}, {at.x + width, foot + thick}, theme::colours().bar);
}

/// Draws the last time of a pass that this frame skips, in grey.
void last_time_cell(const FrameTimes& times, const PassInfo& pass) {
    const auto last = times.pass_ms.find(pass.name);
    if (last == times.pass_ms.end() || !ImGui::TableSetColumnIndex(index_of(Column::Ms))) return;
    right_aligned(fmt::format("{:.2f}", last->second), theme::muted());
    wrapped_tooltip("When it was drawn last; this frame skips it");
}

/// Returns the pass whose cost the row of an effect shows; null: it shows none.
const PassInfo* pass_of(const FrameResult& result, const Effect& effect) {
    return effect.part || effect.pass.empty() ? nullptr : result.pass(effect.pass);
}

void effect_row(EffectsPanel& panel, const FrameTimes& times, const FrameResult& result, const EffectsFacts& facts,
                const Effect& effect, Room room) {
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
    const PassInfo* pass = pass_of(result, effect);
    if (pass && pass->state != PassState::Drawn) last_time_cell(times, *pass);
    if (pass && pass->state == PassState::Drawn) {
        if (pass->gpu_ms > 0 && ImGui::TableSetColumnIndex(index_of(Column::Ms))) time_bar(times, pass->gpu_ms);
        cost_cells({pass->gpu_ms, pass->cpu_ms, pass->draws, pass->triangles});
    }
    if (ImGui::TableSetColumnIndex(index_of(Column::Saved)))
        saved_cell(facts.saved ? facts.saved->saved_ms(effect) : nullptr,
                   sharing_optimisation_count(facts.effects, effect), facts.saved_times_current);
    if (effect.optimisation && ImGui::TableSetColumnIndex(index_of(Column::Force)))
        force_box(panel.forced, *effect.optimisation, "##force");
}

/// Returns true for effects that neither cost nor save anything. What an optimisation skips saves its time, and its box
/// must stay within reach.
bool folds(const Effect& effect) {
    return effect.state == EffectState::NotNeeded && !effect.optimisation;
}

/// Draws the line that stands for all effects that nothing needs. A click lists them, or folds them again.
void fold_row(EffectsPanel& panel, std::span<const Effect> effects, Room room) {
    const auto count = std::ranges::count_if(effects, folds);
    if (count == 0) return;
    ImGui::TableNextRow();
    // The narrowest panel has room for words in the column of the effects only.
    ImGui::TableSetColumnIndex(index_of(room >= Room::Few ? Column::Why : Column::Effect));
    const std::string text = panel.all_listed
                                 ? fmt::format("Hide {} that nothing needs###fold", count)
                                 : fmt::format("{} more: nothing needs {}###fold", count, count == 1 ? "it" : "them");
    if (ImGui::Selectable(text.c_str())) panel.all_listed = !panel.all_listed;
    std::string names;
    for (const Effect& effect : effects)
        if (folds(effect)) names += (names.empty() ? "" : ", ") + effect.name;
    wrapped_tooltip(names);
}

/// Explains what all optimisations save together, and what the shadow takes of the frame.
std::string forced_frame_text(const SavedTimes& saved) {
    const auto times = [](const Spread& ms) {
        return fmt::format("{} ms ({} to {})", digits_text(ms.median), digits_text(ms.median_low),
                           digits_text(ms.median_high));
    };
    std::string text = fmt::format("With every effect forced the frame costs {} more than its {} ms.",
                                   times(*saved.forced_more_ms), digits_text(saved.frame.total_ms.median));
    if (saved.shadow_ms) text += fmt::format(" Its shadows take {} of it.", times(*saved.shadow_ms));
    return text;
}

/// Draws the costs of all passes together, in the row that does not scroll.
/// @param clock meaning of the times; it stands where the rows have their reasons
/// @param saved measured times; null: none @param current they are of the shown settings
void sum_row(const FrameResult& result, std::span<const Effect> effects, const std::string& clock, Room room,
             const SavedTimes* saved, bool current) {
    PassCost sum;
    for (const Effect& effect : effects)
        if (const PassInfo* pass = pass_of(result, effect); pass && pass->state == PassState::Drawn) {
            sum.gpu_ms += pass->gpu_ms;
            sum.cpu_ms += pass->cpu_ms;
            sum.draws += pass->draws;
            sum.triangles += pass->triangles;
        }
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(index_of(Column::Effect));
    ImGui::PushFont(theme::strong());
    ImGui::TextUnformatted("Frame");
    if (room == Room::Least) wrapped_tooltip(clock);
    cost_cells(sum);
    ImGui::PopFont();
    if (saved && saved->forced_more_ms && ImGui::TableSetColumnIndex(index_of(Column::Saved))) {
        right_aligned(fmt::format("{:.2f}", saved->forced_more_ms->median), current ? theme::text() : theme::muted());
        wrapped_tooltip(forced_frame_text(*saved));
    }
    if (!ImGui::TableSetColumnIndex(index_of(Column::Why))) return;
    const std::string shown = beginning_that_fits(clock, ImGui::GetContentRegionAvail().x, ImGui::GetFont());
    ImGui::TextDisabled("%s", shown.c_str());
    if (shown != clock) wrapped_tooltip(clock);
}

/// Draws the frames timed in the last seconds as bars over time.
void history(const FrameTimes& times) {
    if (times.frames.size() < 2) return;
    const double now = ImGui::GetTime();
    const double longest = std::ranges::max(times.frames, {}, &TimedFrame::ms).ms;
    const float em = ImGui::GetFontSize(), wide = em * 9, high = ImGui::GetTextLineHeight();
    same_line_if_fits(wide);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ImGui::GetStyle().FramePadding.y);
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

/// Returns what the times mean: clock and driver.
std::string clock_text(const FrameResult& result, const DriverInfo* driver) {
    std::string clock = result.clock.empty() ? std::string() : "Clock: " + result.clock;
    if (driver && driver->software)
        clock = clock.empty() ? "CPU rasteriser: times do not predict a GPU" : clock + ", no prediction of a GPU";
    if (driver) clock += fmt::format("{}{}", clock.empty() ? "" : "   ", driver->renderer);
    return clock;
}

}  // namespace

void draw_effects(EffectsPanel& panel, const FrameTimes& times, const FrameResult* result, const DriverInfo* driver,
                  const EffectsFacts& facts, EffectsRequests& requests) {
    requests.want_effects = true;
    if (!result) return ImGui::TextDisabled("No frame yet.");
    tools(panel, facts, requests);
    history(times);
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_BordersInnerH |
                                      ImGuiTableFlags_NoSavedSettings;
    const float footer = result->pages ? ImGui::GetTextLineHeightWithSpacing() + ImGui::GetFontSize() * 0.2f : 0;
    const Room room = room_of(ImGui::GetContentRegionAvail().x / ImGui::GetFontSize());
    if (ImGui::BeginTable("effects", kColumns, flags, {0, -footer})) {
        header(room);
        sum_row(*result, facts.effects, clock_text(*result, driver), room, facts.saved, facts.saved_times_current);
        int id = 0;
        for (const Effect& effect : facts.effects) {
            ImGui::PushID(id++);
            if (panel.all_listed || !folds(effect)) effect_row(panel, times, *result, facts, effect, room);
            ImGui::PopID();
        }
        fold_row(panel, facts.effects, room);
        ImGui::EndTable();
    }
    if (result->pages) ImGui::TextDisabled("%s", page_facts_text(*result->pages).c_str());
}

}  // namespace si
