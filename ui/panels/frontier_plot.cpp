#include "ui/panels/frontier_plot.h"

#include <algorithm>
#include <string>
#include <vector>

#include "ui/widgets/log_axis.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr ImU32 kBest = IM_COL32(86, 180, 233, 255), kBeaten = IM_COL32(120, 120, 118, 150),
                kStair = IM_COL32(86, 180, 233, 110);

struct Area {
    ImVec2 lo, hi;  ///< corners of the area inside the axes, pixels
    LogAxis x, y;
    ImVec2 at(const Dot& dot) const {
        return {lo.x + float(x.position(dot.cost)) * (hi.x - lo.x),
                hi.y - float(y.position(dot.error)) * (hi.y - lo.y)};
    }
};

void draw_axes(const Area& a) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float line = theme::small()->FontSize;
    float free_x = a.lo.x;
    for (const LogAxis::Tick& t : a.x.ticks) {
        const float x = a.lo.x + float(a.x.position(t.value)) * (a.hi.x - a.lo.x),
                    w = text_width(t.text, theme::small());
        list.AddLine({x, a.lo.y}, {x, a.hi.y}, theme::line());
        const float left = std::clamp(x - 0.5f * w, a.lo.x, a.hi.x - w);
        if (t.text.empty() || left < free_x) continue;
        small_text({left, a.hi.y + line * 0.1f}, t.text, theme::muted());
        free_x = left + w + line * 0.6f;
    }
    float free_y = a.hi.y + line;
    for (const LogAxis::Tick& t : a.y.ticks) {
        const float y = a.hi.y - float(a.y.position(t.value)) * (a.hi.y - a.lo.y);
        list.AddLine({a.lo.x, y}, {a.hi.x, y}, theme::line());
        const float top = std::clamp(y - 0.5f * line, a.lo.y, a.hi.y - line);
        if (t.text.empty() || top + line > free_y) continue;
        small_text({a.lo.x - text_width(t.text, theme::small()) - line * 0.3f, top}, t.text, theme::muted());
        free_y = top - line * 0.2f;
    }
    list.AddRect(a.lo, a.hi, theme::line());
}

void draw_stair(const Area& a, const std::vector<FrontierView::Mark>& marks) {
    std::vector<ImVec2> best;
    for (const auto& m : marks)
        if (m.on && !m.tied) best.push_back(a.at(m.dot));
    if (best.empty()) return;
    std::sort(best.begin(), best.end(), [](ImVec2 p, ImVec2 q) { return p.x != q.x ? p.x < q.x : p.y > q.y; });
    std::vector<ImVec2> path = {{best[0].x, a.lo.y}, best[0]};
    for (std::size_t i = 1; i < best.size(); ++i) {
        path.push_back({best[i].x, best[i - 1].y});
        path.push_back(best[i]);
    }
    path.push_back({a.hi.x, best.back().y});
    ImGui::GetWindowDrawList()->AddPolyline(path.data(), int(path.size()), kStair, 0, ImGui::GetFontSize() * 0.1f);
}

/// Draws the names of the frontier's dots where they fit.
void draw_names(const Area& a, const SweepFacts& facts) {
    const float line = theme::small()->FontSize, gap = line * 0.55f;
    struct Box {
        ImVec2 lo, hi;
    };
    std::vector<Box> taken;
    for (const auto& m : facts.view.marks) {
        const ImVec2 p = a.at(m.dot);
        taken.push_back({{p.x - gap, p.y - gap}, {p.x + gap, p.y + gap}});
    }
    for (const auto& m : facts.view.marks) {
        if (!m.on || m.tied) continue;
        const std::string& name = facts.cases[m.of].name;
        const ImVec2 p = a.at(m.dot);
        const float w = text_width(name, theme::small());
        const ImVec2 places[] = {{p.x + gap, p.y - line - gap * 0.3f},
                                 {p.x + gap, p.y - line * 0.5f},
                                 {p.x + gap, p.y + gap * 0.3f},
                                 {p.x - gap - w, p.y + gap * 0.3f},
                                 {p.x - gap - w, p.y - line - gap * 0.3f}};
        for (const ImVec2 lo : places) {
            const ImVec2 hi(lo.x + w, lo.y + line);
            const bool inside = lo.x >= a.lo.x && hi.x <= a.hi.x && lo.y >= a.lo.y && hi.y <= a.hi.y;
            const bool free = std::none_of(taken.begin(), taken.end(), [&](const Box& b) {
                return lo.x < b.hi.x && b.lo.x < hi.x && lo.y < b.hi.y && b.lo.y < hi.y;
            });
            if (!inside || !free) continue;
            taken.push_back({lo, hi});
            ImGui::GetWindowDrawList()->AddRectFilled(lo, hi, theme::well());  // hides the stair behind the name
            small_text(lo, name, theme::text());
            break;
        }
    }
}

