// Taps of a probed pixel's kernel, as a grid of coloured squares and as cells on the receiver's plane.
#pragma once

#include <imgui.h>

#include "renderer/inspect/probe.h"
#include "ui/scene_view/picture_painter.h"

namespace si {

/// Returns the colour of a tap: lit, shadowed by another surface, or by the surface itself. Small weights are faint.
ImU32 tap_colour(const KernelTap& tap, double heaviest);
/// Returns the largest weight of a kernel's taps.
double heaviest_tap(const Probe::PerLight& light);

/// Draws the kernel as a square grid at the cursor, the map's top row first. Returns the tap under the mouse, whose
/// numbers are its tooltip; null: none. @param side width, pixels
const KernelTap* draw_tap_grid(const Probe::PerLight& light, float side);

/// Draws the colours with their meaning, one a line.
void draw_tap_key();

/// Outlines each texel of the kernel on the plane of the probed surface, in its tap's colour.
void draw_kernel_on_surface(const PicturePainter& painter, const Probe::PerLight& light);

}  // namespace si
