#include "renderer/view/lights/sky.h"

#include <cstddef>
#include <iterator>

#include "renderer/view/lights/light.h"

namespace si {
namespace {

struct Hour {
    double sine;  ///< sine of the sun's height
    glm::dvec3 zenith, horizon, below;
    double glow;
};

// Colours chosen by eye, for matt surfaces in front of the sky.
constexpr Hour kHours[] = {
    {-0.20, {0.010, 0.014, 0.030}, {0.050, 0.060, 0.095}, {0.020, 0.020, 0.024}, 0.2},
    {0.00, {0.060, 0.090, 0.220}, {0.620, 0.360, 0.220}, {0.160, 0.130, 0.120}, 1.2},
    {0.15, {0.070, 0.150, 0.360}, {0.700, 0.530, 0.370}, {0.300, 0.260, 0.220}, 0.9},
    {0.40, {0.050, 0.155, 0.420}, {0.520, 0.600, 0.710}, {0.380, 0.382, 0.385}, 0.5},
    {0.60, {0.050, 0.165, 0.440}, {0.470, 0.600, 0.780}, {0.395, 0.400, 0.400}, 0.3},
    {1.00, {0.045, 0.160, 0.450}, {0.450, 0.600, 0.800}, {0.395, 0.400, 0.410}, 0.2},
};

Hour hour_of(double sine) {
    std::size_t next = 0;
    while (next < std::size(kHours) && kHours[next].sine < sine) ++next;
    if (next == 0) return kHours[0];
    if (next == std::size(kHours)) return kHours[next - 1];
    const Hour a = kHours[next - 1], b = kHours[next];
    const double t = (sine - a.sine) / (b.sine - a.sine);
    return {sine, glm::mix(a.zenith, b.zenith, t), glm::mix(a.horizon, b.horizon, t), glm::mix(a.below, b.below, t),
            glm::mix(a.glow, b.glow, t)};
}

}  // namespace

double luminance(const glm::dvec3& colour) {
    return glm::dot(colour, glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::dvec3 direction_to_brightest_sun(std::span<const FittedLight> lights) {
    double brightest = 0;
    glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.5, 1, 0.7));
    for (const FittedLight& light : lights) {
        if (light.type != LightType::Directional || !(luminance(light.radiance) > brightest)) continue;
        brightest = luminance(light.radiance);
        to_sun = light.to_light;
    }
    return to_sun;
}

Sky sky_for_sun(const glm::dvec3& to_sun) {
    const Hour hour = hour_of(to_sun.y);
    // A horizontal surface sees more of the horizon than of the zenith, but at a flat angle.
    const glm::dvec3 above = 0.5 * (hour.zenith + hour.horizon);
    constexpr double kKept = 0.4;  // share of the sky's colour kept: eyes take ambient light for white
    constexpr double kRise = 0.35, kSunward = 0.6;
    return {.zenith = hour.zenith,
            .horizon = hour.horizon,
            .below = hour.below,
            .ambient = glm::mix(glm::dvec3(1), above / luminance(above), kKept),
            .rise = kRise,
            .sunward = kSunward,
            .to_sun = to_sun,
            .glow = hour.glow};
}

}  // namespace si
