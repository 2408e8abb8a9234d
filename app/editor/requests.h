// How the parts of the editor do what was wished for: what goes wrong is a line in the log, not the end.
#pragma once

#include <exception>
#include <string>

#include "ui/state/editor_ui.h"

namespace si {

/// Tells a person: a line in the log, which comes to the front.
inline void report(EditorState& state, const std::string& error) {
    state.log.add(LogKind::Error, error);
    state.window.open_tab = BottomTab::Log;
}

/// Does it; reports what it throws. Returns true: the editor is to be drawn again.
template <typename Work>
bool attempt(EditorState& state, const Work& work) {
    try {
        work();
    } catch (const std::exception& e) {
        report(state, e.what());
    }
    return true;
}

}  // namespace si
