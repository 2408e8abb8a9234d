// Panel Error: errors of the shown light's shadows against the ray-traced reference, live, and their causes.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/reference/artefact_picture.h"
#include "renderer/reference/live_error.h"
#include "ui/state/panels.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr const char* kLongestProgress = "Baking the light map … 100 %, 60 min left";

/// Returns the rows of one table, each sum followed by its parts. @param causes shares of wrong pixels; else all other
/// metrics
std::vector<const Metric*> rows_of(bool causes, const ErrorMetrics& m) {
    std::vector<const Metric*> rows;
    const auto add = [&](const Metric& row) {
        if (!row.member || (row.cpu_only && row.unit == "px") || (row.rare && !(row.value(m) > 0))) return;
        if (row.of_pictures && !std::isfinite(row.value(m))) return;
        rows.push_back(&row);
    };
    const auto is_sum = [](const Metric& row) {
        return std::any_of(metrics().begin(), metrics().end(), [&](const Metric& o) { return o.part_of == row.key; });
    };
    for (const bool shares : {true, false})
        for (const Metric& row : metrics()) {
            if (!row.part_of.empty() || is_sum(row) != causes || (row.unit == kShareOfPixels) != shares) continue;
            add(row);
            for (const Metric& part : metrics())
                if (part.part_of == row.key) add(part);
        }
    return rows;
}

std::string text_of(const Metric& row, double value) {
    if (!std::isfinite(value)) return "not measured";
    if (row.unit == kShareOfPixels)
        return value == 0 ? "0 %" : fmt::format("{:.{}f} %", 100 * value, value < 0.0095 ? 4 : 2);
    return row.better == Better::NearZero ? fmt::format("{:+.5f}", value) : fmt::format("{:.5f}", value);
}

/// Metrics that the tables show.
struct ShownMetrics {
    ErrorMetrics metrics;
    bool known = false;    ///< false: nothing was measured yet; the tables then have no numbers
    bool current = false;  ///< of the shown picture, not of an earlier one
};

/// Returns the errors of the shown picture; until they are known those of an earlier picture of this light.
ShownMetrics shown_metrics(const EditorFrame& frame) {
    if (frame.error) return {frame.error->metrics, true, true};
    if (frame.earlier_error) return {frame.earlier_error->metrics, true, false};
    return {};
}

/// Draws one table of metrics. @param causes sums of wrong pixels with their causes; else all other metrics
void metrics_table(const ShownMetrics& shown, bool causes, const char* id) {
    const ErrorMetrics& m = shown.metrics;
    constexpr ImGuiTableFlags flags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings;
    if (!ImGui::BeginTable(id, 2, flags)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 6);
    for (const Metric* row : rows_of(causes, m)) {
        const bool part = !row->part_of.empty();
        const std::string whole = part ? "   " + std::string(row->part) : std::string(row->label);
        std::string name;
        const auto tooltip = [&] {
            const std::string title = name == whole ? "" : whole + "\n";  // for columns too narrow for the whole name
            plain_tooltip(fmt::format("{}{}\n{}", title, row->formula, row->help));
        };
        const double value = row->value(m);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        name = beginning_that_fits(whole, ImGui::GetContentRegionAvail().x, ImGui::GetFont());
        coloured_text(name, part ? theme::muted() : theme::text());
        tooltip();
        right_cell(shown.known ? text_of(*row, value) : "-", value == 0 ? theme::muted() : theme::text());
        tooltip();
    }
    ImGui::EndTable();
}

