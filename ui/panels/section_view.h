// The cross-section of a probed pixel's shadow test, drawn into a panel, and alone for a picture.
#pragma once

#include <imgui.h>

#include <memory>

#include "ui/panels/probe_panel.h"

namespace si {

/// Draws the section of that light of the probe at the cursor, `size` pixels large, as one item that tells under the
/// mouse what its marks mean. Nothing where there is none.
void draw_section_view(SectionViews& views, const Sections& sections, std::size_t light, ImVec2 size);

/// What ImGui's backend makes a picture of: places are pixels, from the upper left corner.
struct SectionSheet {
    std::unique_ptr<ImDrawList> list;
    int width = 0, height = 0;
};

/// All that an SVG of the section holds, verdict and legend too, in the editor's letters and colours. Between
/// NewFrame() and the next, in any place.
SectionSheet section_sheet(const Section& section);

}  // namespace si
