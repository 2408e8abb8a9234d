#include "ui/panels/fixes_table.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <functional>
#include <string>

#include "renderer/advise/fixes.h"
#include "renderer/base/lengths_text.h"
#include "renderer/measure/axes.h"
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
    return text + "A click shows it right of the line in the picture; again: hides it.";
}

/// Shown and present settings, for the rows of a list.
struct Shown {
    const FixTable& table;
    const Settings& settings;
    const Settings* tried;
    bool current;  ///< the rows belong to the present settings
};

/// Draws a tried change in two lines: its name, then its button with its numbers. Returns true at a click that hides
/// the shown row.
bool row(const Trial& t, const Shown& shown, FixRequests& requests) {
    const std::string name = t.candidate.shown_name();
    if (!t.is_drawn()) {
        coloured_wrapped(fmt::format("{}: not tried, {}", name, t.candidate.untried), theme::muted());
        return false;
    }
    bool hide = false;
    ImGui::BeginDisabled(!shown.current);
    const bool seen = shown.current && is_tried(shown.settings, shown.tried, t.changes);
    if (ImGui::Selectable(((t.why_not.empty() ? "Fix: " : "") + name).c_str(), seen)) {
        hide = seen;
        if (!seen) requests.show_fix = &t;
    }
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        ImGui::SetTooltip("%s", about(t, shown.table).c_str());
    if (ImGui::SmallButton("Apply")) requests.apply_fix = &t;
    ImGui::EndDisabled();
    plain_tooltip(fmt::format("Sets it; {} takes it back", key_text(Command::Undo)),
                  ImGuiHoveredFlags_AllowWhenDisabled);
    ImGui::SameLine();
    coloured_wrapped(fmt::format("{} right, {} broken, error {}, {}, maps {}", t.cured, t.broken,
                                 signed_text(t.added_error()), time_text(t.ms), map_bytes_text(t.map_bytes())),
                     shown.current ? theme::text() : theme::muted());
    if (const std::string engine = engine_changes_text(t.changes); !engine.empty())
        ImGui::TextDisabled("%s", engine.c_str());
    return hide;
}

bool rows(const char* id, const Shown& shown, bool helping, FixRequests& requests) {
    bool hide = false;
    ImGui::PushID(id);
    int number = 0;
    for (const Trial& t : shown.table.rows) {
        ImGui::PushID(number++);
        if (t.helps() == helping) hide |= row(t, shown, requests);
        ImGui::PopID();
    }
    ImGui::PopID();
    return hide;
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

bool is_tried(const Settings& settings, const Settings* tried, ShownChanges changes) {
    if (!tried) return false;
    Settings with = settings;
    set_settings(with, changes);
    return measured_settings(with) == measured_settings(*tried);
}

bool draw_fixes_table(const FixSearch& search, const Settings& settings, const Settings* tried, FixRequests& requests,
                      std::optional<glm::ivec2> pixel) {
    if (!search.table || search.pixel != pixel) return false;
    const FixTable& table = *search.table;
    if (!search.current)
        ImGui::TextDisabled("of other settings: search again");
    else if (table.fix())
        wrapped_text(fmt::format("{} pixels are wrong now; {} of {} changes tried", table.wrong, table.drawn(),
                                 table.candidates));
    else
        wrapped_text(fmt::format("No fix among {} of {} changes: none {} and makes nothing worse", table.drawn(),
                                 table.candidates, pixel ? "puts this pixel right" : "lowers the error"));
    same_line_if_fits(button_width("Close"));
    if (ImGui::SmallButton("Close##cures")) (pixel ? requests.forget_pixel_fixes : requests.forget_fixes) = true;
    const Shown shown{table, settings, tried, search.current};
    bool hide = false;
    if (std::ranges::any_of(table.rows, &Trial::helps)) hide |= rows("cures", shown, true, requests);
    const auto others = std::ranges::count_if(table.rows, std::not_fn(&Trial::helps));
    if (others > 0 && ImGui::CollapsingHeader(fmt::format("{} others do not help###others", others).c_str()))
        hide |= rows("others", shown, false, requests);
    if (table.refused > 0) ImGui::TextDisabled("%zu more: the chosen engine lacks them", table.refused);
    return hide;
}

}  // namespace si
