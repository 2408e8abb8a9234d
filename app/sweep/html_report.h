// A sweep's report: one page for a browser that needs nothing beside it (assets/report/).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace si {

/// Bytes of pictures that a report carries at most; those of the frontier come first.
inline constexpr std::size_t kMostPictureBytes = std::size_t{24} << 20;

/// @param results as results_json() gives them
/// @param folder of the sweep, where its pictures lie; missing ones are left out
std::string report_html(const nlohmann::ordered_json& results, const std::filesystem::path& folder,
                        std::size_t most_picture_bytes = kMostPictureBytes);

}  // namespace si
