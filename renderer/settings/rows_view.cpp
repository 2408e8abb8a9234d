// Rows of shading, camera, scene and objects.
#include "renderer/settings/rows.h"

namespace si {
namespace {

using namespace rows;

constexpr Choice kCompositions[] = {
    {"ambient", "ambient and visibility",
     "colour = (ambient + visibility * (diffuse + specular)) * base colour, in one pass: shadows are as soft as their "
     "filter."},
    {"dim-lit", "dim pass, then lit pass",
     "The whole picture is drawn by dimmed lights first. Then it is drawn again where the comparison finds light, by "
     "an alpha test of 0.99. With any filter a pixel is then either lit or not. Blended surfaces take one pass."},
};

constexpr Choice kSkies[] = {
    {"plain", "plain", "A flat grey background, and equal ambient light from everywhere, for measuring by eye."},
    {"gradient", "gradient",
     "A sky whose colours follow the sun's height (the brightest directional light's). Ambient light comes from it "
     "above and from the ground below, so that surfaces in shadow keep their shape."},
};
constexpr Choice kCurves[] = {
    {"plain", "plain", "Encoded as sRGB; values above white are clipped."},
    {"filmic", "filmic",
     "Dark tones become a little darker and highlights roll off softly, so that several lights do not clip. White is "
     "light of four times a lit white surface."},
};

constexpr auto kShading = std::to_array<Param>({
    {SI_FIELD(shading.ambient), .label = "Ambient", .min = 0, .max = 10,
     .help = "Share of light that comes from everywhere and is never shadowed: colour = (ambient + visibility * "
             "(diffuse + specular)) * base colour.",
     .also = "skylight, ambient light, environment light, indirect, shadow strength, shadow color, shadow colour, "
             "shadow opacity, shadow darkness",
     .shader = true},
    {SI_FIELD(shading.diffuse), .label = "Diffuse", .min = 0, .max = 10,
     .help = "Weight of the diffuse term, which falls with the cosine to the light.", .shader = true},
    {SI_FIELD(shading.specular), .label = "Specular", .min = 0, .max = 10,
     .help = "Weight of the Blinn-Phong highlight.", .shader = true},
    {SI_FIELD(shading.shininess), .label = "Shininess", .min = 1, .max = 1024, .logarithmic = true,
     SI_IDLE(s.shading.specular == 0, "without effect: shading.specular is 0"),
     .help = "Exponent of the Blinn-Phong highlight; larger is smaller and sharper.", .shader = true},
    {SI_FIELD(shading.sky), .label = "Sky", SI_CHOICES(kSkies),
     .help = "Background and ambient light of the scene. No visibility depends on it.",
     .also = "skybox, background, world", .read_by = ReadBy::Shading},
    {SI_FIELD(shading.exposure), .label = "Exposure", .unit = "EV", .min = -8, .max = 8,
     .help = "Brightens the picture, sky included, by powers of two before the tone curve.",
     .also = "exposure compensation, toneMappingExposure, post exposure", .read_by = ReadBy::Shading},
    {SI_FIELD(shading.curve), .label = "Tone curve", SI_CHOICES(kCurves),
     .help = "The conversion of light to the picture's colours. No visibility depends on it.",
     .also = "tone mapping, toneMapping, tonemapper, gamma, view transform", .read_by = ReadBy::Shading},
    {SI_FIELD(shading.composition), .label = "Composition", .cost = Cost::Program, SI_CHOICES(kCompositions),
     .help = "The combination of light and shadow in the picture.", .shader = true},
    {SI_FIELD(shading.dim), .label = "Dim light", .min = 0, .max = 1,
     SI_IDLE(s.shading.composition != Composition::DimLit, "without effect: set shading.composition to dim-lit"),
     .help = "Share of each light that the dim pass leaves in shadow, so that surfaces keep their shape there.",
     .shader = true},
    {SI_FIELD(shading.textures), .label = "Textures", .cost = Cost::Program,
     .help = "Use base colour textures and normal maps. Off: plain material colours, so that shadows stand out. Alpha "
             "masks cut out either way.",
     .also = "albedo, normal map", .shader = true},
    {SI_FIELD(shading.separate_visibility), .label = "Visibility as its own pass",
     .help = "Draw visibility into a texture of its own even when nothing else reads it. The picture stays the same; "
             "the cost of the filter shows by itself.",
     .also = "shadow mask, screen-space shadow texture"},
});
static_assert(kShading.size() == member_count<ShadingSettings>(), "a member of ShadingSettings has no row");

constexpr Choice kSources[] = {
    {"auto", "automatic", "The scene's own camera (camera.index), or one that shows the whole scene."},
    {"manual", "by hand", "As the settings below say."},
    {"light", "through the light",
     "The view of the map of view.light: its place, direction and projection (view.face of a point light), near and "
     "far planes included. The map's square fills the picture's shorter side. If the map is fitted to the view "
     "frustum, the map of the whole scene is used instead."},
};

std::string_view camera_idle(const Settings& s, int) {
    return s.camera.source != CameraSource::Manual ? "without effect: set camera.source to manual" : "";
}
std::string_view fov_idle(const Settings& s, int i) {
    const auto reason = camera_idle(s, i);
    return reason.empty() && s.camera.orthographic ? "without effect: the camera is orthographic" : reason;
}
std::string_view height_idle(const Settings& s, int i) {
    const auto reason = camera_idle(s, i);
    return reason.empty() && !s.camera.orthographic ? "without effect: the camera is a perspective one" : reason;
}

constexpr auto kCamera = std::to_array<Param>({
    {SI_FIELD(camera.source), .label = "Camera", SI_CHOICES(kSources), .help = "The source of the camera."},
    {SI_FIELD(camera.index), .label = "Scene's camera", .min = -1, .max = 9999,
     SI_IDLE(s.camera.source != CameraSource::Automatic, "without effect: set camera.source to auto"),
     .help = "Index of the scene's camera that is used, counted from 0. With -1 a camera shows the whole scene, "
             "including objects far from the rest that the first picture leaves out. Without effect on scenes that "
             "have no cameras and no such objects."},
    {SI_FIELD(camera.target_x), .label = "Target x", .unit = "m", .min = -1e8, .max = 1e8, .idle = camera_idle,
     .help = "The point the camera looks at, world x."},
    {SI_FIELD(camera.target_y), .label = "Target y", .unit = "m", .min = -1e8, .max = 1e8, .idle = camera_idle,
     .help = "The point the camera looks at, world y (up)."},
    {SI_FIELD(camera.target_z), .label = "Target z", .unit = "m", .min = -1e8, .max = 1e8, .idle = camera_idle,
     .help = "The point the camera looks at, world z."},
    {SI_FIELD(camera.azimuth), .label = "Azimuth", .unit = "deg", .min = -360, .max = 360, .idle = camera_idle,
     .help = "Direction from the target to the camera, around the vertical axis: 0 is +z, 90 is +x."},
    {SI_FIELD(camera.elevation), .label = "Elevation", .unit = "deg", .min = -90, .max = 90, .idle = camera_idle,
     .help = "Direction from the target to the camera, above the horizon: 90 looks straight down."},
    {SI_FIELD(camera.roll), .label = "Roll", .unit = "deg", .min = -360, .max = 360, .idle = camera_idle,
     .help = "Rotation of the camera around its viewing axis."},
    {SI_FIELD(camera.distance), .label = "Distance", .unit = "m", .min = 1e-6, .max = 1e8, .logarithmic = true,
     .idle = camera_idle, .help = "Distance of the camera from its target."},
    {SI_FIELD(camera.fov), .label = "Field of view", .unit = "deg", .min = 0.1, .max = 170, .idle = fov_idle,
     .help = "Vertical opening angle of a perspective camera.", .also = "focal length, lens, fov"},
    {SI_FIELD(camera.near), .label = "Near", .unit = "m", .min = 0, .max = 1e8, .logarithmic = true,
     .zero_is_auto = true, .idle = camera_idle,
     .help = "Distance of the camera's near plane; 0 is automatic. Nearer surfaces are cut away.",
     .also = "near clip plane, clip start, clipping planes"},
    {SI_FIELD(camera.far), .label = "Far", .unit = "m", .min = 0, .max = 1e8, .logarithmic = true, .zero_is_auto = true,
     .idle = camera_idle, .help = "Distance of the camera's far plane; 0 is automatic. Farther surfaces are cut away.",
     .also = "far clip plane, clip end, clipping planes"},
    {SI_FIELD(camera.orthographic), .label = "Orthographic", .idle = camera_idle,
     .help = "Parallel instead of perspective projection of the camera.", .also = "ortho, isometric"},
    {SI_FIELD(camera.height), .label = "Height", .unit = "m", .min = 1e-6, .max = 1e8, .logarithmic = true,
     .idle = height_idle, .help = "Height of the view of an orthographic camera.",
     .also = "orthographic size, orthographicSize, ortho size, ortho scale"},
});
static_assert(kCamera.size() == member_count<CameraSettings>(), "a member of CameraSettings has no row");

constexpr Choice kPlacedAlong[] = {
    {"aslant", "diagonal", "Along (2, 1, 5), so that no step lies on a grid."},
    {"x", "x", "Along the world's x axis."},
    {"y", "y", "Upwards."},
    {"z", "z", "Along the world's z axis."},
};

constexpr Choice kUpAxes[] = {
    {"file", "as the file says", "The axis that the file names; y where it names none."},
    {"x", "x", "The file's x axis points up."},
    {"y", "y", "The file's y axis points up, as in glTF."},
    {"z", "z", "The file's z axis points up, as in many files for CAD and 3D printing."},
    {"-x", "-x", "The file's x axis points down."},
    {"-y", "-y", "The file's y axis points down, as in many scans."},
    {"-z", "-z", "The file's z axis points down."},
};

constexpr Choice kGrounds[] = {
    {"auto", "if the file has none",
     "A file without a large level surface gets a ground, which receives shadows and casts none. Maps cover only the "
     "part that the model may shadow. Its pixels are counted apart. Built-in scenes have their own."},
    {"off", "off", "The file as it is."},
};

constexpr auto kScene = std::to_array<Param>({
    {SI_FIELD(scene.index), .label = "Scene of the file", .min = -1, .max = 9999,
     .help =
         "The shown scene of a glTF file, counted from 0; -1 is the file's default. A change reads the file again."},
    {SI_FIELD(scene.up), .label = "Up axis of the file", SI_CHOICES(kUpAxes),
     .help = "The axis of the file that points up, for a file that lies on its side. A change reads the file again. "
             "Without effect on built-in scenes.",
     .also = "axis conversion, y-up, z-up, forward axis, bake axis conversion"},
    {SI_FIELD(scene.unit), .label = "Unit of the file", .unit = "m", .min = 0, .max = 1e6, .logarithmic = true,
     .zero_is_auto = true,
     .help = "Metres in one unit of the file: 0.01 for centimetres. 0 is the unit that the file names, 1 m where it "
             "names none. A change reads the file again. Without effect on built-in scenes.",
     .also = "scale factor, convert units, file scale, unit scale factor, import scale"},
    {SI_FIELD(scene.animation), .label = "Animation", .min = -1, .max = 9999,
     .help = "The shown animation of the scene's file, counted from 0; -1 is the rest pose. Without effect on scenes "
             "without animations.",
     .animation_only = true},
    {SI_FIELD(scene.time), .label = "Time", .unit = "s", .min = 0, .max = 1e6,
     SI_IDLE(s.scene.animation < 0, "without effect: scene.animation is -1, the rest pose"),
     .help = "The time of the animation that is shown. After its last key the scene stands still.",
     .animation_only = true},
    {SI_FIELD(scene.distance), .label = "Offset from origin", .unit = "m", .min = 0, .max = 1e7, .logarithmic = true,
     .help = "Distance by which the scene is moved from its place in the file, with its cameras and lights. Far from "
             "the world's origin, single precision has few digits left for the position of a shadow edge "
             "(map.origin). 0 moves nothing."},
    {SI_FIELD(scene.direction), .label = "Offset along", SI_CHOICES(kPlacedAlong),
     SI_IDLE(s.scene.distance == 0, "without effect: scene.distance is 0"),
     .help = "The direction in which the scene is moved."},
    {SI_FIELD(scene.scale), .label = "Scaled by", .min = 1e-3, .max = 1e6, .logarithmic = true,
     .help = "Factor of the scene's size over that of its file, with its cameras and lights. The manual camera and "
             "settings in metres grow with it. Metres given by --set stay as given."},
    {SI_FIELD(scene.ground), .label = "Ground", SI_CHOICES(kGrounds),
     .help = "The ground under a loaded model, which shows its shadow.", .also = "floor, ground plane, shadow catcher"},
    {SI_FIELD(scene.fit_animation), .label = "Fit over the animation",
     SI_IDLE(s.scene.animation < 0, "without effect: scene.animation is -1, the rest pose"),
     .help = "Fits shadow maps to all places that objects reach during the chosen animation. The maps then neither "
             "move nor change size while it plays, but their texels are larger. Off: maps follow the shown pose. A "
             "map fitted to the view frustum follows the camera in both cases. Without effect on scenes without "
             "animations.",
     .also = "stable fit, swimming, shimmer, whole animation, animated bounds, fixed skel bounds, bounds scale, update "
             "when offscreen, skinned bounds",
     .animation_only = true},
});
static_assert(kScene.size() == member_count<SceneSettings>(), "a member of SceneSettings has no row");

std::string_view area_idle(const Settings& s, int) {
    return s.truth.area ? "" : "without effect: truth.area is off";
}

constexpr auto kReference = std::to_array<Param>({
    {SI_FIELD(truth.area), .label = "Area light (soft shadows)",
     .help = "Compare with an area light (light.size), which casts penumbras. Off: with a point or a direction, "
             "which casts hard shadows.",
     .also = "soft shadows, area light, ray-traced shadows"},
    {SI_FIELD(truth.samples), .label = "Maximum rays", .min = 1, .max = 1 << 20, .logarithmic = true, .idle = area_idle,
     .help = "Maximum number of rays from a pixel to an area light. Every pixel gets 8 rays, pixels around penumbrae "
             "get 64, and noise may require more. Rays beyond 256 go only to those cells of a grid on the light that "
             "an occluder's edge crosses, unless occluders are narrower than a cell."},
    {SI_FIELD(truth.noise), .label = "Noise", .min = 0, .max = 1, .logarithmic = true, .idle = area_idle,
     .help = "Target standard error of a pixel's reference visibility under an area light."},
    {SI_FIELD(truth.step), .label = "Trace every n-th pixel", .unit = "px", .min = 1, .max = 8,
     .help = "Step between traced and compared pixels, across and down: 1 is every pixel, 2 one of four (half "
             "resolution)."},
});
static_assert(kReference.size() == member_count<ReferenceSettings>(), "a member of ReferenceSettings has no row");

constexpr Choice kObjectCulls[] = {
    {"inherit", "as the scene", "As caster.cull says."},
    {"none", "none", "Every triangle of the object casts."},
    {"back", "back faces", "Faces turned away from the light do not cast."},
    {"front", "front faces", "Faces turned to the light do not cast."},
};

constexpr auto kObject = with_scope(
    std::to_array<Param>({
        {SI_OBJECT_FIELD(shown), .label = "Shown",
         .help = "Shows this object. A hidden one is not drawn, casts nothing and receives nothing. The scene's bounds "
                 "still contain it, so that the view stays.",
         .also = "visible, visibility, hide, hidden, isolate, enabled, renderable"},
        {SI_OBJECT_FIELD(cull), .label = "Cull", SI_CHOICES(kObjectCulls),
         .help = "The faces of this object that are left out of the shadow map. It keeps single planes and floors "
                 "under front-face culling.",
         .also = "shadow side, double sided, two-sided", .map_only = true},
        {SI_OBJECT_FIELD(cast), .label = "Casts", .help = "Makes this object cast shadows.",
         .also = "cast shadow, castShadow, castShadows, shadow casting mode, cast shadow setting"},
        {SI_OBJECT_FIELD(receive), .label = "Receives", .help = "Makes this object receive shadows.",
         .also = "receive shadow, receiveShadow, receive shadows"},
    }),
    Scope::Object);
static_assert(kObject.size() == member_count<ObjectSettings>(), "a member of ObjectSettings has no row");

}  // namespace

std::vector<Param> picture_rows() {
    return joined(kShading, kCamera, kScene);
}

std::vector<Param> reference_rows() {
    return joined(kReference, kObject);
}

}  // namespace si
