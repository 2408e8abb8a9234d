// Where casters throw shadows on given receivers: what the fits share that narrow a map down to it.
#pragma once

#include <span>
#include <vector>

#include "renderer/view/bounds/convex.h"
#include "renderer/view/cascades/cascades.h"
#include "renderer/view/fits/region.h"

namespace si {

/// Extent across and along the view (as the region's, and metres) of what the light can reach of a box of the shape.
/// Empty where it reaches nothing.
/// @param seen only what lies in it counts
ViewExtent lit_extent(const FitInput& in, std::size_t box, const CameraSlice* seen = nullptr);

/// Holds every place across the view where a caster shadows a receiver that faces the light, by their boxes. Flat
/// casters, and large ones that are convex, are looked at closer: they shadow nothing that lies in the planes that they
/// turn to the light or before them, nothing beyond their outline, and of single-sided materials, whose back faces are
/// not drawn, no triangle that faces away.
/// @param receivers by box of the shape, empty for those that do not count
/// @return nothing where there is no shadow at all
std::optional<MapRegion> shadowed_region(const FitInput& in, std::span<const ViewExtent> receivers);

}  // namespace si
