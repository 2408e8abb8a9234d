// The scenes and settings of the table of hard cases, as tests draw them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/scenes/hard_cases.h"
#include "renderer/settings/param.h"
#include "tests/support/hard_case.h"

namespace si::test {

using Changes = std::vector<std::pair<std::string, std::string>>;

struct DrawnCase {
    Scene scene;
    Settings settings;
};

/// A row's scene with the settings of its preset, and changes to them.
inline DrawnCase hard_view(std::string_view key, bool fixed, const Changes& changes = {}) {
    for (const HardCaseView& view : hard_case_views())
        if (view.row->key == key && (view.fixed == fixed || view.row->broken.empty())) {
            DrawnCase out{view.scene(), view.settings()};
            for (const auto& [setting, value] : changes) set_setting(out.settings, setting, value);
            return out;
        }
    ADD_FAILURE() << "no hard case " << key;
    return {};
}

inline Shot draw_shot(const DrawnCase& c, int width = 160, int height = 120) {
    return draw_shot(c.scene, c.settings, width, height);
}

}  // namespace si::test
