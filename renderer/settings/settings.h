// Settings that a person can choose and a preset can hold, with their defaults. One row of the settings table
// (param.h, rows_*.cpp) describes each member: key, unit, range, help.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace si {

/// Largest number of lights.
inline constexpr int kMaxLights = 16;
/// Largest number of cascades of a directional light.
inline constexpr int kMaxCascades = 8;
/// Largest number of clip levels of a directional light under map.virtual.
inline constexpr int kMaxClipLevels = 8;

// Settings with a closed set of choices have an enumeration; enumerators have the order of the choices in the settings
// table. A setting that chooses a row of an open table of techniques (bias.kind, filter.kernel, light.source,
// view.overlay) is an int, the row's index, so that a new row needs no enumerator.
/// Type of a light (light.type).
enum class LightType { Directional, Spot, Point };
/// Keys of the light types in settings and files, by LightType.
inline constexpr std::string_view kLightTypeKeys[] = {"directional", "spot", "point"};
/// Region of a light's shadow map (light.fit); rows of fits().
enum class LightFit { Manual, Scene, Casters, View, Stabilised, Lispsm };
/// Depth range of a light's shadow map (light.near_far).
enum class NearFar { Fitted, Manual, Casters, Scene, Pancaking };
/// Division of the camera's depth among cascades (light.split); rows of splits().
enum class Split { Uniform, Logarithmic, Practical, Manual };
/// Source of the camera depths that cascades cover (light.depth_bounds): receivers' boxes or the depth buffer.
enum class DepthBounds { Boxes, Sdsm };
/// Choice of the cascade for a point (light.cascade_choice): by depth, or the first map that contains the point.
enum class CascadeChoice { Interval, Map };
/// Projection of a shadow map (light.projection).
enum class LightProjection { Automatic, Orthographic, Perspective };
/// Source of the camera (camera.source).
enum class CameraSource { Automatic, Manual, Light };
/// Storage format of shadow maps (map.format). Colour, Linear and Linear16 are colour images.
enum class MapFormat { D16, D24, D32F, Colour, Linear, Linear16 };
/// Result of a look-up outside the map's square (map.wrap).
enum class MapWrap { Border, Clamp, Repeat, Range };
/// Lighting of surfaces outside the map (map.outside).
enum class Outside { Lit, Unlit };
/// Comparison of the receiver's depth with the depth stored in the map (map.compare).
enum class Compare { Less, LessEqual };
/// Shadow of alpha-blended materials (caster.blend).
enum class BlendCasters { None, Mask };
/// Faces left out of the shadow map for all casters (caster.cull).
enum class Cull { None, Back, Front };
/// Faces of one object left out of the shadow map (object.PATH.cull).
enum class ObjectCull { Inherit, None, Back, Front };
/// Unit of bias.constant and bias.slope (bias.unit).
enum class BiasUnit { Depth, Texels, Metres };
/// Unit of the normal offset (bias.normal_unit).
enum class OffsetUnit { Texels, Metres };
/// Dependence of the normal offset on the angle between normal and light (bias.normal_by).
enum class OffsetBy { Length, Sine, OneMinusCosine, Sideways };
/// Normal used by slope bias and normal offset (bias.normal_source).
enum class NormalSource { Geometric, Shading, Mapped };
/// Way in which a kernel reads the map (filter.method).
enum class FilterMethod { Automatic, Gather, Sampler };
/// Unit of filter.radius (filter.radius_unit).
enum class RadiusUnit { Texels, Metres };
/// Points of the sampled disk (filter.disk): Poisson table or spiral.
enum class Disk { Table, Spiral };
/// Weights of the blur of moments (filter.blur_shape).
enum class BlurShape { Box, Gaussian };
/// Bits of a stored moment (filter.moment_format).
enum class MomentFormat { Bits32, Bits16 };
/// Number type of the summed-area table (filter.sums).
enum class TableSums { Integer, Float };
/// Display of depth in the map viewer (view.map).
enum class MapView { Raw, Linear, Bands };
/// Depth image in the map viewer (view.map_source): a light's shadow map or the camera's depth buffer.
enum class MapSource { Light, Camera };
/// Number of pictures side by side (view.panes).
enum class Panes { One, Two, Four };
/// Range of the overlay's colour scale (view.overlay_range).
enum class OverlayRange { Declared, Fitted, Manual };
/// Contrast of the map viewer (view.map_contrast): fitted to the drawn depths in the editor, or always the whole range.
enum class MapContrast { Auto, Whole };
/// Blend of overlays with the picture (view.overlay_blend).
enum class OverlayBlend { Tint, Flat };
/// Style of the editor's picture beyond light and shadow (view.look).
enum class Look { Plain, Studio };
/// Combination of light and shadow (shading.composition).
enum class Composition { Ambient, DimLit };
/// Background and ambient light (shading.sky).
enum class SkyLook { Plain, Gradient };
/// Tone curve from light to picture colours (shading.curve).
enum class ToneCurve { Plain, Filmic };
/// Ground under a loaded model (scene.ground).
enum class Ground { Auto, Off };
/// Colour ramp of the map viewer (view.map_colours).
enum class MapColours { Grey, Turbo, Viridis };
/// Computation of map coordinates (map.transform): from world space, or from eye space by a texture matrix.
enum class MapTransform { World, Eye };
/// Origin of positions on the GPU (map.origin).
enum class MapOrigin { Near, World };
/// Source of the shadow maps of a bundle, one frame of an engine as files (map.bundle_maps): images of the bundle, or
/// maps drawn with the bundle's views.
enum class BundleMaps { Given, Drawn };
/// Source of the bias with which an engine reads the maps of its bundle, one frame as files (map.bundle_bias).
enum class BundleBiasSource { File, Entered, Unknown };
/// Direction in which the scene is moved (scene.direction).
enum class PlacedAlong { Aslant, X, Y, Z };
/// Axis of a file that points up (scene.up); File: the axis that the file names, else y.
enum class UpAxis { File, X, Y, Z, MinusX, MinusY, MinusZ };
/// Depths at which texels of the shadow map are drawn as quads in the scene (view.slabs).
enum class Slabs { None, Stored, Biased, Both };

