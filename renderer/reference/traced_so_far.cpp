#include "renderer/reference/traced_so_far.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders/shared/colours.h"

namespace si {
namespace {

constexpr std::uint8_t kUnknown = 0, kNoSurface = 1, kDark = 2;
constexpr float kSteps = 253;
constexpr float kOpacity = 0.8f;

/// Returns the colours of all stored numbers, RGBA8.
std::array<glm::u8vec4, 256> colours() {
    std::array<glm::u8vec4, 256> out{};
    for (int i = kDark; i < 256; ++i) {
        const float t = 2 * float(i - kDark) / kSteps;
        const glm::vec3 c = t < 1 ? glm::mix(shared::SEQUENTIAL_LOW, shared::SEQUENTIAL_MIDDLE, t)
                                  : glm::mix(shared::SEQUENTIAL_MIDDLE, shared::SEQUENTIAL_HIGH, t - 1);
        out[std::size_t(i)] = glm::u8vec4(glm::round(255.0f * glm::vec4(c, kOpacity)));
    }
    return out;
}

}  // namespace

void TracedSoFar::add_tile(const Reference& reference, glm::ivec2 first, glm::ivec2 end) {
    const std::lock_guard guard(lock_);
    width_ = reference.width;
    height_ = reference.height;
    pixels_.resize(std::size_t(width_) * std::size_t(height_), kUnknown);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(width_) + std::size_t(x);
            known_ += pixels_[i] == kUnknown;
            const float lit = std::clamp(reference.visibility.data[i], 0.0f, 1.0f);
            pixels_[i] = reference.state[i] == PixelState::Background ? kNoSurface
                                                                      : std::uint8_t(kDark + std::lround(kSteps * lit));
        }
    ++tiles_;
}

double TracedSoFar::share() const {
    const std::lock_guard guard(lock_);
    return pixels_.empty() ? 0 : double(known_) / double(pixels_.size());
}

ByteImage TracedSoFar::picture() const {
    static const std::array<glm::u8vec4, 256> kColours = colours();
    ByteImage out;
    const std::lock_guard guard(lock_);
    out.width = width_;
    out.height = height_;
    out.data.reserve(4 * pixels_.size());
    for (const std::uint8_t pixel : pixels_)
        for (int c = 0; c < 4; ++c) out.data.push_back(kColours[pixel][c]);
    return out;
}

}  // namespace si
