// The region across a light's view in which casters shadow given receivers, shared by the fits that narrow a map.
#pragma once

#include <span>
#include <vector>

#include "renderer/view/bounds/convex.h"
#include "renderer/view/cascades/cascades.h"
#include "renderer/view/fits/region.h"

namespace si {

/// Returns the extent of the part of a box that a light can reach; x and y as in MapRegion, z in metres. Empty if the
/// light reaches no part.
/// @param box index into SceneShape::boxes
/// @param seen a slice of the camera's frustum; only the part inside it counts
ViewExtent lit_extent(const FitInput& in, std::size_t box, const CameraSlice* seen = nullptr);

/// Returns a region that contains every place where a caster shadows a receiver facing the light; empty without any
/// shadow. Tests boxes. Flat casters and large convex casters are also clipped by their planes and outlines, since they
/// cannot shadow their own lit side. Back-facing triangles of single-sided receivers are skipped.
/// @param receivers lit_extent() by box of the shape; empty for boxes that do not count
std::optional<MapRegion> shadowed_region(const FitInput& in, std::span<const ViewExtent> receivers);

}  // namespace si
