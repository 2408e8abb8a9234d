// Estimate of the time that long work still takes.
#pragma once

#include <chrono>

namespace si {

/// Estimates the remaining seconds of work that took `passed` seconds to reach `progress` (0..1). Returns 0 while it is
/// too early to say (before 1 s or 5 %), and at the end.
inline double remaining_seconds(double passed, double progress) {
    constexpr double kMinSeconds = 1, kMinProgress = 0.05;
    if (passed < kMinSeconds || progress < kMinProgress || progress >= 1) return 0;
    return passed / progress * (1 - progress);
}

/// Estimate of the time until long work ends. The clock starts with the construction of the object.
class TimeLeft {
public:
    /// Estimates the seconds until the work ends (remaining_seconds()); 0: too early to say.
    /// @param share part of the work that is done, 0..1
    double seconds(double share) const {
        return remaining_seconds(std::chrono::duration<double>(Clock::now() - began_).count(), share);
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point began_ = Clock::now();
};

}  // namespace si
