// Foliage: a leaf texture with alpha, and clusters of leaf cards.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Draws a texture of a sprig of leaves, `size` pixels square, stem at the bottom edge; alpha is the leaves' coverage.
Texture make_sprig_texture(int size);

/// Makes a mesh of `cards` double-sided square leaf cards, scattered in a ball around the origin and facing outwards.
/// @param radius of the ball, metres @param card_size side of a card, metres
Mesh make_leaf_cluster(double radius, double card_size, int cards, std::uint32_t seed);

}  // namespace si
