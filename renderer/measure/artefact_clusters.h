// Clusters of adjacent pixels that are wrong for the same cause.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/reference/metrics.h"

namespace si {

/// Cluster of pixels, adjacent by side or corner, whose shadow is wrong for the same cause (Artefact).
struct ArtefactCluster {
    glm::ivec2 pixel{0};           ///< pixel of the cluster nearest to the cluster's mean position, from the top left
    glm::ivec2 first{0}, last{0};  ///< corners of the bounding rectangle, inclusive
    std::size_t pixels = 0;        ///< number of pixels
};

/// Finds the clusters of adjacent pixels whose shadow is wrong for `cause`. The largest cluster comes first; clusters
/// of equal size come in reading order.
/// @param classified the class of each pixel, top row first @param width pixels per row
/// @param max_clusters largest number of clusters to return
std::vector<ArtefactCluster> artefact_clusters(const std::vector<ClassifiedPixel>& classified, int width,
                                               Artefact cause, std::size_t max_clusters);

}  // namespace si
