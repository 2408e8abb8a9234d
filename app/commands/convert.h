// Options and function of the command `convert`.
#pragma once

#include <optional>
#include <string>

#include "app/commands/commands.h"

namespace si {

/// Options of the command `convert`, which writes shadow settings as code of another program. Without an output file
/// the code goes to standard output.
struct ConvertOptions : CommandOptions {
    std::string target;               ///< one of convert_targets()
    std::optional<double> angle_deg;  ///< reference angle; nullopt: from the scene, else 45
    bool use_scene = true;            ///< measures map size, angle and error in the scene; false: settings alone
    bool time = true;                 ///< time frames
};

/// Runs the command `convert`: writes the shadow settings of a preset as code for an engine, a graphics API or a
/// language.
/// @throws UsageError, Error
void run_convert(const ConvertOptions& options);

}  // namespace si
