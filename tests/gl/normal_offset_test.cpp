// Compares normal offsets of every unit and dependence on the angle, as drawn, with closed forms: overlays, probe, and
// the amount at which acne begins.
#include "renderer/bias/account.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/tilted_plane.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class NormalOffsetTest : public FrameTest {
protected:
    static constexpr int kWidth = 48, kHeight = 36;
    FrameRequest request{.width = kWidth, .height = kHeight};

    /// Returns the points of the plane that pixels show.
    static std::vector<glm::dvec3> shown_points(const test::TiltedPlane& plane, const Camera& camera) {
        std::vector<glm::dvec3> out;
        for (const auto& [x, y, origin, dir] : test::pixel_rays(camera, kWidth, kHeight))
            out.push_back(origin + dir * (glm::dot(plane.at - origin, plane.normal) / glm::dot(dir, plane.normal)));
        return out;
    }
};

SI_TESTS_ARE(Repeated, NormalOffsetTest);

struct OffsetCase {
    LightType type;
    double degrees, around;
    bool metres;
};
std::vector<OffsetCase> offset_cases() {
    std::vector<OffsetCase> out;
    for (const LightType type : {LightType::Directional, LightType::Spot})
        for (const double degrees : {0.0, 20.0, 45.0, 70.0})
            for (const double around : {0.0, 45.0})
                // Both units at every other case: programs of both are compiled once.
                out.push_back({type, degrees, around, (int(degrees) / 5 + int(around) / 45) % 2 == 1});
    return out;
}

SI_TEST_IS(Later, NormalOffsetTest, OverlaysAndProbeEqualTheClosedForm);
TEST_F(NormalOffsetTest, OverlaysAndProbeEqualTheClosedForm) {
    for (const test::OffsetForm& form : test::offset_forms())
        for (const OffsetCase& c : offset_cases()) {
            SCOPED_TRACE(testing::Message() << form.by << " " << int(c.type) << " " << c.degrees << " " << c.around
                                            << (c.metres ? " metres" : " texels"));
            test::TiltedPlane plane(c.type, c.degrees, c.around);
            Settings s = settings_with(plane.settings, {{"bias.normal_by", form.by}});
            s.bias.normal_unit = c.metres ? OffsetUnit::Metres : OffsetUnit::Texels;
            s.bias.normal = c.metres ? 0.11 : 1.75;
            FrameResult frame;
            const FloatImage slack = overlay_values(plane.scene, s, "bias-slack", request, &frame);
            const FloatImage least = overlay_values(plane.scene, s, "least-bias", request);
            const FloatImage applied = overlay_values(plane.scene, s, "bias-applied", request);
            const FloatImage gap = overlay_values(plane.scene, s, "contact-gap", request);
            const std::vector<glm::dvec3> points = shown_points(plane, frame.camera);
            int compared = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const int x = int(i) % kWidth, y = int(i) / kWidth;
                if (std::isnan(slack.at(x, y))) continue;
                const BiasBreakdown a = test::breakdown_at(frame, s, renderer.driver(), points[i], plane.normal);
                const double theta = a.theta_rad, texel = a.receiver.texel_m;
                const double whole_m = c.metres ? 0.11 : 1.75 * texel;
                const double drawn = slack.at(x, y) + least.at(x, y), scale = 1 + whole_m / texel / std::cos(theta);
                ASSERT_NEAR(drawn, a.amount(a.normal).texels, 2e-3 * scale) << x << "," << y;
                ASSERT_NEAR(applied.at(x, y), a.amount(a.depth_shift).texels, 2e-3 * scale);
                ASSERT_NEAR(gap.at(x, y), a.contact_gap_m(), 2e-3 * scale * texel);
                if (c.type == LightType::Directional) {
                    ASSERT_NEAR(theta, glm::radians(c.degrees), 1e-6);
                    ASSERT_NEAR(drawn, whole_m / texel * form.worth(theta), 2e-3 * scale) << x << "," << y;
                    ASSERT_NEAR(applied.at(x, y), whole_m / texel * form.towards(theta), 2e-3 * scale);
                    ASSERT_NEAR(gap.at(x, y), whole_m * form.shift(theta), 2e-3 * scale * texel);
                }
                ++compared;
            }
            EXPECT_GT(compared, kWidth * kHeight * 9 / 10);
            const Probe probe = renderer.probe(plane.scene, s, request, kWidth / 2 + 5, kHeight / 2 + 3);
            ASSERT_FALSE(probe.lights.empty());
            const BiasBreakdown& a = probe.lights[0].account;
            const double whole_m = c.metres ? 0.11 : 1.75 * a.receiver.texel_m;
            EXPECT_NEAR(a.amount(a.equivalent_depth()).metres, whole_m * form.worth(a.theta_rad),
                        (c.type == LightType::Directional ? 1e-6 : 0.03) * whole_m / std::cos(a.theta_rad) + 1e-9);
        }
}

