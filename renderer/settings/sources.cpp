// Rows of the table of visibility sources.
#include "renderer/settings/sources.h"

#include <algorithm>

namespace si {
namespace {

constexpr std::string_view kBlobSettings[] = {"blob.size", "blob.softness", "blob.opacity", "blob.reach"};
constexpr std::string_view kVolumeSettings[] = {"volumes.allow_large"};
constexpr std::string_view kLightMapSettings[] = {"light_map.resolution", "light_map.samples"};

constexpr Source kSourceRows[] = {
    {.key = "map",
     .label = "shadow map",
     .help = "The depth seen from the light is drawn, and every surface compares its own depth with it.",
     .paper = "Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978",
     .fused = true,
     .needs = {.map = true},
     .file = "sources/map.glsl"},
    {.key = "none",
     .label = "no shadow",
     .help = "Everything that faces the light is lit, for comparison with a picture without shadows.",
     .fused = true},
    {.key = "blob",
     .label = "blobs",
     .help = "A soft disc below each caster, along the light, as in games before shadow maps and still below small "
             "objects. It uses the place and width of a caster. It ignores the caster's shape, everything between, and "
             "the receiver. Casters wider than a quarter of the scene have none.",
     .paper = "Blinn, Jim Blinn's Corner: Me and My (Fake) Shadow, IEEE Computer Graphics and Applications 8(1), 1988",
     .needs = {.blobs = true},
     .file = "sources/blob.glsl",
     .settings = kBlobSettings,
     .approximation = "a disc replaces the caster"},
    {.key = "volumes-zfail",
     .label = "shadow volumes (z-fail)",
     .help = "The shadow of each caster is drawn as a volume into a stencil buffer, which counts at each pixel the "
             "volumes that contain the surface. Exact to the pixel, hard and without a bias, for any camera position; "
             "the cost is the area that the volumes' faces cover. Faces cast from both sides whatever caster.cull "
             "says, masked ones as if they were solid, and so do blended ones where caster.blend lets them cast; on "
             "blended surfaces there is no shadow.",
     .paper = "Everitt and Kilgard, Practical and Robust Stenciled Shadow Volumes for Hardware-Accelerated Rendering, "
              "2002; McGuire et al., Fast, Practical and Robust Shadows, 2003",
     .needs = {.stencil = true, .camera_depth = true},
     .file = "sources/volumes.glsl",
     .settings = kVolumeSettings},
    {.key = "volumes-zpass",
     .label = "shadow volumes (z-pass)",
     .help = "Shadow volumes in their first form: the stencil counts faces before the visible surface instead of those "
             "behind it, which needs no caps. Wrong where the camera is inside a volume or its near plane cuts one: "
             "light and shadow are swapped there. Else as volumes-zfail.",
     .paper = "Crow, Shadow Algorithms for Computer Graphics, SIGGRAPH 1977; Heidmann, Real Shadows Real Time, IRIS "
              "Universe 18, 1991",
     .needs = {.stencil = true, .counts_front_faces = true, .camera_depth = true},
     .file = "sources/volumes.glsl",
     .settings = kVolumeSettings},
    {.key = "traced",
     .label = "ray traced",
     .help = "The ray-traced reference itself, as truth.area, truth.samples, truth.noise and truth.step say. It is "
             "exact and slow. Rays are traced on the CPU before the frame, and their time is not in the frame's. Until "
             "they are traced, the light has no shadow. Blended surfaces never get one.",
     .paper = "Appel, Some Techniques for Shading Machine Renderings of Solids, AFIPS 1968",
     .needs = {.reference = true}},
    {.key = "light-map",
     .label = "light map",
     .help = "Rays are traced once, for texels that lie on all surfaces of the scene, and looked up with bilinear "
             "filtering from any camera: a soft shadow at the price of a hard one. Baked on the CPU before the frame "
             "is drawn, which is not in its time, and kept on disk; baked again when casters, light or light_map.* "
             "change. Until then, also while an animation plays, the light has no shadow; on blended surfaces it never "
             "has. It suits static scenes. 8 bits: visibility is off by up to 1/510 for that.",
     .paper = "Arvo, Backward Ray Tracing, SIGGRAPH 1986 course notes; Abrash, Quake's Lighting Model, in: Graphics "
              "Programming Black Book, 1997",
     .needs = {.light_map = true},
     .file = "sources/light_map.glsl",
     .settings = kLightMapSettings},
};

}  // namespace

std::span<const Source> sources() {
    return kSourceRows;
}

const Source& source_of(const Settings& settings, int light) {
    const auto i = std::size_t(std::clamp(light, 0, kMaxLights - 1));
    return kSourceRows[std::clamp(settings.lights[i].source, 0, int(std::size(kSourceRows)) - 1)];
}

bool any_source_needs(const Settings& settings, bool SourceNeeds::*what) {
    const int count = std::clamp(settings.light_count, 0, kMaxLights);
    for (int i = 0; i < count; ++i)
        if (settings.lights[std::size_t(i)].cast && source_of(settings, i).needs.*what) return true;
    return false;
}

bool no_source_is_map(const Settings& settings) {
    const int count = std::clamp(settings.light_count, 0, kMaxLights);
    for (int i = 0; i < count; ++i)
        if (source_of(settings, i).needs.map) return false;
    return count > 0;
}

}  // namespace si
