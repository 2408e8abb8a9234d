// Legends of overlays: colour scale, numbers, unit and sliders, or the causes of wrong pixels.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "renderer/base/lengths_text.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/reference/live_error.h"
#include "renderer/settings/overlays.h"
#include "shaders/shared/colours.h"
#include "ui/state/panels.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kSmall = 14;        ///< smallest height of a picture with the overlay's name, ems
constexpr float kRounding = 0.25f;  ///< radius of corners, ems
constexpr float kLinesRoom = 0.5f;  ///< largest share of the picture that lines on each view may take

/// Returns the legend of the shown light's views; empty if it has one only.
std::vector<std::string> view_labels(const FittedLight* light) {
    std::vector<std::string> labels;
    if (!light || !light->casts || light->views.size() < 2) return labels;
    for (std::size_t i = 0; i < light->views.size(); ++i) labels.push_back(view_short_name(light->chooser.choice, i));
    return labels;
}

/// Returns the camera depths or distances that a view covers, "12 to 31 m"; empty if they do not choose the view.
std::string span_text(const ViewChooser& chooser, std::size_t view) {
    const bool metres = chooser.choice == ViewChoice::Interval || chooser.choice == ViewChoice::Distance;
    if (!metres || view >= chooser.spans.size()) return {};
    const std::string to = metres_text(chooser.spans[view].ends);
    if (view == 0) return "to " + to;
    const std::string from = metres_text(chooser.spans[view - 1].ends);
    const auto unit = [](const std::string& text) { return text.substr(text.rfind(' ')); };
    return unit(from) == unit(to) ? fmt::format("{}–{}", from.substr(0, from.rfind(' ')), to)
                                  : fmt::format("{}–{}", from, to);
}

/// Returns a line on each view of the shown light: "cascade 2: 12–31 m, 26 mm a texel". Empty for one view.
std::vector<std::string> view_lines(const FittedLight* light, MapSize map_size) {
    std::vector<std::string> lines;
    if (!light || !light->casts || light->views.size() < 2) return lines;
    const ViewChooser& chooser = light->chooser;
    const char* const kind = chooser.choice == ViewChoice::Face       ? "face"
                             : chooser.choice == ViewChoice::Distance ? "clip level"
                                                                      : "cascade";
    for (std::size_t i = 0; i < light->views.size(); ++i) {
        const std::string span = span_text(chooser, i);
        std::string line = fmt::format("{} {}: {}", kind, view_short_name(chooser.choice, i), span);
        if (map_size.shortest() > 0) {
            const TexelSize texel = light->views[i].texel_size_range(map_size);
            const bool varies = texel.shortest < 0.9 * texel.longest;
            line += fmt::format("{}{}{} a texel", span.empty() ? "" : ", ", varies ? "up to " : "",
                                metres_text(texel.longest));
        }
        lines.push_back(line);
    }
    return lines;
}

struct LegendWidget {
    std::string_view label, key;
    float ems;  ///< width of the widget
};

/// Returns the settings of the overlay's look that have a widget in the legend.
std::vector<LegendWidget> legend_widgets(const Settings& settings, const Pane& pane) {
    std::vector<LegendWidget> out = {{"Opacity", "view.overlay_opacity", 4.5f}, {"", "view.overlay_blend", 4}};
    if (!overlays()[std::size_t(pane.overlay - 1)].scalar) return out;
    out.push_back({"Scale", "view.overlay_range", 6.5f});
    if (settings.view.overlay_range != OverlayRange::Manual) return out;
    out.push_back({"from", "view.overlay_min", 4.5f});
    out.push_back({"to", "view.overlay_max", 4.5f});
    return out;
}

/// Returns the width of the box around the legend's widgets, pixels.
float width_of(const std::vector<LegendWidget>& widgets) {
    const float em = ImGui::GetFontSize(), gap = em * 0.5f;
    float width = gap;
    for (const LegendWidget& w : widgets)
        width += ImGui::CalcTextSize(w.label.data(), w.label.data() + w.label.size()).x + gap + em * w.ems + gap;
    return width;
}

}  // namespace

float legend_widgets_width(const Settings& settings, const Pane& pane) {
    return width_of(legend_widgets(settings, pane));
}

