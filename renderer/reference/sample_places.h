// Places of a light's sample points on the plane of a LightDisk, in groups of neighbours. Internal to this folder.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/reference/emitter.h"

namespace si {

/// Places of sample points of a light on the plane of a LightDisk. Groups of neighbours have boxes, so that a triangle
/// is compared with few places.
struct SamplePlaces {
    static constexpr std::size_t kPerGroup = 16;

    std::vector<std::uint32_t> points;  ///< numbers of the sample points
    std::vector<float> x, y;            ///< by sample point; the last group is filled up with copies of the last place
    std::vector<float> low_x, low_y, high_x, high_y;  ///< by group: box of its places

    /// Returns the number of groups.
    std::size_t groups() const { return low_x.size(); }
    /// Sets the places of the sample points of SamplePlaces::points, at least one.
    void update(const LightSamples& samples);
};

/// Places of the first sample points of a directional light. They depend on a surface point only by its scrambling.
class SunPlaces {
public:
    static constexpr int kLeastDigits = 6;

    /// Computes the places for all scramblings. @param light directional
    explicit SunPlaces(const Emitter& light);
    /// Returns the places of the first 2^digits sample points, neighbours one after another.
    /// @param scrambling LightSamples::scrambling() @param digits kLeastDigits to LightSamples::kSquareDigits
    const SamplePlaces& places(std::uint32_t scrambling, int digits) const {
        return places_[scrambling][std::size_t(digits - kLeastDigits)];
    }

private:
    std::vector<std::array<SamplePlaces, LightSamples::kSquareDigits - kLeastDigits + 1>> places_;  ///< by scrambling
};

}  // namespace si
