// The list of lights at the head of their settings.
#pragma once

#include <optional>
#include <string>

namespace si {

class Log;
struct FrameResult;
struct Settings;

/// Name of a light while it is typed in the list of lights.
struct LightRename {
    int light = 0;
    std::string name;
    bool begun = false;  ///< its text field has the keyboard
};

/// State of the list of lights in the editor, with the name that is being typed.
struct LightsPanel {
    std::optional<LightRename> rename;
    bool listed = false;  ///< the list was in sight in the last frame
};

/// Draws the list of lights: a row for each light (name, on, solo, colour, intensity), and buttons that add, copy,
/// delete and move lights. For a point light, six more buttons choose the cube face in the map viewer.
/// @param log receives the reason why a name is not accepted @param result last frame; null: not known
void draw_lights(LightsPanel& panel, Settings& settings, Log& log, const FrameResult* result);
/// Opens the text field that renames a light in the list of lights. @param light index
void begin_light_rename(LightsPanel& panel, const Settings& settings, int light);

}  // namespace si
