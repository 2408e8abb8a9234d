// The probed pixel: what is known of it.
#pragma once

#include <span>

namespace si {

struct Probe;
struct Dossier;

struct ProbeShown {
    const Probe* probe = nullptr;       ///< of state.probe_pixel
    std::span<const Dossier> dossiers;  ///< one for each light of the probe, once the truth is there
    bool tracing_probe = false;         ///< dossiers will follow
};

}  // namespace si
