// Taps of a probed pixel's kernel, as a grid of coloured squares and as cells on the receiver's plane.
#pragma once

#include <imgui.h>

#include "renderer/inspect/probe.h"
#include "ui/scene_view/picture_painter.h"

namespace si {

/// Returns the colour of a kernel's tap: lit, shadowed by another surface, or shadowed by the surface itself. Taps with
/// a small weight are faint.
/// @param heaviest largest weight of the kernel's taps (heaviest_tap()), which gets the full colour
ImU32 tap_colour(const KernelTap& tap, double heaviest);
/// Returns the largest weight among the taps of a probed pixel's kernel, for tap_colour(); 0 without taps.
double heaviest_tap(const Probe::PerLight& light);

/// Draws the kernel of a probed pixel as a square grid of taps at the ImGui cursor, the map's top row first. A tooltip
/// shows the numbers of the tap under the mouse. @param side width of the grid, pixels
void draw_tap_grid(const Probe::PerLight& light, float side);

/// Draws the legend of the colours of a kernel's taps, one per line.
void draw_tap_key();

/// Draws the texels of the probed pixel's kernel into the scene picture, on the plane of the receiver and in the
/// colours of their taps.
void draw_kernel_on_surface(const PicturePainter& painter, const Probe::PerLight& light);

}  // namespace si
