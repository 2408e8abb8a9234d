// What a fuzzer feeds with bytes: code that reads what strangers wrote. Each target takes anything; it may refuse it
// with an Error and nothing else, and what it takes has to be sound. A finding throws or aborts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace si::fuzz {

struct Target {
    std::string name;  ///< of the fuzzer (fuzz_NAME) and of its folder below tests/data/fuzz
    void (*run)(std::span<const std::uint8_t> bytes);
};

/// gltf: a model, loaded and posed. preset: its JSON, read, repaired and written again. value: lines of KEY=VALUE, as
/// --set and --vary take them.
const std::vector<Target>& targets();

}  // namespace si::fuzz