float legend_widgets_height(const Settings& settings, const Pane& pane, ImVec2 room) {
    const float em = ImGui::GetFontSize();
    if (pane.overlay <= 0 || std::size_t(pane.overlay) > overlays().size() || room.y < em * kSmall) return 0;
    if (room.x < width_of(legend_widgets(settings, pane)) + em * 1.2f) return 0;
    return ImGui::GetFrameHeight() + em * 0.8f;
}

void draw_legend_widgets(Settings& settings, const Pane& pane, float left, float bottom, ImVec2 room) {
    const float height = legend_widgets_height(settings, pane, room), em = ImGui::GetFontSize(), gap = em * 0.5f;
    if (height <= 0) return;
    const std::vector<LegendWidget> widgets = legend_widgets(settings, pane);
    ImGui::SetCursorScreenPos({left + em * 0.6f, bottom - em * 0.6f - height + em * 0.4f});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::kVeil);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(gap, em * 0.2f));
    ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, em * kRounding);
    ImGui::BeginChild("legend", {width_of(widgets), height - em * 0.4f}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
    for (const LegendWidget& w : widgets) {
        if (w.key != widgets.front().key) ImGui::SameLine(0, gap);
        ImGui::AlignTextToFramePadding();
        coloured_text(w.label, theme::kOnPicture);
        ImGui::SameLine(0, gap);
        setting_widget(settings, w.key, em * w.ems);
    }
    ImGui::EndChild();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

void draw_legend(const Pane& pane, const FittedLight* light, MapSize map_size, float left, float bottom, ImVec2 room) {
    const int index = pane.overlay - 1;
    if (index < 0 || std::size_t(index) >= overlays().size()) return;
    const Overlay& overlay = overlays()[std::size_t(index)];
    const float em = ImGui::GetFontSize();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    // A small picture has the overlay's name above it, so that the legend shows only the scale.
    const bool small = room.y < em * kSmall;
    if (small && !overlay.scalar) return;
    const std::string unit = overlay.unit.empty() ? std::string() : fmt::format(" ({})", overlay.unit);
    const std::string title = small ? std::string(overlay.unit) : std::string(overlay.label) + unit;
    const float width = std::clamp(room.x - em * 2.4f, em * 5, em * (small ? 9.0f : 15.0f)), pad = em * 0.6f;
    const float head = title.empty() || small ? 0 : em * 1.35f, bar = em * (small ? 0.4f : 0.7f);
    const float text_width = ImGui::CalcTextSize(title.c_str()).x;
    const std::vector<std::string> keys = overlay.names_views ? view_labels(light) : std::vector<std::string>();
    // A picture with room names each view with its range and texels; a small one only its number.
    std::vector<std::string> lines = overlay.names_views ? view_lines(light, map_size) : std::vector<std::string>();
    const float line_height = em * 1.25f;
    float widest = 0;
    for (const std::string& line : lines) widest = std::max(widest, ImGui::CalcTextSize(line.c_str()).x + em * 1.2f);
    if (widest > room.x * kLinesRoom || line_height * float(lines.size()) > room.y * kLinesRoom) lines.clear();
    const float key_width = em * 2.4f;
    const float box_width = !lines.empty()    ? std::max(text_width, widest)
                            : !overlay.scalar ? std::max(text_width, key_width * float(keys.size()))
                            : small           ? width + (title.empty() ? 0 : text_width + pad)
                                              : std::max(width, text_width);
    const float box_height = overlay.scalar   ? head + bar + em * 1.35f
                             : !lines.empty() ? em * 1.35f + line_height * float(lines.size())
                                              : em * (keys.empty() ? 1.2f : 2.5f);
    const ImVec2 lo(left + em * 0.6f, bottom - em * 0.6f - box_height - pad),
        hi(lo.x + box_width + 2 * pad, bottom - em * 0.6f);
    list.AddRectFilled(lo, hi, theme::kVeil, em * kRounding);
    const float top = lo.y + pad * 0.6f;
    list.AddText({lo.x + pad + (small ? width + pad : 0), top + (small ? bar + em * 0.2f : 0)}, theme::kOnPicture,
                 title.c_str());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const ImVec2 at(lo.x + pad, top + em * 1.4f + line_height * float(i));
        list.AddRectFilled({at.x, at.y + em * 0.1f}, {at.x + em * 0.8f, at.y + em * 0.9f},
                           theme::colour(shared::view_colour(int(i))));
        list.AddText({at.x + em * 1.2f, at.y}, theme::kOnPicture, lines[i].c_str());
    }
    for (std::size_t i = 0; lines.empty() && i < keys.size(); ++i) {
        const ImVec2 at(lo.x + pad + key_width * float(i), top + em * 1.4f);
        list.AddRectFilled(at, {at.x + em * 0.8f, at.y + em * 0.8f}, theme::colour(shared::view_colour(int(i))));
        list.AddText({at.x + em, at.y - em * 0.1f}, theme::kOnPicture, keys[i].c_str());
    }
    if (!overlay.scalar) return;
    const bool diverging = overlay.diverging;
    const ImU32 first = theme::colour(diverging ? shared::DIVERGING_LOW : shared::SEQUENTIAL_LOW);
    const ImU32 middle = theme::colour(diverging ? shared::DIVERGING_MIDDLE : shared::SEQUENTIAL_MIDDLE);
    const ImU32 last = theme::colour(diverging ? shared::DIVERGING_HIGH : shared::SEQUENTIAL_HIGH);
    const float x0 = lo.x + pad, x2 = x0 + width, x1 = 0.5f * (x0 + x2), y0 = top + head, y1 = y0 + bar;
    list.AddRectFilledMultiColor({x0, y0}, {x1, y1}, first, middle, middle, first);
    list.AddRectFilledMultiColor({x1, y0}, {x2, y1}, middle, last, last, middle);
    const float low = pane.overlay_min, high = pane.overlay_max;
    const int steps = width < em * 11 ? 2 : 4;
    for (int i = 0; i <= steps; ++i) {
        const float t = float(i) / float(steps), x = x0 + t * (x2 - x0);
        list.AddLine({x, y1}, {x, y1 + em * 0.2f}, theme::kOnPicture);
        const std::string number = digits_text(low + t * (high - low));
        const float w = ImGui::CalcTextSize(number.c_str()).x;
        const float at = i == 0 ? x : i == steps ? x - w : x - 0.5f * w;
        list.AddText({at, y1 + em * 0.2f}, theme::kOnPicture, number.c_str());
    }
}

