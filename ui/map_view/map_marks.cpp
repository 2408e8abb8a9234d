#include "ui/map_view/map_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kNumberEms = 5.2f;  ///< smallest width of a texel that shows its number, ems

}  // namespace

std::pair<ImVec2, ImVec2> MapRect::square(glm::ivec2 first, int count) const {
    const double x = double(first.x) / texels.x, y = double(first.y) / texels.y;
    const ImVec2 a = screen({x, y + double(count) / texels.y}), b = screen({x + double(count) / texels.x, y});
    return {a, b};
}

void outline_texels(const MapRect& rect, glm::ivec2 first, glm::ivec2 size, ImU32 colour) {
    const auto [left, bottom] = rect.square(first, 1);
    const auto [right, top] = rect.square(first + size - 1, 1);
    const ImVec2 lo(std::min(left.x, right.x), std::min(left.y, right.y));
    const ImVec2 hi(std::max(bottom.x, top.x), std::max(bottom.y, top.y));
    const float em = ImGui::GetFontSize();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (hi.x - lo.x < em * 0.5f) {
        const ImVec2 c(0.5f * (lo.x + hi.x), 0.5f * (lo.y + hi.y));
        list.AddCircle(c, em * 0.45f, theme::kShade, 20, em * 0.24f);
        list.AddCircle(c, em * 0.45f, colour, 20, em * 0.1f);
        return;
    }
    list.AddRect(lo, hi, theme::kShade, 0, 0, em * 0.24f);
    list.AddRect(lo, hi, colour, 0, 0, em * 0.1f);
}

bool fits_texel_values(const MapRect& rect) {
    return rect.texel_pixels() >= kNumberEms * theme::small()->FontSize;
}

void draw_texel_values(const MapRect& rect, const FloatImage& values, ImVec2 clip_lo, ImVec2 clip_hi) {
    if (!fits_texel_values(rect) || glm::ivec2(values.width, values.height) != rect.texels) return;
    const glm::dvec2 a = rect.uv({clip_lo.x, clip_hi.y}), b = rect.uv({clip_hi.x, clip_lo.y});
    const glm::ivec2 last = rect.texels - 1;
    const glm::ivec2 from = glm::clamp(glm::ivec2(glm::floor(a * glm::dvec2(rect.texels))), glm::ivec2(0), last);
    const glm::ivec2 to = glm::clamp(glm::ivec2(glm::floor(b * glm::dvec2(rect.texels))), glm::ivec2(0), last);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImFont* font = theme::small();
    for (int y = from.y; y <= to.y; ++y) {
        for (int x = from.x; x <= to.x; ++x) {
            const std::string text = fmt::format("{:.6f}", values.at(x, rect.texels.y - 1 - y));
            const ImVec2 extent = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text.c_str());
            const auto [lo, hi] = rect.square({x, y}, 1);
            const ImVec2 at(0.5f * (lo.x + hi.x - extent.x), 0.5f * (lo.y + hi.y - extent.y));
            list.AddRectFilled({at.x - 2, at.y}, {at.x + extent.x + 2, at.y + extent.y}, theme::kVeil);
            list.AddText(font, font->FontSize, at, theme::kOnPicture, text.c_str());
        }
    }
}

void draw_map_lines(const MapRect& rect, std::span<const std::pair<glm::dvec2, glm::dvec2>> lines, ImU32 colour) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float em = ImGui::GetFontSize();
    for (const auto& [from, to] : lines) {
        const ImVec2 a = rect.screen(from), b = rect.screen(to);
        list.AddLine(a, b, theme::kShade, em * 0.2f);
        list.AddLine(a, b, colour, em * 0.09f);
    }
}

}  // namespace si
