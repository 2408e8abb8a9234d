#include "renderer/optimisations/optimisations.h"

#include <iterator>

namespace si {
namespace {

constexpr OptimisationRow kRows[] = {
    {.key = "uncalled",
     .label = "Passes and look-ups that nothing needs",
     .help = "Passes and look-ups for lights without a shadow are skipped: they would return lit everywhere. "
             "Shading skips lights that are black or reach nothing of the scene. Points in reach of a light whose "
             "maps hold no caster are lit without a look-up."},
    {.key = "blockers",
     .label = "Blocker search without a penumbra",
     .help = "The blocker search of a kernel looks up one place where its light is too small for a penumbra: all "
             "places of the search are then the same."},
    {.key = "early-out",
     .label = "Early-out by depth bounds",
     .help = "Where both bounds of the map's depths within the kernel's reach lie on one side of the receiver, "
             "all taps agree, and none is fetched. Only kernels with enough taps to gain from it test "
             "the bounds."},
    {.key = "facing",
     .label = "Look-ups on unlit surfaces",
     .help = "Surfaces that face away from a light, or lie beyond its range or outside of its cone, skip its "
             "look-up: they receive no light from it, whatever its visibility."},
    {.key = "order",
     .label = "Front-to-back draw order",
     .help = "Near objects are drawn before the objects they hide, so that fewer hidden surfaces are shaded. The "
             "depth test finds the same surfaces in any order, except where two coincide: objects whose boxes "
             "touch keep their order. Large meshes come last. Forced: objects keep the order of the scene."},
    {.key = "in-sight",
     .label = "Frustum culling of objects",
     .help = "Objects whose box lies outside the view frustum are not drawn: none of their triangles would cover a "
             "pixel."},
    {.key = "fused",
     .label = "Visibility fused with shading",
     .help = "The shading pass evaluates visibility itself where nothing else reads it. The code and the surfaces "
             "are the same, so only the second drawing of the surfaces is skipped."},
    {.key = "back-faces",
     .label = "Back faces of closed casters",
     .help = "Closed opaque casters are drawn into maps by their front faces alone, where the near plane does not "
             "cut them: light from outside of a body meets a front face first. Forced: back faces are drawn one "
             "depth step and one texel's slope behind their place, since rounding would decide at silhouettes."},
    {.key = "casters",
     .label = "Frustum culling of casters",
     .help = "Casters whose box lies outside a map, a cascade or a cube face are not drawn into it: none of their "
             "triangles would cover a texel."},
    {.key = "views",
     .label = "Map parts that the camera does not read",
     .help = "Maps, cascades and cube faces without any visible surface are not drawn. Casters are skipped where "
             "they cover no texel within the kernel's reach of a visible surface. Outputs that read whole maps "
             "still find them complete."},
    {.key = "static",
     .label = "Cache of static casters",
     .help = "Where casters move under a light whose maps keep their views, static casters are cached in a map of "
             "their own. Each frame copies that map and draws only moving casters over it: the nearest depth of a "
             "texel is the same in any draw order. The cache doubles the memory of the maps while something moves."},
    {.key = "fragments",
     .label = "Fragment shader of opaque casters",
     .help = "Opaque casters with flat sides, none of them edge-on to the light's parallel rays, are drawn into "
             "depth buffers without a fragment shader. The shader only drops fragments that rounding places "
             "outside the map's range, and such casters have none."},
};
static_assert(std::size(kRows) == kOptimisations);

}  // namespace

std::span<const OptimisationRow> optimisation_rows() {
    return kRows;
}

const OptimisationRow& row_of(Optimisation optimisation) {
    return kRows[std::size_t(optimisation)];
}

}  // namespace si
