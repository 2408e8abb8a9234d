#include "ui/scene_view/picture_painter.h"

#include <algorithm>

#include "ui/widgets/clip.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr ImU32 kHalo = IM_COL32(0, 0, 0, 115);
constexpr double kDash = 5, kGap = 4;  // pixels at scale 1
constexpr double kBeyond = 8;  // pixels beyond the picture at which lines are clipped, so that their ends stay hidden

}  // namespace

std::optional<std::pair<glm::dvec2, glm::dvec2>> PicturePainter::visible(const glm::dvec3& from,
                                                                         const glm::dvec3& to) const {
    const auto on = view_.segment(from, to);
    if (!on) return {};
    return clip_to_box(on->first, on->second, view_.origin - kBeyond, view_.origin + view_.size + kBeyond);
}

void PicturePainter::line(const glm::dvec3& from, const glm::dvec3& to, ImU32 colour, double width) const {
    const auto on = visible(from, to);
    if (!on) return;
    const unsigned alpha = (colour & IM_COL32_A_MASK) >> IM_COL32_A_SHIFT;
    list_.AddLine(to_imgui(on->first), to_imgui(on->second), faded(kHalo, 115 * alpha / 255), px(width + 1.6));
    list_.AddLine(to_imgui(on->first), to_imgui(on->second), colour, px(width));
}

void PicturePainter::thin_line(const glm::dvec3& from, const glm::dvec3& to, ImU32 colour) const {
    if (const auto on = visible(from, to)) list_.AddLine(to_imgui(on->first), to_imgui(on->second), colour, px(1));
}

void PicturePainter::dashes(const glm::dvec3& from, const glm::dvec3& to, ImU32 colour, double width) const {
    const auto on = visible(from, to);
    if (!on) return;
    const double length = glm::distance(on->first, on->second), scale = view_.ui_scale;
    if (!(length > 0)) return;
    const glm::dvec2 way = (on->second - on->first) / length;
    for (double t = 0; t < length; t += (kDash + kGap) * scale) {
        const ImVec2 a = to_imgui(on->first + way * t),
                     b = to_imgui(on->first + way * std::min(t + kDash * scale, length));
        list_.AddLine(a, b, kHalo, px(width + 1.4));
        list_.AddLine(a, b, colour, px(width));
    }
}

void PicturePainter::dot(const glm::dvec2& at, double radius, ImU32 colour) const {
    if (!view_.contains(at)) return;  // points close to the camera's plane project beyond the range of a float
    list_.AddCircleFilled(to_imgui(at), px(radius + 1.4), theme::kShade, 24);
    list_.AddCircleFilled(to_imgui(at), px(radius), colour, 24);
}

void PicturePainter::caption(const glm::dvec2& at, const std::string& text, ImU32 colour) const {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const glm::dvec2 pad(px(6), px(3)), room = view_.size - glm::dvec2(size.x, size.y) - 2.0 * pad;
    const glm::dvec2 lo = view_.origin + glm::clamp(at - view_.origin, glm::dvec2(0), glm::max(room, glm::dvec2(0)));
    const glm::dvec2 hi = lo + glm::dvec2(size.x, size.y) + 2.0 * pad;
    list_.AddRectFilled(to_imgui(lo), to_imgui(hi), theme::kVeil, px(3));
    list_.AddText(to_imgui(lo + pad), colour, text.c_str());
}

}  // namespace si
