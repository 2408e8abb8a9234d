#include "app/sweep/base_case.h"

#include <algorithm>

#include "renderer/measure/shadow_time.h"
#include "renderer/settings/param.h"

namespace si {

SweepCase base_case(const Settings& common) {
    SweepCase base{.values = base_of_costs(), .starts = {}, .settings = common};
    set_settings(base.settings, base.values);
    base.id = "filter.kernel=hard map.resolution=1024";
    return base;
}

std::optional<std::size_t> base_number(const Settings& common, const SweepPlan& plan) {
    const Settings base = without_ineffective_settings(base_case(common).settings);
    const auto same = [&](const SweepCase& c) { return without_ineffective_settings(c.settings) == base; };
    const auto it = std::ranges::find_if(plan.cases, same);
    if (it == plan.cases.end()) return {};
    return std::size_t(it - plan.cases.begin());
}

}  // namespace si
