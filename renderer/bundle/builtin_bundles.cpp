#include "renderer/bundle/builtin_bundles.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "renderer/base/directions.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/bundle/bundle.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/projection/projection.h"

namespace si {
namespace {

constexpr std::string_view kMapFile = "map.raw";

/// Ray from the near plane (0) to the far plane (1) of a map.
struct GivenRay {
    glm::dvec3 from{0}, along{0};
};

/// Returns the share of a ray at which it enters a box; 2 where it does not.
double entry_into(const GivenBody& box, const GivenRay& ray) {
    double enters = 0, leaves = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.along[axis] == 0) {
            if (ray.from[axis] < box.lo[axis] || ray.from[axis] > box.hi[axis]) return 2;
            continue;
        }
        const double a = (box.lo[axis] - ray.from[axis]) / ray.along[axis];
        const double b = (box.hi[axis] - ray.from[axis]) / ray.along[axis];
        enters = std::max(enters, std::min(a, b));
        leaves = std::min(leaves, std::max(a, b));
    }
    return enters <= leaves ? enters : 2;
}

/// Returns the share of a ray at which it meets the scene; 1, the far plane, where it does not.
double first_surface(const GivenRay& ray) {
    double nearest = 1;
    for (const GivenBody& body : kGivenBodies) nearest = std::min(nearest, entry_into(body, ray));
    if (ray.along.y != 0) {
        const double floor = -ray.from.y / ray.along.y;
        const glm::dvec3 at = ray.from + floor * ray.along;
        if (floor >= 0 && std::max(std::abs(at.x), std::abs(at.z)) <= kGivenFloorSide / 2)
            nearest = std::min(nearest, floor);
    }
    return nearest;
}

/// Map of the scene through a matrix.
struct GivenMap {
    glm::dmat4 clip_from_scene{1.0};
    DepthConvention depth;
    int width = 0, height = 0;
    RawFormat texels = RawFormat::F32;
    /// Values are stored as 1 - depth, which the matrix does not say.
    bool flips_values = false;
};

glm::dvec3 given_unprojected(const glm::dmat4& inverse, const glm::dvec3& ndc) {
    const glm::dvec4 p = inverse * glm::dvec4(ndc, 1);
    return glm::dvec3(p) / p.w;
}

/// Returns the bytes of the map's raw image, bottom row first.
std::string map_bytes(const GivenMap& map) {
    const glm::dmat4 inverse = glm::inverse(map.clip_from_scene);
    const double low = map.depth.zero_to_one ? 0 : -1;
    const double near = map.depth.reversed ? 1 : low, far = map.depth.reversed ? low : 1;
    std::string out;
    const auto put = [&](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) out.push_back(char(value >> (8 * i) & 0xff));
    };
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const glm::dvec2 ndc(2 * (x + 0.5) / map.width - 1, 2 * (y + 0.5) / map.height - 1);
            const glm::dvec3 from = given_unprojected(inverse, {ndc, near}),
                             to = given_unprojected(inverse, {ndc, far});
            const double share = first_surface({from, to - from});
            const glm::dvec4 clip = map.clip_from_scene * glm::dvec4(from + share * (to - from), 1);
            double depth = (clip.z / clip.w - low) / (1 - low);
            if (share >= 1) depth = map.depth.far_depth();
            if (map.flips_values) depth = 1 - depth;
            if (map.texels == RawFormat::U16)
                put(std::uint32_t(std::lround(std::clamp(depth, 0.0, 1.0) * 65535)), 2);
            else
                put(std::bit_cast<std::uint32_t>(float(depth)), 4);
        }
    return out;
}

/// Returns the axes of a light's view: right, up, and back to the light.
glm::dmat3 axes_of_light(const GivenLight& light) {
    const glm::dvec3 back = direction_from_angles(light.azimuth_deg, light.elevation_deg);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
    return {right, glm::cross(back, right), back};
}

/// Returns the matrix of parallel rays of the light over a box of light space about the scene's middle.
/// @param half half sizes across the rays and along them, metres
glm::dmat4 clip_of_sun(const GivenLight& light, const glm::dvec3& half, const DepthConvention& depth) {
    const glm::dmat3 axes = axes_of_light(light);
    DepthCurve curve;
    curve.near = 0;
    curve.far = 2 * half.z;
    curve.convention = depth;
    return clip_from_relative(projection_matrix(curve, half.x, half.y), axes, half.z * axes[2], glm::dvec3(0));
}

/// Returns the middle of the bounds of floor and bodies, from which lamps of the settings count.
glm::dvec3 bounds_middle() {
    const glm::dvec3 half(kGivenFloorSide / 2, 0, kGivenFloorSide / 2);
    glm::dvec3 lo = -half, hi = half;
    for (const GivenBody& body : kGivenBodies) {
        lo = glm::min(lo, body.lo);
        hi = glm::max(hi, body.hi);
    }
    return 0.5 * (lo + hi);
}

glm::dmat4 clip_of_spot(const GivenLight& light, double near, double far, const DepthConvention& depth) {
    const glm::dmat3 axes = axes_of_light(light);
    DepthCurve curve;
    curve.perspective = true;
    curve.near = near;
    curve.far = far;
    curve.convention = depth;
    const double half = std::tan(light.cone_deg * M_PI / 360);
    return clip_from_relative(projection_matrix(curve, half, half), axes, bounds_middle() + light.distance * axes[2],
                              glm::dvec3(0));
}

