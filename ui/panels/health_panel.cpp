#include "ui/panels/health_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "renderer/frame/frame.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/settings.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

bool is_of_map(const NumberFinding& f) {
    return f.image && f.light >= 0 && f.view >= 0;
}

MarkedTexel texel_of(const NumberFinding& f) {
    return {f.light, f.view, f.worst, f.level};
}

/// Makes the map viewer show the map that the finding is about.
void show_map(ViewSettings& v, bool moments, const NumberFinding& f) {
    v.map_source = MapSource::Light;
    v.light = f.light;
    v.face = f.view;
    v.map_channel = moments ? std::max(v.map_channel, 1) : 0;
    if (moments) v.map_mip = f.level;
}

void show(Settings& settings, const NumberFinding& f, HealthRequests& requests) {
    if (is_of_map(f)) {
        const bool moments = f.image == Result::Moments && filter_of(settings).samples() == Samples::Moments;
        show_map(settings.view, moments, f);
        requests.show_texel = texel_of(f);
    } else if (f.image) {
        requests.probe_pixel = f.worst;
    }
}

void finding_row(Settings& settings, const std::optional<MarkedTexel>& marked_texel, const NumberFinding& f, int id,
                 HealthRequests& requests) {
    const std::string at = fmt::format("{}, {}", f.first.x, f.first.y);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, theme::error());
    const std::string label(fault_label(f.fault));
    const bool marked = marked_texel && is_of_map(f) && *marked_texel == texel_of(f);
    if (ImGui::Selectable(fmt::format("{}###finding {}", label, id).c_str(), marked,
                          ImGuiSelectableFlags_SpanAllColumns))
        show(settings, f, requests);
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s%s", finding_text(f).c_str(),
                          is_of_map(f) ? "\nClick to see the worst in the map viewer"
                          : f.image    ? "\nClick to probe the worst pixel"
                                       : "");
    text_cell(f.place);
    text_cell(fmt::format("{} {}{}", f.count, f.unit, f.count == 1 ? "" : "s"));
    text_cell(at);
    text_cell(fmt::format("{}, {}   {:.6g}", f.worst.x, f.worst.y, f.value));
}

std::string count_text(std::size_t count) {
    return count == 1 ? "1 thing" : fmt::format("{} things", count);
}

/// Draws the process's memory in a line, which opens to a table of its owners.
void draw_memory(const MemoryReport& memory) {
    const ProcessMemory& p = memory.process;
    const std::string head =
        fmt::format("Memory: {} resident, {} at most; {} held by name, {} kept by the heap for what comes###memory",
                    bytes_text(p.resident), bytes_text(p.peak), bytes_text(memory.held()), bytes_text(p.heap_free));
    if (!ImGui::CollapsingHeader(head.c_str())) return;
    constexpr ImGuiTableFlags flags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings;
    if (!ImGui::BeginTable("holders", 4, flags)) return;
    for (const char* column : {"Holder", "Now", "At most", "Of"}) ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    for (const MemoryUse& h : memory.holders) {
        ImGui::TableNextRow();
        for (const std::string& text : {h.holder, bytes_text(h.bytes), bytes_text(h.most), count_text(h.count)}) {
            text_cell(text);
        }
    }
    ImGui::EndTable();
}

}  // namespace

void draw_health(Settings& settings, const std::optional<MarkedTexel>& marked, const FrameResult* result,
                 const HealthFacts& facts, HealthRequests& requests) {
    requests.want_health = true;
    requests.want_memory = true;
    if (facts.memory) draw_memory(*facts.memory);
    if (!result) {
        ImGui::TextDisabled("No frame yet.");
        return;
    }
    if (!facts.health) {
        ImGui::TextDisabled("Searching ...");
        return;
    }
    const NumericHealth& health = *facts.health;
    if (health.sound()) {
        ImGui::TextUnformatted("All numbers are sound.");
        const std::string searched = fmt::format(
            "{} numbers in {} images, and every matrix and block: no NaN, nothing infinite, depths and "
            "visibility within 0 to 1, no variance below 0, no exponent beyond its format.",
            health.numbers, health.images);
        coloured_wrapped(searched, theme::muted());
        return;
    }
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_BordersInnerH |
                                      ImGuiTableFlags_NoSavedSettings;
    if (!ImGui::BeginTable("findings", 5, flags)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    const float em = ImGui::GetFontSize();
    ImGui::TableSetupColumn("Fault", ImGuiTableColumnFlags_WidthFixed, em * 12);
    ImGui::TableSetupColumn("Where", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("How many", ImGuiTableColumnFlags_WidthFixed, em * 8);
    ImGui::TableSetupColumn("First", ImGuiTableColumnFlags_WidthFixed, em * 6);
    ImGui::TableSetupColumn("Worst", ImGuiTableColumnFlags_WidthFixed, em * 11);
    ImGui::TableHeadersRow();
    for (std::size_t i = 0; i < health.findings.size(); ++i)
        finding_row(settings, marked, health.findings[i], int(i), requests);
    ImGui::EndTable();
}

}  // namespace si
