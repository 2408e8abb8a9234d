// What frames and their passes took when they were timed last.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <string_view>

#include "renderer/frame/frame.h"

namespace si {

struct TimedFrame {
    double at_s = 0;             ///< when it was shown first
    double ms = 0, maps_ms = 0;  ///< of all passes that ran, and of those that draw maps
    bool drew_maps = false;      ///< else they were reused, or there are none
};

struct FrameTimes {
    static constexpr double kKept_s = 30;

    std::string scene;                      ///< as named; nothing is kept from one to the next
    std::map<std::string, double> pass_ms;  ///< of each pass that was ever timed
    std::deque<TimedFrame> frames;          ///< of the last `kKept_s`, the latest at the end; at least that one
    bool of_shown = false;                  ///< the latest is the frame that is shown
};

/// Takes the times of a frame of `scene` that is shown, where its passes were timed and some ran. Call in every frame
/// of the window: one that stays counts once. @param now_s of the window's clock
void keep_times(FrameTimes& times, const FrameResult& shown, std::string_view scene, double now_s);

}  // namespace si
