// Virtual shadow maps: their pages, drawn and read back.
#pragma once

#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"
#include "renderer/passes/page_cache.h"

namespace si {

/// What is drawn into maps, by instance as SceneGpu orders them.
struct PagedCasters {
    std::uint64_t key = 0;                ///< of the scene's arrangement
    std::vector<std::uint64_t> content;   ///< of all that an instance's depths come of; 0: it never casts
    std::vector<std::size_t> indices;     ///< how many its mesh has
    std::vector<Box> corners;             ///< of its box, world
    std::vector<std::vector<Box>> parts;  ///< of the boxes of its parts; none: it is no large mesh
};

/// Pages of the pool that the frame reads, and how many texels a side they have.
struct ReadPages {
    std::vector<PlacedPage> pages;
    int texels = 0;
};

/// Finds which pages of virtual maps look-ups may read, and draws those that are not kept, in place of whole maps.
class PagePasses : public FramePass {
public:
    struct Targets {
        gl::Target wanted;            ///< R8UI, a texel a page, a layer a view
        gl::Target nothing;           ///< a pixel for each of the picture; OpenGL wants something to draw into
        gl::Target pool, unfiltered;  ///< pages of the maps side by side
        gl::Target block, depth;      ///< what pages are drawn in, and beside it where that is colour
        gl::Target table;             ///< RGBA16UI, see shared/pages.h
        PageCache cache;
        PageChoice choice;
        PageFacts facts;
        int page = 0;                                 ///< texels along a page's side
        std::vector<std::uint64_t> unfiltered_pages;  ///< by slot, what `unfiltered` holds
        PagedCasters casters;
        int draw_calls = 0;
    };

    void declare(FrameState& f) override;
    /// Adds the pass that draws the pages again without polygon offset and with masks at their finest level.
    void declare_unfiltered(FrameState& f, Pass pass);

    /// Returns stored depths of a part of a layer of the maps, bottom row first, of the frame whose pages were chosen
    /// last. What no page was asked for is as deep as what was never drawn on.
    std::vector<float> read_depths(int layer, glm::ivec2 first, glm::ivec2 size, float empty_depth) const;
    ReadPages read_pages() const;
    /// Returns facts about the frame's pages. @param drawn whether the frame drew any itself
    PageFacts page_facts(bool drawn) const;

private:
    Targets targets_;
};

}  // namespace si
