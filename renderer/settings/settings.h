// Everything that a person can choose and a preset can hold, with its default. One row of the table in
// settings_table.cpp describes each member: key, unit, range, help.
#pragma once

#include <array>
#include <map>
#include <string>

namespace si {

inline constexpr int kMaxLights = 16;
inline constexpr int kMaxCascades = 8;
inline constexpr int kMaxClipLevels = 8;

// Enumerations are stored as the index of their choice; the choices stand in the table, in this order.
enum class LightType { Directional, Spot, Point };
enum class LightFit { Manual, Scene, Casters, View, Stabilised, Lispsm };
enum class NearFar { Fitted, Manual, Casters, Scene, Pancaking };
enum class Split { Uniform, Logarithmic, Practical, Manual };
enum class DepthBounds { Boxes, Sdsm };
enum class CascadeChoice { Interval, Map };
enum class LightProjection { Automatic, Orthographic, Perspective };
enum class CameraSource { Automatic, Manual, Light };
enum class MapFormat { D16, D24, D32F, Colour, Linear, Linear16 };
enum class MapWrap { Border, Clamp, Repeat, Range };
enum class Outside { Lit, Unlit };
enum class Compare { Less, LessEqual };
enum class BlendCasters { None, Mask };
enum class Cull { None, Back, Front };
enum class ObjectCull { Inherit, None, Back, Front };
enum class BiasUnit { Depth, Texels, Metres };
enum class NormalSource { Geometric, Shading, Mapped };
enum class FilterMethod { Automatic, Gather, Sampler };
enum class RadiusUnit { Texels, Metres };
enum class Disk { Table, Spiral };
enum class MomentFormat { Bits32, Bits16 };
enum class TableSums { Integer, Float };
enum class MapView { Raw, Linear, Bands };
enum class MapSource { Light, Camera };
enum class Panes { One, Two, Four };
enum class OverlayRange { Declared, Fitted, Manual };
enum class Composition { Ambient, DimLit };
enum class SkyLook { Plain, Gradient };
enum class ToneCurve { Plain, Filmic };
enum class Ground { Auto, Off };
enum class MapColours { Grey, Turbo, Viridis };
enum class MapTransform { World, Eye };
enum class MapOrigin { Near, World };
enum class PlacedAlong { Aslant, X, Y, Z };
enum class Slabs { None, Stored, Biased, Both };

struct CameraSettings {
    int source = 0;  ///< CameraSource
    int index = 0;   ///< of the scene's cameras; -1: none of them
    double target_x = 0, target_y = 0, target_z = 0;
    double azimuth = 35, elevation = 25, roll = 0;
    double distance = 10;
    double fov = 45;
    double near = 0, far = 0;
    bool orthographic = false;
    double height = 10;
    bool operator==(const CameraSettings&) const = default;
};

/// What of a file is shown.
struct SceneSettings {
    int index = -1;       ///< of the file's scenes; -1: its default one
    int animation = 0;    ///< -1: the rest pose
    double time = 0;      ///< s
    double distance = 0;  ///< m
    int direction = 0;    ///< PlacedAlong
    double scale = 1;
    int ground = 0;  ///< Ground
    bool fit_animation = false;
    bool operator==(const SceneSettings&) const = default;
};

struct MapSettings {
    int resolution = 2048;
    int format = 2;   ///< MapFormat
    int wrap = 0;     ///< MapWrap
    int outside = 0;  ///< Outside
    bool far_guard = true;
    int compare = 1;  ///< Compare
    bool reversed_z = false;
    int blur_texels = 0;
    int samples = 1;
    int transform = 0;   ///< MapTransform
    int origin = 0;      ///< MapOrigin
    bool paged = false;  ///< map.virtual, a word that C++ keeps to itself
    int page_size = 128;
    int page_pool = 1024;
    int virtual_levels = 8;
    double virtual_bias = 0;
    bool operator==(const MapSettings&) const = default;
};

struct CasterSettings {
    int cull = 0;   ///< Cull
    int blend = 0;  ///< BlendCasters
    bool operator==(const CasterSettings&) const = default;
};

/// The rows of the bias and filter tables that are chosen where nobody chooses: by their keys, wherever they stand.
int default_bias();
int default_filter();

struct BiasSettings {
    int kind = default_bias();  ///< row of the bias table
    int unit = 1;               ///< BiasUnit
    // Three texels along the normal clear a plane at any angle under the default kernel: h >= kappa*sqrt(2)*sin(theta)
    // with kappa = 2 (bias_theory.h); the constant covers quantisation.
    double constant = 0.1;
    double slope = 0.0;
    double plane_clamp = 100;
    double normal = 3.0;
    int normal_source = 0;  ///< NormalSource
    double raster_slope = 0;
    double raster_units = 0;
    double raster_clamp = 0;
    bool operator==(const BiasSettings&) const = default;
};

struct FilterSettings {
    int kernel = default_filter();  ///< row of the filter table
    int method = 0;                 ///< FilterMethod
    // Of single kernels: see the rows' `settings` in the filter table.
    int size = 3;
    bool point = false;
    int taps = 16;
    double radius = 3;
    int radius_unit = 0;  ///< RadiusUnit
    bool rotate = true;
    int disk = 0;  ///< Disk
    int blocker_taps = 16;
    double max_radius = 16;
    int rays = 16;
    int steps = 8;
    double thickness = 0.1;
    int blur = 2;
    double bleed = 0.2;
    double min_variance = 1e-6;
    int blur_shape = 0;  ///< box, Gaussian
    bool mips = false;
    int anisotropy = 1;
    int moment_format = 0;  ///< MomentFormat
    double exponent = 40;
    double negative_exponent = 5;
    double moment_bias = 3e-6;
    int sums = 0;  ///< TableSums
    double window = 5;
    bool footprint = false;
    bool operator==(const FilterSettings&) const = default;
};

/// The row of the fit table that is chosen where nobody chooses.
int default_fit();

struct LightSettings {
    std::string name;
    int type = 0;  ///< LightType
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
    int source = 0;           ///< row of the source table
    int fit = default_fit();  ///< LightFit, row of the fit table
    bool snap = true;
    int projection = 0;  ///< LightProjection
    int near_far = 0;    ///< NearFar
    double near = 0, far = 0, stretch = 1, extent = 0;
    int cascades = 1;
    int depth_bounds = 0;  ///< DepthBounds
    int split = 2;         ///< Split, row of the split table
    double split_lambda = 0.5;
    double split_1 = 0.07, split_2 = 0.2, split_3 = 0.45, split_4 = 0.6, split_5 = 0.7, split_6 = 0.8, split_7 = 0.9;
    double cascade_blend = 0.1;
    int cascade_choice = 0;  ///< CascadeChoice
    bool operator==(const LightSettings&) const = default;
};

struct VolumeSettings {
    bool allow_large = false;
    bool operator==(const VolumeSettings&) const = default;
};

/// Of lights whose source are blobs.
struct BlobSettings {
    double size = 1;
    double softness = 0.6;
    double opacity = 0.7;
    double reach = 8;
    bool operator==(const BlobSettings&) const = default;
};

/// Of lights with light.contact above 0.
struct ContactSettings {
    int steps = 16;
    double thickness = 0.1;
    bool operator==(const ContactSettings&) const = default;
};

/// Of lights whose source is a light map.
struct LightMapSettings {
    int resolution = 1024;
    int samples = 1;
    bool operator==(const LightMapSettings&) const = default;
};

struct ShadingSettings {
    double ambient = 0.25;
    double diffuse = 0.75;
    double specular = 0.15;
    double shininess = 32;
    int sky = 1;  ///< SkyLook
    double exposure = 0;
    int curve = 1;        ///< ToneCurve
    int composition = 0;  ///< Composition
    double dim = 0.2;
    bool textures = true;
    bool separate_visibility = false;
    bool operator==(const ShadingSettings&) const = default;
};

struct ViewSettings {
    int map_source = 0;   ///< MapSource
    int map = 1;          ///< MapView
    int map_channel = 0;  ///< 0 depth, else 1 + channel of the kernel's moments
    int map_mip = 0;
    bool map_fit = false;
    int map_colours = 0;     ///< MapColours
    bool map_region = true;  ///< outline of what the camera sees
    double map_black = 0, map_white = 1;
    double band_low = 0.9, band_high = 0.925;
    int light = 0;    ///< whose map and overlay are shown
    int face = 0;     ///< which of a light's faces or cascades
    int panes = 0;    ///< Panes
    int overlay = 0;  ///< 0 none, else row of the overlay table + 1; the first pane's
    int overlay_2 = 0, overlay_3 = 0, overlay_4 = 0;
    double overlay_opacity = 1;
    int overlay_range = 0;  ///< OverlayRange
    double overlay_min = 0, overlay_max = 1;
    bool frustum = true;
    bool bounds = false;
    bool axes = true;
    bool smooth = true;  ///< anti-aliasing of a view that rests
    int slabs = 0;       ///< Slabs
    double slabs_u = 0.5, slabs_v = 0.5;
    int slabs_texels = 32;
    bool operator==(const ViewSettings&) const = default;
};

/// The ray-traced truth that the shadows of view.light are compared with.
struct ReferenceSettings {
    bool area = false;
    int samples = 1024;
    double noise = 0.005;
    int step = 1;
    bool operator==(const ReferenceSettings&) const = default;
};

/// What one object does differently from the scene; keyed by its node path.
struct ObjectSettings {
    bool shown = true;
    int cull = 0;  ///< ObjectCull
    bool cast = true;
    bool receive = true;
    bool operator==(const ObjectSettings&) const = default;
};

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
