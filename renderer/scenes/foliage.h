// Leaves: a texture with alpha drawn in code, and clusters of cards that carry it.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// A sprig of leaves, `size` pixels square, stem at the bottom edge; alpha is the leaves' coverage.
Texture make_sprig_texture(int size);

/// `cards` square double-sided leaf cards of `card_size` metres scattered in a ball around the origin, turned outwards.
Mesh make_leaf_cluster(double radius, double card_size, int cards, std::uint32_t seed);

}  // namespace si
