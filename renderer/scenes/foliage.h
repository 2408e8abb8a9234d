// Foliage: a leaf texture with alpha, and clusters of leaf cards.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Draws a texture of a sprig of leaves for leaf cards, stem at the bottom edge. Alpha is the leaves' coverage.
/// @param size side of the square texture, texels
Texture make_sprig_texture(int size);

/// Makes a mesh of square leaf cards, scattered in a ball around the origin and facing outwards. The cards are
/// double-sided.
/// @param radius of the ball, metres @param card_size side of a card, metres @param cards number of cards
/// @param seed of the random positions
Mesh make_leaf_cluster(double radius, double card_size, int cards, std::uint32_t seed);

}  // namespace si