/// Draws the coloured mark and name of a cause. Returns true if it was clicked.
bool cause_row(const ArtefactStyle& style, bool chosen, const ShownMetrics& of, bool with_share) {
    const std::size_t pixels = of.metrics.artefacts[std::size_t(style.artefact)], counted = of.metrics.counted;
    const float em = ImGui::GetFontSize();
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const std::string label(style.label);
    const bool clicked = ImGui::Selectable(("##" + label).c_str(), chosen, ImGuiSelectableFlags_SpanAllColumns);
    const double percent = counted == 0 ? 0.0 : 100.0 * double(pixels) / double(counted);
    plain_tooltip(
        fmt::format("{}: a click chooses it for \"Next artefact\" and shows in the picture what is wrong;\n"
                    "a second one takes both back. {:.3f} % of the pixels compared",
                    label, percent));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 lo(at.x, at.y + em * 0.2f), hi(at.x + em * 0.7f, at.y + em * 0.9f);
    list.AddRectFilled(lo, hi, theme::rgb(style.rgb));
    list.AddRect(lo, hi, theme::faint());  // outlines a white mark on a white panel
    // Names that differ only in brackets show their ends: "(normal offset)", "(polygon offset)".
    const auto fitted = label.find(" (") == label.npos ? beginning_that_fits : end_that_fits;
    const std::string shown = fitted(label, width - em * 1.1f, ImGui::GetFont());
    list.AddText({at.x + em * 1.1f, at.y}, ImGui::GetColorU32(ImGuiCol_Text), shown.c_str());
    right_cell(of.known ? fmt::format("{}", pixels) : "-", pixels == 0 ? theme::muted() : theme::text());
    if (with_share) right_cell(counted == 0 ? "-" : fmt::format("{:.3f} %", percent), theme::muted());
    return clicked;
}

/// Returns true while the errors of the shown picture are being computed.
bool waits_for_errors(const EditorFrame& frame) {
    return !frame.error && frame.reference && !frame.reference->current && frame.reference->problem.empty();
}

void next_button(EditorState& state, const EditorFrame& frame, const std::string& tour) {
    // While rays are traced, the press waits for them.
    const bool possible = waits_for_errors(frame) || artefact_tour_cause(state, frame) != Artefact::None;
    if (button_if(possible && state.artefact_tour.waits_for == 0, "Next artefact")) next_artefact(state, frame);
    plain_tooltip(
        with_key(
            "Takes the camera to the next cluster of wrong pixels of the chosen cause, largest first, and probes it",
            Command::NextWrongPixels) +
            ".\nClusters are those of the picture in which it was pressed first. Undo takes the camera back.",
        ImGuiHoveredFlags_AllowWhenDisabled);
    if (tour.empty()) return;
    ImGui::SameLine();
    ImGui::TextDisabled("%s", tour.c_str());
}

/// Draws the list of causes. @param first, end range of artefact_styles() @param shares shares of pixels fit, too
void causes_table(EditorState& state, const ShownMetrics& of, std::size_t first, std::size_t end, bool shares) {
    constexpr ImGuiTableFlags flags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings;
    ImGui::PushID(int(first));
    if (ImGui::BeginTable("causes", shares ? 3 : 2, flags)) {
        const float em = ImGui::GetFontSize();
        ImGui::TableSetupColumn("cause", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("pixels", ImGuiTableColumnFlags_WidthFixed, em * 4.5f);
        if (shares) ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthFixed, em * 5.5f);
        for (const ArtefactStyle& style : artefact_styles().subspan(first, end - first))
            if (cause_row(style, state.artefact_tour.cause == style.artefact, of, shares))
                toggle_tour_cause(state, style.artefact);
        ImGui::EndTable();
    }
    ImGui::PopID();
}

void save_button(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    if (button_if(frame.error != nullptr || waits_for_errors(frame), "Save…")) ImGui::OpenPopup("save error");
    plain_tooltip("Writes all numbers as JSON, distances between the edges included (as `measure --json`)");
    if (!ImGui::BeginPopup("save error")) return;
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    if (path_input("##file", "file.json", state.files.error_path, "Write"))
        requests.save_error = state.files.error_path;
    ImGui::EndPopup();
}

}  // namespace

