#include "renderer/projection/projection.h"

namespace si {

glm::dmat4 projection_matrix(const DepthCurve& curve, double half_x, double half_y) {
    const double n = curve.near, f = curve.far, range = f - n;
    const bool reversed = curve.convention.reversed;
    glm::dmat4 m(0.0);
    m[0][0] = 1 / half_x;
    m[1][1] = 1 / half_y;
    double a, b;  // clip z = a z_view + b, in [0,w]
    if (curve.perspective) {
        a = reversed ? n / range : -f / range;
        b = reversed ? f * (n / range) : -f * (n / range);
        m[2][3] = -1;
        if (!curve.convention.zero_to_one) {
            a = 2 * a + 1;
            b = 2 * b;
        }
    } else {
        a = reversed ? 1 / range : -1 / range;
        b = reversed ? f / range : -n / range;
        m[3][3] = 1;
        if (!curve.convention.zero_to_one) {
            a = 2 * a;
            b = 2 * b - 1;
        }
    }
    m[2][2] = a;
    m[3][2] = b;
    return m;
}

glm::dvec3 uvd_from_ndc(const DepthConvention& convention, const glm::dvec3& ndc) {
    const glm::dvec3 half = 0.5 * ndc + 0.5;
    return {half.x, half.y, convention.zero_to_one ? ndc.z : half.z};
}

glm::dmat4 uvd_from_clip(const DepthConvention& convention) {
    // The columns are the images of the three axes and of the origin.
    const glm::dvec3 zero = uvd_from_ndc(convention, glm::dvec3(0));
    glm::dmat4 m(1.0);
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 axis(0);
        axis[i] = 1;
        m[i] = glm::dvec4(uvd_from_ndc(convention, axis) - zero, 0);
    }
    m[3] = glm::dvec4(zero, 1);
    return m;
}

glm::dmat4 clip_from_relative(const glm::dmat4& projection, const glm::dmat3& axes, const glm::dvec3& eye,
                              const glm::dvec3& origin) {
    const glm::dmat3 rotation = glm::transpose(axes);
    glm::dmat4 view(rotation);
    view[3] = glm::dvec4(rotation * (origin - eye), 1.0);
    return projection * view;
}

}  // namespace si
