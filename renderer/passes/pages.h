// What the pages of virtual maps hold, for who reads maps back.
#pragma once

#include <vector>

#include "renderer/frame/state.h"
#include "renderer/passes/page_cache.h"

namespace si {

/// Stored depths of a part of a layer of the maps, bottom row first, of the frame whose pages were chosen last. What no
/// page was asked for is as deep as what was never drawn on.
std::vector<float> read_paged_depths(Resources& resources, int layer, glm::ivec2 first, glm::ivec2 size,
                                     float empty_depth);

/// Pages of the pool that the frame reads, and how many texels a side they have.
struct ReadPages {
    std::vector<PlacedPage> pages;
    int texels = 0;
};
ReadPages pages_read(Resources& resources);

/// Of the frame's pages. @param drawn whether the frame drew any itself
PageFacts page_facts(Resources& resources, bool drawn);

/// Adds the pass that draws the pages again without polygon offset and with masks at their finest level.
void add_unfiltered_pages_pass(FrameState& f, Pass pass);

}  // namespace si
