// Handles of a light as geometry: kinds and places. No drawing.
#pragma once

#include <string_view>
#include <vector>

#include "renderer/view/lights/light.h"
#include "ui/scene_view/picture_view.h"

namespace si {

/// Handle of a light in the scene picture: a mark that the mouse drags to change one property of the light.
enum class LightHandle {
    Position,
    AxisX,
    AxisY,
    AxisZ,
    Direction,
    Target,
    ExtentRight,
    ExtentTop,
    ExtentLeft,
    ExtentBottom,
    ConeRight,
    ConeTop,
    ConeLeft,
    ConeBottom,
    Range,
    Near,
    Far
};

/// Returns true for the handles that are arrows, which move a light along a world axis.
bool is_axis(LightHandle handle);
/// Returns true for the handles that change the width and height of a directional light's map.
bool is_extent(LightHandle handle);
/// Returns true for the handles that change the cone angle of a spot light.
bool is_cone(LightHandle handle);

/// Returns the name of a light's handle for tooltips: "Near plane".
std::string_view handle_name(LightHandle handle);

/// Pose of a light: what its handles in the scene picture show and change, such as position, direction, extent of the
/// map, and near and far plane.
struct LightPose {
    LightSettings settings;
    LightType type = LightType::Directional;
    LightView view;                   ///< shown view, whose near, far and extent the handles change
    std::vector<LightView> cascades;  ///< views of a cascaded or warped light, which only the fit changes; else empty
    glm::dvec3 centre{0};             ///< world; origin of settings.target_x, y, z
    glm::dvec3 target{0};             ///< world; point that the light turns about or looks at
    glm::dvec3 position{0};           ///< world; place of the light's mark
    glm::dvec3 to_light{0, 1, 0};     ///< world; unit vector from the target
    double distance = 1;              ///< m, from target to position
    bool has_map = true;              ///< the light has a shadow map, with near, far and extent
    /// Returns true if the light has cascades or a warped view. Only the fit (the rule for what a map covers) changes
    /// these.
    bool cascaded() const { return !cascades.empty(); }
    /// Returns true if the light's map is in parallel projection.
    bool orthographic() const { return !view.curve.perspective; }
    /// Returns true if the light is a spot or point light with a limited range.
    bool ranged() const { return type != LightType::Directional && settings.range > 0; }
};

/// Returns the pose of a light, from which its handles in the scene picture are placed.
/// @param fitted the light as the last frame fitted it @param face index of the view (cube face, cascade) that is shown
LightPose light_pose(const LightSettings& settings, const FittedLight& fitted, int face);

/// Returns all handles that a light has by its type and fit (the rule for what its map covers), visible in the picture
/// or not.
std::vector<LightHandle> handles_of(const LightPose& pose);

/// Returns the position of a light's handle in world space. Arrows, and the ball on which the direction's handle moves,
/// have a constant size on the screen. So these positions depend on the view.
glm::dvec3 handle_position(const LightPose& pose, LightHandle handle, const PictureView& view);

/// Returns the radius in metres of the ball on which the handle of a light's direction moves. The ball's centre is a
/// spot light itself, or the target of a directional light.
double direction_ball_radius(const LightPose& pose, const PictureView& view);
/// Returns the distance in metres from a spot light at which the rim of its cone is drawn in the scene picture.
double cone_rim_distance(const LightPose& pose);
/// Returns the unit vector in world space along which the mouse drags an arrow, extent or cone handle of a light.
glm::dvec3 handle_axis(const LightPose& pose, LightHandle handle);
/// Returns the unit vector in world space from a light to the handle of its range. For a spot light it lies on the
/// cone, for a point light across the line to the target.
glm::dvec3 range_axis(const LightPose& pose);
/// Returns half the angle of a spot light's cone, radians.
double half_cone_rad(const LightSettings& settings);

/// Handle of a light with its position in world space and on the screen.
struct PlacedHandle {
    LightHandle handle = LightHandle::Position;
    glm::dvec3 at{0};         ///< world
    glm::dvec2 on_screen{0};  ///< pixels
};

/// Returns the handles of a light that can be dragged in this view: those inside the picture that do not move along the
/// line of sight.
std::vector<PlacedHandle> place_handles(const LightPose& pose, const PictureView& view);

}  // namespace si
