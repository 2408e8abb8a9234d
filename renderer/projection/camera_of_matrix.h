// A camera from a matrix of any origin: an engine's picture.
#pragma once

#include <glm/glm.hpp>

#include "renderer/projection/depth_curve.h"

namespace si {

/// Camera found from a view-projection matrix, such as that of an engine's picture. The corners of the picture are
/// tangents of the angles to the axis (metres at a distance of one metre); for parallel rays they are metres.
struct MatrixCamera {
    glm::dvec3 eye{0};     ///< world; for parallel rays on the near plane
    glm::dmat3 axes{1.0};  ///< columns right, up, back
    bool orthographic = false;
    glm::dvec2 lo{0}, hi{0};   ///< picture's corners across the axis, lower left and upper right
    double near = 0, far = 0;  ///< metres along the axis; 0: none, as for an infinite far plane
    /// Returns the vertical field of view of this perspective camera, radians. For a picture off its axis: that of a
    /// centred picture of the same height.
    double fov_y_rad() const;
    /// Returns true when the camera's viewing axis does not pass through the middle of its picture, as with a shifted
    /// lens.
    bool is_off_axis() const;
};

/// Finds the camera of a picture from its view-projection matrix, such as an engine's. A picture that clip space turns
/// upside down, as in Vulkan, is turned back.
/// @param clip_from_world view-projection matrix, or a positive multiple of it
/// @param convention depth convention of the matrix
/// @throws Error if the matrix is not finite or describes no camera
MatrixCamera camera_of_matrix(const glm::dmat4& clip_from_world, const DepthConvention& convention);

}  // namespace si
