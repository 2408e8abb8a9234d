#include "ui/panels/imported_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/base/lengths_text.h"
#include "renderer/inspect/map_comparison.h"
#include "renderer/settings/param.h"
#include "ui/scene_view/picture_painter.h"
#include "ui/widgets/quantity_text.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kPictureEms = 16, kListEms = 18;  // widths

/// Draws the switch between the three pictures.
void picture_switch(ImportedPicture& picture) {
    static constexpr std::array<std::pair<ImportedPicture, const char*>, 3> kChoices = {
        {{ImportedPicture::Imported, "Theirs"},
         {ImportedPicture::Drawn, "Ours"},
         {ImportedPicture::Difference, "Difference"}}};
    static constexpr const char* kHints[] = {
        "The imported map, linear in distance", "The map that this program draws with the same view and raster state",
        "Blue: theirs lies nearer to the light. Red: farther. Yellow: the scene lacks what theirs holds.\n"
        "Magenta: theirs lacks what the scene holds"};
    for (std::size_t i = 0; i < kChoices.size(); ++i) {
        if (i > 0) ImGui::SameLine();
        if (toggle_button(kChoices[i].second, picture == kChoices[i].first)) picture = kChoices[i].first;
        plain_tooltip(kHints[i]);
    }
}

/// Draws the switches of texels that the comparison leaves out.
void left_out_switches(ImportedLeftOut& left_out) {
    if (toggle_button("No masked", left_out.masked)) left_out.masked = !left_out.masked;
    plain_tooltip("Leaves texels that masked casters may cover out of both maps");
    ImGui::SameLine();
    if (toggle_button("No border", left_out.border)) left_out.border = !left_out.border;
    plain_tooltip("Does not count extra texels next to covered ones, as of blurred maps of moments");
}

void number_row(const char* name, const std::string& value, ImU32 colour = theme::text()) {
    ImGui::TableNextRow();
    text_cell(name, theme::muted());
    text_cell(value, colour);
}

std::string share_text(std::size_t count, double share) {
    return fmt::format("{}   {}", count, percent_text(share));
}

void draw_map_numbers(const MapComparison& n) {
    if (!ImGui::BeginTable("numbers", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings)) return;
    const auto colour = [](bool good) { return good ? theme::text() : theme::error(); };
    number_row("Covered", fmt::format("{} of {}", n.covered, n.match.size()));
    number_row("Missed", share_text(n.missed, n.missed_share()), colour(n.gate.missed));
    number_row("Extra", share_text(n.extra, n.extra_share()), colour(n.gate.extra));
    number_row("Depth, median", fmt::format("{} steps   {}", digits_text(n.steps.median), metres_text(n.metres.median)),
               colour(n.gate.median));
    number_row("99 % within",
               fmt::format("{} steps   {}", digits_text(n.steps.most_of_99), metres_text(n.metres.most_of_99)),
               colour(n.gate.most));
    number_row("Largest", fmt::format("{}   {}", metres_text(n.metres.max), texels_text(n.texels.max)));
    if (n.masked > 0) number_row("Left out", fmt::format("{} of masked casters", n.masked));
    if (n.invalid > 0) number_row("No depth", fmt::format("{} are NaN or outside 0 to 1", n.invalid), theme::warning());
    if (n.missed + n.nearer > 0)
        number_row("Unexplained", fmt::format("{} hold what no caster explains", n.missed + n.nearer),
                   theme::warning());
    ImGui::EndTable();
}

/// Lists the casters that the imported map lacks. A click selects the object.
void draw_casters(const std::string& selected, const std::vector<LackingCaster>& casters, ImportedRequests& requests) {
    if (casters.empty()) return ImGui::TextDisabled("It lacks no caster of the scene.");
    if (!begin_table("lacking", ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerH,
                     {{.heading = "Theirs lacks", .share = 1}, {"Texels", 7}}))
        return;
    for (const LackingCaster& caster : casters) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::string name = caster.path.empty() ? "(unnamed)" : caster.path;
        if (ImGui::Selectable(fmt::format("{}###lacking {}", name, caster.object).c_str(), caster.path == selected,
                              ImGuiSelectableFlags_SpanAllColumns))
            requests.select_object = caster.path;
        plain_tooltip(lacking_caster_text(caster) + "\nClick to select it in the scene");
        text_cell(fmt::format("{} of {}", caster.empty + caster.farther, caster.texels),
                  caster.is_whole() ? theme::error() : theme::text());
    }
    ImGui::EndTable();
}

