// Strip of error, time or shimmer along a light's path, which is dragged to set the light.
#pragma once

#include <optional>
#include <string>

#include "renderer/measure/light_path.h"
#include "ui/panels/tune_controls.h"

namespace si {

/// Measured number that the page Light path plots over the positions along the path of a light.
enum class StripPlots { Error, Time, Shimmer };

/// State of the page Light path: ends of the path, and the number that is plotted along it (error, time or shimmer).
struct LightStripPanel {
    bool day = false;                               ///< the sun over a day; else from one direction to another
    double azimuth_from = -90, azimuth_to = 90;     ///< degrees
    double elevation_from = 30, elevation_to = 30;  ///< degrees
    double latitude = 48;                           ///< degrees, north positive
    int day_of_year = 172;                          ///< 1 to 365
    int steps = kPathSteps;
    StripPlots plots = StripPlots::Error;
};

/// Data for the page Light path: progress and last result of its measurement.
struct LightStripFacts {
    std::optional<SearchProgress> measuring_path;  ///< none: not under way
    const LightPathResult* path = nullptr;  ///< last result for this scene, also while it is measured; null: none
    bool path_current = false;              ///< `path` belongs to the present settings, except the light's direction
};

/// Requests of the page Light path: measure a path, cancel, save the worst step (largest error) as a preset.
struct LightStripRequests {
    std::optional<std::string> measure_along;  ///< path for straight_path()
    std::optional<std::string> measure_day;    ///< path for day_path()
    int path_steps = kPathSteps;
    bool cancel_path = false;
    bool save_worst = false;  ///< the settings are at the worst step: choose a file for the preset
};

/// Returns the position of the present settings along a measured path of a light, 0 at its first point to 1 at its
/// last. None if the settings are not on the path.
std::optional<double> strip_position(const LightPathResult& result, const Settings& settings);
/// Sets the settings that a measured path of a light varies, such as the azimuth, to their values at a position.
/// Interpolates between the points of the path.
/// @param position 0 at the first point to 1 at the last
void set_strip_position(const LightPathResult& result, double position, Settings& settings);

/// Draws the fields that define the path of a light, and the plot of error, time or shimmer along it.
/// @param settings changed by a drag over the plot, and by the button that goes to the worst step (largest error)
void draw_light_strip(LightStripPanel& panel, Settings& settings, const LightStripFacts& facts,
                      LightStripRequests& requests);

}  // namespace si
