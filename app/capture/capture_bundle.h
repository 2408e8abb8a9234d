// Shadow maps of a RenderDoc capture: listed, written as a bundle, and as text for people.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/base/json_text.h"

namespace si {

/// Function that receives the progress of reading a RenderDoc capture: the share 0..1 that is done and a label, at
/// least every 50 ms. Returning false ends the work.
using CaptureProgress = std::function<bool(double, const std::string&)>;

/// Lists the shadow maps of a RenderDoc capture, so that the user can pick some for write_capture_bundle(). Returns a
/// JSON array with one object (candidate) per map. The work runs in a child process (run_capture_helper()).
/// @throws Error with one sentence @throws Cancelled when `progress` returns false
Json list_capture(const std::filesystem::path& capture, const CaptureProgress& progress);

/// Checks before long work that a new bundle folder can be made: the name ends in .bundle and nothing exists at `path`.
/// @throws UsageError, Error
void require_new_bundle(const std::filesystem::path& path);

/// Writes shadow maps of a RenderDoc capture with scene and camera as a bundle (the files of one frame). The bundle
/// appears whole or not at all. Returns the summary that the child process reports (run_capture_helper()), a JSON
/// object.
/// @param picks numbers of maps in the list of list_capture(); empty: all
/// @param output new folder that ends in .bundle
/// @throws Error with one sentence @throws Cancelled when `progress` returns false
Json write_capture_bundle(const std::filesystem::path& capture, const std::vector<int>& picks,
                          const std::filesystem::path& output, const CaptureProgress& progress);

/// Formats one shadow map of a capture as text for a list: "texture 242, slice 1 of 4, 1024 x 1024, D16, 30 draws,
/// directional". @param candidate an element of list_capture()
std::string candidate_text(const Json& candidate);

/// Formats the check of one captured shadow map as text. In the check, the importer draws the casters again and
/// compares the texels.
/// @param gate an element of `gate` in the summary of write_capture_bundle()
std::string gate_text(const Json& gate);

/// Returns the remarks on an imported RenderDoc capture for the user, one line each. @param summary result of
/// write_capture_bundle()
std::vector<std::string> capture_notes(const Json& summary);

}  // namespace si
