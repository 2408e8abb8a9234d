// The cross-section of a probed pixel's shadow test, in a panel and as a picture of its own.
#pragma once

#include <imgui.h>

#include <memory>

#include "ui/panels/probe_panel.h"

namespace si {

/// Draws one light's section as an item, `size` pixels from the cursor, with tooltips on its marks. Does nothing
/// without a section.
void draw_section_view(SectionViews& views, const Sections& sections, std::size_t light, ImVec2 size);

/// Draw list of a picture. Coordinates are pixels from the upper left corner.
struct SectionSheet {
    std::unique_ptr<ImDrawList> list;
    int width = 0;   ///< pixels
    int height = 0;  ///< pixels
};

/// Returns the section with verdict and legend, in the editor's fonts and colours. Call between ImGui::NewFrame() and
/// the next, in any window.
SectionSheet section_sheet(const Section& section);

}  // namespace si
