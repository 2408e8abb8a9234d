#include "app/editor/persistence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/base/absolute_path.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

constexpr double kLayoutSeconds = 1;  ///< time without changes before the layout is written

std::string count_text(double number, const char* unit) {
    const long n = std::max(1L, std::lround(number));
    return fmt::format("{} {}{} ago", n, unit, n == 1 ? "" : "s");
}

}  // namespace

std::string age_text(double seconds) {
    if (seconds < 60) return "less than a minute ago";
    if (seconds < 90 * 60) return count_text(seconds / 60, "minute");
    if (seconds < 36 * 3600) return count_text(seconds / 3600, "hour");
    return count_text(seconds / 86400, "day");
}

void EditorPersistence::note_scene(const std::string& path) {
    if (is_builtin_scene(path)) return;
    workspace_.change([&](WorkspaceData& d) { put_first(d.recent_scenes, absolute_path(path).string()); });
}

void EditorPersistence::note_preset(const std::string& path) {
    workspace_.change([&](WorkspaceData& d) { put_first(d.recent_presets, absolute_path(path).string()); });
}

void EditorPersistence::note_welcome() {
    if (!workspace().welcomed) workspace_.change([](WorkspaceData& d) { d.welcomed = true; });
}

void EditorPersistence::note_capture_warning() {
    workspace_.change([](WorkspaceData& d) { d.capture_warned = true; });
}

void EditorPersistence::drop_recent(const std::string& path) {
    workspace_.change([&](WorkspaceData& d) {
        std::erase(d.recent_scenes, path);
        std::erase(d.recent_presets, path);
    });
}

void EditorPersistence::note_window(int width, int height, bool maximised) {
    workspace_.change([&](WorkspaceData& d) {
        d.maximised = maximised;
        if (!maximised) {
            d.window_width = width;
            d.window_height = height;
        }
    });
}

void EditorPersistence::write_when_due(EditorState& state, double now_s) {
    if (!state.between_steps && !state.scene_name.empty()) autosave_.update(state.scene_name, state.settings, now_s);
    if (seen_layout_ != state.layout) {
        if (seen_layout_) layout_due_s_ = now_s + kLayoutSeconds;
        seen_layout_ = state.layout;
    }
    if (layout_due_s_ > 0 && now_s >= layout_due_s_) {
        layout_due_s_ = 0;
        workspace_.change([&](WorkspaceData& d) { d.layout = state.layout; });
    }
    for (const std::string& remark : workspace_.take_remarks()) state.log.add(LogKind::Warning, remark);
    for (const std::string& remark : autosave_.take_remarks()) state.log.add(LogKind::Warning, remark);
}

void EditorPersistence::fill(EditorFrame& frame) const {
    frame.recent_scenes = workspace().recent_scenes;
    frame.recent_presets = workspace().recent_presets;
    if (const Autosave::Lost* lost = autosave_.lost())
        frame.lost = LostFacts{lost->preset.scene, age_text(lost->age_s)};
}

void EditorPersistence::end(const EditorState& state, bool unsaved) {
    autosave_.end(state.scene_name, state.settings, unsaved && !state.between_steps && !state.scene_name.empty());
    workspace_.change([&](WorkspaceData& d) { d.layout = state.layout; });
}

}  // namespace si
