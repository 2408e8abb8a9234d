// Planes at exact angles to a light, and what a normal offset is worth on them in closed form.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "renderer/base/directions.h"
#include "renderer/scenes/shapes.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"

namespace si::test {

/// Way of the normal offset and what it does to shadows, as factors of the offset's length.
struct OffsetForm {
    const char* by;                   ///< value of bias.normal_by
    double (*worth)(double theta);    ///< equivalent depth bias along the ray
    double (*length)(double theta);   ///< length of the shift
    double (*towards)(double theta);  ///< part of the shift along the ray
    double (*shift)(double theta);    ///< way of shadows over the plane
};

/// Returns the closed forms of all values of bias.normal_by, theta in radians.
inline const std::array<OffsetForm, 4>& offset_forms() {
    using std::cos, std::sin, std::tan;
    static const std::array<OffsetForm, 4> forms = {
        OffsetForm{"length", [](double t) { return 1 / cos(t); }, [](double) { return 1.0; },
                   [](double t) { return cos(t); }, [](double t) { return tan(t); }},
        OffsetForm{"sine", [](double t) { return tan(t); }, [](double t) { return sin(t); },
                   [](double t) { return sin(t) * cos(t); }, [](double t) { return sin(t) * tan(t); }},
        OffsetForm{"one-minus-cosine", [](double t) { return (1 - cos(t)) / cos(t); },
                   [](double t) { return 1 - cos(t); }, [](double t) { return (1 - cos(t)) * cos(t); },
                   [](double t) { return (1 - cos(t)) * tan(t); }},
        OffsetForm{"sideways", [](double t) { return sin(t) * tan(t); }, [](double t) { return sin(t); },
                   [](double) { return 0.0; }, [](double t) { return tan(t); }}};
    return forms;
}

/// Plane of 10 x 10 m at an exact angle to a light, far from the origin.
struct TiltedPlane {
    Scene scene;
    Settings settings;  ///< without any bias
    glm::dvec3 at{1000, -500, 300}, normal{0};

    /// @param theta_deg angle between normal and light @param around_deg direction of the tilt: 0 along a side of the
    /// map, 45 along its diagonal
    TiltedPlane(LightType type, double theta_deg, double around_deg) {
        const double theta = glm::radians(theta_deg), around = glm::radians(around_deg);
        const glm::dmat3 basis = orthonormal_basis(direction_from_angles(30, 50));
        normal =
            basis * glm::dvec3(std::sin(theta) * std::cos(around), std::sin(theta) * std::sin(around), std::cos(theta));
        const glm::dmat3 turn = orthonormal_basis(normal);
        const glm::dmat4 place(glm::dvec4(turn[1], 0), glm::dvec4(turn[2], 0), glm::dvec4(turn[0], 0),
                               glm::dvec4(at, 1));
        scene = grey_scene({{"plane", make_plane(10, 10), place},
                            // Sheets before and behind the plane give the light a depth range.
                            {"above", make_plane(0.1f, 0.1f), place * moved(4.5, 2, 4.5)},
                            {"below", make_plane(0.1f, 0.1f), place * moved(-4.5, -2, -4.5)}});
        settings = hard_settings();
        settings.bias = no_bias();
        set_all(settings, {"bias.kind=constant", "bias.unit=texels", "filter.kernel=hard", "map.format=d32f",
                           "map.resolution=256", "light.azimuth=30", "light.elevation=50"});
        settings.camera = orbiting_camera(at, glm::degrees(std::atan2(normal.x, normal.z)),
                                          glm::degrees(std::asin(glm::clamp(normal.y, -1.0, 1.0))), 4);
        LightSettings& light = settings.lights[0];
        light.type = type;
        set_target(light, at - scene.bounds.centre());  // counted from the scene's centre
        if (type == LightType::Directional) return;
        light.distance = 12;
        light.cone = 50;
    }
};

}  // namespace si::test
