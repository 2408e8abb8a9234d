// The handles of a light as geometry: which there are and where they stand. No drawing.
#pragma once

#include <string_view>
#include <vector>

#include "renderer/view/lights/light.h"
#include "ui/scene_view/picture_view.h"

namespace si {

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

/// "Near plane"; for tooltips.
std::string_view handle_name(LightHandle handle);

/// One light as its handles see it.
struct LightPose {
    LightSettings settings;
    LightType type = LightType::Directional;
    LightView view;                   ///< the shown one: near, far and extent act on it
    std::vector<LightView> cascades;  ///< all of them where the light has some, or a warped map; they are the fit's
    glm::dvec3 centre{0};             ///< world; what settings.target_x, y, z count from
    glm::dvec3 target{0};             ///< world; what the light turns about or looks at
    glm::dvec3 position{0};           ///< world; where the light's mark stands
    glm::dvec3 to_light{0, 1, 0};
    double distance = 1;  ///< m, from target to position
    bool has_map = true;  ///< near, far and extent mean something
    bool cascaded() const { return !cascades.empty(); }
    bool orthographic() const { return !view.curve.perspective; }
    bool ranged() const { return type != LightType::Directional && settings.range > 0; }
};

/// @param face of a light with several views
LightPose light_pose(const LightSettings& settings, const FittedLight& fitted, int face);

/// The handles that the light has, whatever the view.
std::vector<LightHandle> handles_of(const LightPose& pose);

/// Where a handle stands, world. Arrows and the direction's ball have a size on the screen, so that depends on the
/// view.
glm::dvec3 handle_place(const LightPose& pose, LightHandle handle, const PictureView& view);

/// Radius of the ball on whose surface the direction's handle moves, about the target (directional) or the light
/// (spot).
double direction_ball(const LightPose& pose, const PictureView& view);
/// Distance from the light at which the rim of a spot light's cone is drawn.
double cone_reach(const LightPose& pose);
/// Unit vector along which an arrow, an extent or a cone handle lies.
glm::dvec3 handle_way(const LightPose& pose, LightHandle handle);
/// Unit vector from a spot or point light to the handle of its range: on the cone's rim, between two of its handles, or
/// across the line to the target.
glm::dvec3 range_way(const LightPose& pose);
/// Half a spot light's cone.
double half_cone_rad(const LightSettings& settings);

struct PlacedHandle {
    LightHandle handle = LightHandle::Position;
    glm::dvec3 at{0};         ///< world
    glm::dvec2 on_screen{0};  ///< pixels
};

/// The handles that can be dragged in this view: in the picture, and moving across the line of sight.
std::vector<PlacedHandle> place_handles(const LightPose& pose, const PictureView& view);

}  // namespace si