void draw_error(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    const float em = ImGui::GetFontSize();
    Settings& s = state.settings;
    if (!frame.reference) return ImGui::TextDisabled("No frame yet.");
    const auto labelled = [&](const char* label, const char* key, float width) {
        same_line_if_fits(ImGui::CalcTextSize(label).x + ImGui::GetStyle().ItemSpacing.x + width);
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("%s", label);
        ImGui::SameLine();
        setting_widget(s, key, width);
    };
    ImGui::Dummy({0, 0});
    labelled("Area light (soft shadows)", "truth.area", ImGui::GetFrameHeight());
    if (s.truth.area) labelled("Noise", "truth.noise", em * 5);
    labelled("Every n-th pixel", "truth.step", em * 4);
    same_line_if_fits(em * 4);
    save_button(state, frame, requests);
    same_line_if_fits(button_width("Improve..."));
    if (ImGui::Button("Improve...")) open_improve(state, ImproveMode::Picture);
    plain_tooltip("Fixes of the picture, the least bias, and settings that it can do without: tab Improve");
    const std::string tour = artefact_tour_text(state, frame), status = reference_status(frame);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    same_line_if_fits(button_width("Next artefact") + (tour.empty() ? 0 : gap + ImGui::CalcTextSize(tour.c_str()).x));
    next_button(state, frame, tour);
    // The longest text of a progress has room, so that the tables below keep their place while it changes.
    const float room = std::max(ImGui::CalcTextSize(status.c_str()).x, ImGui::CalcTextSize(kLongestProgress).x);
    same_line_if_fits(room + em * 4);
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", status.c_str());
    if (!frame.reference->doing.empty() && !frame.reference->current) {
        ImGui::SameLine();
        if (ImGui::SmallButton("Cancel")) requests.cancel_reference = true;
    }
    const ShownMetrics shown = shown_metrics(frame);
    const float width = ImGui::GetContentRegionAvail().x;
    const int columns = width > em * 56 ? 4 : width > em * 34 ? 2 : 1;
    const ImVec2 padding = ImGui::GetStyle().CellPadding;
    // Numbers of an earlier picture stay, in grey: a table that comes and goes takes clicks away.
    const Greyed greyed(!shown.current);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {padding.x, padding.y * 0.6f});
    if (!ImGui::BeginTable("error blocks", columns,
                           ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_NoSavedSettings))
        return ImGui::PopStyleVar();
    ImGui::TableNextColumn();
    metrics_table(shown, true, "causes of each side");
    if (columns > 1) ImGui::TableNextColumn();
    metrics_table(shown, false, "means");
    if (!shown.known)
        ImGui::TextDisabled("Not measured yet");
    else
        ImGui::TextDisabled("%zu pixels compared%s", shown.metrics.counted,
                            shown.current ? "" : ", of an earlier picture");
    if (shown.known && ImGui::IsItemHovered()) {
        const auto& p = shown.metrics.pixels;
        std::size_t others = 0;
        for (std::size_t i = 1; i < p.size(); ++i) others += p[i];
        ImGui::SetTooltip("n: they show a surface that faces the light, in its cone and range.\n%zu do not", others);
    }
    if (const std::size_t n = shown.metrics.pixels[std::size_t(PixelState::ShadowTerminator)]; n > 0) {
        ImGui::TextDisabled("%zu at a shadow terminator", n);
        plain_tooltip(
            "Not compared: the triangle faces away from the light, its smooth normal does not.\n"
            "No bias cures it; smaller triangles do. The overlay Shadow terminator shows these pixels");
    }
    const std::size_t all = artefact_styles().size(), half = (all + 1) / 2;
    if (columns > 2) ImGui::TableNextColumn();
    causes_table(state, shown, 0, half, columns < 3);
    if (columns > 2) ImGui::TableNextColumn();
    causes_table(state, shown, half, all, columns < 3);
    ImGui::EndTable();
    ImGui::PopStyleVar();
}

}  // namespace si
