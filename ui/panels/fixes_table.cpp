#include "ui/panels/fixes_table.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <functional>
#include <string>

#include "renderer/advise/fixes.h"
#include "renderer/base/lengths_text.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/settings/param.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/changes_text.h"
#include "ui/widgets/progress_bar.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

std::string about(const Trial& t, const FixTable& table) {
    std::string text = changes_list(t.candidate.settings, t.changes);
    if (!t.why_not.empty()) text += fmt::format("No fix: {}\n", t.why_not);
    text += fmt::format("{} px wrong, {} now; mean error {}, {} now\n", wrong_pixels(t.metrics), table.wrong,
                        digits_text(t.after.error), digits_text(t.before.error));
    for (const ArtefactStyle& style : artefact_styles())
        if (const std::size_t all = table.wrong_of[std::size_t(style.artefact)]; all > 0)
            text += fmt::format("{}: {} of {} put right\n", style.label, t.cured_of[std::size_t(style.artefact)], all);
    if (t.pixel)
        text +=
            fmt::format("this pixel: visibility {:.2f}, {:.2f} is right\n", t.pixel->visibility, t.pixel->reference);
    if (t.ms)
        text += fmt::format("time {} ms a frame, noise {} ms\n", signed_text(t.ms->value), digits_text(t.ms->noise));
    return text + fmt::format("A click applies it; {} takes it back.", key_text(Command::Undo));
}

void row(const Trial& t, const FixTable& table, bool current, FixRequests& requests) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string name = t.candidate.shown_name();
    if (!t.is_drawn()) return ImGui::TextDisabled("%s: not tried, %s", name.c_str(), t.candidate.untried.c_str());
    ImGui::BeginDisabled(!current);
    const std::string label = (t.why_not.empty() ? "Fix: " : "") + name;
    if (ImGui::Selectable(label.c_str(), false, ImGuiSelectableFlags_SpanAllColumns)) requests.apply_fix = &t;
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", about(t, table).c_str());
    if (const std::string engine = engine_changes_text(t.changes); !engine.empty())
        ImGui::TextDisabled("%s", engine.c_str());
    const ImU32 plain = current ? theme::text() : theme::muted();
    text_cell(std::to_string(t.cured), plain);
    text_cell(std::to_string(t.broken), t.broken == 0 ? theme::muted() : plain);
    text_cell(signed_text(t.added_error()), plain);
    text_cell(time_text(t.ms), plain);
    text_cell(map_bytes_text(t.map_bytes()), plain);
}

void rows(const char* id, const FixSearch& search, bool helping, FixRequests& requests) {
    if (!begin_table(id, ImGuiTableFlags_SizingFixedFit,
                     {{"change"}, {"right"}, {"broken"}, {"error"}, {"time"}, {"maps"}}))
        return;
    int number = 0;
    for (const Trial& t : search.table->rows) {
        ImGui::PushID(number++);
        if (t.helps() == helping) row(t, *search.table, search.current, requests);
        ImGui::PopID();
    }
    ImGui::EndTable();
}

}  // namespace

void draw_fixes_button(const FixSearch& search, FixRequests& requests, std::optional<glm::ivec2> pixel, bool ready,
                       bool wrong) {
    if (search.running) {
        const float em = ImGui::GetFontSize(), gap = ImGui::GetStyle().ItemSpacing.x;
        const float room = std::min(ImGui::GetContentRegionAvail().x, em * 30);
        const std::string text = fmt::format("{}  {}", progress_text(*search.running), search.running->about);
        progress_bar(search.running->progress, text, std::max(room - button_width("Cancel") - gap, em * 4));
        wrapped_tooltip(search.running->about);
        ImGui::SameLine();
        if (ImGui::Button("Cancel##cures")) (pixel ? requests.cancel_pixel_fixes : requests.cancel_fixes) = true;
        return;
    }
    if (button_if(ready && wrong, "Find fixes")) requests.find_fixes = FixRequest{pixel};
    plain_tooltip(wrong ? "Draws and measures each change that may help: pixels put right and broken, error, time and "
                          "bytes. A fix\n"
                          "makes nothing worse and costs at most twice the shadow's time and bytes."
                        : "Nothing is wrong here.",
                  ImGuiHoveredFlags_AllowWhenDisabled);
}

const Trial* found_fix(const FixSearch& search, std::optional<glm::ivec2> pixel) {
    return search.table && search.current && search.pixel == pixel ? search.table->fix() : nullptr;
}

void draw_fixes_table(const FixSearch& search, FixRequests& requests, std::optional<glm::ivec2> pixel) {
    if (!search.table || search.pixel != pixel) return;
    const FixTable& table = *search.table;
    if (!search.current)
        ImGui::TextDisabled("of other settings: search again");
    else if (table.fix())
        ImGui::TextDisabled("%zu pixels are wrong now; %zu of %zu changes tried", table.wrong, table.drawn(),
                            table.candidates);
    else
        ImGui::TextDisabled("No fix among %zu of %zu changes: none %s and makes nothing worse", table.drawn(),
                            table.candidates, pixel ? "puts this pixel right" : "lowers the error");
    ImGui::SameLine();
    if (ImGui::SmallButton("Close##cures")) (pixel ? requests.forget_pixel_fixes : requests.forget_fixes) = true;
    if (std::ranges::any_of(table.rows, &Trial::helps)) rows("cures", search, true, requests);
    const auto others = std::ranges::count_if(table.rows, std::not_fn(&Trial::helps));
    if (others > 0 && ImGui::CollapsingHeader(fmt::format("{} others do not help###others", others).c_str()))
        rows("others", search, false, requests);
    if (table.refused > 0) ImGui::TextDisabled("%zu more: the chosen engine lacks them", table.refused);
}

}  // namespace si
