#include "renderer/reference/sample_places.h"

#include <algorithm>

namespace si {

void SamplePlaces::update(const LightSamples& samples) {
    const std::size_t count = (points.size() + kPerGroup - 1) / kPerGroup;
    for (std::vector<float>* coordinates : {&x, &y}) coordinates->resize(count * kPerGroup);
    samples.find_places(points, x, y);
    for (std::vector<float>* coordinates : {&x, &y})
        std::fill(coordinates->begin() + std::ptrdiff_t(points.size()), coordinates->end(),
                  (*coordinates)[points.size() - 1]);
    for (std::vector<float>* bounds : {&low_x, &low_y, &high_x, &high_y}) bounds->resize(count);
    const auto find_bounds = [](const float* first, float& low, float& high) {
        low = high = first[0];
        for (std::size_t k = 1; k < kPerGroup; ++k) {
            low = std::min(low, first[k]);
            high = std::max(high, first[k]);
        }
    };
    for (std::size_t g = 0; g < count; ++g) {
        find_bounds(&x[g * kPerGroup], low_x[g], high_x[g]);
        find_bounds(&y[g * kPerGroup], low_y[g], high_y[g]);
    }
}

SunPlaces::SunPlaces(const Emitter& light) : places_(LightSamples::kScramblings) {
    std::size_t missing = places_.size();
    for (std::uint64_t pixel = 0; missing > 0; ++pixel) {
        const LightSamples samples(light, {}, pixel);
        auto& all = places_[samples.scrambling()];
        if (!all.front().points.empty()) continue;
        --missing;
        for (std::size_t k = 0; k < all.size(); ++k) {
            samples.points_in_squares(kLeastDigits + int(k), all[k].points);
            all[k].update(samples);
        }
    }
}

}  // namespace si
