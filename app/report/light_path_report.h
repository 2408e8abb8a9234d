// Measurements along a light's path as JSON, CSV and a page (docs/cli.md).
#pragma once

#include <string>
#include <string_view>

#include "app/base/json_text.h"
#include "renderer/measure/light_path.h"

namespace si {

/// Value of the field `format` in path.json (measurements along a light's path), by which the program recognises the
/// file.
inline constexpr std::string_view kLightPathFormat = "shadow-inspector-light-path";

/// Measurements of the shadows at each step along a path of the light, with the facts that their report shows.
struct LightPathReport {
    std::string scene;  ///< name or path
    int width = 0, height = 0;
    bool area = false;                          ///< compared with an area light
    std::string renderer;                       ///< driver
    const Metric* metric = &metrics().front();  ///< error whose largest value marks the worst step
    LightPathResult measured;
    std::string command;                       ///< command line that repeats the measurement
    std::string worst_command;                 ///< command line that shows the worst step
    ByteImage worst_picture, worst_artefacts;  ///< of the worst step; empty: not shown
};

/// Converts the measurements along a path of the light to JSON (path.json).
nlohmann::ordered_json light_path_json(const LightPathReport& report);
/// Formats the measurements along a path of the light as CSV: a header and one line per step (RFC 4180, but with LF
/// line ends).
std::string light_path_csv(const LightPathReport& report);
/// Formats the measurements along a path of the light as a self-contained HTML page without scripts.
std::string light_path_html(const LightPathReport& report);

}  // namespace si
