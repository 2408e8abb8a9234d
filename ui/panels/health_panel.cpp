#include "ui/panels/health_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "renderer/frame/frame.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/settings.h"
#include "ui/widgets/quantity_text.h"
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

/// Makes the map viewer show the map that the finding is about, or probes the finding's pixel.
void show(Settings& settings, const NumberFinding& f, HealthRequests& requests) {
    if (is_of_map(f)) {
        const bool moments = f.image == Result::Moments && filter_of(settings).samples() == Samples::Moments;
        ViewSettings& v = settings.view;
        v.map_source = MapSource::Light;
        v.light = f.light;
        v.face = f.view;
        v.map_channel = moments ? std::max(v.map_channel, 1) : 0;
        if (moments) v.map_mip = f.level;
        requests.show_texel = texel_of(f);
    } else if (f.image) {
        requests.probe_pixel = f.worst;
    }
}

void finding_row(Settings& settings, const std::optional<MarkedTexel>& marked_texel, const NumberFinding& f, int id,
                 HealthRequests& requests) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, theme::error());
    const bool marked = marked_texel && is_of_map(f) && *marked_texel == texel_of(f);
    if (ImGui::Selectable(fmt::format("{}###finding {}", fault_label(f.fault), id).c_str(), marked,
                          ImGuiSelectableFlags_SpanAllColumns))
        show(settings, f, requests);
    ImGui::PopStyleColor();
    plain_tooltip(finding_text(f) + (is_of_map(f) ? "\nClick to see the worst in the map viewer"
                                     : f.image    ? "\nClick to probe the worst pixel"
                                                  : ""));
    text_cell(f.place);
    text_cell(fmt::format("{} {}{}", f.count, f.unit, f.count == 1 ? "" : "s"));
    text_cell(fmt::format("{}, {}", f.first.x, f.first.y));
    text_cell(fmt::format("{}, {}   {}", f.worst.x, f.worst.y, stored_text(f.value, 6)));
}

std::string count_text(std::size_t count) {
    return count == 1 ? "1 thing" : fmt::format("{} things", count);
}

/// Draws the process's memory in a line, which opens to a table of its owners.
void draw_memory(const MemoryReport& memory) {
    const ProcessMemory& p = memory.process;
    const std::string head =
        fmt::format("Memory: {} resident, {} at most; {} held by name, {} free in the heap###memory",
                    bytes_text(p.resident), bytes_text(p.peak), bytes_text(memory.held()), bytes_text(p.heap_free));
    if (!ImGui::CollapsingHeader(head.c_str())) return;
    if (!begin_table("holders", ImGuiTableFlags_SizingFixedFit, {{"Holder"}, {"Now"}, {"At most"}, {"Of"}})) return;
    for (const MemoryUse& h : memory.holders) {
        ImGui::TableNextRow();
        for (const std::string& text : {h.holder, bytes_text(h.bytes), bytes_text(h.most), count_text(h.count)})
            text_cell(text);
    }
    ImGui::EndTable();
}

}  // namespace

void draw_health(Settings& settings, const std::optional<MarkedTexel>& marked, const FrameResult* result,
                 const HealthFacts& facts, HealthRequests& requests) {
    requests.want_health = true;
    requests.want_memory = true;
    if (facts.memory) draw_memory(*facts.memory);
    if (!result) return ImGui::TextDisabled("No frame yet.");
    if (!facts.health) return ImGui::TextDisabled("Searching ...");
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
    if (!begin_table("findings",
                     ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_BordersInnerH,
                     {{"Fault", 12}, {.heading = "Where", .share = 1}, {"How many", 8}, {"First", 6}, {"Worst", 11}}))
        return;
    for (std::size_t i = 0; i < health.findings.size(); ++i)
        finding_row(settings, marked, health.findings[i], int(i), requests);
    ImGui::EndTable();
}

}  // namespace si
