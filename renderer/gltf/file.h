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

/// Returns true for "data:" URIs, which contain their bytes.
bool is_data_uri(std::string_view uri);

/// Decodes the bytes of a base64 data URI (RFC 2397, RFC 4648; padding optional, otherwise strict).
ReadResult decode_data_uri(std::string_view uri);

/// File that a URI names, or the reason why it is not allowed.
struct ResolvedUri {
    std::filesystem::path path;
    std::string error;  ///< empty: resolved
};

/// Resolves a relative URI (RFC 3986, percent-encoded) to a file below `folder`. Anything outside the folder, or on the
/// network, is an error.
ResolvedUri resolve_uri(const std::filesystem::path& folder, std::string_view uri);

}  // namespace si::gltf
