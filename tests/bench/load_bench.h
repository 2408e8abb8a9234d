#pragma once

namespace si {

/// Loading and scenes of many objects; called by the benchmarks' main().
void register_load_benchmarks(int rounds);

}  // namespace si
