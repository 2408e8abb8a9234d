// Registration of the benchmarks that other files define.
#pragma once

namespace si {

/// Registers the benchmarks of loading and of scenes with many objects. Called by main(). @param rounds timed rounds a
/// benchmark
void register_load_benchmarks(int rounds);

/// Registers the benchmarks of optimised shadow look-ups. Called by main(). @param rounds timed rounds a benchmark
void register_lookup_benchmarks(int rounds);
/// Registers the benchmarks of whole frames, single passes and loading. Called once by main().
void register_frame_benchmarks();

}  // namespace si
