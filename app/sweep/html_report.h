// Report of a sweep as one self-contained HTML page (assets/report/).
#pragma once

#include <filesystem>
#include <string>

#include "app/base/json_text.h"

namespace si {

/// Largest total size of the pictures that the HTML page of a sweep embeds, bytes. Pictures of cases on the Pareto
/// front come first.
inline constexpr std::size_t kMaxPictureBytes = std::size_t{24} << 20;

/// Returns the self-contained HTML page of a sweep. Pictures are embedded, those of the Pareto front first, up to
/// `max_picture_bytes` in all; missing ones are left out.
/// @param results the JSON of results_json() @param folder the folder of the sweep, with its pictures. The command of
/// each case names it as it is given, like the scene
/// @param picture the frontier plot as SVG (frontier_svg()); empty: none
std::string report_html(const nlohmann::ordered_json& results, const std::filesystem::path& folder,
                        const std::string& picture = {}, std::size_t max_picture_bytes = kMaxPictureBytes);

}  // namespace si
