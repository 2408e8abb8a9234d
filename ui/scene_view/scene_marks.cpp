#include "ui/scene_view/scene_marks.h"

#include <fmt/format.h>

#include "renderer/base/lengths_text.h"
#include "renderer/settings/param.h"
#include "renderer/view/bounds/scene_shape.h"
#include "ui/scene_view/frustum_lines.h"
#include "ui/scene_view/kernel_marks.h"
#include "ui/state/panels.h"
#include "ui/state/selection.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr double kMinTick = 3;  // shortest drawn normal offset, pixels at scale 1

constexpr int kMaxBoxes = 2000;    // largest number of drawn boxes of casters
constexpr int kMaxSelected = 200;  // largest number of drawn boxes of selected objects

void box(const PicturePainter& p, const Box& corners, ImU32 colour, bool thin) {
    for (int i = 0; i < 8; ++i)
        for (int bit = 1; bit < 8; bit <<= 1) {
            if (i & bit) continue;
            const glm::dvec3 &a = corners[std::size_t(i)], &b = corners[std::size_t(i | bit)];
            thin ? p.thin_line(a, b, colour) : p.line(a, b, colour, 1.2);
        }
}

/// Returns the ray of the probe's shadow test for the shown light; nothing if probe and light belong to different
/// frames. @param answer receives the probe's result for the light
std::optional<ProbeRay> shown_ray(const EditorState& state, const EditorFrame& frame, const Probe::PerLight** answer) {
    const FittedLight* const light = frame.result ? shown_fitted_light(state.settings, *frame.result) : nullptr;
    if (!frame.probe || !light) return {};
    for (const Probe::PerLight& p : frame.probe->lights)
        if (p.light == shown_light(state.settings)) {
            *answer = &p;
            return probe_ray(*frame.probe, p, *light);
        }
    return {};
}

/// Returns true if the normal offset is long enough on the screen to be drawn.
bool shows_offset(const PictureView& view, const ProbeRay& ray, const Probe::PerLight& p) {
    const auto surface = view.point(ray.to), moved = view.point(p.offset_position_ws);
    return p.account.receiver.normal_offset_m > 0 && surface && moved &&
           glm::distance(*surface, *moved) > kMinTick * view.ui_scale;
}

bool same_view(const Camera& a, const Camera& b) {
    return glm::distance(a.eye, b.eye) < 1e-3 * a.focus && glm::dot(a.axes[2], b.axes[2]) > 1 - 1e-6;
}

/// Word of a legend with the colour of the stroke in front.
struct LegendWord {
    ImU32 colour;
    const char* word;
};

/// Draws the boxes of the selected objects (with the name of the first) and of the object hovered in the list.
void draw_selection(const PicturePainter& p, const EditorState& state, const Scene& scene) {
    if (!state.objects.hovered.empty())
        if (const Bounds around = bounds_below(scene, state.objects.hovered); !around.empty())
            box(p, around.corners(), theme::kSelected, true);
    int drawn = 0;
    for (const std::string& path : state.selection.others)
        if (drawn < kMaxSelected)
            if (const auto corners = box_of(scene, path)) {
                ++drawn;
                box(p, *corners, theme::kSelected, false);
            }
    const auto corners = box_of(scene, state.selection.first);
    if (!corners) return;
    box(p, *corners, theme::kSelected, false);
    std::optional<glm::dvec2> top;
    for (const glm::dvec3& c : *corners)
        if (const auto at = p.view().point(c); at && (!top || at->y < top->y)) top = at;
    std::string name = last_path_part(state.selection.first);
    if (!state.selection.others.empty()) name += fmt::format(" and {} more", state.selection.others.size());
    if (top) p.caption(*top - glm::dvec2(0, p.px(26)), name, theme::kOnPicture);
}

/// Draws the bounding boxes of casters that the light fit uses, at most kMaxBoxes.
void draw_caster_bounds(const PicturePainter& p, const Scene& scene, const Settings& settings) {
    const SceneShape shape = scene_shape(scene, settings);
    int drawn = 0;
    for (std::size_t i = 0; i < shape.boxes.size() && drawn < kMaxBoxes; ++i)
        if (shape.box_casts[i]) {
            box(p, shape.boxes[i], theme::kBounds, true);
            ++drawn;
        }
}

