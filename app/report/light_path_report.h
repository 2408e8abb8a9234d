// Measurements along a light's path as JSON, CSV and a page (docs/cli.md).
#pragma once

#include <string>

#include "app/base/json_text.h"
#include "renderer/measure/light_path.h"

namespace si {

/// Data of a report about a light's path besides its measurements.
struct LightPathReport {
    std::string scene;  ///< name or path
    int width = 0, height = 0;
    bool area = false;                          ///< compared with an area light
    std::string renderer;                       ///< driver
    const Metric* metric = &metrics().front();  ///< error whose largest value is the worst step
    LightPathResult measured;
    std::string command;                       ///< command line that measures it again
    std::string worst_command;                 ///< command line that shows the worst step
    ByteImage worst_picture, worst_artefacts;  ///< of the worst step; empty: not shown
};

/// Converts measurements along a path to JSON (path.json).
nlohmann::ordered_json light_path_json(const LightPathReport& report);
/// Formats measurements along a path as CSV: a header and one line a point (RFC 4180 with plain line breaks).
std::string light_path_csv(const LightPathReport& report);
/// Formats measurements along a path as a self-contained page without scripts.
std::string light_path_html(const LightPathReport& report);

}  // namespace si
