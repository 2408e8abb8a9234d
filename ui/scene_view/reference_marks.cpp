// Progress of the ray-traced reference, and the legend of the artefact overlay.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "renderer/reference/artefact_picture.h"
#include "renderer/reference/live_error.h"
#include "ui/state/panels.h"
#include "ui/widgets/theme.h"

namespace si {

std::string reference_status(const EditorFrame& frame) {
    const ReferenceFacts& t = *frame.reference;
    if (!t.doing.empty()) return fmt::format("{} … {} %", t.doing, int(t.progress * 100));
    if (!t.problem.empty()) return t.problem;
    if (t.lacks_light_map) return "The light map of this scene and light is not baked yet.";
    if (!t.current) return "The reference of this view is not traced yet.";
    std::string text = fmt::format("{} × {} pixels, {:.2f} million rays", t.width, t.height, double(t.rays) * 1e-6);
    if (t.trace_ms > 0) text += fmt::format(", traced in {:.0f} ms", t.build_ms + t.place_ms + t.trace_ms);
    if (!t.noise.empty()) text += ", " + t.noise;
    return text;
}

void draw_artefact_legend(const LiveError* error, float left, float bottom, float room) {
    const float em = ImGui::GetFontSize(), pad = em * 0.6f, line = em * 1.25f;
    struct Line {
        ImU32 colour;
        std::string label, count;
    };
    std::vector<Line> lines;
    const auto count_of = [&](std::size_t pixels) {
        const std::size_t n = error->metrics.counted;
        return n == 0 ? std::string("0") : fmt::format("{}   {:.2f} %", pixels, 100.0 * double(pixels) / double(n));
    };
    // Causes without a pixel are left out, because fourteen lines would hide a quarter of a small picture.
    for (const ArtefactStyle& style : artefact_styles())
        if (!error || error->metrics.artefacts[std::size_t(style.artefact)] > 0)
            lines.push_back({theme::rgb(style.rgb), std::string(style.label),
                             error ? count_of(error->metrics.artefacts[std::size_t(style.artefact)]) : ""});
    if (lines.empty()) lines.push_back({theme::kVeil, "No artefacts", ""});
    float label_width = 0, count_width = 0;
    for (const Line& l : lines) {
        label_width = std::max(label_width, ImGui::CalcTextSize(l.label.c_str()).x);
        count_width = std::max(count_width, ImGui::CalcTextSize(l.count.c_str()).x);
    }
    const bool counts = error && em * 3 + label_width + count_width + 2 * pad < room - em;
    const float width = em * 1.2f + label_width + (counts ? em * 1.2f + count_width : 0) + 2 * pad;
    const float height = line * float(lines.size()) + 1.2f * pad;
    const ImVec2 hi(left + em * 0.6f + width, bottom - em * 0.6f), lo(left + em * 0.6f, hi.y - height);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(lo, hi, theme::kVeil, em * 0.25f);
    float y = lo.y + 0.6f * pad;
    for (const Line& l : lines) {
        list.AddRectFilled({lo.x + pad, y + em * 0.2f}, {lo.x + pad + em * 0.75f, y + em * 0.95f}, l.colour);
        list.AddText({lo.x + pad + em * 1.2f, y}, theme::kOnPicture, l.label.c_str());
        if (counts)
            list.AddText({hi.x - pad - ImGui::CalcTextSize(l.count.c_str()).x, y}, theme::kMutedOnPicture,
                         l.count.c_str());
        y += line;
    }
}

void draw_tracing(const EditorFrame& frame, EditorRequests& requests, float left, float bottom, float width) {
    if (!frame.reference || frame.reference->current) return;
    const float em = ImGui::GetFontSize(), pad = em * 0.5f;
    const float wide = std::min(width - 2 * pad, em * 24);
    const ReferenceFacts& t = *frame.reference;
    const std::optional<double> progress = t.doing.empty() ? std::nullopt : std::optional(t.progress);
    if (progress_strip("tracing", left + (width - wide) / 2, bottom - ImGui::GetFrameHeight() - 4 * pad, wide, progress,
                       reference_status(frame)))
        requests.cancel_reference = true;
}

}  // namespace si
