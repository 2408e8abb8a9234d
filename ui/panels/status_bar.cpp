// Status bar below all panels.
#include <fmt/format.h>
#include <imgui.h>

#include <string>
#include <utility>

#include "renderer/base/held_memory.h"
#include "renderer/measure/time_sampler.h"
#include "ui/state/panels.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr double kMessageSeconds = 20;  ///< time for which a message without a problem is shown

/// Returns the times of the last timed frame. Frames are timed while the page Effects is shown.
std::string cost_text(const FrameTimes& times) {
    if (times.frames.empty()) return {};
    const auto number = [](double t) { return fmt::format("{:.{}f}", t, t < 10 ? 2 : t < 100 ? 1 : 0); };
    const TimedFrame& last = times.frames.back();
    return fmt::format("{}frame {} {}, {}   ", times.newest_is_shown ? "" : "last timed: ", number(last.ms),
                       time_unit(times.clock),
                       last.drew_maps ? "maps " + number(last.maps_ms) + " ms" : "no map drawn");
}

std::string facts_text(const EditorState& state, const EditorFrame& frame) {
    const FrameResult& result = *frame.result;
    std::string text = cost_text(state.times);
    int maps = 0;
    for (const FittedLight& light : result.lights) maps += light.casts ? int(light.views.size()) : 0;
    const MapSize n = result.map_size;
    if (maps > 0 && n.shortest() > 0) {
        const WorkCost cost = work_cost(state.settings, result);
        const std::string size = n.is_square() ? fmt::format("{}²", n.width) : fmt::format("{}×{}", n.width, n.height);
        text += maps == 1 ? "map " + size : fmt::format("{} maps of {}", maps, size);
        text += fmt::format(", {}, {} tap{}   ", bytes_text(cost.map_bytes), digits_text(cost.taps_per_pixel),
                            cost.taps_per_pixel == 1 ? "" : "s");
    }
    if (!result.panes.empty())
        text += fmt::format("picture {} × {}   ", result.panes[0].picture.width, result.panes[0].picture.height);
    if (state.window.maximised) text += fmt::format("all panels: {}   ", key_text(Command::RestorePanels));
    if (state.frozen) text += with_key("view frozen", Command::ToggleFrozenCamera) + "   ";
    if (frame.driver) text += frame.driver->renderer.substr(0, frame.driver->renderer.find(" ("));
    return text;
}

}  // namespace

float status_bar_height() {
    return ImGui::GetFontSize() * 1.6f;
}

void draw_status_bar(EditorState& state, const EditorFrame& frame) {
    const float em = ImGui::GetFontSize(), width = ImGui::GetWindowWidth();
    ImFont* font = theme::small();
    const ImVec2 at = ImGui::GetWindowPos();
    const float y = at.y + 0.5f * (status_bar_height() - font->FontSize);
    const std::string facts = frame.result ? facts_text(state, frame) : std::string();
    const float right = width - text_width(facts, font) - em * 0.7f;
    float free = width - em * 1.4f;
    if (right > em * 12) {
        small_text({at.x + right, y}, facts, theme::muted());
        free = right - em * 2;
    }
    if (state.log.lines().empty()) return;
    const LogLine& last = state.log.lines().back();
    if (std::exchange(state.window.shown_message, state.log.added()) != state.log.added())
        state.window.message_since = ImGui::GetTime();
    if (last.kind == LogKind::Info && ImGui::GetTime() - state.window.message_since > kMessageSeconds) return;
    const ImU32 colour = last.kind == LogKind::Error     ? theme::error()
                         : last.kind == LogKind::Warning ? theme::warning()
                                                         : theme::muted();
    const std::string text = beginning_that_fits(last.text.substr(0, last.text.find('\n')), free, font);
    small_text({at.x + em * 0.7f, y}, text, colour);
    ImGui::SetCursorScreenPos(at);
    ImGui::InvisibleButton("last message",
                           {std::max(std::min(text_width(text, font) + em, free), 1.0f), status_bar_height()});
    wrapped_tooltip(last.text + "\nA click opens the log.");
    if (ImGui::IsItemClicked()) state.window.open_page = Page::Log;
}

}  // namespace si
