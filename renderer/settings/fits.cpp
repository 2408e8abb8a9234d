// Rows of the table of fits, which choose the region of a shadow map.
#include "renderer/settings/fits.h"

#include "renderer/settings/paging.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

constexpr FitRow kFits[] = {
    {.key = "manual",
     .label = "by hand",
     .help = "near, far, extent and distance as given (0: as the scene fit finds them)."},
    {.key = "scene", .label = "whole scene", .help = "The frustum holds the bounds of the scene."},
    {.key = "casters",
     .label = "caster region",
     .help = "The caster region: where a caster can shadow anything that faces the light, wherever the camera is. All "
             "else is lit. A ground is drawn and does not widen the map, since it shadows nothing on it. Point lights, "
             "wide cones and directional lights in perspective: the whole scene.",
     .narrows = true},
    {.key = "view",
     .label = "view frustum",
     .help =
         "As casters, restricted to surfaces in the view frustum: the finest texels, which change as the camera moves.",
     .paper = "Brabec, Annen, Seidel, Practical Shadow Mapping, Journal of Graphics Tools 7(4), 2002",
     .reads_camera = true,
     .narrows = true},
    {.key = "stabilised",
     .label = "stabilised",
     .help = "For directional lights: a sphere around the view frustum, of constant size while the camera turns and "
             "moves, in steps of whole texels. Shadow edges do not shimmer, and the map is wider. Each cascade is such "
             "a map. Camera depths are taken from the sphere around the scene, in octaves of the camera's distance. "
             "Other lights: the whole scene.",
     .paper = "Valient, Stable Rendering of Cascaded Shadow Maps, ShaderX 6, 2008",
     .reads_camera = true},
    {.key = "lispsm",
     .label = "LiSPSM",
     .help = "For directional lights: the view frustum, with small texels near the camera and large ones far away. The "
             "warp is weaker the closer light and view are to parallel, and none if they are parallel or the camera is "
             "orthographic. Each cascade is warped by itself. Depths are fitted: light.near and light.far have no "
             "effect. Other lights, and directional lights in perspective: the whole scene.",
     .paper = "Wimmer, Scherzer, Purgathofer, Light Space Perspective Shadow Maps, EGSR 2004",
     .reads_camera = true,
     .warps = true},
};

}  // namespace

std::span<const FitRow> fits() {
    return kFits;
}

const FitRow& fit_row(LightFit fit) {
    const auto row = std::size_t(fit);
    return kFits[row < std::size(kFits) ? row : std::size_t(LightFit::Scene)];
}

bool uses_camera_slices(const LightSettings& s) {
    return (s.cascades > 1 || s.fit == LightFit::Stabilised || fit_row(s.fit).warps) &&
           s.type == LightType::Directional && s.fit != LightFit::Manual &&
           s.projection != LightProjection::Perspective;
}

bool fit_reads_camera(const Settings& settings, int light) {
    const LightSettings& s = settings.lights[std::size_t(light)];
    return has_clip_levels(settings, light) || uses_camera_slices(s) || fit_row(s.fit).reads_camera;
}

bool fit_reads_measured_depths(const Settings& settings, int light) {
    const LightSettings& s = settings.lights[std::size_t(light)];
    return s.depth_bounds == DepthBounds::Sdsm && !has_clip_levels(settings, light) &&
           fit_reads_camera(settings, light) && s.type != LightType::Point && s.fit != LightFit::Stabilised && s.cast &&
           source_of(settings, std::size_t(light)).needs.map;
}

}  // namespace si
