#include "ui/panels/fixes_table.h"

#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "renderer/advise/fixes.h"
#include "renderer/base/lengths_text.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/settings/param.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

std::string about(const MeasuredFix& fix, const FixTable& table) {
    std::string text;
    for (const auto& [key, value] : fix.settings) text += fmt::format("{} = {}\n", key, value);
    for (const ArtefactStyle& style : artefact_styles())
        if (const std::size_t all = table.wrong_of[std::size_t(style.artefact)]; all > 0)
            text +=
                fmt::format("{}: {} of {} made right\n", style.label, fix.cured_of[std::size_t(style.artefact)], all);
    if (fix.ms)
        text += fmt::format("time {} ms, noise {} ms, of the passes that it changes\n", signed_text(fix.ms->value),
                            digits_text(fix.ms->noise));
    return text + fmt::format("A click applies it; {} takes it back.", key_text(Command::Undo));
}

void row(const MeasuredFix& fix, const FixTable& table, bool current, Settings& settings) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (!fix.untried.empty())
        return ImGui::TextDisabled("%s: not tried, %s", fix.shown_name().c_str(), fix.untried.c_str());
    const std::string mark = fix.pixel_right.value_or(true) ? "" : "  (this pixel stays wrong)";
    ImGui::BeginDisabled(!current);
    if (ImGui::Selectable((fix.shown_name() + mark).c_str(), false, ImGuiSelectableFlags_SpanAllColumns))
        for (const auto& [key, value] : fix.settings) set_setting(settings, key, value);
    ImGui::EndDisabled();
    plain_tooltip(about(fix, table), ImGuiHoveredFlags_AllowWhenDisabled);
    const ImU32 plain = current ? theme::text() : theme::muted();
    text_cell(std::to_string(fix.cured), plain);
    text_cell(std::to_string(fix.broken), fix.broken == 0 ? theme::muted() : plain);
    text_cell(time_text(fix.ms), plain);
    text_cell(map_bytes_text(fix.map_bytes), plain);
}

}  // namespace

void draw_fixes_button(const FixSearch& search, FixRequests& requests, std::optional<glm::ivec2> pixel, bool ready,
                       bool wrong) {
    if (search.running) {
        const std::string text = fmt::format("{:.0f} %  {}", 100 * search.running->progress, search.running->about);
        ImGui::ProgressBar(float(search.running->progress), {ImGui::GetFontSize() * 12, 0}, text.c_str());
        ImGui::SameLine();
        if (ImGui::Button("Cancel##cures")) requests.cancel_fixes = true;
        return;
    }
    if (button_if(ready && wrong, "Find fixes")) requests.find_fixes = FixRequest{pixel};
    plain_tooltip(
        wrong ? "Measures each change that may help: pixels made right, pixels broken, time and bytes of the maps."
              : "Nothing is wrong here.",
        ImGuiHoveredFlags_AllowWhenDisabled);
}

void draw_fixes_table(Settings& settings, const FixSearch& search, FixRequests& requests,
                      std::optional<glm::ivec2> pixel) {
    if (!search.table || search.pixel != pixel) return;
    if (search.current)
        ImGui::TextDisabled("%zu pixels are wrong now", search.table->wrong);
    else
        ImGui::TextDisabled("of other settings: search again");
    ImGui::SameLine();
    if (ImGui::SmallButton("Close##cures")) requests.forget_fixes = true;
    if (!begin_table("cures", ImGuiTableFlags_SizingFixedFit, {{"fix"}, {"right"}, {"broken"}, {"time"}, {"maps"}}))
        return;
    int id = 0;
    for (const MeasuredFix& fix : search.table->rows) {
        ImGui::PushID(id++);
        row(fix, *search.table, search.current, settings);
        ImGui::PopID();
    }
    ImGui::EndTable();
}

}  // namespace si
