// Draws lines, marks and captions at places of the world into a scene picture.
#pragma once

#include <imgui.h>

#include <string>

#include "ui/scene_view/picture_view.h"

namespace si {

class PicturePainter {
public:
    /// Both must outlive the painter.
    PicturePainter(const PictureView& view, ImDrawList& list) : view_(view), list_(list) {}

    const PictureView& view() const { return view_; }
    ImDrawList& list() const { return list_; }
    /// Pixels of the screen that are `units` at scale 1.
    float px(double units) const { return float(units * view_.ui_scale); }

    /// A line with a dark edge, so that it shows on any picture; `width` at scale 1.
    void line(const glm::dvec3& from, const glm::dvec3& to, ImU32 colour, double width = 1.4) const;
    /// A line without an edge: for many, or for faint ones.
    void thin_line(const glm::dvec3& from, const glm::dvec3& to, ImU32 colour) const;
    void dashes(const glm::dvec3& from, const glm::dvec3& to, ImU32 colour, double width = 1.2) const;
    void dot(const glm::dvec2& at, double radius, ImU32 colour) const;

    /// Text on a dark veil with its upper left corner at `at`, moved as far as it takes to stay in the picture.
    void caption(const glm::dvec2& at, const std::string& text, ImU32 colour) const;

private:
    /// The part of a segment that is seen, pixels.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> visible(const glm::dvec3& from, const glm::dvec3& to) const;

    const PictureView& view_;
    ImDrawList& list_;
};

inline ImVec2 to_imgui(const glm::dvec2& p) {
    return {float(p.x), float(p.y)};
}

/// The same hue, `alpha` of 255 as opaque.
constexpr ImU32 faded(ImU32 colour, unsigned alpha) {
    return (colour & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT);
}

}  // namespace si
