// What memory this process has, and who holds it, as JSON (docs/cli.md).
#pragma once

#include <nlohmann/json.hpp>

#include "renderer/base/held.h"

namespace si {

/// {resident, peak, heap, heap_free, held, holders: [{holder, bytes, most, count}]}, bytes.
nlohmann::ordered_json memory_json(const MemoryReport& facts);

}  // namespace si
