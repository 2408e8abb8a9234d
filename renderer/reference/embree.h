// Owners of Embree objects. Only sources of this folder include this header.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

namespace si::embree {

/// Deleter that calls an Embree release function.
template <auto Release>
struct Releaser {
    /// Releases an Embree object.
    template <typename T>
    void operator()(T* p) const {
        Release(p);
    }
};

using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Releaser<rtcReleaseDevice>>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Releaser<rtcReleaseScene>>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Releaser<rtcReleaseGeometry>>;

}  // namespace si::embree