void draw_marks(const Area& a, const SweepFacts& facts, std::optional<int> chosen) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float r = ImGui::GetFontSize() * 0.26f;
    for (const bool on : {false, true})
        for (const auto& m : facts.view.marks) {
            if (m.on != on) continue;
            const ImVec2 p = a.at(m.dot);
            if (on && m.dot.cost_noise > 0) {
                const Dot left{.cost = std::max(m.dot.cost - m.dot.cost_noise, a.x.low), .error = m.dot.error};
                const Dot right{.cost = m.dot.cost + m.dot.cost_noise, .error = m.dot.error};
                list.AddLine(a.at(left), a.at(right), kStair, 1);
            }
            list.AddCircleFilled(p, r, on ? kBest : kBeaten, 16);
            if (m.tied) list.AddCircle(p, r * 1.7f, kStair, 16);
            if (chosen == facts.cases[m.of].number) list.AddCircle(p, r * 2.1f, theme::text(), 20, r * 0.3f);
        }
    if (!facts.view.present) return;
    const float d = r * 1.5f;
    const auto diamond = [&](ImVec2 p, ImU32 inside, ImU32 edge) {
        const ImVec2 corners[] = {{p.x, p.y - d}, {p.x + d, p.y}, {p.x, p.y + d}, {p.x - d, p.y}};
        list.AddConvexPolyFilled(corners, 4, inside);
        list.AddPolyline(corners, 4, edge, ImDrawFlags_Closed, r * 0.3f);
    };
    const ImVec2 now = a.at(*facts.view.present);
    if (facts.view.before) {
        const ImVec2 before = a.at(*facts.view.before);
        list.AddLine(before, now, theme::accent(), r * 0.3f);
        diamond(before, theme::well(), theme::accent());
    }
    diamond(now, theme::accent(), theme::well());
}

}  // namespace

FrontierPlotResult draw_frontier_plot(const SweepFacts& facts, bool bytes, std::optional<int> chosen, ImVec2 size) {
    FrontierPlotResult out;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("plot", size);
    const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
    std::vector<double> costs, errors;
    for (const auto& m : facts.view.marks) {
        costs.push_back(m.dot.cost);
        errors.push_back(m.dot.error);
    }
    for (const auto& dot : {facts.view.present, facts.view.before})
        if (dot) {
            costs.push_back(dot->cost);
            errors.push_back(dot->error);
        }
    Area a{.x = log_axis(costs, bytes), .y = log_axis(errors)};
    const float line = theme::small()->FontSize;
    float numbers = line;
    for (const LogAxis::Tick& t : a.y.ticks) numbers = std::max(numbers, text_width(t.text, theme::small()));
    a.lo = {corner.x + numbers + line * 0.5f, corner.y + line * 0.2f};
    a.hi = {corner.x + size.x - line * 0.3f, corner.y + size.y - line * 1.3f};
    if (a.hi.x < a.lo.x + line * 4 || a.hi.y < a.lo.y + line * 2) return out;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
    list.AddRectFilled(a.lo, a.hi, theme::well());
    draw_axes(a);
    draw_stair(a, facts.view.marks);
    draw_marks(a, facts, chosen);
    draw_names(a, facts);
    list.PopClipRect();
    if (!hovered) return out;

    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const auto apart = [&](const Dot& dot) {
        const ImVec2 p = a.at(dot);
        return (p.x - mouse.x) * (p.x - mouse.x) + (p.y - mouse.y) * (p.y - mouse.y);
    };
    float least = line * line * 1.6f;
    for (const auto& m : facts.view.marks)
        if (const float d = apart(m.dot); d < least) {
            least = d;
            out.hovered = m.of;
        }
    if (facts.view.present && apart(*facts.view.present) < least) {
        out.hovered.reset();
        out.present_hovered = true;
    }
    if (out.hovered) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        if (clicked) out.clicked = out.hovered;
    }
    return out;
}

}  // namespace si
