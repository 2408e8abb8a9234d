#pragma once

namespace si {

/// Loading and scenes of many objects; called by the benchmarks' main().
void register_load_benchmarks(int rounds);

/// What look-ups save.
void register_lookup_benchmarks(int rounds);
/// Frames, whole and by passes, and loading; called once by main().
void register_frame_benchmarks();

}  // namespace si
