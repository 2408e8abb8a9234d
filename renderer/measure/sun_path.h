// Path of the sun over a day at a latitude.
#pragma once

#include <vector>

namespace si {

/// Position of the sun in the sky.
struct SunPosition {
    double hour = 12;          ///< solar time, hours since midnight; the sun is highest at 12
    double azimuth_deg = 0;    ///< as light.azimuth: 0 is south (+z), 90 east (+x), 180 north (-z)
    double elevation_deg = 0;  ///< above the horizon
};

/// Computes the sun's declination on a day in degrees, with an error below 0.04 degrees: Spencer, "Fourier series
/// representation of the position of the sun", Search 2 (5), 1971.
/// @param day day of the year, 1 to 365
double sun_declination_deg(int day);

/// Computes the sun's position at a solar time: Duffie, Beckman, Solar Engineering of Thermal Processes, 4th edition,
/// equations 1.6.2, 1.6.5 and 1.6.6. Ignores refraction and the sun's size.
/// @param latitude_deg north is positive, -90 to 90 @param day day of the year, 1 to 365
/// @param hour solar time, hours since midnight
SunPosition sun_position(double latitude_deg, int day, double hour);

/// Computes `count` positions of the sun between sunrise and sunset, at the middles of equal intervals of time, so that
/// none is on the horizon. On a polar day they cover 24 hours. Azimuths do not jump by 360 degrees. Empty for a polar
/// night.
/// @param latitude_deg north is positive, -90 to 90 @param day day of the year, 1 to 365
std::vector<SunPosition> sun_path(double latitude_deg, int day, int count);

}  // namespace si
