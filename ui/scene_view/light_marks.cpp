#include "ui/scene_view/light_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/base/directions.h"
#include "renderer/base/index_of.h"
#include "shaders/shared/colours.h"
#include "ui/scene_view/frustum_lines.h"
#include "ui/state/panels.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr ImU32 kHot = IM_COL32_WHITE;
constexpr int kRimSegments = 64;
constexpr int kIdleOpacity = 70;  ///< opacity of lines while the light is not hovered, of 255
// Distance of the pointer to a light outside from the picture's edges, pixels at scale 1.
constexpr double kEdge = 12, kCaptionEdge = 42;

std::string_view help(LightHandle h, LightType type) {
    const bool directional = type == LightType::Directional;
    if (h == LightHandle::Position)
        return directional ? "Moves the light and its target across the line of sight."
                           : "Moves the light across the line of sight; it keeps looking at its target.";
    if (is_axis(h)) return "Moves the light along this axis.";
    if (h == LightHandle::Direction)
        return directional ? "Turns the light about its target." : "Turns the light where it stands.";
    if (h == LightHandle::Target)
        return directional ? "Moves what the light turns about, and the light with it."
                           : "Moves what the light looks at; the light stays.";
    if (h == LightHandle::Range) return "Where the light has faded to nothing; light.range 0 is unlimited.";
    if (h == LightHandle::Near) return "Casters nearer to the light than this are lost.";
    if (h == LightHandle::Far) return "Where the map ends.";
    return is_cone(h) ? "Opening angle of the spot light." : "Half the width of the map.";
}

void diamond(const PicturePainter& p, const glm::dvec2& at, double radius, ImU32 colour) {
    const auto shape = [&](double r, ImU32 c) {
        const float x = float(at.x), y = float(at.y), d = p.px(r);
        p.list().AddQuadFilled({x, y - d}, {x + d, y}, {x, y + d}, {x - d, y}, c);
    };
    shape(radius + 2, theme::kShade);
    shape(radius, colour);
}

void square(const PicturePainter& p, const glm::dvec2& at, double half, ImU32 colour) {
    const auto shape = [&](double r, ImU32 c) {
        const float x = float(at.x), y = float(at.y), d = p.px(r);
        p.list().AddRectFilled({x - d, y - d}, {x + d, y + d}, c);
    };
    shape(half + 1.4, theme::kShade);
    shape(half, colour);
}

/// Draws a triangle with its tip at `at`.
void arrow_head(const PicturePainter& p, const glm::dvec2& at, const glm::dvec2& way, double size, ImU32 colour) {
    if (!(glm::length(way) > 0)) return;
    const glm::dvec2 along = glm::normalize(way), aside(-along.y, along.x);
    const double s = p.px(size);
    const ImVec2 tip = to_imgui(at), a = to_imgui(at - s * along + 0.45 * s * aside),
                 b = to_imgui(at - s * along - 0.45 * s * aside);
    p.list().AddTriangleFilled(tip, a, b, colour);
    p.list().AddTriangle(tip, a, b, theme::kShade, p.px(1));
}

/// Draws the circle of radius |u| = |v| about a point.
void draw_circle(const PicturePainter& p, const glm::dvec3& centre, const glm::dvec3& u, const glm::dvec3& v,
                 ImU32 colour) {
    const auto at = [&](int i) {
        const double turn = 2 * std::numbers::pi * i / kRimSegments;
        return centre + std::cos(turn) * u + std::sin(turn) * v;
    };
    for (int i = 0; i < kRimSegments; ++i) p.line(at(i), at(i + 1), colour, 1.2);
}

/// Draws the circle in which a spot light's cone leaves the sphere of this radius.
void draw_rim(const PicturePainter& p, const LightPose& pose, double radius, ImU32 colour) {
    const double half = half_cone_rad(pose.settings);
    const glm::dmat3 axes = orthonormal_basis(pose.to_light) * (radius * std::sin(half));
    draw_circle(p, pose.position - radius * std::cos(half) * pose.to_light, axes[0], axes[1], colour);
}

void draw_range(const PicturePainter& p, const LightPose& pose) {
    const ImU32 colour = faded(theme::kLight, 120);
    const double range = pose.settings.range;
    if (pose.type == LightType::Spot) return draw_rim(p, pose, range, colour);
    const glm::dmat3 axes = orthonormal_basis(pose.to_light) * range;
    for (int i = 0; i < 3; ++i) draw_circle(p, pose.position, axes[i], axes[(i + 1) % 3], colour);
}

}  // namespace

std::optional<glm::dvec2> pointer_place(const LightPose& pose, const PictureView& view) {
    const auto seen = view.point(pose.position);
    if (seen && view.contains(*seen)) return {};
    const glm::dvec3 v = glm::transpose(view.camera.axes) * (pose.position - view.camera.eye);
    // Captions are along the upper edge.
    const glm::dvec2 lo = view.origin + glm::dvec2(kEdge, kCaptionEdge) * view.ui_scale;
    const glm::dvec2 hi = view.origin + view.size - kEdge * view.ui_scale, middle = 0.5 * (lo + hi);
    glm::dvec2 way = seen ? *seen - middle : glm::dvec2(v.x, -v.y);
    if (!(glm::length(way) > 0) || !std::isfinite(glm::length(way))) return {};
    way = glm::normalize(way);
    const glm::dvec2 room = 0.5 * (hi - lo);
    const double across = way.x != 0 ? std::abs(room.x / way.x) : std::numeric_limits<double>::infinity();
    const double upwards = way.y != 0 ? std::abs(room.y / way.y) : std::numeric_limits<double>::infinity();
    return middle + std::min(across, upwards) * way;
}

