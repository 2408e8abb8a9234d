// Handles of a light as geometry: kinds and places. No drawing.
#pragma once

#include <string_view>
#include <vector>

#include "renderer/view/lights/light.h"
#include "ui/scene_view/picture_view.h"

namespace si {

/// Kind of a handle.
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

bool is_axis(LightHandle handle);
bool is_extent(LightHandle handle);
bool is_cone(LightHandle handle);

/// Returns the name for tooltips: "Near plane".
std::string_view handle_name(LightHandle handle);

/// Light with the values that its handles show.
struct LightPose {
    LightSettings settings;
    LightType type = LightType::Directional;
    LightView view;                   ///< shown view, which near, far and extent act on
    std::vector<LightView> cascades;  ///< all views of a cascaded or warped light, which only the fit changes
    glm::dvec3 centre{0};             ///< world; origin of settings.target_x, y, z
    glm::dvec3 target{0};             ///< world; point that the light turns about or looks at
    glm::dvec3 position{0};           ///< world; place of the light's mark
    glm::dvec3 to_light{0, 1, 0};     ///< world; unit vector from the target
    double distance = 1;              ///< m, from target to position
    bool has_map = true;              ///< the light has near, far and extent
    bool cascaded() const { return !cascades.empty(); }
    bool orthographic() const { return !view.curve.perspective; }
    bool ranged() const { return type != LightType::Directional && settings.range > 0; }
};

/// Returns the pose of a light. @param face index of its shown view
LightPose light_pose(const LightSettings& settings, const FittedLight& fitted, int face);

/// Returns all handles of the light, visible or not.
std::vector<LightHandle> handles_of(const LightPose& pose);

/// Returns the place of a handle, world. Arrows and the direction's ball have a constant size on the screen, so that
/// their places depend on the view.
glm::dvec3 handle_position(const LightPose& pose, LightHandle handle, const PictureView& view);

/// Returns the radius of the ball on which the direction's handle moves, about the target (directional) or the light
/// (spot); metres.
double direction_ball_radius(const LightPose& pose, const PictureView& view);
/// Returns the distance from the light at which the rim of a spot light's cone is drawn; metres.
double cone_rim_distance(const LightPose& pose);
/// Returns the unit vector along which an arrow, extent or cone handle moves; world.
glm::dvec3 handle_axis(const LightPose& pose, LightHandle handle);
/// Returns the unit vector from a light to the handle of its range: on the cone's rim between two handles (spot), or
/// across the line to the target (point).
glm::dvec3 range_axis(const LightPose& pose);
/// Returns half the angle of a spot light's cone.
double half_cone_rad(const LightSettings& settings);

/// A handle and its place.
struct PlacedHandle {
    LightHandle handle = LightHandle::Position;
    glm::dvec3 at{0};         ///< world
    glm::dvec2 on_screen{0};  ///< pixels
};

/// Returns the handles that can be dragged in this view: inside the picture and not along the line of sight.
std::vector<PlacedHandle> place_handles(const LightPose& pose, const PictureView& view);

}  // namespace si
