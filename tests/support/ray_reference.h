// Traces reference rays of small scenes in double precision, independently of renderer/reference.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/view/lights/light.h"

namespace si::test {

/// Triangle of a scene, relative to the scene's centre.
struct Triangle {
    glm::dvec3 a, b, c;  ///< corners, metres from the scene's centre
    glm::dvec3 normal;   ///< unit normal by winding (mirrored objects: as drawn)
    int object = 0;      ///< index into the scene's objects
};

/// Intersection of a ray with a triangle.
struct Hit {
    glm::dvec3 position;  ///< world metres
    glm::dvec3 normal;    ///< unit normal, towards the ray's origin
    int triangle = -1;    ///< index for RayReference::triangle()
    double distance = 0;  ///< distance from the ray's origin, metres
};

/// Ray tracer that tests rays against the triangles of a small scene, two-sided, in double. Tests compare drawn shadows
/// with its answers.
class RayReference {
public:
    /// Copies the triangles of a scene.
    explicit RayReference(const Scene& scene);
    /// Returns the nearest hit of a ray; nothing if the ray misses the scene.
    /// @param origin_ws world metres
    /// @param direction unit direction, world
    std::optional<Hit> first_hit(const glm::dvec3& origin_ws, const glm::dvec3& direction) const;
    /// Returns whether a triangle lies between a point and the light.
    /// @param own index of the point's own triangle, which is ignored
    /// @param least smallest distance of an occluder that counts, metres
    bool occluded(const glm::dvec3& point_ws, const FittedLight& light, int own, double least = 0) const;
    /// Returns the number of triangles of all objects.
    std::size_t triangle_count() const { return triangles_.size(); }
    /// Returns a triangle by its index (Hit::triangle).
    const Triangle& triangle(int i) const { return triangles_[std::size_t(i)]; }

private:
    /// Range of one object's triangles with a sphere around them.
    struct Group {
        std::size_t begin = 0;
        std::size_t end = 0;
        glm::dvec3 centre{0};
        double radius = 0;
    };
    /// Calls `visit` with the index of each triangle whose group's sphere the line meets, until `visit` returns true.
    template <class Visit>
    bool visit_near_line(const glm::dvec3& origin, const glm::dvec3& direction, Visit visit) const;

    std::vector<Triangle> triangles_;
    std::vector<Group> groups_;
    glm::dvec3 centre_{0};
    double radius_ = 1;
};

/// Returns whether the segment or ray from `p` along `d` meets an axis-aligned box, by the slab test.
/// @param most parameter of the segment's end
/// @param lo, hi opposite corners of the box
bool meets_box(const glm::dvec3& p, const glm::dvec3& d, double most, const glm::dvec3& lo, const glm::dvec3& hi);

/// Pixel of a picture with the ray through it.
struct PixelRay {
    int x = 0;
    int y = 0;                ///< from the top
    glm::dvec3 origin{0};     ///< world metres
    glm::dvec3 direction{0};  ///< unit direction, world
};

/// Pixel of a picture with the first hit of its ray.
struct PixelHit {
    int x = 0;
    int y = 0;  ///< from the top
    Hit hit;
};

/// Returns the rays of a camera's pixels, row by row from the top.
/// @param width, height size of the picture, pixels
/// @param step distance of the returned pixels along both axes, pixels
/// @param first coordinates of the first returned pixel
std::vector<PixelRay> pixel_rays(const Camera& camera, int width, int height, int step = 1, int first = 0);

/// Returns the pixels of pixel_rays() whose rays meet the scene, with their first hits.
std::vector<PixelHit> pixel_hits(const RayReference& scene, const Camera& camera, int width, int height, int step = 1,
                                 int first = 0);

/// State of a pixel in the reference. Nothing: no geometry. Away: the surface faces away from the light. Boundary: a
/// shadow edge lies within the reach of the comparison.
enum class ReferenceState { Nothing, Away, Lit, Shadow, Boundary };

/// Picture of reference states and first hits, row by row from the top.
struct ReferenceImage {
    int width = 0;   ///< pixels
    int height = 0;  ///< pixels
    std::vector<ReferenceState> states;
    std::vector<std::optional<Hit>> hits;  ///< first hit of each pixel's ray
    /// Returns the state of a pixel; y counts from the top.
    ReferenceState state_at(int x, int y) const { return states[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

/// Traces the reference state of every pixel of a camera's picture.
/// @param width, height size of the picture, pixels
/// @param map_resolution texels per side of the light's map, for the size of a texel
/// @param reach_texels distance of Boundary pixels from a shadow edge, in texels along each map axis on the receiver's
///     plane
ReferenceImage trace_reference(const RayReference& scene, const Camera& camera, const FittedLight& light, int width,
                               int height, int map_resolution, double reach_texels);

/// Returns the unit direction from a world point towards the light.
glm::dvec3 direction_to(const FittedLight& light, const glm::dvec3& point_ws);

/// Returns the light's view that covers a world point. A point light's face follows from the largest coordinate.
const LightView& view_of(const FittedLight& light, const glm::dvec3& point_ws);

/// Returns map coordinates (u, v), depth and w of a world point in double precision.
glm::dvec4 uvdw(const LightView& view, const glm::dvec3& point_ws);

}  // namespace si::test