/// Settings of the camera: camera.*. Lengths in metres, angles in degrees.
struct CameraSettings {
    CameraSource source = CameraSource::Automatic;
    int index = 0;  ///< index of the scene's camera; -1: a camera that shows the whole scene, far objects too
    double target_x = 0, target_y = 0, target_z = 0;
    double azimuth = 35, elevation = 25, roll = 0;
    double distance = 10;
    double fov = 45;
    double near = 0, far = 0;
    bool orthographic = false;
    double height = 10;
    bool operator==(const CameraSettings&) const = default;
};

/// Settings of the shown scene (scene.*): how its file is read, animation, placement and ground.
struct SceneSettings {
    int index = -1;  ///< index of the file's scene; -1: default scene
    UpAxis up = UpAxis::File;
    double unit = 0;      ///< metres per unit of the file; 0: the unit that the file names, else 1
    int animation = 0;    ///< index of the animation; -1: rest pose
    double time = 0;      ///< time of the animation, seconds
    double distance = 0;  ///< translation of the scene, metres
    PlacedAlong direction = PlacedAlong::Aslant;
    double scale = 1;
    Ground ground = Ground::Auto;
    bool fit_animation = false;
    bool operator==(const SceneSettings&) const = default;
};

/// Settings that choose how a scene's file is read. When one of them changes, the file has to be read again.
struct FileChoices {
    int scene = -1;  ///< index of the file's scene; -1: default scene
    UpAxis up = UpAxis::File;
    double unit = 0;  ///< metres per unit of the file; 0: the unit that the file names, else 1
    auto operator<=>(const FileChoices&) const = default;
};

/// Returns the settings of a scene that choose how its file is read: scene.index, scene.up, scene.unit.
inline FileChoices file_choices(const SceneSettings& settings) {
    return {settings.index, settings.up, settings.unit};
}

/// Replaces the settings of a scene that choose how its file is read: scene.index, scene.up, scene.unit.
inline void set_file_choices(SceneSettings& settings, const FileChoices& choices) {
    settings.index = choices.scene;
    settings.up = choices.up;
    settings.unit = choices.unit;
}

/// Settings of the shadow maps: map.*.
struct MapSettings {
    int resolution = 2048;
    MapFormat format = MapFormat::D32F;
    MapWrap wrap = MapWrap::Border;
    Outside outside = Outside::Lit;
    bool far_guard = true;
    bool face_guard = true;
    Compare compare = Compare::LessEqual;
    bool reversed_z = false;
    int blur_texels = 0;
    int samples = 1;
    MapTransform transform = MapTransform::World;
    MapOrigin origin = MapOrigin::Near;
    bool paged = false;  ///< setting map.virtual; `virtual` is a keyword of C++
    int page_size = 128;
    int page_pool = 1024;
    int virtual_levels = 8;
    double virtual_bias = 0;
    std::string bundle;  ///< path of a bundle whose maps are read in place of drawn ones; empty: none
    BundleMaps bundle_maps = BundleMaps::Given;
    BundleBiasSource bundle_bias = BundleBiasSource::File;
    bool operator==(const MapSettings&) const = default;
};

