// Strips over the scene picture with progress and a button to cancel: a scene that is loading, the ray-traced
// reference.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "ui/state/panels.h"

namespace si {
namespace {

std::string loading_text(const LoadingFacts& loading) {
    const std::string name = scene_label(loading.name);
    if (loading.progress >= 1) return fmt::format("Drawing {} for the first time …", name);
    std::string text = fmt::format("Loading {} … {} %", name, int(std::max(loading.progress, 0.0) * 100));
    if (loading.seconds_left > 0) text += fmt::format(", {} left", seconds_text(loading.seconds_left));
    return text;
}

}  // namespace

void draw_loading(const EditorFrame& frame, EditorRequests& requests, float left, float top, float width) {
    if (!frame.loading) return;
    if (progress_strip("loading", left, width, top + ImGui::GetFontSize() * 2, 28, frame.loading->progress,
                       loading_text(*frame.loading)))
        requests.cancel_load = true;
}

std::string reference_status(const EditorFrame& frame) {
    const ReferenceFacts& t = *frame.reference;
    if (!t.doing.empty()) {
        const std::string left = t.seconds_left > 0 ? fmt::format(", {} left", seconds_text(t.seconds_left)) : "";
        return fmt::format("{} … {} %{}", t.doing, int(t.progress * 100), left);
    }
    if (!t.problem.empty() && t.traced_share > 0 && t.traced_share < 1)
        return fmt::format("{}: {} % of the pixels are traced", t.problem, int(t.traced_share * 100));
    if (!t.problem.empty()) return t.problem;
    if (t.lacks_light_map) return "The light map of this scene and light is not baked yet.";
    if (!t.current) return "The reference of this view is not traced yet.";
    std::string text = fmt::format("{} × {} pixels, {:.2f} million rays", t.width, t.height, double(t.rays) * 1e-6);
    if (t.trace_ms > 0) text += fmt::format(", traced in {:.0f} ms", t.build_ms + t.place_ms + t.trace_ms);
    if (!t.noise.empty()) text += ", " + t.noise;
    return text;
}

void draw_tracing(const EditorFrame& frame, EditorRequests& requests, float left, float bottom, float width) {
    if (!frame.reference || frame.reference->current) return;
    const ReferenceFacts& t = *frame.reference;
    const std::optional<double> progress = t.doing.empty() ? std::nullopt : std::optional(t.progress);
    const float top = bottom - ImGui::GetFrameHeight() - 2 * ImGui::GetFontSize();
    if (progress_strip("tracing", left, width, top, 24, progress, reference_status(frame)))
        requests.cancel_reference = true;
}

}  // namespace si
