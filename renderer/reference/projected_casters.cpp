#include "renderer/reference/projected_casters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace si {
namespace {

/// Limits of triangles that meet a light, above which rays are faster: all, and those with an alpha test.
constexpr std::size_t kMostTriangles = 200, kMostMasked = 64;

/// Returns true when face culling removes the face of a triangle that a shadow ray meets.
/// @param front the ray meets the front face of the triangle from behind: the face's normal points along the ray
bool is_culled(Cull cull, bool front) {
    return cull == Cull::Back ? !front : cull == Cull::Front && front;
}

// The compiler builds the loops for several processors, one of which chooses. All give the same bytes: none fuses
// products. The choice at start-up and AddressSanitizer do not go together.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__)
#define SI_WIDE_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SI_WIDE_VECTORS
#endif

/// Lists the triangles in a shaft that may hide the light from one of its points.
/// @param along the point along the shaft's axes @param list room for the number of each triangle
/// @returns the number of listed triangles
SI_WIDE_VECTORS std::size_t list_near(const ShaftTriangles& casters, const LightShaft& shaft, const glm::vec3& along,
                                      std::int32_t* list) {
    const float x = along.x, y = along.y, z = along.z, top = shaft.top, slope_x = shaft.slope.x,
                slope_y = shaft.slope.y;
    const float *const low_x = casters.low_x.data(), *const low_y = casters.low_y.data(),
                       *const high_x = casters.high_x.data(), *const high_y = casters.high_y.data(),
                       *const tops = casters.top.data();
    const std::size_t count = casters.size();
    for (std::size_t k = 0; k < count; ++k) {
        const float height = (tops[k] < top ? tops[k] : top) - z, reach_x = height * slope_x,
                    reach_y = height * slope_y;
        list[k] = (height > 0) & (low_x[k] <= x + reach_x) & (high_x[k] >= x - reach_x) & (low_y[k] <= y + reach_y) &
                  (high_y[k] >= y - reach_y);
    }
    std::size_t listed = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::int32_t is_near = list[k];
        list[listed] = std::int32_t(k);
        listed += std::size_t(is_near);
    }
    return listed;
}

/// Sets the flags of all places inside a triangle.
/// @param edges three edge functions (X, Y, Z)
/// @param touched room for a number of each group
SI_WIDE_VECTORS void hide_inside(const glm::vec3* edges, const SamplePlaces& places, std::int32_t* touched,
                                 std::int32_t* flags) {
    const float ax = edges[0].x, ay = edges[0].y, az = edges[0].z, bx = edges[1].x, by = edges[1].y, bz = edges[1].z,
                cx = edges[2].x, cy = edges[2].y, cz = edges[2].z;
    // Corner of a box at which each edge function is largest.
    const float* const a_x = ax < 0 ? places.low_x.data() : places.high_x.data();
    const float* const a_y = ay < 0 ? places.low_y.data() : places.high_y.data();
    const float* const b_x = bx < 0 ? places.low_x.data() : places.high_x.data();
    const float* const b_y = by < 0 ? places.low_y.data() : places.high_y.data();
    const float* const c_x = cx < 0 ? places.low_x.data() : places.high_x.data();
    const float* const c_y = cy < 0 ? places.low_y.data() : places.high_y.data();
    for (std::size_t g = 0; g < places.groups(); ++g) {
        const float a = ax * a_x[g] + ay * a_y[g] + az, b = bx * b_x[g] + by * b_y[g] + bz,
                    c = cx * c_x[g] + cy * c_y[g] + cz;
        const float ab = a < b ? a : b;
        touched[g] = (ab < c ? ab : c) >= 0 ? 1 : 0;
    }
    // A list of groups in place of a branch for each, which no processor predicts.
    std::size_t count = 0;
    for (std::size_t g = 0; g < places.groups(); ++g) {
        const std::int32_t is_touched = touched[g];
        touched[count] = std::int32_t(g);
        count += std::size_t(is_touched);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const auto g = std::size_t(touched[i]);
        const float* const x = places.x.data() + g * SamplePlaces::kPerGroup;
        const float* const y = places.y.data() + g * SamplePlaces::kPerGroup;
        std::int32_t* const hidden = flags + g * SamplePlaces::kPerGroup;
        for (std::size_t k = 0; k < SamplePlaces::kPerGroup; ++k) {
            const float a = ax * x[k] + ay * y[k] + az, b = bx * x[k] + by * y[k] + bz, c = cx * x[k] + cy * y[k] + cz;
            const float ab = a < b ? a : b;
            hidden[k] |= (ab < c ? ab : c) >= 0 ? 1 : 0;
        }
    }
}

}  // namespace

