// The list of lights at the head of their settings.
#pragma once

#include <optional>
#include <string>

namespace si {

struct EditorState;
struct FrameResult;

/// A name being typed in the list of lights.
struct LightRename {
    int light = 0;
    std::string name;
    bool begun = false;  ///< its text field has the keyboard
};

/// State of the list of lights.
struct LightsPanel {
    std::optional<LightRename> rename;
    bool listed = false;  ///< the list was drawn in the last frame
};

/// A line for each light: which one is shown, whether it shines, alone or with others, its colour and intensity; what
/// can be done with the list; and of a light with six maps the cube's cross, which chooses the one that is shown.
/// @param result of the last frame; null: not known
void draw_lights(EditorState& state, const FrameResult* result);
/// Opens the text field that renames a light of the list.
void begin_light_rename(EditorState& state, int light);

}  // namespace si
