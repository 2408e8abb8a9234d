// Dialog that shows the settings as code of another program, copies it and saves it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ui/panels/tune_controls.h"

namespace si {

/// Target of a conversion, for the dialog's list.
struct ConvertTargetLabel {
    std::string_view name, title;
};

/// Result of converting the settings to an engine's code, for the dialog Convert.
struct ConvertFacts {
    std::span<const ConvertTargetLabel> targets;
    std::string text;                ///< code; empty: it could not be made
    std::string problem;             ///< why it could not be made or saved, and what to do; empty: it could
    std::vector<std::string> notes;  ///< remarks, one line each
    bool replaces = false;           ///< the file of the last request exists; saving again replaces it
    std::optional<SearchProgress> measuring = {};  ///< measurement of the scene under way
    bool measured = false;                         ///< the code states error and time of these settings
};

/// State of the dialog.
struct ConvertDialog {
    bool asked = false;     ///< opens in the next frame
    bool shown = false;     ///< the dialog is open, and needs facts
    std::string target;     ///< name of a target
    std::string output;     ///< path of the file while it is being typed
    double angle_deg = 45;  ///< reference angle between normal and light
};

/// Requests of the dialog to the application.
struct ConvertRequests {
    std::optional<std::string> save_conversion;  ///< path of the file to write
    bool replace_conversion = false;             ///< a file that exists may be replaced
    bool measure_conversion = false;             ///< measure angle, error and time of the scene
    bool cancel_conversion = false;              ///< stop measuring
};

/// Draws the dialog while it is open.
void draw_convert_dialog(ConvertDialog& dialog, const ConvertFacts* facts, ConvertRequests& requests);

}  // namespace si
