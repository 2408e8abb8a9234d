// Times of frames and passes, as measured last.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <string_view>

#include "renderer/frame/frame.h"

namespace si {

/// GPU times of one frame, for the plot of frame times.
struct TimedFrame {
    double at_s = 0;         ///< time at which it was shown first, seconds
    double ms = 0;           ///< sum of all passes that ran
    double maps_ms = 0;      ///< sum of the passes that draw maps
    bool drew_maps = false;  ///< else maps were cached, or there are none
};

/// GPU times of one scene's last frames and passes, for the plot of frame times.
struct FrameTimes {
    static constexpr double kKept_s = 30;  ///< age up to which frames are kept

    std::string clock;                      ///< name of the clock of all times; empty: none was taken
    std::string scene;                      ///< built-in scene key or path; another scene drops all times
    std::map<std::string, double> pass_ms;  ///< last time of each pass, by its name
    std::deque<TimedFrame> frames;          ///< frames of the last kKept_s, newest last; at least the newest
    bool newest_is_shown = false;           ///< the newest is the frame that is shown
};

/// Adds the GPU times of the shown frame to the recorded ones, if its passes were timed. Call in every frame of the
/// window; a frame that stays on the screen is added once.
/// @param scene the name of the scene; times of another scene are dropped
/// @param now_s time of the window's clock, seconds
void keep_times(FrameTimes& times, const FrameResult& shown, std::string_view scene, double now_s);

}  // namespace si
