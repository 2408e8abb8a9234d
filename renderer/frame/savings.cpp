#include "renderer/frame/savings.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "renderer/base/error.h"

namespace si {
namespace {

constexpr OptimisationRow kRows[] = {
    {.key = "uncalled",
     .label = "What nothing calls for",
     .help = "Passes and look-ups for lights without a shadow are left out: what they would find is lit everywhere. "
             "Shading leaves out lights that are black or reach nothing of the scene, and takes for lit what is in "
             "reach of a light whose maps no caster lies in."},
    {.key = "blockers",
     .label = "Searches without a penumbra",
     .help = "A kernel that searches for blockers looks once where its light is too small for a penumbra: all places "
             "of the search are that one."},
    {.key = "early-out",
     .label = "Taps that cannot differ",
     .help = "Where the map's nearest and farthest depth within the kernel's reach lie on one side of the receiver, "
             "all taps agree, and none is fetched. Asked for by kernels of so many taps that it pays."},
    {.key = "facing",
     .label = "Look-ups of light that does not arrive",
     .help = "Surfaces turned away from a light, beyond its range or outside of its cone get nothing of it, whatever "
             "its visibility."},
    {.key = "order",
     .label = "Hidden surfaces",
     .help =
         "What is near is drawn before what it hides, so that less of that is shaded. The depth test finds the same "
         "surfaces in any order, unless two lie in exactly one place: objects whose boxes touch keep theirs, large "
         "meshes after small ones, whatever the camera. Forced, all keep theirs."},
    {.key = "in-sight",
     .label = "Objects beside the picture",
     .help =
         "Objects whose box lies outside of what the camera sees are not drawn: none of their triangles would cover "
         "a pixel."},
    {.key = "fused",
     .label = "Visibility as a pass of its own",
     .help = "The shading pass evaluates visibility itself where nothing else reads it: the same code on the same "
             "surfaces, so what is spared is drawing them twice."},
    {.key = "back-faces",
     .label = "Back faces of closed casters",
     .help =
         "Opaque casters whose triangles bound bodies are drawn into maps by their front faces alone, where the near "
         "plane cuts nothing of them: what a light outside of a body meets first is a front face. Forced, back faces "
         "are drawn a step and a texel's slope behind where they lie, as at silhouettes rounding would decide."},
    {.key = "casters",
     .label = "Casters beside a map",
     .help = "Casters whose box lies outside of what a map, a cascade or a face holds are not drawn into it: none of "
             "their triangles would cover a texel."},
    {.key = "views",
     .label = "What of maps the camera cannot read",
     .help = "Maps, cascades and faces in which nothing lies that the camera sees are not drawn, nor are casters that "
             "cover no texel within the kernel's reach of what it sees. Whatever reads whole maps has them whole."},
    {.key = "static",
     .label = "Casters at rest",
     .help = "Where casters move under a light whose maps keep their views, those at rest are kept in a map of their "
             "own, which is copied where others were, and only what moves is drawn over it: of all that covers a "
             "texel the nearest depth stays, in whatever order. It takes the maps' memory once more, while something "
             "moves."},
    {.key = "fragments",
     .label = "Fragments of opaque casters",
     .help =
         "Opaque casters with flat sides, none of which the light's parallel rays meet edge-on, are drawn into "
         "depth buffers without a fragment shader. Of the others it drops what rounding draws from beyond the map's "
         "range, which a flat side seen well from its front does not leave."},
};
static_assert(std::size(kRows) == kOptimisations);

}  // namespace

std::span<const OptimisationRow> savings() {
    return kRows;
}

const OptimisationRow& row_of(Optimisation saving) {
    return kRows[std::size_t(saving)];
}

Optimisation parse_optimisation(std::string_view key) {
    const auto row =
        std::find_if(std::begin(kRows), std::end(kRows), [&](const OptimisationRow& r) { return r.key == key; });
    if (row != std::end(kRows)) return Optimisation(row - kRows);
    std::string known;
    for (const OptimisationRow& r : kRows) known += fmt::format("{}{}", known.empty() ? "" : ", ", r.key);
    throw Error(fmt::format("there is no saving \"{}\"; known are {}", key, known));
}

}  // namespace si
