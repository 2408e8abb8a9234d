// The cross-section of a probed pixel's shadow test, drawn into a panel.
#pragma once

#include <imgui.h>

#include "ui/panels/probed.h"

namespace si {

/// Draws the section of that light of the probe at the cursor, `size` pixels large, as one item that tells under the
/// mouse what its marks mean. Nothing where there is none.
void draw_section_view(SectionViews& views, const Sections& sections, std::size_t light, ImVec2 size);

}  // namespace si
