#include "renderer/measure/sun_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace si {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kDegreesPerHour = 15;
constexpr double kNoon = 12;

/// Returns half the length of a day, hours: cos w = -tan(latitude) tan(declination) (Duffie, Beckman, equation 1.6.10).
double half_day_hours(double latitude_deg, double declination_deg) {
    const double c = -std::tan(latitude_deg * kRadians) * std::tan(declination_deg * kRadians);
    return std::acos(std::clamp(c, -1.0, 1.0)) / kRadians / kDegreesPerHour;
}

}  // namespace

double sun_declination_deg(int day) {
    const double b = 2 * std::numbers::pi * (day - 1) / 365;
    return (0.006918 - 0.399912 * std::cos(b) + 0.070257 * std::sin(b) - 0.006758 * std::cos(2 * b) +
            0.000907 * std::sin(2 * b) - 0.002697 * std::cos(3 * b) + 0.00148 * std::sin(3 * b)) /
           kRadians;
}

SunPosition sun_position(double latitude_deg, int day, double hour) {
    const double latitude = latitude_deg * kRadians, declination = sun_declination_deg(day) * kRadians;
    const double angle = (hour - kNoon) * kDegreesPerHour * kRadians;  // positive in the afternoon
    const double up =
        std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(angle);
    const double south =
        std::sin(latitude) * std::cos(declination) * std::cos(angle) - std::cos(latitude) * std::sin(declination);
    const double east = -std::cos(declination) * std::sin(angle);
    return {hour, std::atan2(east, south) / kRadians, std::asin(std::clamp(up, -1.0, 1.0)) / kRadians};
}

std::vector<SunPosition> sun_path(double latitude_deg, int day, int count) {
    std::vector<SunPosition> out;
    const double half = half_day_hours(latitude_deg, sun_declination_deg(day));
    if (!(half > 0)) return out;
    for (int i = 0; i < count; ++i) {
        SunPosition sun = sun_position(latitude_deg, day, kNoon + half * (2 * (i + 0.5) / count - 1));
        // South of the sun's zenith, noon lies at 180 degrees, which is -180.
        if (!out.empty())
            sun.azimuth_deg = out.back().azimuth_deg + std::remainder(sun.azimuth_deg - out.back().azimuth_deg, 360);
        out.push_back(sun);
    }
    return out;
}

}  // namespace si
