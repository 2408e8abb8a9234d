// The cross-section of a probed pixel's shadow test, in a panel and as a picture of its own.
#pragma once

#include <imgui.h>

#include <memory>

#include "ui/panels/probe_panel.h"

namespace si {

/// Draws the cross-section of one light's shadow test at the probed pixel: surface and stored depths along the light's
/// ray. Draws into the current window, with tooltips on the marks. Draws nothing if there is no section.
/// @param views cache of drawings @param light index of the light @param size size in pixels, from the ImGui cursor
void draw_section_view(SectionViews& views, const Sections& sections, std::size_t light, ImVec2 size);

/// Cross-section of a shadow test (surface and stored depths along the light's ray), drawn as a separate image for
/// saving. Coordinates are pixels from the upper left corner.
struct SectionSheet {
    std::unique_ptr<ImDrawList> list;
    int width = 0;   ///< pixels
    int height = 0;  ///< pixels
};

/// Draws a cross-section of a shadow test (surface and stored depths along the light's ray) as a separate image, with
/// verdict and legend. Uses the editor's fonts and colours. Call within an ImGui frame, in any window.
SectionSheet section_sheet(const Section& section);

}  // namespace si
