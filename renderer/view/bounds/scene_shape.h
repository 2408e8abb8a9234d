// What the light fit needs to know of a scene's extent. Pure CPU, double precision.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "renderer/view/bounds/half_space.h"
#include "renderer/view/lights/light.h"

namespace si {

struct SceneShape {
    glm::dvec3 centre{0};
    double radius = 1;            ///< of the sphere around the bounds; never 0
    bool one_box = false;         ///< it stands for all objects
    std::vector<Box> boxes;       ///< of one object each (or of the scene), world; never empty
    std::vector<bool> box_casts;  ///< as long as `boxes`, like all that begins so
    std::vector<bool> box_receives;
    std::vector<std::size_t> box_objects;  ///< of Scene::objects
    /// Of objects whose triangles all lie in one plane, within box_tolerance.
    std::vector<std::optional<HalfSpace>> box_planes;
    std::vector<double> box_tolerance;  ///< metres
    std::vector<bool>
        box_spans_animation;            ///< of all the places that an animation takes an object to: triangles say less
    std::optional<std::size_t> ground;  ///< which box is that of the ground under a model; nothing: there is none
    /// Of one light: around its shadows on the ground, a convex polygon or a point; empty: all of the ground's box.
    std::vector<glm::dvec3> ground_shadow;
    bool triangles = false;  ///< the scene has any
    bool casters = false;    ///< an object with triangles casts
    bool receivers = false;  ///< an object with triangles receives shadows
};

/// Boxes of all objects, over all of the animation where measure_animation_bounds() was called; above 20000 objects the
/// scene's box stands for them. Always finite, also for empty scenes. Meshes are read to find the flat ones.
SceneShape scene_shape(const Scene& scene, const Settings& settings);

/// The shape as a light's maps have to hold it: of the ground under a model no more than where casters shadow it, which
/// across the light is within the casters.
/// @param scene that the shape is of
SceneShape with_shadowed_ground(const SceneShape& shape, const Scene& scene, const PlacedLight& light);

/// Extent in a view: x and y across, z metres along the axis (positive in front).
struct ViewExtent {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()};
    glm::dvec3 hi{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec3& p) {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
    void add(const ViewExtent& e) {
        lo = glm::min(lo, e.lo);
        hi = glm::max(hi, e.hi);
    }
};

ViewExtent extent_in_view(std::span<const glm::dvec3> points, const LightView& view);
/// Of a ground under a model only how deep it lies counts.
ViewExtent extent_in_view(const SceneShape& shape, const LightView& view);

/// Of what lies of a box within the sides of a parallel view.
ViewExtent extent_inside_view(const Box& box, const LightView& view);
/// The same of one of the shape's boxes; of the ground the part that lies in shadow.
ViewExtent extent_inside_view(const SceneShape& shape, std::size_t box, const LightView& view);

/// Points whose hull is what lies within planes of one of the shape's boxes; of the ground the part in shadow.
std::vector<glm::dvec3> points_inside_planes(const SceneShape& shape, std::size_t box,
                                             std::span<const HalfSpace> planes);

/// What of these extents, of shadows on the ground, sticks out of a model's own across the view is added to these, and
/// all of what they have along it. Less than a millionth is rounding.
void widen_for_ground_shadow(ViewExtent& model, const ViewExtent& ground);
constexpr double kMinGroundWidening = 1e-6;

/// The least distance along the axis at which a box can meet the pyramid |x|, |y| <= z tan; infinite when it cannot.
double pyramid_entry_m(const ViewExtent& e, double tan_half);

/// Casting objects of which a part lies in front of the near plane of any view. Boxes only: an upper estimate.
int count_near_clipped_casters(const SceneShape& shape, const std::vector<LightView>& views);

}  // namespace si
