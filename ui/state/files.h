// Files that the editor has open, and the dialogs that choose them.
#pragma once

#include <optional>
#include <string>

#include "ui/panels/presets.h"
#include "ui/state/history.h"
#include "ui/widgets/file_dialog.h"

namespace si {

/// State of the editor's files: paths of preset and scene, notes about them, and the dialogs that choose files.
struct FilesState {
    std::string scene_input;                  ///< path of a scene while it is being typed
    std::string preset_path = "preset.json";  ///< file that saving writes
    std::string error_path = "error.json";    ///< file that saving the errors writes
    GuideNote guide;                          ///< sentence of the preset that was opened last
    std::string hidden_scene_note;            ///< note on the scene that the user has hidden; empty: none
    std::string hidden_guide;                 ///< preset key of the note that the user has hidden; empty: none
    FileDialog dialog;
    std::optional<Replacement> replace;  ///< file that is replaced once the user agrees
};

}  // namespace si
