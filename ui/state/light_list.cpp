#include "ui/state/light_list.h"

#include <algorithm>
#include <cmath>

#include "renderer/frame/frame.h"

namespace si {
namespace {

constexpr double kTurn_deg = 75;   ///< angle, or its multiples, from the shown light to an added one
constexpr double kApart_deg = 30;  ///< smallest angle of an added light to all others, if possible
constexpr int kTurns = 24;         ///< number of turns of kTurn_deg until directions repeat

bool exists(const Settings& s, int light) {
    return light >= 0 && light < std::min(s.light_count, kMaxLights);
}

/// Returns the angle to the nearest light, degrees.
double clearance(const Settings& s, double azimuth) {
    double least = 360;
    for (int i = 0; i < std::min(s.light_count, kMaxLights); ++i)
        least = std::min(least, std::abs(std::remainder(s.lights[std::size_t(i)].azimuth - azimuth, 360.0)));
    return least;
}

/// Returns a direction apart from all other lights: the first of some turns that is far enough, else the best one.
double free_azimuth(const Settings& s, double from) {
    double best = from, most = -1;
    for (int turn = 1; turn < kTurns; ++turn) {
        const double azimuth = std::remainder(from + turn * kTurn_deg, 360.0), room = clearance(s, azimuth);
        if (room >= kApart_deg) return azimuth;
        if (room > most) {
            best = azimuth;
            most = room;
        }
    }
    return best;
}

}  // namespace

int shown_light(const Settings& settings) {
    const int count = std::clamp(settings.light_count, 0, kMaxLights);
    return count == 0 ? -1 : std::clamp(settings.view.light, 0, count - 1);
}

const FittedLight* shown_fitted_light(const Settings& settings, const FrameResult& result) {
    const int light = shown_light(settings);
    return light >= 0 && std::size_t(light) < result.lights.size() ? &result.lights[std::size_t(light)] : nullptr;
}

int shown_face(const Settings& settings, const FrameResult& result) {
    const FittedLight* const light = shown_fitted_light(settings, result);
    return light ? std::clamp(settings.view.face, 0, std::max(0, int(light->views.size()) - 1)) : 0;
}

bool can_add_light(const Settings& s) {
    return s.light_count < kMaxLights;
}

void add_light(Settings& s) {
    if (!can_add_light(s)) return;
    const int added = std::max(s.light_count, 0);
    LightSettings light;
    if (exists(s, s.view.light)) light.azimuth = free_azimuth(s, s.lights[std::size_t(s.view.light)].azimuth);
    s.lights[std::size_t(added)] = light;
    s.light_count = added + 1;
    s.view.light = added;
}

void copy_light(Settings& s, int light) {
    if (!can_add_light(s) || !exists(s, light)) return;
    const auto after = s.lights.begin() + light + 1;
    std::copy_backward(after, s.lights.begin() + s.light_count, s.lights.begin() + s.light_count + 1);
    *after = s.lights[std::size_t(light)];
    after->name.clear();  // two lights of one name could not be distinguished
    ++s.light_count;
    s.view.light = light + 1;
}

void delete_light(Settings& s, int light) {
    if (!exists(s, light)) return;
    std::copy(s.lights.begin() + light + 1, s.lights.begin() + s.light_count, s.lights.begin() + light);
    s.lights[std::size_t(--s.light_count)] = {};  // unused lights keep no settings
    if (s.view.light > light || s.view.light >= s.light_count) s.view.light = std::max(s.view.light - 1, 0);
}

bool is_solo(const Settings& s, int light) {
    if (!exists(s, light)) return false;
    for (int i = 0; i < s.light_count; ++i)
        if (s.lights[std::size_t(i)].on != (i == light)) return false;
    return true;
}

void solo_light(Settings& s, int light) {
    if (!exists(s, light)) return;
    const bool all = is_solo(s, light);
    for (int i = 0; i < s.light_count; ++i) s.lights[std::size_t(i)].on = all || i == light;
}

void move_light(Settings& s, int light, int places) {
    if (!exists(s, light)) return;
    const int to = std::clamp(light + places, 0, s.light_count - 1);
    const auto at = s.lights.begin();
    if (to > light) std::rotate(at + light, at + light + 1, at + to + 1);
    if (to < light) std::rotate(at + to, at + light, at + light + 1);
    s.view.light = to;
}

}  // namespace si
