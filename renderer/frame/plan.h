// The plan of a frame: passes in order, each with what it reads and writes, and why it runs or not.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

struct Pass {
    std::string name;
    PassCategory category = PassCategory::Picture;
    std::vector<ResultRef> reads, writes;
    std::string unneeded;             ///< why the scene does not call for it; empty: it does
    std::uint64_t key = 0;            ///< of everything the result depends on
    std::uint64_t* cached = nullptr;  ///< key of the contents that the target holds
    std::function<void(PassInfo&)> run;
    std::string idle_reason = "nothing reads it";  ///< shown when no live pass reads what it writes
};

/// Walks back from `wanted`: a pass lives when something wanted or read by a live pass is written by it. Dead passes
/// and passes the scene does not call for are skipped, passes whose key is unchanged are reused, others are to run.
/// `force` runs cached passes, `no_skip` those that the scene does not call for.
std::vector<PassInfo> plan_passes(const std::vector<Pass>& passes, const std::vector<ResultRef>& wanted, bool force,
                                  bool no_skip);

}  // namespace si
