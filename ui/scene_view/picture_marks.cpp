#include "ui/scene_view/picture_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/lengths_text.h"
#include "renderer/inspect/probe.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/settings/overlays.h"
#include "shaders/shared/colours.h"
#include "ui/scene_view/picture_painter.h"
#include "ui/state/panels.h"
#include "ui/widgets/quantity_text.h"
#include "ui/widgets/text.h"

namespace si {
namespace {

constexpr float kLoupeFactor = 8;  ///< size of an enlarged pixel at scale 1
constexpr ImU32 kLoupeGrid = IM_COL32(0, 0, 0, 70);

/// Returns the name of the light's view whose colour is nearest: "cascade 2". @param light null: unknown
std::string view_of_colour(const glm::vec3& rgb, const FittedLight* light) {
    if (!light || light->views.empty()) return "no map";
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < std::min<std::size_t>(light->views.size(), shared::VIEW_COLOUR_COUNT); ++i)
        if (glm::distance(shared::view_colour(int(i)), rgb) < glm::distance(shared::view_colour(int(nearest)), rgb))
            nearest = i;
    return view_name(light->chooser.choice, nearest, light->views.size());
}

}  // namespace

void draw_probe_mark(const EditorState& state, const FrameResult& result, ImVec2 origin, ImVec2 size) {
    if (!state.probe_pixel || result.colour.width <= 0) return;
    const float em = ImGui::GetFontSize();
    const ImVec2 p(origin.x + (float(state.probe_pixel->x) + 0.5f) * size.x / float(result.colour.width),
                   origin.y + (float(state.probe_pixel->y) + 0.5f) * size.y / float(result.colour.height));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const auto& [colour, thick] : {std::pair{theme::kShade, em * 0.25f}, {theme::kProbed, em * 0.1f}}) {
        list.AddCircle(p, em * 0.5f, colour, 24, thick);
        for (const ImVec2 d : {ImVec2(1, 0), ImVec2(-1, 0), ImVec2(0, 1), ImVec2(0, -1)})
            list.AddLine({p.x + d.x * em * 0.5f, p.y + d.y * em * 0.5f}, {p.x + d.x * em, p.y + d.y * em}, colour,
                         thick);
    }
}

void draw_readers(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size) {
    if (!state.map.hovered_texel || !frame.texel_usage) return;
    const FloatImage* c = frame.map_coordinates;
    const MapSize n = frame.texel_usage->size();
    if (!c || state.map.hovered_texel->x >= n.width || state.map.hovered_texel->y >= n.height) return;
    const ImVec2 step(size.x / float(c->width), size.y / float(c->height));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const glm::ivec2 p : frame.texel_usage->readers(*state.map.hovered_texel)) {
        const ImVec2 lo(origin.x + float(p.x) * step.x, origin.y + float(p.y) * step.y);
        list.AddRectFilled(lo, {lo.x + step.x, lo.y + step.y}, faded(theme::kLinked, 200));
    }
}

