// The cross-section of a probed pixel's shadow test, in a panel and as a picture of its own.
#pragma once

#include <imgui.h>

#include <memory>

#include "ui/panels/probe_panel.h"

namespace si {

/// Draws the cross-section of one light's shadow test into the panel, with tooltips on its marks. Does nothing without
/// a section. @param light the index of the light @param size the size in pixels, counted from the cursor
void draw_section_view(SectionViews& views, const Sections& sections, std::size_t light, ImVec2 size);

/// Drawing of a cross-section for a picture of its own. Coordinates are pixels from the upper left corner.
struct SectionSheet {
    std::unique_ptr<ImDrawList> list;
    int width = 0;   ///< pixels
    int height = 0;  ///< pixels
};

/// Lays out a cross-section with verdict and legend as a picture of its own, in the editor's fonts and colours. Call
/// within an ImGui frame, in any window.
SectionSheet section_sheet(const Section& section);

}  // namespace si