/// Draws the picture as large as fits, and the scale of the difference's colours below it.
void draw_picture(bool difference, const ImportedFacts& facts, ImVec2 room) {
    const Image& picture = facts.compared_picture;
    const float scale_height = ImGui::GetFontSize() * 1.6f;
    const float height = room.y - (difference ? scale_height : 0);
    if (picture.texture == 0 || height < 8) return;
    const float fit = std::min(room.x / float(picture.width), height / float(picture.height));
    const ImVec2 at = ImGui::GetCursorScreenPos(), size(fit * float(picture.width), fit * float(picture.height));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddImage(texture_id(picture.texture), at, {at.x + size.x, at.y + size.y}, {0, 1}, {1, 0});
    list.AddRect(at, {at.x + size.x, at.y + size.y}, theme::line());
    ImGui::Dummy({std::max(size.x, 1.0f), size.y});
    if (!difference) return;
    const float bar = ImGui::GetFontSize() * 0.4f, top = at.y + size.y + bar * 0.5f;
    constexpr int kSteps = 32;
    for (int i = 0; i < kSteps; ++i) {
        const auto rgb =
            difference_colour((2.0 * i / (kSteps - 1) - 1) * facts.compared_scale_m, facts.compared_scale_m);
        list.AddRectFilled({at.x + room.x * float(i) / kSteps, top}, {at.x + room.x * float(i + 1) / kSteps, top + bar},
                           IM_COL32(rgb[0], rgb[1], rgb[2], 255));
    }
    small_text({at.x, top + bar}, "-" + metres_text(facts.compared_scale_m), theme::muted());
    small_text({at.x + room.x, top + bar}, "+" + metres_text(facts.compared_scale_m), theme::muted(), 1);
}

/// Draws a label and the widget of a setting, on the line of the widget before it where they fit.
void labelled_widget(Settings& settings, const char* key, float width, bool first = false) {
    const std::string label(find_setting(key)->param->label);
    if (!first) same_line_if_fits(ImGui::CalcTextSize(label.c_str()).x + width + 3 * ImGui::GetStyle().ItemSpacing.x);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label.c_str());
    ImGui::SameLine();
    setting_widget(settings, key, width);
}

/// Draws the choice of the maps and what is known of the engine's bias, with the widgets by which it is entered.
void draw_bias(Settings& settings, EngineBias bias) {
    const float em = ImGui::GetFontSize();
    labelled_widget(settings, "map.bundle_maps", em * 9, true);
    if (bias == EngineBias::Own) return;
    labelled_widget(settings, "map.bundle_bias", em * 11);
    if (bias == EngineBias::Entered)
        for (const char* key : {"bias.kind", "bias.unit", "bias.constant", "bias.slope", "bias.normal",
                                "bias.normal_unit", "bias.normal_by"})
            labelled_widget(settings, key, em * 8);
    if (bias == EngineBias::Unknown)
        coloured_wrapped(
            "The engine's bias is unknown: no verdict speaks of the engine's pixel. Choose \"entered by hand\" and set "
            "it.",
            theme::warning());
    if (bias == EngineBias::Changed)
        coloured_wrapped(
            "The bias of these settings is not the one that the bundle states: verdicts speak of these settings.",
            theme::warning());
}

/// Returns why there is no comparison of the shown map; empty: there is one, or there will be.
std::string why_no_comparison(const Settings& settings, const FittedLight* light, const ImportedFacts& facts) {
    if (light && light->provider == MapProvider::Drawn && settings.map.bundle_maps == BundleMaps::Drawn &&
        !settings.map.bundle.empty())
        return "This program draws the maps of the bundle's lights. As given, they are compared with drawn ones.";
    if (!light || light->provider != MapProvider::Imported)
        return "The shown light's map is drawn by this program. A bundle of an engine's frame has maps to compare "
               "with: File, Open, or map.bundle.";
    return facts.comparison_problem;
}

}  // namespace

void draw_imported(ImportedPicture& picture, ImportedLeftOut& left_out, Settings& settings, const FittedLight* light,
                   EngineBias bias, const std::string& selected, const ImportedFacts& facts,
                   ImportedRequests& requests) {
    requests.want_map_comparison = light && light->provider == MapProvider::Imported;
    if (!settings.map.bundle.empty()) draw_bias(settings, bias);
    if (const std::string why = why_no_comparison(settings, light, facts); !why.empty())
        return coloured_wrapped(why, theme::muted());
    if (!facts.compared_map) return ImGui::TextDisabled("Comparing ...");
    const MapComparison& n = facts.compared_map->numbers;
    const float em = ImGui::GetFontSize();
    picture_switch(picture);
    ImGui::SameLine();
    left_out_switches(left_out);
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, n.gate.passed() ? theme::text() : theme::error());
    wrapped_text(n.gate.text + (n.gate.hint.empty() ? "" : "; ") + n.gate.hint);
    ImGui::PopStyleColor();
    const ImVec2 rest = ImGui::GetContentRegionAvail();
    const float side = std::min(em * kPictureEms, rest.x * 0.3f), list = std::min(em * kListEms, rest.x * 0.3f);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    if (ImGui::BeginChild("compared picture", {side, 0}))
        draw_picture(picture == ImportedPicture::Difference, facts, {side, rest.y});
    ImGui::EndChild();
    ImGui::SameLine();
    if (ImGui::BeginChild("compared numbers", {rest.x - side - list - 2 * gap, 0})) draw_map_numbers(n);
    ImGui::EndChild();
    ImGui::SameLine();
    if (ImGui::BeginChild("lacking casters", {list, 0})) draw_casters(selected, facts.compared_map->lacking, requests);
    ImGui::EndChild();
}

}  // namespace si
