// Strip of error, time or shimmer along a light's path, which is dragged to set the light.
#pragma once

#include <optional>
#include <string>

#include "renderer/measure/light_path.h"
#include "ui/panels/tune_controls.h"

namespace si {

/// Number that the strip plots.
enum class StripPlots { Error, Time, Shimmer };

/// State of the strip along a light's path: the path's ends, and the number that the strip plots.
struct LightStripPanel {
    bool day = false;                               ///< the sun over a day; else from one direction to another
    double azimuth_from = -90, azimuth_to = 90;     ///< degrees
    double elevation_from = 30, elevation_to = 30;  ///< degrees
    double latitude = 48;                           ///< degrees, north positive
    int day_of_year = 172;                          ///< 1 to 365
    int steps = kPathSteps;
    StripPlots plots = StripPlots::Error;
};

/// Data that the strip along a light's path shows.
struct LightStripFacts {
    std::optional<SearchProgress> measuring_path;  ///< none: not under way
    const LightPathResult* path = nullptr;  ///< last result for this scene, also while it is measured; null: none
    bool path_current = false;              ///< of the present settings, the light's direction aside
};

/// Requests of the strip.
struct LightStripRequests {
    std::optional<std::string> measure_along;  ///< path for straight_path()
    std::optional<std::string> measure_day;    ///< path for day_path()
    int path_steps = kPathSteps;
    bool cancel_path = false;
    bool save_worst = false;  ///< the settings are at the worst step: choose a file for the preset
};

/// Returns the position on a path's strip, 0..1, of the settings; none: they are not on the path.
std::optional<double> strip_position(const LightPathResult& result, const Settings& settings);
/// Sets the settings of a light to a position on a path, 0..1, between its points, too.
void set_strip_position(const LightPathResult& result, double position, Settings& settings);

/// Draws the fields of the path and the strip. @param settings changed by a drag, and by going to the worst step
void draw_light_strip(LightStripPanel& panel, Settings& settings, const LightStripFacts& facts,
                      LightStripRequests& requests);

}  // namespace si
