// Boxes of a scene's objects, as the fits of shadow maps need them. CPU, double precision.
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

/// Bounding boxes of a scene's objects, with flags for casting and receiving shadows. Input of light placement and of
/// fitting shadow maps.
struct SceneShape {
    glm::dvec3 centre{0};
    double radius = 1;                     ///< radius of the sphere around the bounds, metres; never 0
    double main_radius = 1;                ///< `radius` without objects far from the rest (main_bounds())
    bool one_box = false;                  ///< `boxes` has one box for the whole scene instead of one per object
    std::vector<Box> boxes;                ///< world space; one per object, or one for the scene; never empty
    std::vector<bool> box_casts;           ///< objects that cast; by index in `boxes`, like all members named box_*
    std::vector<bool> box_receives;        ///< objects that receive shadows
    std::vector<std::size_t> box_objects;  ///< indices into Scene::objects
    /// Planes of flat objects, world space; empty for objects that are not flat within box_tolerance.
    std::vector<std::optional<HalfSpace>> box_planes;
    std::vector<double> box_tolerance;  ///< flatness tolerance in metres
    /// Flags of boxes that enclose all poses of an animated object. The object's triangles at one time do not fill such
    /// a box.
    std::vector<bool> box_spans_animation;
    std::optional<std::size_t> ground;  ///< index of the box of the generated ground under a model; empty without one
    /// Convex polygon around one light's shadows on the ground, or a single point, world space. Empty: the whole box of
    /// the ground counts.
    std::vector<glm::dvec3> ground_shadow;
    bool triangles = false;  ///< the scene has triangles
    bool casters = false;    ///< an object with triangles casts
    bool receivers = false;  ///< an object with triangles receives shadows
};

/// Returns true when no corner of a box is NaN or infinite.
bool is_finite(const Box& box);

/// Computes the bounding boxes of all objects of a scene, for fitting shadow maps to the scene. Boxes cover the whole
/// animation after measure_animation_bounds(). Above 20,000 objects one box stands for the whole scene. Reads meshes to
/// find flat ones. The result is finite, also for empty scenes.
SceneShape scene_shape(const Scene& scene, const Settings& settings);

/// Returns a copy of a scene's boxes in which the ground under a model is reduced to the part that casters can shadow
/// under one light. A large ground then does not widen that light's maps.
/// @param shape boxes of a scene with a ground (SceneShape::ground)
/// @param scene the scene from which `shape` was computed
SceneShape with_shadowed_ground(const SceneShape& shape, const Scene& scene, const PlacedLight& light);

/// Extent of points in a light's view: x and y across the axis in metres, z metres along the axis, positive in front.
using ViewExtent = Bounds;

/// Returns the bounding box of world-space points in the axes of a light's view, metres.
ViewExtent extent_in_view(std::span<const glm::dvec3> points, const LightView& view);
/// Returns the bounding box of all objects of a scene in the axes of a light's view, metres. A generated ground under a
/// model counts along the light's axis only.
ViewExtent extent_in_view(const SceneShape& shape, const LightView& view);

/// Returns the corners of the part of a perspective light view between two distances from its eye, in metres.
/// @param near,far the two distances along the axis, metres
/// @param widening factor on the width of the pyramid
Box view_pyramid(const LightView& view, double near, double far, double widening = 1);

/// Clips a world-space box to the four sides of a light view with parallel rays. Returns the bounding box of the part
/// inside, in the axes of the view, metres.
ViewExtent extent_inside_view(const Box& box, const LightView& view);
/// Clips the box of one object of a scene to the four sides of a light view with parallel rays. Returns the bounding
/// box of the part inside, in the axes of the view, metres. Of the ground under a model, only the shadowed part counts.
/// @param box index into SceneShape::boxes
ViewExtent extent_inside_view(const SceneShape& shape, std::size_t box, const LightView& view);

/// Returns points whose convex hull is the part of one object's box inside all of the half-spaces; none if no part is
/// inside. Of the ground under a model, only the shadowed part counts.
/// @param box index into SceneShape::boxes
/// @param planes the half-spaces, such as the sides of a light's view
std::vector<glm::dvec3> points_inside_planes(const SceneShape& shape, std::size_t box,
                                             std::span<const HalfSpace> planes);

/// Widens the extent of a model in a light's view so that it contains the model's shadows on the ground. Depth (z) is
/// always widened; width and height (x, y) only where the shadows stick out by more than kMinGroundWidening.
/// @param[in,out] model extent of the model
/// @param ground extent of the shadows on the ground
void widen_for_ground_shadow(ViewExtent& model, const ViewExtent& ground);
/// Least amount by which widen_for_ground_shadow() widens a model's extent across the light's view, as a share of the
/// extent's larger side; smaller differences are rounding.
constexpr double kMinGroundWidening = 1e-6;

/// Returns the smallest distance along the light's axis, in metres, at which a box can meet the pyramid of a
/// perspective light view. Infinite if they do not meet. Used to place the near plane.
/// @param e extent of the box in the axes of the view
/// @param sides sides of the pyramid, from LightView::cross_section()
double pyramid_entry_m(const ViewExtent& e, const CrossSection& sides);

/// Counts the casters of a scene that have a part in front of the near plane of any of the light's views, where the map
/// cannot store them. Tests the casters' bounding boxes, so the count is an upper bound.
int count_near_clipped_casters(const SceneShape& shape, const std::vector<LightView>& views);

}  // namespace si
