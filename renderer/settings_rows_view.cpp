// Rows of shading, camera, scene, view and objects.
#include "renderer/settings_rows.h"
#include "renderer/techniques.h"

namespace si {
namespace {

using namespace rows;

constexpr auto kShading = std::to_array<Param>({
    {SI_FIELD(shading.ambient), .label = "Ambient", .unit = "", .min = 0, .max = 10,
     .help = "Share of light that comes from everywhere and is never shadowed: colour = (ambient + visibility * "
             "(diffuse + specular)) * base colour.",
     .shader = true},
    {SI_FIELD(shading.diffuse), .label = "Diffuse", .unit = "", .min = 0, .max = 10,
     .help = "Weight of the diffuse term, which falls with the cosine to the light.", .shader = true},
    {SI_FIELD(shading.specular), .label = "Specular", .unit = "", .min = 0, .max = 10,
     .help = "Weight of the Blinn-Phong highlight.", .shader = true},
    {SI_FIELD(shading.shininess), .label = "Shininess", .unit = "", .min = 1, .max = 1024, .logarithmic = true,
     SI_IDLE(s.shading.specular == 0, "without effect: shading.specular is 0"),
     .help = "Exponent of the Blinn-Phong highlight; larger is smaller and sharper.", .shader = true},
    {SI_FIELD(shading.textures), .label = "Textures", .unit = "", .cost = Cost::Program,
     .help = "Use base colour textures and normal maps. Off: plain material colours, so that shadows stand out. Alpha "
             "masks cut out either way.",
     .shader = true},
    {SI_FIELD(shading.separate_visibility), .label = "Visibility as its own pass", .unit = "",
     .help = "Draw visibility into a texture of its own even when nothing else reads it. The picture stays the same; "
             "the cost of the filter shows by itself."},
});
static_assert(kShading.size() == members<ShadingSettings>(), "a member of ShadingSettings has no row");

constexpr Choice kSources[] = {
    {"auto", "automatic", "The scene's own camera, or one that shows the whole scene."},
    {"manual", "by hand", "As the settings below say."},
};

std::string_view camera_idle(const Settings& s, int) {
    return s.camera.source != at(CameraSource::Manual) ? "without effect: set camera.source to manual" : "";
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
    {SI_FIELD(camera.source), .label = "Camera", .unit = "", SI_CHOICES(kSources),
     .help = "Where the camera comes from."},
    {SI_FIELD(camera.target_x), .label = "Target x", .unit = "m", .min = -1e8, .max = 1e8, .idle = camera_idle,
     .help = "The point the camera looks at, world x."},
    {SI_FIELD(camera.target_y), .label = "Target y", .unit = "m", .min = -1e8, .max = 1e8, .idle = camera_idle,
     .help = "The point the camera looks at, world y (up)."},
    {SI_FIELD(camera.target_z), .label = "Target z", .unit = "m", .min = -1e8, .max = 1e8, .idle = camera_idle,
     .help = "The point the camera looks at, world z."},
    {SI_FIELD(camera.azimuth), .label = "Azimuth", .unit = "deg", .min = -360, .max = 360, .idle = camera_idle,
     .help = "Where the camera stands as seen from its target, about the vertical axis: 0 is +z, 90 is +x."},
    {SI_FIELD(camera.elevation), .label = "Elevation", .unit = "deg", .min = -90, .max = 90, .idle = camera_idle,
     .help = "Where the camera stands as seen from its target, above the horizon: 90 looks straight down."},
    {SI_FIELD(camera.roll), .label = "Roll", .unit = "deg", .min = -360, .max = 360, .idle = camera_idle,
     .help = "Turn of the camera about its own axis."},
    {SI_FIELD(camera.distance), .label = "Distance", .unit = "m", .min = 1e-6, .max = 1e8, .logarithmic = true,
     .idle = camera_idle, .help = "Distance of the camera from its target."},
    {SI_FIELD(camera.fov), .label = "Field of view", .unit = "deg", .min = 0.1, .max = 170, .idle = fov_idle,
     .help = "Vertical opening angle of a perspective camera."},
    {SI_FIELD(camera.near), .label = "Near", .unit = "m", .min = 0, .max = 1e8, .logarithmic = true,
     .idle = camera_idle, .help = "Distance of the camera's near plane; 0 is automatic. Nearer surfaces are cut away."},
    {SI_FIELD(camera.far), .label = "Far", .unit = "m", .min = 0, .max = 1e8, .logarithmic = true, .idle = camera_idle,
     .help = "Distance of the camera's far plane; 0 is automatic. Farther surfaces are cut away."},
    {SI_FIELD(camera.orthographic), .label = "Orthographic", .unit = "", .idle = camera_idle,
     .help = "Parallel instead of perspective projection of the camera."},
    {SI_FIELD(camera.height), .label = "Height", .unit = "m", .min = 1e-6, .max = 1e8, .logarithmic = true,
     .idle = height_idle, .help = "Height of what an orthographic camera shows."},
});
static_assert(kCamera.size() == members<CameraSettings>(), "a member of CameraSettings has no row");

constexpr auto kScene = std::to_array<Param>({
    {SI_FIELD(scene.animation), .label = "Animation", .unit = "", .min = -1, .max = 9999,
     .help = "Which animation of the scene's file is shown, counted from 0; -1 is the rest pose. Without effect on scenes "
             "without animations."},
    {SI_FIELD(scene.time), .label = "Time", .unit = "s", .min = 0, .max = 1e6,
     SI_IDLE(s.scene.animation < 0, "without effect: scene.animation is -1, the rest pose"),
     .help = "The moment of the animation that is shown. After its last key the scene stands still."},
});
static_assert(kScene.size() == members<SceneSettings>(), "a member of SceneSettings has no row");

constexpr Choice kMapViews[] = {
    {"raw", "raw", "The depth as stored, 0 black to 1 white."},
    {"linear", "linear", "Distance along the light's axis, near black to far white."},
    {"bands", "bands",
     "Depth bands: red below view.band_low, green from there, blue above view.band_high. Most of a "
     "perspective map's depth is spent close to the near plane (the 90/10 rule)."},
};

bool is_overlay_off(const Settings& s) {
    return s.view.overlay == 0;
}
constexpr std::string_view kNoOverlay = "without effect: view.overlay is none";

std::string_view range_idle(const Settings& s, int) {
    if (is_overlay_off(s)) return kNoOverlay;
    return s.view.overlay_range_auto ? "without effect: view.overlay_range_auto is on" : "";
}
std::string_view face_idle(const Settings& s, int) {
    const int light = s.view.light < 0 || s.view.light >= kMaxLights ? 0 : s.view.light;
    const LightSettings& shown = s.lights[std::size_t(light)];
    // 1.5 rad is half the widest cone that light_fit.cpp draws as one map.
    const bool faces = shown.type == at(LightType::Point) ||
                       (shown.type == at(LightType::Spot) && shown.cone > 2 * 1.5 * 57.29577951308232);
    return faces ? "" : "without effect: only a point light's map has six faces";
}

constexpr auto kView = std::to_array<Param>({
    {SI_FIELD(view.map), .label = "Map view", .unit = "", SI_CHOICES(kMapViews),
     .help = "How the map viewer shows depth."},
    {SI_FIELD(view.map_black), .label = "Black at", .unit = "", .min = -1, .max = 2,
     SI_IDLE(s.view.map == at(MapView::Bands), "without effect: the band view has colours of its own"),
     .help = "The value that the map viewer shows black, as a share of its range."},
    {SI_FIELD(view.map_white), .label = "White at", .unit = "", .min = -1, .max = 2,
     SI_IDLE(s.view.map == at(MapView::Bands), "without effect: the band view has colours of its own"),
     .help = "The value that the map viewer shows white, as a share of its range."},
    {SI_FIELD(view.band_low), .label = "Lower band", .unit = "depth", .min = 0, .max = 1,
     SI_IDLE(s.view.map != at(MapView::Bands), "without effect: view.map is not bands"),
     .help = "Depths below this are red in the band view."},
    {SI_FIELD(view.band_high), .label = "Upper band", .unit = "depth", .min = 0, .max = 1,
     SI_IDLE(s.view.map != at(MapView::Bands), "without effect: view.map is not bands"),
     .help = "Depths above this are blue in the band view."},
    {SI_FIELD(view.light), .label = "Light shown", .unit = "", .min = 0, .max = kMaxLights - 1,
     SI_IDLE(s.light_count < 2, "without effect: there is one light"),
     .help = "Whose shadow map, visibility and overlays are shown; 0 is the first light."},
    {SI_FIELD(view.face), .label = "Face shown", .unit = "", .min = 0, .max = 5, .idle = face_idle,
     .help = "Which of a point light's six map faces is shown: 0 +x, 1 -x, 2 +y, 3 -y, 4 +z, 5 -z."},
    {SI_FIELD(view.overlay), .label = "Overlay", .unit = "", .cost = Cost::Program, .choices = overlay_choices,
     .help = "A quantity of the shadow test drawn over the scene."},
    {SI_FIELD(view.overlay_opacity), .label = "Opacity", .unit = "", .min = 0, .max = 1,
     SI_IDLE(is_overlay_off(s), kNoOverlay), .help = "How much of the overlay covers the picture: 0 nothing, 1 all."},
    {SI_FIELD(view.overlay_range_auto), .label = "Automatic range", .unit = "", SI_IDLE(is_overlay_off(s), kNoOverlay),
     .help = "The colour scale spans the range that the overlay suggests."},
    {SI_FIELD(view.overlay_min), .label = "Scale from", .unit = "overlay's", .min = -1e8, .max = 1e8,
     .idle = range_idle, .help = "The value at the low end of the colour scale, in the overlay's unit."},
    {SI_FIELD(view.overlay_max), .label = "Scale to", .unit = "overlay's", .min = -1e8, .max = 1e8, .idle = range_idle,
     .help = "The value at the high end of the colour scale, in the overlay's unit."},
    {SI_FIELD(view.frustum), .label = "Light frustum", .unit = "",
     .help = "Draw the outline of the shown light's frustum in the editor's view."},
});
static_assert(kView.size() == members<ViewSettings>(), "a member of ViewSettings has no row");

constexpr Choice kObjectCulls[] = {
    {"inherit", "as the scene", "As caster.cull says."},
    {"none", "none", "Every triangle of the object casts."},
    {"back", "back faces", "Faces turned away from the light do not cast."},
    {"front", "front faces", "Faces turned to the light do not cast."},
};

constexpr auto kObject = with_scope(
    std::to_array<Param>({
        {SI_OBJECT_FIELD(cull), .label = "Cull", .unit = "", SI_CHOICES(kObjectCulls),
         .help = "Which faces of this object are left out of the shadow map; the way to keep single planes and floors "
                 "under front-face culling."},
        {SI_OBJECT_FIELD(cast), .label = "Casts", .unit = "", .help = "Whether this object casts shadows."},
        {SI_OBJECT_FIELD(receive), .label = "Receives", .unit = "", .help = "Whether this object receives shadows."},
    }),
    Scope::Object);
static_assert(kObject.size() == members<ObjectSettings>(), "a member of ObjectSettings has no row");

}  // namespace

std::span<const Param> shading_rows() {
    return kShading;
}
std::span<const Param> camera_rows() {
    return kCamera;
}
std::span<const Param> scene_rows() {
    return kScene;
}

std::span<const Param> view_rows() {
    return kView;
}
std::span<const Param> object_rows() {
    return kObject;
}

}  // namespace si
