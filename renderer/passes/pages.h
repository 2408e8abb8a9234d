// Passes that draw the pages of virtual shadow maps, and read them back.
#pragma once

#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"
#include "renderer/passes/page_cache.h"

namespace si {

/// Boxes and content keys of all casters, to find the casters of each page of a virtual shadow map. Members are by
/// index in SceneGpu::instance_objects().
struct PagedCasters {
    std::uint64_t key = 0;                ///< CasterContent::key from which this was made
    std::vector<std::uint64_t> content;   ///< content key of each instance's depths; 0: never casts
    std::vector<std::size_t> indices;     ///< index count of each instance's mesh
    std::vector<Box> corners;             ///< corners of each instance's box, world
    std::vector<std::vector<Box>> parts;  ///< boxes of the parts of large meshes; else empty
};

/// Description of one layer of the shadow map textures for reading it back: how it stores depth over distance, and
/// whether it is paged or holds distances.
struct MapLayer {
    DepthCurve curve;
    int layer = 0;
    bool paged = false, holds_distances = false;
};

/// Passes for virtual shadow maps: one finds the pages that look-ups may read, one draws those that are not cached.
/// They replace the passes that draw unpaged maps.
class PagePasses : public FramePass {
public:
    /// Images that PagePasses draws and keeps between frames for virtual maps, with the page cache and the choice of
    /// pages.
    struct Targets {
        gl::Target wanted;            ///< R8UI, a texel for each page, a layer for each view
        gl::Target nothing;           ///< unused image of the picture's size, as OpenGL needs an attachment
        gl::Target pool, unfiltered;  ///< all pages side by side
        gl::Target block, depth;      ///< page render target; its depth buffer where the map is a colour format
        gl::Target table;             ///< RGBA16UI, see shared/pages.h
        PageCache cache;
        PageChoice choice;
        PageFacts facts;
        int page = 0;                                 ///< texels along a page's side
        std::vector<std::uint64_t> unfiltered_pages;  ///< by slot: key of the page in `unfiltered`
        PagedCasters casters;
    };

    void declare(FrameState& f) override;
    /// Adds a pass to the frame's plan that draws the pages of virtual shadow maps without polygon offset and with
    /// alpha masks at their finest mip level. The trials that find the cause of a wrong pixel read these pages for the
    /// true depth of casters.
    /// @param pass pass with its name and reasons filled in
    void declare_unfiltered(FrameState& f, Pass pass);

    /// Reads back stored depths of a rectangle of one shadow map layer, bottom row first. Works for depth formats,
    /// colour formats and virtual maps.
    /// @param maps textures of the shadow maps; ignored for virtual maps
    /// @param of layer to read
    /// @param first lower left texel
    /// @param size width and height in texels
    std::vector<float> read_map_depths(const gl::Target& maps, const MapLayer& of, glm::ivec2 first,
                                       glm::ivec2 size) const;
    /// Returns the virtual map pages that look-ups of the last frame read, for the search for invalid numbers.
    const std::vector<PlacedPage>& read_pages() const { return targets_.choice.read; }
    /// Returns statistics of the pages of virtual shadow maps in the current frame.
    /// @param drawn true: this frame drew pages; false: all pages were cached
    PageFacts page_facts(bool drawn) const;

private:
    /// Reads back stored depths of a rectangle of one virtual shadow map layer, bottom row first.
    /// @param first lower left texel
    /// @param size width and height in texels
    /// @param empty_depth value for texels without a page
    std::vector<float> read_depths(int layer, glm::ivec2 first, glm::ivec2 size, float empty_depth) const;

    Targets targets_;
};

}  // namespace si