/// Returns a warp whose w changes with y: w = 1 + rise y. It keeps the square of x and y, and depth from -1 to 1.
glm::dmat4 warp_of_rows(double rise) {
    glm::dmat4 out(1.0);
    out[1][3] = rise;
    out[3][1] = rise;
    out[2][2] = 1 - std::abs(rise);
    return out;
}

glm::dmat4 scene_from_far() {
    return glm::translate(glm::dmat4(1), -kGivenFarPlace);
}

/// Returns a matrix as an engine uploads it: in single precision.
glm::dmat4 as_floats(const glm::dmat4& m) {
    return glm::dmat4(glm::mat4(m));
}

/// Returns a bundle of one light, without a scene. Its bias is known to be none.
Bundle bundle_of(const GivenMap& map, const GivenLight& light, const glm::dmat4& clip_from_world) {
    Bundle out;
    out.made_by = "Shadow Inspector";
    BundleLight& own = out.lights.emplace_back();
    own.name = "given";
    own.type = light.cone_deg > 0 ? LightType::Spot : LightType::Directional;
    if (light.cone_deg > 0) own.cone_deg = light.cone_deg;
    BundleMap& m = own.maps.emplace_back();
    m.image = {.file = std::string(kMapFile),
               .first_row = FirstRow::Bottom,
               .width = map.width,
               .height = map.height,
               .format = map.texels};
    m.clip.clip_from_world = clip_from_world;
    m.depth.convention = map.depth;
    m.depth.format = map.texels == RawFormat::U16 ? BundleDepthFormat::D16 : BundleDepthFormat::D32F;
    own.lookup.bias = {.constant = 0, .slope = 0, .normal = 0, .units = {}};
    return out;
}

BundleContents contents_of(const GivenMap& map, const Bundle& bundle) {
    return {{std::string(kFrameJson), format_bundle(bundle)}, {std::string(kMapFile), map_bytes(map)}};
}

BundleContents make_strip() {
    // The long side of a texel lies along the slope of the floor.
    const glm::dmat4 quarter_turn(glm::dvec4(0, 1, 0, 0), glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 0, 1, 0),
                                  glm::dvec4(0, 0, 0, 1));
    const GivenMap map{quarter_turn * clip_of_sun(kGivenSun, {6, 6, 8}, {}), {}, 128, 512};
    return contents_of(map, bundle_of(map, kGivenSun, map.clip_from_scene));
}

BundleContents make_warped() {
    const DepthConvention depth{.zero_to_one = false};
    const GivenMap map{warp_of_rows(0.6) * clip_of_sun(kGivenSun, {6, 6, 8}, depth), depth, 256, 256};
    return contents_of(map, bundle_of(map, kGivenSun, map.clip_from_scene));
}

/// @param stated true: the matrix is that of the reversed map; false: it is the one before depth was reversed
BundleContents make_reversed(bool stated) {
    const DepthConvention depth{.zero_to_one = true, .reversed = stated};
    const GivenMap map{clip_of_spot(kGivenSpot, 0.03125, 64, depth), depth, 512, 512, RawFormat::F32, !stated};
    return contents_of(map, bundle_of(map, kGivenSpot, map.clip_from_scene));
}

BundleContents make_16_bits() {
    const GivenMap map{clip_of_spot(kGivenSpot, 0.0625, 32, {}), {}, 512, 512, RawFormat::U16};
    return contents_of(map, bundle_of(map, kGivenSpot, map.clip_from_scene));
}

GivenMap far_map() {
    return {clip_of_sun(kGivenSun, {6, 6, 8}, {}), {}, 512, 512};
}

BundleContents make_relative_to_camera() {
    const GivenMap map = far_map();
    // The engine's camera stands anywhere: its place is no sum of few powers of two.
    const glm::dvec3 camera = kGivenFarPlace + glm::dvec3(-2.7, 7.1, 6.3);
    const glm::dmat4 scene_from_camera = scene_from_far() * glm::translate(glm::dmat4(1), camera);
    Bundle bundle = bundle_of(map, kGivenSun, as_floats(map.clip_from_scene * scene_from_camera));
    bundle.world.origin = camera;
    return contents_of(map, bundle);
}

BundleContents make_absolute() {
    const GivenMap map = far_map();
    return contents_of(map, bundle_of(map, kGivenSun, as_floats(map.clip_from_scene * scene_from_far())));
}

struct BuiltinBundle {
    std::string_view key;
    BundleContents (*make)();
};
constexpr BuiltinBundle kBundles[] = {
    {"strip", make_strip},
    {"warped", make_warped},
    {"reversed", [] { return make_reversed(true); }},
    {"reversed-unstated", [] { return make_reversed(false); }},
    {"16-bits", make_16_bits},
    {"relative-to-camera", make_relative_to_camera},
    {"absolute", make_absolute},
};

}  // namespace

bool is_builtin_bundle(const std::filesystem::path& path) {
    return path.native().starts_with(kBuiltinBundlePrefix);
}

BundleContents builtin_bundle(std::string_view name) {
    const std::string_view key = name.substr(std::min(name.size(), kBuiltinBundlePrefix.size()));
    std::string known;
    for (const BuiltinBundle& bundle : kBundles) {
        if (bundle.key == key) return bundle.make();
        known += fmt::format("{}{}", known.empty() ? "" : ", ", bundle.key);
    }
    throw Error(fmt::format("{}: there is no such built-in bundle; name a file, or one of {} after {}",
                            printable(name, 100), known, kBuiltinBundlePrefix));
}

}  // namespace si
