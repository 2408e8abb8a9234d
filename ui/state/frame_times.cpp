#include "ui/state/frame_times.h"

namespace si {

void keep_times(FrameTimes& times, const FrameResult& shown, std::string_view scene, double now_s) {
    if (times.scene != scene) times = {.scene = std::string(scene)};
    TimedFrame frame{.at_s = now_s};
    for (const PassInfo& pass : shown.passes) {
        if (pass.state != PassState::Drawn || pass.gpu_ms <= 0) continue;
        times.pass_ms[pass.name] = pass.gpu_ms;
        frame.ms += pass.gpu_ms;
        if (pass.category == PassCategory::Maps) {
            frame.maps_ms += pass.gpu_ms;
            frame.drew_maps = true;
        }
    }
    times.newest_is_shown = frame.ms > 0;
    if (times.newest_is_shown) times.clock = shown.clock;
    const bool stays = !times.frames.empty() && times.frames.back().ms == frame.ms;
    if (times.newest_is_shown && !stays) times.frames.push_back(frame);
    while (times.frames.size() > 1 && times.frames.front().at_s < now_s - FrameTimes::kKept_s) times.frames.pop_front();
}

}  // namespace si
