// Axes of the world in a corner of the scene picture. A click on an end looks along that axis.
#include <algorithm>
#include <array>

#include "ui/scene_view/camera_gesture.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/scene_view/scene_marks.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr double kReach = 28, kCorner = 44, kLetterDisc = 7.5, kPlainDisc = 5, kHit = 8;  // pixels at scale 1
constexpr double kMinPictureWidth = 390;  // smallest picture with axes, pixels at scale 1

struct AxisEnd {
    int axis = 0;
    bool positive = true;
    glm::dvec2 at{0};
    double towards = 0;  ///< -1 away from the viewer to 1 towards
};

bool is_shown(const EditorState& state, const PictureView& view) {
    return state.settings.view.axes && view.size.x >= kMinPictureWidth * view.ui_scale;
}

/// Returns the place of the axes: the lower right corner of the picture, above what the open strip covers.
glm::dvec2 middle(const EditorState& state, const PictureView& view) {
    const ScreenRect& pictures = state.shots.scene_rect;
    const double end = pictures.size.y > 0 ? pictures.lo.y + pictures.size.y - state.viewport.covered : 1e9;
    const glm::dvec2 corner = view.origin + view.size;
    return glm::dvec2(corner.x, std::min(corner.y, end)) - kCorner * view.ui_scale;
}

/// Returns the ends of the axes from the farthest to the nearest.
std::array<AxisEnd, 6> axis_ends(const EditorState& state, const PictureView& view) {
    std::array<AxisEnd, 6> ends;
    for (int i = 0; i < 6; ++i) {
        AxisEnd& e = ends[std::size_t(i)];
        e.axis = i / 2;
        e.positive = i % 2 == 0;
        const glm::dvec3 way = (e.positive ? 1.0 : -1.0) * glm::dmat3(1.0)[e.axis];
        const glm::dvec3 seen = glm::transpose(view.camera.axes) * way;
        e.at = middle(state, view) + kReach * view.ui_scale * glm::dvec2(seen.x, -seen.y);
        e.towards = seen.z;
    }
    std::sort(ends.begin(), ends.end(), [](const AxisEnd& a, const AxisEnd& b) { return a.towards < b.towards; });
    return ends;
}

std::optional<AxisEnd> end_under(const EditorState& state, const PictureView& view, const glm::dvec2& mouse) {
    std::optional<AxisEnd> found;
    for (const AxisEnd& e : axis_ends(state, view))
        if (glm::distance(e.at, mouse) <= kHit * view.ui_scale) found = e;
    return found;
}

}  // namespace

void steer_gnomon(EditorState& state, const EditorFrame& frame, const PictureView& view) {
    const glm::dvec2 mouse(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
    state.viewport.hovered_axis = {};
    if (!is_shown(state, view)) return;
    if (state.viewport.press_taken || !ImGui::IsItemHovered() || (ImGui::IsItemActive() && !ImGui::IsItemActivated()))
        return;
    const auto end = end_under(state, view, mouse);
    if (!end) return;
    state.viewport.hovered_axis = "xyz"[end->axis];
    ImGui::SetTooltip("Look along %c from its %s side", "xyz"[end->axis], end -> positive ? "positive" : "negative");
    if (!ImGui::IsItemActivated() || !ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
    state.viewport.press_taken = true;
    take_camera(state, frame);
    look_along_axis(state.settings.camera, end->axis, end->positive);
}

void draw_gnomon(const EditorState& state, const PicturePainter& p) {
    const PictureView& view = p.view();
    if (!is_shown(state, view)) return;
    ImDrawList& list = p.list();
    const ImVec2 centre = to_imgui(middle(state, view));
    if (state.viewport.hovered_axis) list.AddCircleFilled(centre, p.px(kReach + 12), IM_COL32(255, 255, 255, 16), 48);
    ImFont* font = theme::small();
    for (const AxisEnd& e : axis_ends(state, view)) {
        const double shade = 0.55 + 0.45 * 0.5 * (e.towards + 1);
        const ImU32 colour = faded(theme::kAxes[e.axis], unsigned(255 * shade));
        const ImVec2 at = to_imgui(e.at);
        if (!e.positive) {
            list.AddCircleFilled(at, p.px(kPlainDisc + 1), IM_COL32(0, 0, 0, 110), 20);
            list.AddCircle(at, p.px(kPlainDisc), faded(colour, 150), 20, p.px(1.2));
            continue;
        }
        list.AddLine(centre, at, IM_COL32(0, 0, 0, 130), p.px(3.6));
        list.AddLine(centre, at, colour, p.px(1.8));
        list.AddCircleFilled(at, p.px(kLetterDisc + 1), IM_COL32(0, 0, 0, 130), 24);
        list.AddCircleFilled(at, p.px(kLetterDisc), colour, 24);
        const char letter[2] = {"xyz"[e.axis], 0};
        const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e9f, 0, letter);
        list.AddText(font, font->FontSize, {at.x - 0.5f * size.x, at.y - 0.55f * size.y}, IM_COL32(16, 16, 17, 255),
                     letter);
    }
}

}  // namespace si
