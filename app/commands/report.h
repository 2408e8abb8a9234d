// Options and function of the command `report`.
#pragma once

#include <string>
#include <vector>

#include "app/commands/commands.h"

namespace si {

/// Options of the command `report`, which compares presets on one scene. `output` is an HTML page.
struct ReportOptions : CommandOptions {
    std::vector<std::string> presets;  ///< files or built-in presets; the first one's view is drawn for all
    std::vector<std::string> pixels;   ///< "X,Y" from the top left; empty: one of each cause
    bool time = true;                  ///< time frames
};

/// Runs the command `report`: writes a page that compares presets on one scene. It shows pictures, errors, times and
/// diagnosed pixels of each preset.
void run_report(const ReportOptions& options);

}  // namespace si
