#include "renderer/frame/plan.h"

#include <algorithm>
#include <set>

namespace si {

std::vector<PassInfo> plan_passes(const std::vector<Pass>& passes, const std::vector<std::string>& wanted, bool force,
                                  bool no_skip) {
    std::vector<PassInfo> out(passes.size());
    std::set<std::string, std::less<>> needed(wanted.begin(), wanted.end());
    for (std::size_t i = passes.size(); i-- > 0;) {
        const Pass& pass = passes[i];
        PassInfo& info = out[i];
        info.name = pass.name;
        info.category = pass.category;
        const bool live = std::any_of(pass.writes.begin(), pass.writes.end(),
                                      [&](const std::string& w) { return needed.contains(w); });
        if (!pass.unneeded.empty() && !(no_skip && pass.run && live)) {
            info.reason = pass.unneeded;
            continue;
        }
        if (!live) {
            info.reason = pass.idle_reason;
            continue;
        }
        needed.insert(pass.reads.begin(), pass.reads.end());
        if (!force && pass.cached && *pass.cached == pass.key) {
            info.state = PassState::Reused;
            info.reason = "nothing it depends on changed";
        } else {
            info.state = PassState::Ran;
            info.reason = force && pass.cached && *pass.cached == pass.key ? "asked to run" : "its inputs changed";
        }
    }
    return out;
}

const PassInfo* FrameResult::pass(std::string_view name) const {
    for (const PassInfo& p : passes)
        if (p.name == name) return &p;
    return nullptr;
}

}  // namespace si
