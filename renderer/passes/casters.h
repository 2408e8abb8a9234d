// Drawing of shadow casters from a light's view.
#pragma once

#include <functional>
#include <vector>

#include "renderer/frame/state.h"
#include "renderer/view/culling/map_cells.h"

namespace si {

struct CasterRaster;

/// Choice of the casters to draw into a shadow map: by the cells of the map (64 x 64, MapCells) that look-ups read, and
/// by instance.
struct CasterChoice {
    const MapCells* needed = nullptr;         ///< map cells that look-ups read; null: all
    const std::vector<bool>* only = nullptr;  ///< by index in SceneGpu::instance_objects(): true draws it; null: all
    bool keeps_contents = false;              ///< true: draws over the map's contents; false: clears the map first
    MapCells* covered = nullptr;              ///< receives all cells that drawn casters may cover; may be null
    const CasterRaster* raster = nullptr;     ///< raster state of the map; null: as the settings say
};

/// Light view from which casters are drawn into a map: projection, origin, size and raster options.
struct CasterView {
    glm::dmat4 clip_from_relative{1.0};  ///< from positions relative to `origin`
    DepthCurve curve;
    glm::dvec3 origin{0};
    bool unfiltered = false;   ///< without polygon offset, masks at their finest level
    bool clamps_near = false;  ///< casters in front of the near plane are flattened onto it
    MapSize size{1};           ///< texels of the map
    CasterChoice choice;
    bool mirrored = false;  ///< triangles have the opposite winding: see is_mirrored()
    glm::dvec3 away_ws{0};  ///< unit, along the view's axis away from the light, for `shift`
    CasterShift shift;      ///< of all casters
};

/// Range of a mesh's triangle indices, counted from the first index of the mesh.
struct IndexRange {
    std::size_t first = 0;
    GLsizei count = 0;
};

/// Appends a range of a mesh's indices to a list of ranges to draw. If `next` begins where the last range ends, extends
/// that range instead, to save draw calls.
void append_index_range(std::vector<IndexRange>& parts, IndexRange next);

/// Part of an instance that is drawn into a map: nothing, the whole mesh, or some of its index ranges.
enum class InstanceParts { Nothing, Whole, Parts };

/// Callback that returns which part of an instance to draw.
/// @param instance index in SceneGpu::instance_objects()
/// @param[out] parts index ranges to draw for InstanceParts::Parts
using InstancePartsQuery = std::function<InstanceParts(std::size_t instance, std::vector<IndexRange>& parts)>;

/// Returns true when an object may cast shadows. It must not be the ground disc, and its own settings must let it cast.
/// A blended object casts only if caster.blend lets it. Alpha masks and culling are not considered.
bool can_cast(const Scene& scene, const Settings& settings, const Object& object);
/// Returns true when a batch of instances is drawn into shadow maps. Batches with blended materials are drawn only if
/// caster.blend lets them cast, by their alpha mask.
bool is_drawn_into_maps(const FrameState& f, const Batch& batch);

/// Clears a framebuffer of a shadow map to the far depth, within the scissor rectangle if enabled.
/// @param framebuffer the bound framebuffer
/// @param convention depth convention, which decides the value of the far depth
void clear_casters(const FrameState& f, GLuint framebuffer, const DepthConvention& convention);

/// Counts of casters that were skipped, or drawn with less work, while a shadow map was drawn.
struct SkippedCasters {
    std::uint64_t outside_map = 0;       ///< instances entirely outside the map
    std::uint64_t unread = 0;            ///< instances that cover no map cell that look-ups read
    std::uint64_t front_faces_only = 0;  ///< instances drawn by front faces alone
    std::uint64_t without_shader = 0;    ///< instances drawn without a fragment shader
};

/// Draws casters into the bound framebuffer and viewport, as seen from a light. Used for pages of virtual shadow maps.
/// Returns the counts of skipped casters.
/// @param seen callback that returns the parts to draw of each instance; empty: every caster as a whole
/// @param[out] info draw and triangle counts
SkippedCasters draw_casters(FrameState& f, const CasterView& view, const InstancePartsQuery& seen, PassInfo& info);
/// Draws the casters that one view of a light contains into the framebuffer of a whole map. Returns the counts of
/// skipped casters.
/// @param unfiltered true: draws without polygon offset, with masks at their finest mip level
/// @param[out] info draw and triangle counts
SkippedCasters draw_casters(FrameState& f, const gl::Framebuffer& into, bool unfiltered, const FittedLight& light,
                            const LightView& view, PassInfo& info, const CasterChoice& choice = {});

}  // namespace si