void draw_loupe(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size) {
    const LoupeFacts* loupe = frame.loupe;
    if (!state.loupe_pixel || !loupe || loupe->at != *state.loupe_pixel) return;
    const float em = ImGui::GetFontSize();
    const float cell = kLoupeFactor * std::max(1.0f, std::round(em / 15)), side = cell * float(loupe->pixels.width);
    const float text = em * 2.7f, above = em * 2.6f;
    if (size.x < 3 * side || size.y < side + text + 2 * above) return;
    const auto* middle = &loupe->pixels.data[std::size_t(kLoupeRadiusPixels * (loupe->pixels.width + 1)) * 4];
    ImFont* font = theme::small();
    const std::string colour =
        fmt::format("{}, {}   RGB {} {} {}", loupe->at.x, loupe->at.y, middle[0], middle[1], middle[2]);
    const float across = std::max(side, text_width(colour, font) + em * 0.4f);
    // The loupe moves to the other side if it would cover its own pixels.
    const float at_x = (float(loupe->at.x) + 0.5f) * size.x / float(std::max(frame.result->colour.width, 1));
    const bool right = at_x < side * 2;
    const ImVec2 lo(std::round(right ? origin.x + size.x - across - em : origin.x + em), std::round(origin.y + above)),
        hi(lo.x + side, lo.y + side);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({lo.x - 2, lo.y - 2}, {lo.x + across + 2, hi.y + text}, theme::kVeil, em * 0.2f);
    const auto* pixel = loupe->pixels.data.data();
    for (int y = 0; y < loupe->pixels.height; ++y)
        for (int x = 0; x < loupe->pixels.width; ++x, pixel += 4) {
            const ImVec2 p(lo.x + cell * float(x), lo.y + cell * float(y));
            if (pixel[3] != 0)
                list.AddRectFilled(p, {p.x + cell, p.y + cell}, IM_COL32(pixel[0], pixel[1], pixel[2], 255));
        }
    for (int i = 0; i <= loupe->pixels.width; ++i) {
        const float d = cell * float(i);
        list.AddLine({lo.x + d, lo.y}, {lo.x + d, hi.y}, kLoupeGrid);
        list.AddLine({lo.x, lo.y + d}, {hi.x, lo.y + d}, kLoupeGrid);
    }
    const ImVec2 c(lo.x + cell * kLoupeRadiusPixels, lo.y + cell * kLoupeRadiusPixels);
    list.AddRect({c.x - 1, c.y - 1}, {c.x + cell + 1, c.y + cell + 1}, theme::kShade, 0, 0, 3);
    list.AddRect({c.x - 1, c.y - 1}, {c.x + cell + 1, c.y + cell + 1}, theme::kProbed, 0, 0, 1.5f);
    std::optional<double> visibility;
    if (loupe->visibility) visibility = double(*loupe->visibility);
    if (frame.probe && glm::ivec2(frame.probe->x, frame.probe->y) == loupe->at)
        for (const Probe::PerLight& light : frame.probe->lights)
            if (light.light == shown_light(state.settings) && light.casts) visibility = light.visibility;
    const auto line = [&](int row, const std::string& what) {
        small_text({lo.x + em * 0.2f, hi.y + em * (0.15f + 1.2f * float(row))}, what, theme::kOnPicture);
    };
    line(0, colour);
    if (visibility) line(1, "visibility " + digits_text(*visibility));
}

void draw_text_on_picture(ImVec2 at, const std::string& text, ImU32 colour) {
    const float em = ImGui::GetFontSize();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x - em * 0.4f, at.y - em * 0.2f}, {at.x + size.x + em * 0.4f, at.y + size.y + em * 0.2f},
                       theme::kVeil, em * 0.2f);
    list.AddText(at, colour, text.c_str());
}

/// Returns the cause that a colour of the artefact overlay stands for.
std::string artefact_of(const glm::vec3& colour) {
    constexpr float kAlike = 0.01f;
    for (const ArtefactStyle& style : artefact_styles()) {
        const glm::vec3 own = glm::vec3(style.rgb[0], style.rgb[1], style.rgb[2]) / 255.0f;
        if (glm::all(glm::lessThan(glm::abs(own - colour), glm::vec3(kAlike)))) return std::string(style.label);
    }
    return "nothing wrong";
}

void draw_hover_readout(const EditorFrame& frame, const Pane& pane, const FittedLight* light, ImVec2 origin,
                        glm::ivec2 pixel) {
    std::string text = fmt::format("{}, {}", pixel.x, pixel.y);
    const int overlay = pane.overlay;
    const FloatImage* values = frame.overlay_values;
    if (values && overlay > 0 && std::size_t(overlay) <= overlays().size() && pixel.x < values->width &&
        pixel.y < values->height) {
        const Overlay& row = overlays()[std::size_t(overlay - 1)];
        const float value = values->at(pixel.x, pixel.y, 0);
        const bool drawn = values->at(pixel.x, pixel.y, 3) > 0;
        if (row.names_causes)
            text +=
                "   " + (drawn ? artefact_of({value, values->at(pixel.x, pixel.y, 1), values->at(pixel.x, pixel.y, 2)})
                               : std::string("nothing wrong, or nothing there"));
        else if (!drawn)
            text += "   background";
        else if (row.scalar && std::isnan(value))
            text += fmt::format("   {}: no value here", row.label);
        else if (row.scalar)
            text += fmt::format("   {} {}", row.label, quantity_text(value, row.unit));
        else if (row.names_views)
            text += "   " +
                    view_of_colour({value, values->at(pixel.x, pixel.y, 1), values->at(pixel.x, pixel.y, 2)}, light);
        else
            text += fmt::format("   {}", row.label);
    }
    const float em = ImGui::GetFontSize();
    draw_text_on_picture({origin.x + em * 0.8f, origin.y + em * 0.6f}, text);
}

}  // namespace si
