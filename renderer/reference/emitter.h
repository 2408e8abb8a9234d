// Lights of the ray-traced reference: position, direction, size, and sample points on their area.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Light in the form that the ray tracer samples: a directional light is a disk on the sky, a spot light a disk
/// perpendicular to its axis, a point light a sphere.
struct Emitter {
    LightType type = LightType::Directional;
    glm::dvec3 position_ws{0};     ///< metres; spot and point lights only
    glm::dvec3 to_light{0, 1, 0};  ///< unit; directional: towards the light; spot: against its axis
    double cos_cone = -1;          ///< cosine of a spot's outer half angle
    double range_m = 0;            ///< spot and point: no light beyond this distance; 0: unlimited
    double size = 0;               ///< light.size: angular radius in degrees (directional) or radius in metres
    bool casts = true;             ///< false: the light casts no shadows

    /// Returns the unit vector from a point to the light's centre.
    /// @param distance_m receives the distance, infinite for directional lights
    glm::dvec3 direction_from(const glm::dvec3& point_ws, double& distance_m) const {
        distance_m = std::numeric_limits<double>::infinity();
        if (type == LightType::Directional) return to_light;
        const glm::dvec3 d = position_ws - point_ws;
        distance_m = glm::length(d);
        return distance_m > 0 ? d / distance_m : to_light;
    }
    /// Returns true when a point lies in the spot light's cone; always true for other lights.
    /// @param to_light_from_point unit vector from the point to the light
    bool in_cone(const glm::dvec3& to_light_from_point) const {
        return type != LightType::Spot || glm::dot(to_light_from_point, to_light) > cos_cone;
    }
};

/// Returns a light of a frame in the form that the ray tracer samples. @param settings settings of this light
Emitter emitter_of(const FittedLight& light, const LightSettings& settings);

/// Ray segment from a surface point to a point on a light.
struct LightRay {
    glm::dvec3 direction{0};  ///< unit
    double length_m = std::numeric_limits<double>::infinity();
};

/// Disk that a light with a size fills for one surface point, on a plane at distance 1 across the light's direction.
struct LightDisk {
    glm::dmat3 axes{1};    ///< columns: two axes across the light, then the axis towards it; unit vectors
    glm::dvec2 centre{0};  ///< along the two axes across, at distance 1
    double radius = 0;     ///< at distance 1
    double near_m = std::numeric_limits<double>::infinity();  ///< least height of a sample point, along the third axis
    double far_m = std::numeric_limits<double>::infinity();   ///< largest height of a sample point
};

/// Cell of a 2^16 x 2^16 grid on an area light in which a sample point lies. The upper bits of column and row are
/// those of the enclosing cell in a coarser grid.
struct LightCell {
    std::uint16_t x = 0, y = 0;
    /// Returns the row-major index of the enclosing cell in a coarser grid of 2^digits cells. The grid has equal
    /// numbers of columns and rows; for odd `digits` it has twice as many columns.
    /// @param digits 0 to 32
    std::size_t index(int digits) const {
        const int across = (digits + 1) / 2, down = digits / 2;
        return std::size_t(y >> (16 - down)) << across | std::size_t(x >> (16 - across));
    }
};

/// Sample points on an area light for the shadow rays of one surface point: a (0,2)-sequence (Sobol') under Owen's
/// nested scrambling. In every grid of 2^k cells whose sides are powers of two, each cell has exactly one of the first
/// 2^k points. More samples extend the sequence, and earlier points stay. With N samples the error at a shadow edge
/// falls as N^(-3/4); with independent samples it falls as N^(-1/2). Owen, Scrambled Net Variance for Integrals of
/// Smooth Functions, 1997; Kollig and Keller, Efficient Multidimensional Sampling, Eurographics 2002. The pixel of the
/// surface point selects one of 64 scramblings and a rotation, so that results are reproducible. Disks use the
/// concentric map of Shirley and Chiu, A Low Distortion Map Between Disk and Square, 1997. Spheres are sampled by solid
/// angle.
class LightSamples {
public:
    /// Prepares the sample points on a light for the shadow rays of one surface point.
    /// @param emitter the light; must outlive this object
    /// @param pixel index of the surface point's pixel: the seed of scrambling and rotation
    LightSamples(const Emitter& emitter, const glm::dvec3& point_ws, std::uint64_t pixel);
    /// Returns the shadow ray to sample point `k` on the light, from the surface point given to the constructor.
    LightRay ray(std::uint32_t k) const;
    /// Returns the disk that the light fills for the surface point given to the constructor. Returns nullopt if the
    /// light is wider than 60 degrees from its centre, lies far beside its axes, or holds the point.
    std::optional<LightDisk> disk() const;
    /// Computes where the shadow rays to sample points cross the plane of disk().
    /// @param points indices of the sample points
    /// @param[out] x,y places along the two axes across the light, at distance 1; as many as `points`
    void find_places(std::span<const std::uint32_t> points, std::span<float> x, std::span<float> y) const;
    /// Returns the cell in which sample point `k` on the light lies, of a 2^16 x 2^16 grid over the light.
    LightCell cell(std::uint32_t k) const;
    /// Lists the first 2^digits sample points so that neighbours on the light follow each other.
    /// @param digits at most kSquareDigits
    /// @param out receives the indices of the sample points
    void points_in_squares(int digits, std::vector<std::uint32_t>& out) const;
    /// Largest `digits` of points_in_squares().
    static constexpr int kSquareDigits = 10;
    /// Number of scramblings of the sequence of sample points.
    static constexpr std::uint32_t kScramblings = 64;
    /// Returns the index of the scrambling that the pixel selects.
    std::uint32_t scrambling() const { return scrambling_; }
    /// Lists the sample point in each cell of a grid of 2^digits cells on the light. Each cell holds exactly one of the
    /// first 2^digits sample points.
    /// @param out receives the index of the sample point for each cell, by LightCell::index()
    void points_in_cells(int digits, std::vector<std::uint32_t>& out) const;

private:
    const Emitter& emitter_;
    glm::dvec3 point_;
    glm::dmat3 axes_;           ///< columns: two axes across the light, then the axis towards it
    double radius_ = 0;         ///< spot light: radius of the disk, metres; else 0
    double one_minus_cos_ = 0;  ///< 1 - cos of the angular radius of a sphere or of the disk on the sky
    double distance_ = 0;
    std::uint32_t scrambling_;
    const struct LightSamplePoint* points_;  ///< first points of the scrambling
};

}  // namespace si
