// Frames of other engines that become a bundle before they are opened: dialogs and progress of captures and of images
// of maps.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/widgets/export_kind.h"

namespace si {

/// Step of an import, which converts a frame of another engine (a RenderDoc capture, or an image of a shadow map) to a
/// bundle of scene, lights and maps.
enum class ImportStep {
    Warning,   ///< the user is told once that opening a capture runs its shaders
    Light,     ///< the user names the light of an image of a map
    Reading,   ///< the file is read in the background
    Choosing,  ///< the user chooses maps or a reading, and the bundle
    Writing,   ///< the bundle is written in the background
};

/// Choice that an import offers: a shadow map of a capture, or a depth convention by which an image of a map can be
/// read.
struct ImportChoice {
    int number = 0;      ///< number of the map in the capture, or row of the list of readings, from 1
    std::string text;    ///< the map, or the reading's convention
    std::string fit;     ///< of a reading: how well it fits the scene
    bool fits = true;    ///< of a reading: none fits better
    bool usable = true;  ///< false: the reading is refused, and `fit` says why
};

/// Data about the import of another engine's frame, for its dialogs and its progress bar.
struct ImportFacts {
    ImportStep step = ImportStep::Warning;
    bool is_capture = true;  ///< a RenderDoc capture; false: an image of a map
    std::string file;        ///< path of the capture or the image
    std::string doing;       ///< step of the background work
    double progress = 0;     ///< 0..1
    double seconds = 0;      ///< since the background work began
    std::span<const ImportChoice> choices;
    std::string problem;  ///< why the last request was refused; empty: it was not
};

/// State of the dialogs that import another engine's frame: what the user has chosen and typed. Before a dialog with
/// choices or text fields is shown (ImportStep::Light, ImportStep::Choosing), the application fills in its proposals.
struct ImportDialog {
    std::vector<int> picks;  ///< numbers of the chosen maps, or of the chosen reading
    std::string output;      ///< path of the bundle while it is being typed
    std::string light;       ///< path of the light's file while it is being typed
    bool over_scene = true;  ///< an image of a map is compared with the shown scene
};

/// Requests to the application by the dialogs that import another engine's frame.
struct ImportRequests {
    bool start_import = false;                 ///< goes on after ImportStep::Warning or ImportStep::Light
    bool write_import = false;                 ///< writes the chosen maps as the bundle ImportDialog::output
    bool cancel_import = false;                ///< ends the import at any step
    std::optional<ExportRequest> export_file;  ///< write the shown frame
};

/// Draws the dialog for the present step of the import of another engine's frame. Steps in the background have no
/// dialog.
/// @param facts the import under way; none: there is no import @param scene name of the shown scene
void draw_import_dialog(ImportDialog& dialog, const std::optional<ImportFacts>& facts, const std::string& scene,
                        ImportRequests& requests);
/// Draws the progress of the import of another engine's frame, with a button that cancels it, over the upper edge of a
/// picture. Draws nothing unless a step runs in the background.
/// @param left, top, width place of the picture, pixels of the screen
void draw_import_progress(const std::optional<ImportFacts>& facts, float left, float top, float width,
                          ImportRequests& requests);

}  // namespace si
