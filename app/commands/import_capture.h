// The command `import-capture`.
#pragma once

#include <string>
#include <vector>

#include "app/commands/commands.h"

namespace si {

/// Options of the command `import-capture`. Its output is a folder, .bundle.
struct ImportCaptureOptions : CommandOptions {
    std::string capture;     ///< file that RenderDoc wrote, .rdc
    bool list = false;       ///< print the shadow maps of the capture and write nothing
    std::vector<int> picks;  ///< numbers of the list; empty: all
};

/// Runs the command `import-capture`: opens a RenderDoc capture and writes its shadow maps, scene, camera and picture
/// as a bundle.
void run_import_capture(const ImportCaptureOptions& options);

}  // namespace si
