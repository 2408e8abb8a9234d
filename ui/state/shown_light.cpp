#include "ui/state/shown_light.h"

#include <algorithm>

#include "renderer/frame/frame.h"

namespace si {

int shown_light(const Settings& settings) {
    const int count = std::clamp(settings.light_count, 0, kMaxLights);
    return count == 0 ? -1 : std::clamp(settings.view.light, 0, count - 1);
}

int shown_face(const Settings& settings, const FrameResult& result) {
    const int light = shown_light(settings);
    if (light < 0 || std::size_t(light) >= result.lights.size()) return 0;
    return std::clamp(settings.view.face, 0, std::max(0, int(result.lights[std::size_t(light)].views.size()) - 1));
}

}  // namespace si
