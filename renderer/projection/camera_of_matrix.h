// A camera from a matrix of any origin: an engine's picture.
#pragma once

#include <glm/glm.hpp>

#include "renderer/projection/depth_curve.h"

namespace si {

/// Camera that a matrix describes. Rectangles are in tangents, for parallel rays in metres.
struct MatrixCamera {
    glm::dvec3 eye{0};     ///< world; for parallel rays on the near plane
    glm::dmat3 axes{1.0};  ///< columns right, up, back
    bool orthographic = false;
    glm::dvec2 lo{0}, hi{0};   ///< picture's corners across the axis, at one metre in perspective
    double near = 0, far = 0;  ///< metres along the axis; 0: none, as for an infinite far plane
    /// Returns the vertical field of view of the symmetric picture of this height, radians; for perspective.
    double fov_y_rad() const;
    /// Returns true when the axis does not pass through the picture's middle.
    bool is_off_axis() const;
};

/// Returns the camera of a picture whose clip-space matrix is known. A picture that clip space turns upside down, as in
/// Vulkan, is turned back.
/// @param clip_from_world any positive multiple
/// @throws Error if the matrix is not finite, or names no camera
MatrixCamera camera_of_matrix(const glm::dmat4& clip_from_world, const DepthConvention& convention);

}  // namespace si
