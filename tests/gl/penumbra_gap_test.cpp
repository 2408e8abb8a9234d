// Tests that kernels with a variable penumbra measure the distance of a straight edge from the surface, whatever bias
// moves the compared point: against the closed form.
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using PenumbraGap = FrameTest;

const FrameRequest kSmallPicture{.width = 32, .height = 18};

/// Direction towards the light of azimuth 0 and elevation 45.
const glm::dvec3 kToLight(0, std::sqrt(0.5), std::sqrt(0.5));

/// Makes a floor with a sheet of 6 x 6 m that faces the light, `gap_m` before the origin.
Scene sheet_facing_light(double gap_m) {
    glm::dmat4 place(1);
    place[1] = glm::dvec4(kToLight, 0);
    place[2] = glm::dvec4(glm::cross(glm::dvec3(1, 0, 0), kToLight), 0);
    place[3] = glm::dvec4(gap_m * kToLight, 1);
    return test::grey_scene({{"floor", make_plane(16, 16)}, {"sheet", make_plane(6, 6), place}});
}

SI_TEST_IS(Later, PenumbraGap, IsMeasuredFromTheSurfaceUnderEveryBias);
TEST_F(PenumbraGap, IsMeasuredFromTheSurfaceUnderEveryBias) {
    constexpr double kGapM = 2;
    const Scene scene = sheet_facing_light(kGapM);
    const std::vector<Sets> biases = {
        {"bias.kind=constant", "bias.constant=6"},
        {"bias.kind=slope", "bias.slope=20"},
        {"bias.kind=receiver-plane"},
        {"bias.kind=receiver-plane", "bias.constant=6"},
        {"bias.kind=receiver-plane-derivatives"},
        {"bias.kind=adaptive"},
        {"bias.kind=adaptive", "bias.normal=4"},
        {"bias.kind=constant", "bias.normal=6"},
        {"bias.kind=adaptive", "bias.raster_slope=4", "bias.raster_units=4"},
    };
    for (const bool spot : {false, true})
        for (const char* kernel : {"pcss", "dpcf", "smrt"})
            for (const Sets& bias : biases) {
                std::string name = std::string(kernel) + (spot ? " spot" : "");
                for (const auto& [key, value] : bias) name += " " + key + "=" + value;
                SCOPED_TRACE(name);
                Settings s =
                    settings_with(test::texel_settings(kernel, 1024, 0),
                                  {"light.azimuth=0", "light.elevation=45", "bias.normal=0", "filter.max_radius=64",
                                   "filter.rotate=false", "filter.thickness=1", "filter.rays=32", "filter.steps=32"});
                set_all(s, bias);
                LightSettings& light = s.lights[0];
                light.size = 1;
                glm::dvec3 under(3, 0, 0);  // on the floor under the sheet's edge
                if (spot) {
                    set_all(s, {"light.type=spot", "light.distance=12", "light.cone=90", "light.size=0.2"});
                    const glm::dvec3 at = 12.0 * kToLight, edge = kGapM * kToLight + under;
                    under = at + (edge - at) * (at.y / (at.y - edge.y));
                    set_target(light, -scene.bounds.centre());
                }
                s.camera = orbiting_camera(under, 180, 50, 5);
                FrameResult frame;
                const FloatImage gaps = overlay_values(scene, s, "blocker-gap", kSmallPicture, &frame);
                glm::dvec3 eye, ray;
                frame.camera.pixel_ray(kSmallPicture.width / 2, kSmallPicture.height / 2, kSmallPicture.width,
                                       kSmallPicture.height, eye, ray);
                const glm::dvec3 floor = eye - ray * (eye.y / ray.y);
                const double gap_m = kGapM - glm::dot(floor, kToLight);
                EXPECT_NEAR(gaps.at(kSmallPicture.width / 2, kSmallPicture.height / 2), gap_m, 0.01 * gap_m);
            }
}

}  // namespace
}  // namespace si
