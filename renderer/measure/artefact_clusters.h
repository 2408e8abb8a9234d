// Wrong pixels that hang together.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/reference/metrics.h"

namespace si {

/// Pixels of one cause, neighbours also across corners.
struct ArtefactCluster {
    glm::ivec2 pixel{0};           ///< the one next to their mean place, row 0 at the top
    glm::ivec2 first{0}, last{0};  ///< corners of the rectangle that holds all of them
    std::size_t pixels = 0;
};

/// Largest first; those of one size row by row. @param judged top row first, `width` of them a row
/// @param most so many are returned
std::vector<ArtefactCluster> artefact_clusters(const std::vector<JudgedPixel>& classified, int width, Artefact cause,
                                               std::size_t most);

}  // namespace si
