// Memory of the process by owner, as JSON (docs/cli.md).
#pragma once

#include <nlohmann/json.hpp>

#include "renderer/base/held_memory.h"

namespace si {

/// Converts memory facts to JSON {resident, peak, heap, heap_free, held, holders: [{holder, bytes, most, count}]}, in
/// bytes.
nlohmann::ordered_json memory_json(const MemoryReport& facts);

}  // namespace si
