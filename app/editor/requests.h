// Fulfilment of requests: a failure becomes a line in the log instead of ending the program.
#pragma once

#include <exception>
#include <string>

#include "ui/state/editor_ui.h"

namespace si {

/// Adds an error to the editor's log and brings the page Log to the front.
inline void report(EditorState& state, const std::string& error) {
    state.log.add(LogKind::Error, error);
    state.window.open_page = Page::Log;
}

/// Runs `work`. An exception that it throws becomes an error in the editor's log. Returns true in any case: the editor
/// has to be drawn again.
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
