#include "ui/map_view/map_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/widgets/quantity_text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kNumberEms = 5.2f;  ///< smallest width of a texel that shows its number, ems

/// Formats a value with six digits, which distinguish neighbouring texels.
std::string exact_metres(double metres) {
    return std::isfinite(metres) ? stored_text(metres, 6) + " m" : "no distance";
}

}  // namespace

std::pair<ImVec2, ImVec2> MapRect::square(glm::ivec2 texel) const {
    const double x = double(texel.x) / texels.x, y = double(texel.y) / texels.y;
    return {screen({x, y + 1.0 / texels.y}), screen({x + 1.0 / texels.x, y})};
}

void outline_texels(const MapRect& rect, glm::ivec2 first, glm::ivec2 size, ImU32 colour) {
    const auto [left, bottom] = rect.square(first);
    const auto [right, top] = rect.square(first + size - 1);
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
            const auto [lo, hi] = rect.square({x, y});
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

std::pair<std::string, std::string> texel_readout(glm::ivec2 texel, glm::ivec2 size, const FloatImage* values,
                                                  const DepthCurve& curve, const TexelUsage* usage, bool frozen,
                                                  const ShownMap& shown, bool linear) {
    std::string where = fmt::format("texel {}, {}", texel.x, texel.y);
    if (usage && usage->size().sides() == size)
        where += fmt::format("   read by {} {}pixels", usage->pixels(texel), frozen ? "frozen " : "");
    if (shown.mip > 0) {
        texel = (2 * texel + 1) * shown.texels / (2 * size);  // texel of the full map under the middle of the mip texel
        where += fmt::format("   in mip level {} texel {}, {}", shown.mip, texel.x, texel.y);
        size = shown.texels;
    }
    if (!values || values->width != size.x || values->height != size.y) return {where, {}};
    const double stored = values->at(texel.x, size.y - 1 - texel.y);
    const DepthCurve here = curve.curve_at_row((texel.y + 0.5) / size.y);
    if (shown.channel > 0 && linear)
        return {where, fmt::format("{}   of a depth alone at {} of the range   {}", shown.name, stored_text(stored, 6),
                                   exact_metres(here.near + stored * (here.far - here.near)))};
    if (shown.channel > 0) return {where, fmt::format("{}   {}", shown.name, stored_text(stored, 9))};
    const double z = here.distance(stored), share = (z - curve.near) / (curve.far - curve.near);
    // Nine digits distinguish any two 32-bit depths.
    const std::string depth =
        fmt::format("{}   stored {}   linear {}", exact_metres(z), stored_text(stored, 9), stored_text(share, 6));
    return {where, stored == curve.convention.far_depth() ? depth + "   nothing drawn" : depth};
}

}  // namespace si
