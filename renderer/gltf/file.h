// Safe file access for the glTF loader: files inside the model's folder, and data URIs.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "renderer/base/regular_file.h"

namespace si::gltf {

using si::Bytes;
using si::read_regular_file;
using si::ReadResult;

/// Returns true for a "data:" URI, which contains its bytes instead of naming a file.
bool is_data_uri(std::string_view uri);

/// Decodes the bytes of a base64 data URI (RFC 2397, RFC 4648; padding optional, otherwise strict). Failures are
/// reported in ReadResult::error.
ReadResult decode_data_uri(std::string_view uri);

/// Path of the file that a URI names, or the reason why the URI is refused.
struct ResolvedUri {
    std::filesystem::path path;
    std::string error;  ///< empty: resolved
};

/// Resolves a relative URI (RFC 3986, percent-encoded) to the path of an existing file below `folder`.
/// ResolvedUri::error is set for a file outside the folder, on the network, or missing.
ResolvedUri resolve_uri(const std::filesystem::path& folder, std::string_view uri);

}  // namespace si::gltf
