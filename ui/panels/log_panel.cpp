#include "ui/panels/log_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "ui/state/log.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

ImU32 colour_of(LogKind kind) {
    return kind == LogKind::Error ? theme::error() : kind == LogKind::Warning ? theme::warning() : theme::text();
}

}  // namespace

void draw_log(Log& log, std::string_view shader_log) {
    log.mark_seen();
    if (ImGui::SmallButton("Copy")) {
        std::string all;
        for (const LogLine& line : log.lines()) all += line.text + "\n";
        ImGui::SetClipboardText(all.c_str());
    }
    ImGui::SameLine();
    if (ImGui::SmallButton("Clear")) log.clear();
    ImGui::BeginChild("lines", {0, 0}, false);
    ImGui::PushTextWrapPos(0);
    for (const LogLine& line : log.lines()) {
        ImGui::PushStyleColor(ImGuiCol_Text, colour_of(line.kind));
        const std::string text = line.count > 1 ? fmt::format("{}  (×{})", line.text, line.count) : line.text;
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopStyleColor();
    }
    if (!shader_log.empty()) coloured_text(shader_log, theme::error());
    if (log.lines().empty() && shader_log.empty()) ImGui::TextDisabled("Nothing to report.");
    ImGui::PopTextWrapPos();
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) ImGui::SetScrollHereY(1);
    ImGui::EndChild();
}

}  // namespace si
