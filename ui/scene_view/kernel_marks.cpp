#include "ui/scene_view/kernel_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/reference/artefact_picture.h"
#include "ui/state/panels.h"
#include "ui/widgets/quantity_text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

/// Returns the colour of self-shadowed taps: that of acne in the artefact overlay.
ImU32 self_shadow() {
    return theme::rgb(artefact_styles()[std::size_t(Artefact::Acne) - 1].rgb);
}

/// Texts of KernelTap::Meets.
constexpr const char* kMeets[] = {"nothing was drawn there", "the surface itself", "a surface nearer to the light",
                                  "a surface farther from the light"};

void tooltip(const KernelTap& t) {
    const std::string text = fmt::format(
        "texel {}, {}: {}\n"
        "stored    {:.8f}   {}   {}\n"
        "compared  {:.8f}\n"
        "own plane {:.8f}\n"
        "weighs {} of the kernel",
        t.texel.x, t.texel.y, t.lit ? "passes, lit" : "fails, in shadow", t.stored, metres_text(t.stored_m),
        kMeets[int(t.meets)], t.compared, t.plane, percent_text(t.weight));
    ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

double heaviest_tap(const Probe::PerLight& light) {
    double most = 0;
    for (const KernelTap& t : light.taps) most = std::max(most, t.weight);
    return most;
}

ImU32 tap_colour(const KernelTap& t, double heaviest) {
    const ImU32 colour = t.lit ? theme::kLit : t.meets == KernelTap::Meets::Own ? self_shadow() : theme::kShadowed;
    const double share = heaviest > 0 ? t.weight / heaviest : 1;
    return faded(colour, unsigned(70 + 185 * std::clamp(share, 0.0, 1.0)));
}

void draw_tap_grid(const Probe::PerLight& p, float side) {
    const int n = std::max({p.taps_size.x, p.taps_size.y, 1});
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("taps", {side, side});
    if (p.taps.empty()) return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + side, at.y + side}, theme::well());
    const float cell = side / float(n), gap = cell > 8 ? 1.0f : 0.0f;
    const double heaviest = heaviest_tap(p);
    const KernelTap* hovered = nullptr;
    for (const KernelTap& t : p.taps) {
        const glm::ivec2 place = t.texel - p.taps_first;
        const ImVec2 lo(at.x + float(place.x) * cell, at.y + float(n - 1 - place.y) * cell);
        const ImVec2 hi(lo.x + cell - gap, lo.y + cell - gap);
        list.AddRectFilled(lo, hi, tap_colour(t, heaviest));
        if (ImGui::IsItemHovered() && ImGui::IsMouseHoveringRect(lo, {lo.x + cell, lo.y + cell})) {
            list.AddRect(lo, hi, IM_COL32_WHITE, 0, 0, 2);
            hovered = &t;
        }
    }
    if (hovered) tooltip(*hovered);
}

void draw_tap_key() {
    const std::array<std::pair<ImU32, const char*>, 3> keys{
        {{theme::kLit, "lit"}, {theme::kShadowed, "in shadow"}, {self_shadow(), "self-shadowed"}}};
    const float em = theme::small()->FontSize;
    ImGui::PushFont(theme::small());
    ImGui::BeginGroup();
    for (const auto& [colour, word] : keys) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled({at.x, at.y + em * 0.2f}, {at.x + em * 0.8f, at.y + em}, colour);
        list.AddRect({at.x, at.y + em * 0.2f}, {at.x + em * 0.8f, at.y + em}, theme::muted());
        ImGui::Dummy({em * 1.1f, em});
        ImGui::SameLine(0, 0);
        ImGui::TextUnformatted(word);
    }
    ImGui::EndGroup();
    ImGui::PopFont();
}

void draw_kernel_on_surface(const PicturePainter& painter, const Probe::PerLight& p) {
    if (p.taps.empty() || std::size_t(p.face) >= p.fitted.views.size() || !faces_light(p.account.receiver.n_dot_l))
        return;
    const LightView& view = p.fitted.views[std::size_t(p.face)];
    const auto corner = [&](const glm::ivec2& texel) {
        const glm::dvec2 uv = glm::dvec2(texel) / p.account.map_size.texels();
        return view.position_ws(uv, view.curve.curve_at_row(uv.y).distance(p.account.plane.depth_at(uv)));
    };
    const double heaviest = heaviest_tap(p);
    for (const KernelTap& t : p.taps) {
        const std::array<glm::dvec3, 4> ws{corner(t.texel), corner(t.texel + glm::ivec2(1, 0)),
                                           corner(t.texel + glm::ivec2(1, 1)), corner(t.texel + glm::ivec2(0, 1))};
        std::array<ImVec2, 4> at;
        bool seen = true;
        for (std::size_t i = 0; i < 4 && seen; ++i) {
            const auto point = painter.view().point(ws[i]);
            seen = point && std::abs(point->x) < 1e6 && std::abs(point->y) < 1e6;
            if (seen) at[i] = to_imgui(*point);
        }
        if (!seen) continue;
        const ImU32 colour = tap_colour(t, heaviest);
        painter.list().AddQuadFilled(at[0], at[1], at[2], at[3], faded(colour, 90));
        painter.list().AddQuad(at[0], at[1], at[2], at[3], faded(colour, 230), painter.px(1));
    }
}

}  // namespace si
