// Draws lines, marks and captions at places of the world into a scene picture.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <string>

#include "ui/scene_view/picture_view.h"

namespace si {

/// Painter of lines, marks and captions over one scene picture.
class PicturePainter {
public:
    /// @param view, list outlive the painter
    PicturePainter(const PictureView& view, ImDrawList& list) : view_(view), list_(list) {}

    /// Returns the placement of the picture that is painted over.
    const PictureView& view() const { return view_; }
    /// Returns the ImGui draw list that receives the drawing.
    ImDrawList& list() const { return list_; }
    /// Converts a length from pixels at a UI scale of 1 to pixels of the screen.
    float px(double units) const { return float(units * view_.ui_scale); }

    /// Draws a line between two points of the world over the picture, with a dark edge, visible on any background.
    /// @param from, to the ends, world @param width pixels at a UI scale of 1
    void line(const glm::dvec3& from, const glm::dvec3& to, ImU32 colour, double width = 1.4) const;
    /// Draws a line between two points of the world over the picture, one pixel wide and without the dark edge of
    /// line(). For many or faint lines. @param from, to the ends, world
    void thin_line(const glm::dvec3& from, const glm::dvec3& to, ImU32 colour) const;
    /// Draws a dashed line between two points of the world over the picture.
    /// @param from, to the ends, world @param width pixels at a UI scale of 1
    void dashes(const glm::dvec3& from, const glm::dvec3& to, ImU32 colour, double width = 1.2) const;
    /// Draws a filled circle over the picture.
    /// @param at the centre, pixels of the screen @param radius pixels at a UI scale of 1
    void dot(const glm::dvec2& at, double radius, ImU32 colour) const;

    /// Draws text on a dark background over the picture. Text that would leave the picture is moved into it.
    /// @param at upper left corner of the text, pixels of the screen
    void caption(const glm::dvec2& at, const std::string& text, ImU32 colour) const;

private:
    /// Projects a line segment in world space to the screen, and clips it a few pixels outside the rectangle of the
    /// picture. Occluders are ignored. Returns the ends in pixels of the screen; nothing if all of the segment is
    /// outside.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> visible(const glm::dvec3& from, const glm::dvec3& to) const;

    const PictureView& view_;
    ImDrawList& list_;
};

inline ImVec2 to_imgui(const glm::dvec2& p) {
    return {float(p.x), float(p.y)};
}

/// Returns ImGui's handle of a texture.
inline ImTextureID texture_id(unsigned texture) {
    return reinterpret_cast<ImTextureID>(std::uintptr_t(texture));
}

/// Returns the colour with another alpha, 0..255.
constexpr ImU32 faded(ImU32 colour, unsigned alpha) {
    return (colour & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT);
}

}  // namespace si
