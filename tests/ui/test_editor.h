// Editor without a window for tests: options in one call, keys, clicks and drags over several frames.
#pragma once

#include <gtest/gtest.h>
#include <imgui.h>

#include <string>
#include <utility>
#include <vector>

#include "app/editor/headless_editor.h"
#include "tests/ui/screen.h"

namespace si::test {

/// Returns options of an editor that shows a scene under changed settings. @param size pixels
inline EditorOptions editor_options(const std::string& scene = "boxes", std::vector<std::string> sets = {},
                                    glm::ivec2 size = {kWidth, kHeight}) {
    EditorOptions o;
    o.session.scene = scene;
    o.session.sets = std::move(sets);
    o.width = size.x;
    o.height = size.y;
    return o;
}

/// Expects no line worse than information in the log.
inline void expect_calm(HeadlessEditor& editor) {
    for (const LogLine& line : editor.model().state.log.lines()) EXPECT_EQ(line.kind, LogKind::Info) << line.text;
}

/// Editor without a window whose input takes several frames, as a person's does.
class TestEditor : public HeadlessEditor {
public:
    /// Starts an editor and waits until nothing changes any more.
    explicit TestEditor(const EditorOptions& options = editor_options()) : HeadlessEditor(options) { settle(); }

    EditorState& state() { return model().state; }
    EditorFrame facts() { return model().facts(); }
    /// Returns the last line of the log.
    std::string last_line() { return state().log.lines().back().text; }
    void frames(int count) {
        for (int i = 0; i < count; ++i) frame();
    }
    /// Presses and releases a key.
    void key(int code) {
        ImGui::GetIO().KeysDown[code] = true;
        frame();
        ImGui::GetIO().KeysDown[code] = false;
        frames(3);
    }
    /// Presses the left button at a position in pixels, moves through further positions and releases the button.
    void drag(const std::vector<glm::vec2>& positions) {
        mouse.at = positions.front();
        frames(2);
        mouse.left = true;
        frame();
        for (const glm::vec2& at : positions) {
            mouse.at = at;
            frame();
        }
        mouse.left = false;
        frames(3);
    }
    /// Returns requests for the shown size of the scene picture and nothing else.
    EditorRequests requests() {
        EditorRequests requests;
        requests.scene_width = facts().result->colour.width;
        requests.scene_height = facts().result->colour.height;
        return requests;
    }
};

}  // namespace si::test
