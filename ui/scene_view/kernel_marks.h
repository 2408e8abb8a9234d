// The taps of a probed pixel's kernel: as a grid of coloured squares, and as cells on the receiver's plane.
#pragma once

#include <imgui.h>

#include "renderer/inspect/probe.h"
#include "ui/scene_view/picture_painter.h"

namespace si {

/// Lit, dark by another surface, dark by the surface itself; fainter for taps that weigh less.
ImU32 tap_colour(const KernelTap& tap, double heaviest);
/// The largest weight of a kernel's taps.
double heaviest_tap(const Probe::PerLight& light);

/// The kernel as a square grid, the map's top row first, `side` pixels wide, at the cursor. Hovering a cell shows its
/// numbers and returns it.
const KernelTap* draw_tap_grid(const Probe::PerLight& light, float side);

/// What the colours mean, one below the other.
void draw_tap_key();

/// Outlines each texel that the kernel compares on the plane of the probed surface, in its colour.
void draw_kernel_on_surface(const PicturePainter& painter, const Probe::PerLight& light);

}  // namespace si
