// What casts, drawn as a light sees it.
#pragma once

#include <functional>
#include <vector>

#include "renderer/frame/state.h"
#include "renderer/view/culling/map_cells.h"

namespace si {

/// Which of the casters that lie in a map are drawn.
struct CasterChoice {
    const MapCells* called = nullptr;         ///< what of the map is read; null: all
    const std::vector<bool>* only = nullptr;  ///< by instance as SceneGpu orders them; null: all
    bool over = false;                        ///< over what the map holds; else it is cleared first
    MapCells* covered = nullptr;              ///< takes up all that those drawn may cover; null: nobody asks
};

struct CasterView {
    glm::dmat4 clip_from_relative{1.0};  ///< from positions relative to `origin`
    DepthCurve curve;
    glm::dvec3 origin{0};
    bool unfiltered = false;   ///< without polygon offset, masks at their finest level
    bool clamps_near = false;  ///< what lies before the near plane is drawn at it
    int resolution = 1;        ///< texels along a side
    CasterChoice which;
};

/// Indices of a mesh, counted from its first.
struct IndexRange {
    std::size_t first = 0;
    GLsizei count = 0;
};

/// Adds what follows in the mesh, to the last part where that ends there.
void add_part(std::vector<IndexRange>& parts, IndexRange next);

enum class Seen { Nothing, Whole, Parts };

/// What can be seen of an instance, counted as SceneGpu orders them. @param[out] parts what to draw where it is Parts
using SeenOf = std::function<Seen(std::size_t instance, std::vector<IndexRange>& parts)>;

/// Whether an object casts, whatever its masks and its triangles' sides; blended ones do only if asked.
bool casts_at_all(const Scene& scene, const Settings& settings, const Object& object);
/// Whether a batch is drawn into maps, where blended materials can cast by their mask alone.
bool draws_into_maps(const FrameState& f, const Batch& batch);

/// Empties the bound framebuffer, or what of it the scissor test leaves, to the far depth.
void clear_casters(const FrameState& f, GLuint framebuffer, const DepthConvention& convention);

/// What drawing left out.
struct SkippedCasters {
    std::uint64_t beside = 0;  ///< instances of which nothing lies in the map
    std::uint64_t unread = 0;  ///< instances that cover nothing of what is called for
    std::uint64_t closed = 0;  ///< instances that were drawn by their front faces alone
    std::uint64_t bare = 0;    ///< instances that were drawn without a fragment shader
};

/// Draws every caster, or what of them can be seen, into the bound framebuffer and viewport.
SkippedCasters draw_casters(FrameState& f, const CasterView& view, const SeenOf& seen, PassInfo& info);
/// Draws what of a light's casters lies in its view into the framebuffer of a whole map.
SkippedCasters draw_casters(FrameState& f, const gl::Framebuffer& into, bool unfiltered, const FittedLight& light,
                            const LightView& view, PassInfo& info, const CasterChoice& which = {});

}  // namespace si