void draw_artefact_legend(const LiveError* error, float left, float bottom, float room) {
    const float em = ImGui::GetFontSize(), pad = em * 0.6f, line = em * 1.25f;
    struct Line {
        ImU32 colour;
        std::string label, count;
    };
    std::vector<Line> lines;
    const auto count_of = [&](std::size_t pixels) {
        const std::size_t n = error->metrics.counted;
        if (n == 0) return std::string("0");
        const double percent = 100.0 * double(pixels) / double(n);
        return pixels > 0 && percent < 0.005 ? fmt::format("{}   < 0.01 %", pixels)
                                             : fmt::format("{}   {:.2f} %", pixels, percent);
    };
    // Causes without a pixel are left out, because fourteen lines would hide a quarter of a small picture.
    for (const ArtefactStyle& style : artefact_styles())
        if (!error || error->metrics.artefacts[std::size_t(style.artefact)] > 0)
            lines.push_back({theme::rgb(style.rgb), std::string(style.label),
                             error ? count_of(error->metrics.artefacts[std::size_t(style.artefact)]) : ""});
    if (lines.empty()) lines.push_back({theme::kVeil, "No artefacts", ""});
    float label_width = 0, count_width = 0;
    for (const Line& l : lines) {
        label_width = std::max(label_width, ImGui::CalcTextSize(l.label.c_str()).x);
        count_width = std::max(count_width, ImGui::CalcTextSize(l.count.c_str()).x);
    }
    const bool counts = error && em * 3 + label_width + count_width + 2 * pad < room - em;
    const float width = em * 1.2f + label_width + (counts ? em * 1.2f + count_width : 0) + 2 * pad;
    const float height = line * float(lines.size()) + 1.2f * pad;
    const ImVec2 hi(left + em * 0.6f + width, bottom - em * 0.6f), lo(left + em * 0.6f, hi.y - height);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(lo, hi, theme::kVeil, em * 0.25f);
    float y = lo.y + 0.6f * pad;
    for (const Line& l : lines) {
        list.AddRectFilled({lo.x + pad, y + em * 0.2f}, {lo.x + pad + em * 0.75f, y + em * 0.95f}, l.colour);
        list.AddText({lo.x + pad + em * 1.2f, y}, theme::kOnPicture, l.label.c_str());
        if (counts)
            list.AddText({hi.x - pad - ImGui::CalcTextSize(l.count.c_str()).x, y}, theme::kMutedOnPicture,
                         l.count.c_str());
        y += line;
    }
}

}  // namespace si