/// Settings of all casters (caster.*): which faces are culled, and whether blended surfaces cast.
struct CasterSettings {
    Cull cull = Cull::None;
    BlendCasters blend = BlendCasters::None;
    bool operator==(const CasterSettings&) const = default;
};

/// Returns the default of bias.kind: the index of its row in the bias table.
int default_bias();
/// Returns the default of filter.kernel: the index of its row in the kernel table.
int default_filter();

/// Settings of the bias: bias.*.
struct BiasSettings {
    int kind = default_bias();  ///< index of a row of the bias table
    BiasUnit unit = BiasUnit::Texels;
    double constant = 0;
    double slope = 0.0;
    double plane_clamp = 100;
    double normal = 0;
    OffsetUnit normal_unit = OffsetUnit::Texels;
    OffsetBy normal_by = OffsetBy::Length;
    NormalSource normal_source = NormalSource::Geometric;
    double raster_slope = 0;
    double raster_units = 0;
    double raster_clamp = 0;
    bool operator==(const BiasSettings&) const = default;
    /// Returns the normal offset (bias.normal) if its unit is texels, else 0.
    double normal_texels() const { return normal_unit == OffsetUnit::Texels ? normal : 0; }
    /// Returns the normal offset (bias.normal) if its unit is metres, else 0.
    double normal_metres() const { return normal_unit == OffsetUnit::Metres ? normal : 0; }
};

/// Settings of the shadow filter kernel: filter.*.
struct FilterSettings {
    int kernel = default_filter();  ///< index of a row of the kernel table
    FilterMethod method = FilterMethod::Automatic;
    // The members below belong to single kernels: see Filter::settings.
    int size = 3;
    bool point = false;
    bool bilinear = false;
    int taps = 16;
    double radius = 3;
    RadiusUnit radius_unit = RadiusUnit::Texels;
    bool rotate = true;
    Disk disk = Disk::Table;
    int blocker_taps = 16;
    double max_radius = 16;
    int rays = 16;
    int steps = 8;
    double thickness = 0.1;
    int blur = 2;
    double bleed = 0.2;
    double min_variance = 1e-6;
    BlurShape blur_shape = BlurShape::Box;
    bool mips = false;
    int anisotropy = 1;
    MomentFormat moment_format = MomentFormat::Bits32;
    double exponent = 40;
    double negative_exponent = 5;
    double moment_bias = 3e-6;
    TableSums sums = TableSums::Integer;
    double window = 5;
    bool footprint = false;
    bool operator==(const FilterSettings&) const = default;
};

/// Settings of one light: light.* for light 0, light.N.* for light N. Lengths in metres, angles in degrees.
struct LightSettings {
    std::string name;
    LightType type = LightType::Directional;
    bool on = true;
    double azimuth = -40, elevation = 45;
    double distance = 0;
    double target_x = 0, target_y = 0, target_z = 0;
    double size = 0.27;
    double range = 0;
    double cone = 60, cone_blend = 0.1;
    double intensity = 1;
    double red = 1, green = 1, blue = 1;
    bool cast = true;
    double contact = 0;
    int source = 0;                    ///< index of a row of the table of visibility sources
    LightFit fit = LightFit::Casters;  ///< row of the table of fits
    bool snap = true;
    LightProjection projection = LightProjection::Automatic;
    NearFar near_far = NearFar::Fitted;
    double near = 0, far = 0, stretch = 1, extent = 0;
    int cascades = 1;
    DepthBounds depth_bounds = DepthBounds::Boxes;
    Split split = Split::Practical;  ///< row of the table of cascade splits
    double split_lambda = 0.5;
    double split_1 = 0.07, split_2 = 0.2, split_3 = 0.45, split_4 = 0.6, split_5 = 0.7, split_6 = 0.8, split_7 = 0.9;
    double cascade_blend = 0.1;
    CascadeChoice cascade_choice = CascadeChoice::Interval;
    bool operator==(const LightSettings&) const = default;
};

/// Settings of shadow volumes: volumes.*.
struct VolumeSettings {
    bool allow_large = false;
    bool operator==(const VolumeSettings&) const = default;
};

