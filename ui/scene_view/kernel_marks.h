// Taps of a probed pixel's kernel, as a grid of coloured squares and as cells on the receiver's plane.
#pragma once

#include <imgui.h>

#include "renderer/inspect/probe.h"
#include "ui/scene_view/picture_painter.h"

namespace si {

/// Returns the colour of a kernel's tap: lit, shadowed by another surface, or shadowed by the surface itself. Small
/// weights are faint. @param heaviest heaviest_tap()
ImU32 tap_colour(const KernelTap& tap, double heaviest);
/// Returns the largest weight among the taps of a probed pixel's kernel.
double heaviest_tap(const Probe::PerLight& light);

/// Draws a probed pixel's kernel as a square grid of taps at the cursor, the map's top row first. A tooltip shows
/// the numbers of the tap under the mouse. @param side width of the grid, pixels
void draw_tap_grid(const Probe::PerLight& light, float side);

/// Draws the legend of the tap colours, one a line.
void draw_tap_key();

/// Draws the outline of each texel of the probed pixel's kernel on the plane of the surface, in its tap's colour.
void draw_kernel_on_surface(const PicturePainter& painter, const Probe::PerLight& light);

}  // namespace si
