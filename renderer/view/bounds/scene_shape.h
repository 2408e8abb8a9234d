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

/// Bounding boxes of the objects of a scene with their shadow flags: the input of light placement and map fitting.
struct SceneShape {
    glm::dvec3 centre{0};
    double radius = 1;                     ///< radius of the sphere around the bounds, metres; never 0
    double main_radius = 1;                ///< radius around main_bounds(), metres; `radius` where nothing is far
    bool one_box = false;                  ///< one box stands for all objects
    std::vector<Box> boxes;                ///< world boxes, one an object or one for the scene; never empty
    std::vector<bool> box_casts;           ///< objects that cast; indexed as `boxes`, like all members named box_*
    std::vector<bool> box_receives;        ///< objects that receive shadows
    std::vector<std::size_t> box_objects;  ///< indices into Scene::objects
    /// Planes of flat objects, world space; empty for objects that are not flat within box_tolerance.
    std::vector<std::optional<HalfSpace>> box_planes;
    std::vector<double> box_tolerance;  ///< flatness tolerance in metres
    /// Boxes around all poses of an animated object. Its triangles at one time do not bound them.
    std::vector<bool> box_spans_animation;
    std::optional<std::size_t> ground;  ///< index of the box of the generated ground under a model; empty without one
    /// Convex polygon around one light's shadows on the ground, or a single point. Empty: the whole box of the ground
    /// counts.
    std::vector<glm::dvec3> ground_shadow;
    bool triangles = false;  ///< the scene has triangles
    bool casters = false;    ///< an object with triangles casts
    bool receivers = false;  ///< an object with triangles receives shadows
};

/// Returns true when no corner of a box is NaN or infinite.
bool is_finite(const Box& box);

/// Computes the boxes of all objects, over the whole animation after measure_animation_bounds(). Above 20,000 objects
/// one box stands for the scene. Reads meshes to find flat ones. The result is finite, also for empty scenes.
SceneShape scene_shape(const Scene& scene, const Settings& settings);

/// Returns a shape whose ground is reduced to the part that casters can shadow under one light, so that a large ground
/// does not widen that light's maps.
/// @param scene the scene that `shape` was computed from
SceneShape with_shadowed_ground(const SceneShape& shape, const Scene& scene, const PlacedLight& light);

/// Extent of points in a light's view: x and y across the axis in metres, z metres along the axis, positive in front.
using ViewExtent = Bounds;

/// Returns the extent of world-space points in a light's view.
ViewExtent extent_in_view(std::span<const glm::dvec3> points, const LightView& view);
/// Returns the extent of all boxes of a shape in a light's view. A ground under a model counts along the light's axis
/// only.
ViewExtent extent_in_view(const SceneShape& shape, const LightView& view);

/// Returns the corners of the part of a perspective view between two distances from its eye, in metres.
/// @param widening factor on the pyramid's width
Box view_pyramid(const LightView& view, double near, double far, double widening = 1);

/// Returns the extent of the part of a world-space box between the four sides of a parallel light view.
ViewExtent extent_inside_view(const Box& box, const LightView& view);
/// Returns the extent of the part of one box of a shape between the four sides of a parallel light view. For a ground,
/// only its shadowed part counts.
/// @param box index into SceneShape::boxes
ViewExtent extent_inside_view(const SceneShape& shape, std::size_t box, const LightView& view);

/// Returns points whose convex hull is the part of one box of a shape inside all of the half-spaces. For a ground, only
/// its shadowed part counts.
/// @param box index into SceneShape::boxes
std::vector<glm::dvec3> points_inside_planes(const SceneShape& shape, std::size_t box,
                                             std::span<const HalfSpace> planes);

/// Widens a model's extent in a light's view to contain its shadows on the ground: in depth (z) always, in width and
/// height (x, y) only where the shadows stick out by more than kMinGroundWidening.
void widen_for_ground_shadow(ViewExtent& model, const ViewExtent& ground);
/// Least widening across the view as a share of the model's width; smaller differences are rounding.
constexpr double kMinGroundWidening = 1e-6;

/// Returns the smallest distance along the axis, in metres, at which a box can meet the pyramid of a perspective view;
/// infinite if they do not meet.
/// @param e extent of the box in the view
/// @param sides LightView::cross_section()
double pyramid_entry_m(const ViewExtent& e, const CrossSection& sides);

/// Counts casters with a part in front of the near plane of any view, where the map cannot store them. Tests boxes, so
/// the count is an upper bound.
int count_near_clipped_casters(const SceneShape& shape, const std::vector<LightView>& views);

}  // namespace si