bool ProjectedCasters::project(const RayHierarchy& scene, const CasterTree& tree, const LightShaft& shaft,
                               const ShaftTriangles& casters, const glm::vec3& origin, const LightDisk& disk,
                               std::span<const ObjectTraits> culls, const SunPlaces* sun) {
    triangles_.clear();
    sun_ = sun;
    table_.clear();
    hides_all_ = false;
    masked_ = 0;
    const glm::vec3 along = glm::transpose(shaft.axes) * origin;
    const glm::dmat3 across = glm::transpose(disk.axes);
    const double radius2 = disk.radius * disk.radius;
    const double near = disk.near_m * scene.scale, far = disk.far_m * scene.scale;
    numbers_.resize(casters.size());
    const std::size_t near_light = list_near(casters, shaft, along, numbers_.data());
    for (std::size_t k = 0; k < near_light; ++k) {
        const std::uint32_t id = casters.caster[std::size_t(numbers_[k])],
                            primitive = casters.primitive[std::size_t(numbers_[k])];
        const auto corners = tree.corners(id, primitive);
        glm::dvec3 c[3];
        for (int i = 0; i < 3; ++i) c[i] = across * (glm::dvec3(corners[std::size_t(i)]) - glm::dvec3(origin));
        const double highest = std::max({c[0].z, c[1].z, c[2].z});
        if (highest <= 0 || std::min({c[0].z, c[1].z, c[2].z}) > far) continue;
        glm::dvec3 edges[3] = {glm::cross(c[1], c[2]), glm::cross(c[2], c[0]), glm::cross(c[0], c[1])};
        // A line through the origin meets the triangle in front of it where all edge functions have this sign.
        const double side = glm::dot(c[0], edges[0]);
        if (side == 0) continue;
        bool misses = false;
        std::array<bool, 3> crosses;
        for (std::size_t i = 0; i < 3; ++i) {
            glm::dvec3& edge = edges[i];
            if (side < 0) edge = -edge;
            const double in_centre = edge.x * disk.centre.x + edge.y * disk.centre.y + edge.z;
            crosses[i] = in_centre * in_centre < radius2 * (edge.x * edge.x + edge.y * edge.y);
            misses = misses || (in_centre < 0 && !crosses[i]);
        }
        if (misses) continue;
        const Caster& of = scene.casters[id];
        if (!culls.empty() && is_culled(culls[of.object].cull, (side > 0) != of.mirrored)) continue;
        if (highest > near) {
            triangles_.clear();
            return false;
        }
        const AlphaMask* mask = scene.geometry->objects[of.object].mesh->mask.get();
        if (!mask && std::ranges::count(crosses, true) == 0) {
            hides_all_ = true;
            return true;
        }
        Triangle out{.mask = mask, .primitive = primitive};
        for (std::size_t i = 0; i < 3; ++i) {
            const double length = glm::length(edges[i]);
            out.edges[i] = glm::vec3(edges[i] * (1 / length));
            out.weights[int(i)] = float(length);
        }
        masked_ += mask != nullptr;
        if (triangles_.size() == kMostTriangles || masked_ > kMostMasked) {
            triangles_.clear();
            return false;
        }
        triangles_.push_back(out);
    }
    return true;
}

void ProjectedCasters::hide_places(const SamplePlaces& places) {
    hidden_.assign(places.x.size(), 0);
    numbers_.resize(places.groups());
    for (const Triangle& t : triangles_) {
        if (!t.mask) {
            hide_inside(t.edges, places, numbers_.data(), hidden_.data());
            continue;
        }
        inside_.assign(hidden_.size(), 0);
        hide_inside(t.edges, places, numbers_.data(), inside_.data());
        for (std::size_t k = 0; k < places.points.size(); ++k) {
            if (!inside_[k] || hidden_[k]) continue;
            const glm::vec3 place(places.x[k], places.y[k], 1);
            const glm::vec3 inside(glm::dot(t.edges[0], place), glm::dot(t.edges[1], place),
                                   glm::dot(t.edges[2], place));
            const glm::dvec3 weights = glm::dvec3(inside) * glm::dvec3(t.weights);
            const double sum = weights.x + weights.y + weights.z;
            hidden_[k] = sum > 0 && t.mask->is_solid(t.primitive, weights.y / sum, weights.z / sum);
        }
    }
}

void ProjectedCasters::find_seen(const LightSamples& samples, std::span<const std::uint32_t> points,
                                 std::span<Seen> seen) {
    if (points.empty()) return;
    if (hides_all_or_none()) {
        std::ranges::fill(seen, hides_all_ ? Seen::Dark : Seen::Lit);
        return;
    }
    const std::uint32_t largest = *std::ranges::max_element(points);
    // A table with many more points than are asked for is dear where each takes an alpha test.
    const bool few = has_masks() && 2 * points.size() < largest;
    if (largest >= table_.size() && largest < std::uint32_t{1} << LightSamples::kSquareDigits && !few)
        fill_table(samples, std::bit_width(largest));
    if (largest < table_.size()) {
        for (std::size_t k = 0; k < points.size(); ++k) seen[k] = table_[points[k]];
        return;
    }
    places_.points.assign(points.begin(), points.end());
    places_.update(samples);
    hide_places(places_);
    for (std::size_t k = 0; k < points.size(); ++k) seen[k] = hidden_[k] ? Seen::Dark : Seen::Lit;
}

void ProjectedCasters::fill_table(const LightSamples& samples, int digits) {
    const SamplePlaces* places = &places_;
    if (sun_ && digits >= SunPlaces::kLeastDigits) {
        places = &sun_->places(samples.scrambling(), digits);
    } else {
        samples.points_in_squares(digits, places_.points);
        places_.update(samples);
    }
    hide_places(*places);
    table_.resize(places->points.size());
    for (std::size_t k = 0; k < table_.size(); ++k) table_[places->points[k]] = hidden_[k] ? Seen::Dark : Seen::Lit;
}

}  // namespace si