/// Draws the frustum of the frozen camera, unless the view is the same.
void draw_frozen_camera(const PicturePainter& p, const Camera& frozen) {
    if (same_view(frozen, p.view().camera)) return;
    for (const auto& [from, to, far] : camera_edges(frozen)) p.line(from, to, theme::kFrozen, 1.2);
    if (const auto at = p.view().point(frozen.eye)) p.dot(*at, 4, theme::kFrozen);
}

/// Draws the ray from the shown light to the probed pixel: lit up to the occluder, shadowed behind it.
void draw_probe_ray(const PicturePainter& p, const EditorState& state, const EditorFrame& frame) {
    const Probe::PerLight* answer = nullptr;
    const auto ray = shown_ray(state, frame, &answer);
    if (!ray) return;
    draw_kernel_on_surface(p, *answer);
    p.line(ray->from, ray->occluder, theme::kLit, 2);
    if (ray->blocked) p.line(ray->occluder, ray->to, theme::kShadowed, 2);
    if (const auto at = p.view().point(ray->occluder); ray->blocked && at) {
        p.dot(*at, 4, theme::kShadowed);
        p.list().AddCircle(to_imgui(*at), p.px(4), IM_COL32_WHITE, 20, p.px(1.2));
    }
    if (shows_offset(p.view(), *ray, *answer)) p.line(ray->to, answer->offset_position_ws, theme::kOffset, 1.6);
}

/// Draws captions in the upper right corner: a frozen camera, the view through a light, the colours of the ray.
void draw_captions(const PicturePainter& p, const EditorState& state, const EditorFrame& frame) {
    const PictureView& view = p.view();
    const ImFont& font = *ImGui::GetFont();
    double y = view.origin.y + p.px(8);
    const double right = view.origin.x + view.size.x - p.px(8);
    const auto say = [&](const std::string& text, ImU32 colour) {
        const float width = ImGui::CalcTextSize(text.c_str()).x + p.px(12);
        p.caption({right - width, y}, text, colour);
        y += font.FontSize + p.px(10);
    };
    if (state.settings.camera.source == CameraSource::Light && shown_light(state.settings) >= 0)
        say(fmt::format("Through {}; L goes back", light_title(state.settings, shown_light(state.settings))),
            theme::kLight);
    if (state.frozen) say("Shadow camera frozen", theme::kFrozen);
    if (state.viewport.flight.on)
        say(fmt::format("Flying, speed {}×", digits_text(state.viewport.flight.speed)), theme::kOnPicture);
    if (state.probe_pixel && frame.anchor_place == AnchorPlace::Outside)
        say("Probed point: outside of the picture", theme::kWarningOnPicture);
    if (state.probe_pixel && frame.anchor_place == AnchorPlace::Hidden)
        say("Probed point: hidden by what is probed here", theme::kWarningOnPicture);
    const Probe::PerLight* answer = nullptr;
    const auto ray = shown_ray(state, frame, &answer);
    if (!ray) return;
    std::vector<LegendWord> keys{{theme::kLit, "lit"}};
    if (ray->blocked) keys.push_back({theme::kShadowed, "in shadow"});
    if (shows_offset(view, *ray, *answer)) keys.push_back({theme::kOffset, "normal offset"});
    const float stroke = p.px(14), gap = p.px(5), between = p.px(12);
    float width = p.px(12) - between;
    for (const LegendWord& k : keys) width += stroke + gap + ImGui::CalcTextSize(k.word).x + between;
    ImVec2 at(float(right) - width, float(y));
    p.list().AddRectFilled(at, {float(right), at.y + font.FontSize + p.px(6)}, theme::kVeil, p.px(3));
    at.x += p.px(6);
    at.y += p.px(3);
    for (const LegendWord& k : keys) {
        const float middle = at.y + 0.55f * font.FontSize;
        p.list().AddLine({at.x, middle}, {at.x + stroke, middle}, k.colour, p.px(2));
        p.list().AddText({at.x + stroke + gap, at.y}, theme::kOnPicture, k.word);
        at.x += stroke + gap + ImGui::CalcTextSize(k.word).x + between;
    }
}

}  // namespace

void draw_scene_marks(const PicturePainter& p, const EditorState& state, const EditorFrame& frame) {
    if (frame.scene && state.settings.view.bounds) draw_caster_bounds(p, *frame.scene, state.settings);
    if (frame.scene) draw_selection(p, state, *frame.scene);
    if (state.frozen) draw_frozen_camera(p, state.frozen->camera);
    draw_lights(state, frame, p);
    draw_probe_ray(p, state, frame);
    draw_gnomon(state, p);
    draw_captions(p, state, frame);
}

}  // namespace si
