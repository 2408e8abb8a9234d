// Dialog that shows the settings as code of another program, copies it and saves it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ui/panels/tune_controls.h"

namespace si {

/// Engine or graphics API for which the dialog Convert makes code: its name for the command-line option --to, and
/// title.
struct ConvertTargetLabel {
    std::string_view name, title;
};

/// Data that the dialog Convert shows: the settings as code of another engine, with messages about the conversion.
struct ConvertFacts {
    std::span<const ConvertTargetLabel> targets;
    std::string text;                ///< code; empty: it could not be made
    std::string problem;             ///< why it could not be made or saved, and what to do; empty: it could
    std::vector<std::string> notes;  ///< remarks, one line each
    std::string taken;               ///< path of the last request where a file exists, which may be replaced
    std::optional<SearchProgress> measuring = {};  ///< measurement of the scene under way
    bool measured = false;                         ///< the code states error and time of these settings
};

/// State of the dialog Convert, which shows the settings as code of another engine.
struct ConvertDialog {
    bool asked = false;     ///< opens in the next frame
    bool shown = false;     ///< the dialog is open, and needs facts
    std::string target;     ///< name of a target
    std::string output;     ///< path of the file while it is being typed
    double angle_deg = 45;  ///< reference angle between normal and light
};

/// Requests of the dialog Convert to the application: save the code, or measure the numbers in the comments of the
/// code. These are the reference angle between normal and light, error and time.
struct ConvertRequests {
    std::optional<std::string> save_conversion;  ///< path of the file to write
    bool replace_conversion = false;             ///< a file that exists may be replaced
    bool measure_conversion = false;             ///< measure angle, error and time of the scene
    bool cancel_conversion = false;              ///< stop measuring
};

/// Draws the dialog Convert while it is open. It shows the settings as code of another engine, which the user copies or
/// saves.
/// @param facts the code; null: there is no frame yet @param requests receives what the user requests
void draw_convert_dialog(ConvertDialog& dialog, const ConvertFacts* facts, ConvertRequests& requests);

}  // namespace si