// With the least bias of the closed form, and a fiftieth more, no pixel is dark. Less of it leaves dark ones.
SI_TEST_IS(Later, NormalOffsetTest, AcneBeginsWhereTheFormulaSays);
TEST_F(NormalOffsetTest, AcneBeginsWhereTheFormulaSays) {
    for (const test::OffsetForm& form : test::offset_forms())
        for (const OffsetCase& c : offset_cases()) {
            SCOPED_TRACE(testing::Message() << form.by << " " << int(c.type) << " " << c.degrees << " " << c.around
                                            << (c.metres ? " metres" : " texels"));
            if (c.degrees == 0) continue;  // a plane that faces the light needs no offset, and gets none but by length
            test::TiltedPlane plane(c.type, c.degrees, c.around);
            Settings s = settings_with(plane.settings, {{"bias.normal_by", form.by}});
            s.bias.normal_unit = c.metres ? OffsetUnit::Metres : OffsetUnit::Texels;
            s.bias.normal = c.metres ? 0.01 : 1;
            FrameResult frame;
            visibility(plane.scene, s, request, &frame);
            double most = 0;  // amount by which all pixels have enough
            for (const glm::dvec3& p : shown_points(plane, frame.camera)) {
                const BiasBreakdown a = test::breakdown_at(frame, s, renderer.driver(), p, plane.normal);
                const double whole_m = c.metres ? 1 : a.receiver.texel_m;
                most = std::max(most, a.amount(a.least.total()).metres / (whole_m * form.worth(a.theta_rad)));
            }
            const auto dark_pixels = [&](double amount) {
                s.bias.normal = amount;
                FrameRequest large{.width = 10 * kWidth, .height = 10 * kHeight};
                const FloatImage lit = visibility(plane.scene, s, large);
                return std::ranges::count_if(lit.data, [](float v) { return v < 0.5f; });
            };
            EXPECT_EQ(dark_pixels(1.02 * most), 0) << most;
            // Under a spot light only the farthest pixels need as much, and they may lie well within their texels.
            const double less = c.type == LightType::Directional ? 0.9 : 0.7;
            EXPECT_GT(dark_pixels(less * most), 0) << most;
        }
}

// A suggested fix counts in the unit of the settings and puts the pixel right.
TEST_F(NormalOffsetTest, FixesAreCountedInTheUnit) {
    for (const test::OffsetForm& form : test::offset_forms())
        for (const bool metres : {false, true}) {
            SCOPED_TRACE(testing::Message() << form.by << (metres ? " metres" : " texels"));
            test::TiltedPlane plane(LightType::Directional, 45, 45);
            Settings s = settings_with(plane.settings, {{"bias.normal_by", form.by}});
            s.bias.normal_unit = metres ? OffsetUnit::Metres : OffsetUnit::Texels;
            s.bias.normal = metres ? 0.001 : 0.01;
            const Probe probe = renderer.probe(plane.scene, s, request, kWidth / 2, kHeight / 2);
            const BiasBreakdown& a = probe.lights[0].account;
            const double needed_m = a.amount(a.least.total()).metres / form.worth(glm::radians(45.0));
            const double needed = metres ? needed_m : needed_m / a.receiver.texel_m;
            s.bias.normal = needed * 1.0005;
            const BiasBreakdown enough =
                renderer.probe(plane.scene, s, request, kWidth / 2, kHeight / 2).lights[0].account;
            EXPECT_GE(enough.equivalent_depth(), enough.least.total());
            s.bias.normal = needed * 0.9995;
            const BiasBreakdown less =
                renderer.probe(plane.scene, s, request, kWidth / 2, kHeight / 2).lights[0].account;
            EXPECT_LT(less.equivalent_depth(), less.least.total());
        }
}

}  // namespace
}  // namespace si