/// Settings of blob shadows, for lights whose source is blobs: blob.*.
struct BlobSettings {
    double size = 1;
    double softness = 0.6;
    double opacity = 0.7;
    double reach = 8;
    bool operator==(const BlobSettings&) const = default;
};

/// Settings of contact shadows, for lights with light.contact above 0: contact.*.
struct ContactSettings {
    int steps = 16;
    double thickness = 0.1;
    bool operator==(const ContactSettings&) const = default;
};

/// Settings of light maps, for lights whose source is a light map: light_map.*.
struct LightMapSettings {
    int resolution = 1024;
    int samples = 1;
    bool operator==(const LightMapSettings&) const = default;
};

/// Settings of shading: shading.*.
struct ShadingSettings {
    double ambient = 0.25;
    double diffuse = 0.75;
    double specular = 0.15;
    double shininess = 32;
    SkyLook sky = SkyLook::Gradient;
    double exposure = 0;
    ToneCurve curve = ToneCurve::Filmic;
    Composition composition = Composition::Ambient;
    double dim = 0.2;
    bool textures = true;
    bool separate_visibility = false;
    bool operator==(const ShadingSettings&) const = default;
};

/// Settings of the map viewer, panes and overlays: view.*.
struct ViewSettings {
    MapSource map_source = MapSource::Light;
    MapView map = MapView::Linear;
    int map_channel = 0;  ///< 0: depth, else 1 + channel of the kernel's moments
    int map_mip = 0;
    bool map_fit = false;
    MapContrast map_contrast = MapContrast::Auto;
    MapColours map_colours = MapColours::Grey;
    bool map_region = true;  ///< outline of the view frustum
    double map_black = 0, map_white = 1;
    double band_low = 0.9, band_high = 0.925;
    int light = 0;  ///< light with the shown map and overlay
    int face = 0;   ///< shown face or cascade of the light
    Panes panes = Panes::One;
    int overlay = 0;  ///< overlay of the first pane: 0 none, else row of the overlay table + 1
    int overlay_2 = 0, overlay_3 = 0, overlay_4 = 0;
    double overlay_opacity = 1;
    OverlayBlend overlay_blend = OverlayBlend::Tint;
    OverlayRange overlay_range = OverlayRange::Declared;
    double overlay_min = 0, overlay_max = 1;
    bool frustum = true;
    bool bounds = false;
    bool axes = true;
    bool smooth = true;  ///< anti-aliasing while nothing moves
    Look look = Look::Studio;
    Slabs slabs = Slabs::None;
    double slabs_u = 0.5, slabs_v = 0.5;
    int slabs_texels = 32;

    /// Returns `light`, clamped to the indices of Settings::lights.
    int light_index() const { return std::clamp(light, 0, kMaxLights - 1); }
    bool operator==(const ViewSettings&) const = default;
};

/// Settings of the ray-traced reference, with which the shadows of view.light are compared: truth.*.
struct ReferenceSettings {
    bool area = false;
    int samples = 1024;
    double noise = 0.005;
    int step = 1;
    bool operator==(const ReferenceSettings&) const = default;
};

/// Settings of one object: object.PATH.*, with the node path of the object as PATH.
struct ObjectSettings {
    bool shown = true;
    ObjectCull cull = ObjectCull::Inherit;
    bool cast = true;
    bool receive = true;
    bool operator==(const ObjectSettings&) const = default;
};

/// Returns the face culling that applies to an object.
/// @param own the choice of the object @param of_all the choice for all casters (caster.cull), used if the object
/// inherits
constexpr Cull cull_in_force(ObjectCull own, Cull of_all) {
    return own == ObjectCull::None    ? Cull::None
           : own == ObjectCull::Back  ? Cull::Back
           : own == ObjectCull::Front ? Cull::Front
                                      : of_all;
}

/// Complete settings of a session: scene, camera, techniques, lights, display and objects. A comparable, copyable
/// value.
struct Settings {
    SceneSettings scene;
    CameraSettings camera;
    MapSettings map;
    CasterSettings caster;
    BiasSettings bias;
    FilterSettings filter;
    int light_count = 1;
    std::array<LightSettings, kMaxLights> lights{};
    VolumeSettings volumes;
    ContactSettings contact;
    BlobSettings blob;
    LightMapSettings light_map;
    ShadingSettings shading;
    ViewSettings view;
    ReferenceSettings truth;
    std::map<std::string, ObjectSettings> objects;
    bool operator==(const Settings&) const = default;
};

}  // namespace si