void draw_shown_light(const PicturePainter& p, const LightPose& pose, bool busy, bool pointer_hovered) {
    const int near_alpha = busy ? 220 : kIdleOpacity, far_alpha = busy ? 110 : kIdleOpacity / 2;
    for (std::size_t i = 0; i < pose.cascades.size(); ++i)
        for (const Segment& s : frustum_edges(pose.cascades[i]))
            p.line(s.from, s.to, faded(theme::colour(shared::view_colour(int(i))), s.far ? far_alpha : near_alpha));
    if (pose.has_map && !pose.cascaded())
        for (const Segment& s : frustum_edges(pose.view))
            p.line(s.from, s.to, faded(theme::kLight, s.far ? far_alpha : near_alpha));
    if (pose.type == LightType::Spot) draw_rim(p, pose, cone_rim_distance(pose), faded(theme::kLight, near_alpha));
    if (pose.ranged()) draw_range(p, pose);
    const PictureView& view = p.view();
    if (const auto at = pointer_place(pose, view))
        arrow_head(p, *at, *at - view.origin - 0.5 * view.size, 12, pointer_hovered ? kHot : theme::kLight);
}

void draw_other_light(const PicturePainter& p, const LightPose& pose, const FittedLight& fitted, bool hovered) {
    if (pose.has_map && fitted.chooser.choice != ViewChoice::Face)
        for (const LightView& view : fitted.views)
            for (const Segment& s : frustum_edges(view))
                p.thin_line(s.from, s.to, faded(theme::kLight, hovered ? 120 : 55));
    if (const auto at = p.view().point(pose.position))
        p.dot(*at, hovered ? 5.5 : 4, faded(theme::kLight, hovered ? 255 : 150));
}

void draw_handles(const PicturePainter& p, const LightPose& pose, std::optional<LightHandle> hovered) {
    const PictureView& view = p.view();
    const glm::dvec3 tip = handle_position(pose, LightHandle::Direction, view);
    if (pose.type == LightType::Spot) {
        p.dashes(pose.position, pose.target, faded(theme::kLight, 150), 1);
        p.line(pose.position, tip, theme::kLight);
    } else if (pose.type == LightType::Directional) {
        p.line(tip, pose.target, theme::kLight);
    }
    for (const PlacedHandle& h : place_handles(pose, view)) {
        const bool hot = hovered == h.handle;
        const double more = hot ? 1.5 : 0;
        const ImU32 colour = hot ? kHot : theme::kLight;
        const auto way_from = [&](const glm::dvec3& from) {
            return h.on_screen - view.point(from).value_or(h.on_screen);
        };
        if (is_axis(h.handle)) {
            const ImU32 axis = theme::kAxes[index_of(h.handle) - index_of(LightHandle::AxisX)];
            p.line(pose.position, h.at, hot ? kHot : axis, 1.6);
            arrow_head(p, h.on_screen, way_from(pose.position), 10 + 2 * more, hot ? kHot : axis);
        } else if (h.handle == LightHandle::Direction) {
            const bool spot = pose.type == LightType::Spot;
            arrow_head(p, h.on_screen, (spot ? 1.0 : -1.0) * way_from(spot ? pose.position : pose.target),
                       13 + 2 * more, colour);
        } else if (h.handle == LightHandle::Target) {
            p.list().AddCircle(to_imgui(h.on_screen), p.px(5.5 + more), theme::kShade, 24, p.px(3.6));
            p.list().AddCircle(to_imgui(h.on_screen), p.px(5.5 + more), colour, 24, p.px(1.6));
        } else if (is_extent(h.handle)) {
            square(p, h.on_screen, 3.5 + more, colour);
        } else if (is_cone(h.handle) || h.handle == LightHandle::Range) {
            p.dot(h.on_screen, 3.8 + more, colour);
        } else if (h.handle != LightHandle::Position) {
            diamond(p, h.on_screen, 5.5 + more, colour);
        }
    }
    // The light is drawn over its arrows.
    if (const auto at = view.point(pose.position)) {
        const bool hot = hovered == LightHandle::Position;
        p.dot(*at, hot ? 7 : 5.5, hot ? kHot : theme::kLight);
    }
}

void draw_numbers(const PicturePainter& p, const LightPose& pose, LightHandle handle, MapSize map_size) {
    const auto at = p.view().point(handle_position(pose, handle, p.view()));
    if (!at) return;
    std::string text = fmt::format("{}   {}", handle_name(handle), handle_numbers(pose, handle));
    if (is_extent(handle) && map_size.shortest() > 0)
        text += fmt::format("   texel {}", metres_text(pose.view.texel_size(1, map_size)));
    p.caption(*at + glm::dvec2(p.px(14), p.px(10)), text, theme::kOnPicture);
}

void handle_tooltip(const LightPose& pose, LightHandle handle) {
    ImGui::BeginTooltip();
    ImGui::Text("%s   %s", std::string(handle_name(handle)).c_str(), handle_numbers(pose, handle).c_str());
    ImGui::PushStyleColor(ImGuiCol_Text, theme::muted());
    ImGui::TextUnformatted(std::string(help(handle, pose.type)).c_str());
    ImGui::Text("Drag, with Ctrl in steps; %s: as before the drag", key_text(Command::CancelHandleDrag));
    ImGui::PopStyleColor();
    ImGui::EndTooltip();
}

}  // namespace si
