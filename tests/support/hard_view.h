// Draws rows of the table of hard cases with the settings of their presets.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/scenes/hard_cases.h"
#include "renderer/settings/param.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"

namespace si::test {

/// Scene and settings of one hard case, ready to draw.
struct DrawnCase {
    Scene scene;
    Settings settings;
};

/// Returns a hard case's scene with the settings of its preset and further changes. Fails the test if there is no such
/// case.
/// @param key key of the row in the table of hard cases
/// @param fixed chooses the preset with the fix; otherwise the preset that shows the fault
inline DrawnCase hard_view(std::string_view key, bool fixed, const Sets& changes = {}) {
    for (const HardCaseView& view : hard_case_views())
        if (view.row->key == key && (view.fixed == fixed || view.row->broken.empty())) {
            DrawnCase out{view.scene(), view.settings()};
            for (const auto& [setting, value] : changes) set_setting(out.settings, setting, value);
            return out;
        }
    ADD_FAILURE() << "no hard case " << key;
    return {};
}

/// Draws a hard case and checks the results as draw_shot() of its scene and settings does. Sizes are pixels.
inline Shot draw_shot(const DrawnCase& c, int width = 160, int height = 120) {
    return draw_shot(c.scene, c.settings, width, height);
}

}  // namespace si::test
