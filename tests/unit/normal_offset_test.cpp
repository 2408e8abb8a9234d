// Tests of bias.normal_unit and bias.normal_by against closed forms, on planes at exact angles.
#include <gtest/gtest.h>

#include "app/report/frame_bundle.h"
#include "renderer/advise/least_bias.h"
#include "renderer/bias/account.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/bundle/engine_bias.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/error_text.h"
#include "tests/support/tilted_plane.h"

namespace si {
namespace {

constexpr double kOffsetAngles[] = {0, 20, 45, 70};
constexpr double kOffsetTilts[] = {0, 45};

BiasBreakdown offset_account(const test::TiltedPlane& plane, const Settings& s, const FittedLight& light,
                             const glm::dvec3& aside = glm::dvec3(0)) {
    return bias_breakdown(light, s, s.map.resolution,
                          {.position_ws = plane.at + aside, .geometric = plane.normal, .bias_normal = plane.normal},
                          {.subpixel_bits = 8});
}

// Along parallel rays each way is worth its closed form at every angle, in texels and in metres.
TEST(NormalOffset, IsWorthItsClosedFormUnderParallelLight) {
    for (const test::OffsetForm& form : test::offset_forms())
        for (const double degrees : kOffsetAngles)
            for (const double around : kOffsetTilts)
                for (const bool metres : {false, true}) {
                    SCOPED_TRACE(testing::Message() << form.by << " " << degrees << " " << around << " " << metres);
                    const double theta = glm::radians(degrees), amount = metres ? 0.07 : 1.75;
                    test::TiltedPlane plane(LightType::Directional, degrees, around);
                    Settings s = settings_with(plane.settings, {{"bias.normal_by", form.by}});
                    s.bias.normal_unit = metres ? OffsetUnit::Metres : OffsetUnit::Texels;
                    s.bias.normal = amount;
                    const FittedLight light = fit_lights(plane.scene, s)[0];
                    const BiasBreakdown a = offset_account(plane, s, light, {0, 0, 0});
                    const double whole_m = metres ? amount : amount * a.receiver.texel_m;
                    EXPECT_NEAR(a.theta_rad, theta, 1e-7);
                    EXPECT_NEAR(a.amount(a.normal).metres, whole_m * form.worth(theta), 1e-9);
                    EXPECT_NEAR(a.amount(a.normal).texels, whole_m / a.receiver.texel_m * form.worth(theta), 1e-7);
                    EXPECT_EQ(a.equivalent_depth(), a.normal);
                    EXPECT_NEAR(a.amount(a.depth_shift).metres, whole_m * form.towards(theta), 1e-9);
                    EXPECT_NEAR(a.receiver.normal_offset_m, whole_m * form.length(theta), 1e-8);
                    EXPECT_NEAR(glm::length(a.receiver.normal_offset_ws), whole_m * form.length(theta), 1e-8);
                    EXPECT_NEAR(a.contact_gap_m(), whole_m * form.shift(theta), 1e-8);
                    EXPECT_NEAR(a.offset_shift_m(), whole_m * form.shift(theta), 1e-8);
                }
}

// Under a spot light the ray through the moved point meets the plane: that distance is the offset's worth.
TEST(NormalOffset, IsTheDistanceFromThePlaneUnderASpotLight) {
    for (const test::OffsetForm& form : test::offset_forms())
        for (const double degrees : kOffsetAngles)
            for (const double around : kOffsetTilts)
                for (const bool metres : {false, true})
                    for (const double aside : {0.0, 1.5}) {
                        SCOPED_TRACE(testing::Message() << form.by << " " << degrees << " " << around << " " << metres);
                        test::TiltedPlane plane(LightType::Spot, degrees, around);
                        Settings s = settings_with(plane.settings, {{"bias.normal_by", form.by}});
                        s.bias.normal_unit = metres ? OffsetUnit::Metres : OffsetUnit::Texels;
                        s.bias.normal = metres ? 0.07 : 1.75;
                        const FittedLight light = fit_lights(plane.scene, s)[0];
                        const glm::dvec3 in_plane = aside * orthonormal_basis(plane.normal)[0];
                        const BiasBreakdown a = offset_account(plane, s, light, in_plane);
                        const LightView& view = light.views[0];
                        const glm::dvec3 p = plane.at + in_plane, ray = glm::normalize(light.position - p);
                        const double theta = std::acos(glm::dot(ray, plane.normal));
                        if (aside == 0) {
                            EXPECT_NEAR(theta, glm::radians(degrees), 1e-7);
                        }
                        const double whole_m = metres ? 0.07 : 1.75 * view.texel_size_at(p, 256).longest;
                        // The shift in the plane of ray and normal, by its parts along the ray and across it.
                        const glm::dvec3 tangent = plane.normal - ray * std::cos(theta);
                        const glm::dvec3 across = glm::length(tangent) > 1e-9 ? glm::normalize(tangent) : glm::dvec3(0);
                        const double toward = whole_m * form.towards(theta);
                        const double sideways =
                            whole_m * std::sqrt(std::max(
                                          std::pow(form.length(theta), 2) - std::pow(form.towards(theta), 2), 0.0));
                        const glm::dvec3 moved = p + toward * ray + sideways * across;
                        const glm::dvec3 away = moved - view.eye;
                        const glm::dvec3 met =
                            view.eye + away * (glm::dot(p - view.eye, plane.normal) / glm::dot(away, plane.normal));
                        const auto depth = [&](const glm::dvec3& q) {
                            return view.curve.depth(glm::dot(view.eye - q, view.axes[2]));
                        };
                        EXPECT_NEAR(a.normal, depth(met) - depth(moved), 1e-9 * (1 + a.normal));
                        // To first order it is the closed form.
                        const double worth = whole_m * form.worth(theta);
                        EXPECT_NEAR(a.amount(a.normal).metres, worth, 0.03 * whole_m / std::cos(theta) + 1e-9);
                    }
}

TEST(NormalOffset, TextsNameUnitAndWay) {
    BiasSettings b = settings_with(Settings{}, {"bias.kind=constant"}).bias;
    b.normal = 3;
    EXPECT_EQ(bias_text(b), "bias.normal 3 texels");
    b.normal_unit = OffsetUnit::Metres;
    b.normal_by = OffsetBy::OneMinusCosine;
    EXPECT_EQ(bias_text(b), "bias.normal 3 m (one-minus-cosine)");
    const Settings none;
    for (const char* key : {"bias.normal_unit", "bias.normal_by"}) {
        EXPECT_EQ(std::string(idle_reason(none, *find_setting(key))), "without effect: bias.normal is 0");
        EXPECT_EQ(std::string(idle_reason(settings_with(none, {"bias.normal=1"}), *find_setting(key))), "");
    }
}

TEST(NormalOffset, AnUnknownNameIsAnsweredByTheNearest) {
    Settings s;
    const auto answer = [&](const char* key, const char* value) {
        try {
            set_setting(s, key, value);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(answer("bias.normal_by", "sines").find("sine"), std::string::npos) << answer("bias.normal_by", "sines");
    EXPECT_NE(answer("bias.normal_unit", "depth").find("metres"), std::string::npos);
    EXPECT_NE(answer("bias.normal_bye", "sine").find("bias.normal_by"), std::string::npos);
}

// A number in metres and the same length in texels give the same maps, and look-ups stay inside them.
TEST(NormalOffset, MetresFitTheSameMaps) {
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
        for (const char* fit : {"scene", "casters", "view", "lispsm"}) {
            if (type != LightType::Directional && std::string(fit) == "lispsm") continue;
            SCOPED_TRACE(testing::Message() << int(type) << " " << fit);
            test::TiltedPlane plane(type, 20, 45);
            Settings s = settings_with(plane.settings, {{"light.fit", fit}, "map.resolution=512"});
            s.camera.distance = 9;
            const Camera camera = make_camera(plane.scene, s, 1.5);
            const auto fitted = [&](double amount, OffsetUnit unit) {
                s.bias.normal = amount;
                s.bias.normal_unit = unit;
                return fit_lights(plane.scene, s, &camera)[0];
            };
            const FittedLight small = fitted(1, OffsetUnit::Texels);
            const TexelSize texel = small.views[0].texel_size_range(512);
            const FittedLight metres = fitted(0.5 * texel.shortest, OffsetUnit::Metres);
            ASSERT_EQ(metres.views.size(), small.views.size());
            if (std::string(fit) != "lispsm" && type == LightType::Directional) {
                EXPECT_EQ(metres.views[0].clip_from_relative(glm::dvec3(0)),
                          small.views[0].clip_from_relative(glm::dvec3(0)));
            }
            // Half a metre is some dozen texels. Each point of the plane is read inside of the map.
            const FittedLight wide = fitted(20 * texel.longest, OffsetUnit::Metres);
            const glm::dmat3 turn = orthonormal_basis(plane.normal);
            for (const double x : {-4.9, 0.0, 4.9})
                for (const double y : {-4.9, 0.0, 4.9}) {
                    const glm::dvec3 p = x * turn[0] + y * turn[1];
                    const BiasBreakdown a = offset_account(plane, s, wide, p);
                    if (!a.receiver.in_map() || std::string(fit) == "view") continue;
                    EXPECT_GE(a.receiver.tap.x, 0) << x << " " << y;
                    EXPECT_LE(a.receiver.tap.x, 1) << x << " " << y;
                    EXPECT_GE(a.receiver.tap.y, 0) << x << " " << y;
                    EXPECT_LE(a.receiver.tap.y, 1) << x << " " << y;
                }
        }
}

TEST(NormalOffset, ABundleStatesIt) {
    Bundle bundle;
    bundle.lights.resize(1);
    bundle.lights[0].maps.resize(1);
    BundleBias& bias = bundle.lights[0].lookup.bias;
    bias = {.constant = 0.001, .slope = 0, .normal = 0.0293, .units = {}};
    bias.units = {BiasUnit::Metres, BiasUnit::Metres, BiasUnit::Metres};
    bias.normal_by = OffsetBy::Sine;
    const auto known = stated_bias(bundle, bundle.lights[0]);
    ASSERT_TRUE(known);
    EXPECT_EQ(known->normal, 0.0293);
    EXPECT_EQ(known->normal_unit, OffsetUnit::Metres);
    EXPECT_EQ(known->normal_by, OffsetBy::Sine);
    ImportedMaps maps;
    BiasSettings other = *known;
    EXPECT_TRUE(is_same_look_up_bias(*known, other));
    other.normal_by = OffsetBy::Length;
    EXPECT_FALSE(is_same_look_up_bias(*known, other));
    other = *known;
    other.normal_unit = OffsetUnit::Texels;
    EXPECT_FALSE(is_same_look_up_bias(*known, other));
    bias.normal = 0;
    EXPECT_TRUE(is_same_look_up_bias(*stated_bias(bundle, bundle.lights[0]), *stated_bias(bundle, bundle.lights[0])));
    bias.normal = 0.0293;
    bias.units[2] = BiasUnit::Depth;
    EXPECT_FALSE(stated_bias(bundle, bundle.lights[0])) << "a depth is no length";
}

}  // namespace
}  // namespace si
