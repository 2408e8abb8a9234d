// Shadow maps of a RenderDoc capture: listed, written as a bundle, and as text for people.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/base/json_text.h"

namespace si {

/// Function that receives the share 0..1 that is done and a label, at least every 50 ms. Returning false ends the work.
using CaptureProgress = std::function<bool(double, const std::string&)>;

/// Lists the shadow maps of a capture (run_capture_helper()). Returns an array of candidates, one for each map.
/// @throws Error one sentence @throws Cancelled where `progress` returns false
Json list_capture(const std::filesystem::path& capture, const CaptureProgress& progress);

/// Checks before long work that a new bundle can be made at `path`, a folder. @throws UsageError, Error
void require_new_bundle(const std::filesystem::path& path);

/// Writes maps of a capture as a bundle, which appears whole or not at all. Returns the summary that the capture helper
/// reports (run_capture_helper()).
/// @param picks numbers of candidates, as list_capture() returns them; empty: all
/// @param output new folder that ends in .bundle
/// @throws Error one sentence @throws Cancelled where `progress` returns false
Json write_capture_bundle(const std::filesystem::path& capture, const std::vector<int>& picks,
                          const std::filesystem::path& output, const CaptureProgress& progress);

/// Formats a listed shadow map as text: "texture 242, slice 1 of 4, 1024 x 1024, D16, 30 draws, directional".
std::string candidate_text(const Json& candidate);

/// Formats the result of comparing a map with its casters drawn again: member `gate` of the summary.
std::string gate_text(const Json& gate);

/// Returns the remarks of a summary.
std::vector<std::string> capture_notes(const Json& summary);

}  // namespace si
