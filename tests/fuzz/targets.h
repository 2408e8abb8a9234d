// Fuzz targets: code that reads files and texts from strangers. A target may refuse bytes only by an Error, and
// accepted input must be valid. A finding throws or aborts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace si::fuzz {

/// One fuzz target and its name.
struct Target {
    std::string name;  ///< name of the fuzzer (fuzz_NAME) and of its folder below tests/data/fuzz
    void (*run)(std::span<const std::uint8_t> bytes);
};

/// Returns all fuzz targets. gltf: a model, loaded and posed. preset: its JSON, read, repaired and written again.
/// value: lines of KEY=VALUE, as --set and --vary take them. draco, meshopt, webp: decoders of compressed glTF.
/// bundle: frame.json, read and written again. zip: the entries of a zip file.
const std::vector<Target>& targets();

}  // namespace si::fuzz
