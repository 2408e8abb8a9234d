// Strip over the scene picture while another scene is loading: name, progress and a button to cancel.
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
    const float em = ImGui::GetFontSize(), pad = em * 0.5f;
    const float wide = std::min(width - 2 * pad, em * 28);
    if (progress_strip("loading", left + (width - wide) / 2, top + em * 2, wide, frame.loading->progress,
                       loading_text(*frame.loading)))
        requests.cancel_load = true;
}

}  // namespace si
