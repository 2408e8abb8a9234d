// Table of settings: all groups of rows, in the order of panels, listings and presets.
#include "renderer/settings/rows.h"

namespace si {

// A group added to Settings needs its rows in the list of params(). Groups: scene, map, caster, bias, filter,
// light_count, lights, volumes, contact, blob, light_map, shading, camera, view, truth, objects.
static_assert(rows::member_count<Settings>() == 16, "Settings has a member without rows: add them to params()");

std::span<const Param> params() {
    static const std::vector<Param> table = [] {
        std::vector<Param> all;
        for (const auto& group :
             {shadow_rows(), light_rows(), source_rows(), picture_rows(), view_rows(), reference_rows()})
            all.insert(all.end(), group.begin(), group.end());
        for (Param& p : all) {
            if (p.choices) {
                p.min = 0;
                p.max = double(p.choices().size()) - 1;
            }
        }
        return all;
    }();
    return table;
}

}  // namespace si
