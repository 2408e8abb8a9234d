// Tests contact shadows: they restore lost shadows, add no false ones, and multiply any source.
#include <algorithm>

#include "renderer/measure/measured_error.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/sources.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/ray_reference.h"
#include "tests/support/sets.h"

namespace si {
namespace {

using test::kLightTypes;
using test::kPlaces;

class ContactTest : public FrameTest {
protected:
    ReferenceCache cache;
    FrameRequest request{.width = 320, .height = 240, .outputs = {.colour = false, .visibility = true}};
    static Settings under(LightType type, const test::Place& place) {
        Settings s = test::hard_settings();
        test::place_light(s, type, place);
        s.lights[0].elevation = std::min(place.elevation, 60.0);
        return settings_with(s, {"light.contact=0.5", "contact.steps=64", "contact.thickness=1"});
    }
};

// No surface occludes itself under any light or camera; a ball is its own smallest occluder at its rim.
TEST_F(ContactTest, APlaneAloneStaysLit) {
    for (const test::Place& place : kPlaces)
        for (const LightType type : kLightTypes)
            for (const bool orthographic : {false, true}) {
                Scene floor = make_scene(make_plane(10, 10));
                test::move_scene(floor, place.at);
                Settings s = under(type, place);
                set_setting(s, "light.source", "none");
                s.camera.orthographic = orthographic;
                s.camera.elevation = 8;  // grazing: a pixel spans a long stretch of the plane
                const FloatImage v = visibility(floor, s, request);
                EXPECT_TRUE(std::ranges::all_of(v.data, [](float x) { return x == 1; })) << int(type) << orthographic;
            }
}

// A box on a floor without any other shadow is compared with rays as long as the marched ones. The camera faces the
// box's unlit side, so that its near faces stand for the box.
TEST_F(ContactTest, OccludersWithinTheRayLengthDarkenAPixel) {
    for (const test::Place& place : kPlaces)
        for (const LightType type : kLightTypes) {
            Scene scene = test::floor_and_box(10, {1.5, 1, 2});
            test::move_scene(scene, place.at);
            Settings s = under(type, place);
            set_setting(s, "light.source", "none");
            s.contact.thickness = 3;  // depth of the box
            const FrameResult frame = renderer.render(scene, s, request);
            const FloatImage v = renderer.read_float(frame.visibility, 1);
            const test::RayReference rays(scene);
            int dark = 0, found = 0, lit = 0, wrong = 0;
            for (const auto& [x, y, hit] : test::pixel_hits(rays, frame.camera, v.width, v.height)) {
                if (hit.normal.y < 0.5 || hit.position.y > place.at.y + 1e-3) continue;
                const FittedLight& light = frame.lights[0];
                const glm::dvec3 to =
                    type == LightType::Directional ? light.to_light : glm::normalize(light.position - hit.position);
                const auto met = rays.first_hit(hit.position + 1e-6 * to, to);
                const double within = met ? glm::distance(met->position, hit.position) : 1e9;
                if (within < 0.45) {
                    ++dark;
                    found += v.at(x, y) == 0;
                }
                if (within > 1e8) {
                    ++lit;
                    wrong += v.at(x, y) == 0;
                }
            }
            SCOPED_TRACE(testing::Message() << int(type) << " at " << place.at.x);
            EXPECT_GT(lit, 5000);
            EXPECT_LT(wrong, lit / 100) << "what lies free behind the box's edges";
            if (dark > 50) {
                EXPECT_GT(found, 0.9 * dark) << dark;
            }
        }
}

// Bias has detached the shadow from its caster. The contact shadow closes the gap and changes no other error.
TEST_F(ContactTest, ContactShadowsRestoreShadowsThatBiasRemoved) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2});
    Settings s = test::texel_settings("pcf3", 512, 40);
    const auto measured = [&] { return measure_error(renderer, scene, s, request, 0, {}, cache).metrics; };
    const ErrorMetrics without = measured();
    set_all(s, {"light.contact=0.6", "contact.steps=64", "contact.thickness=2"});
    const ErrorMetrics with = measured();
    ASSERT_GT(without.bias_false_light, 0.001);
    EXPECT_LT(with.bias_false_light, 0.3 * without.bias_false_light);
    EXPECT_LT(with.false_shadow, without.false_shadow + 0.003);
    EXPECT_EQ(with.artefacts[std::size_t(Artefact::Contact)] > 0, with.false_shadow > without.false_shadow)
        << "what they darken wrongly bears their name";
}

TEST_F(ContactTest, ContactShadowsMultiplyAnySource) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"light.source=none", "light.contact=1"});
    const FloatImage factor = visibility(scene, s, request);
    ASSERT_GT(std::ranges::count(factor.data, 0.f), 300);
    for (const Source& source : sources()) {
        SCOPED_TRACE(source.key);
        set_setting(s, "light.source", source.key);
        Settings off = s;
        off.lights[0].contact = 0;
        const auto drawn = [&](const Settings& settings) {
            return renderer.read_float(
                render_with_reference(renderer, scene, settings, request, cache, Workers{.threads = 2}).visibility, 1);
        };
        const FloatImage with = drawn(s), without = drawn(off);
        for (std::size_t i = 0; i < with.data.size(); ++i)
            ASSERT_EQ(with.data[i], without.data[i] * factor.data[i]) << i;
    }
}

}  // namespace
}  // namespace si
