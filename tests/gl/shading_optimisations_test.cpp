// Tests optimisations of the picture's passes: skipped work is really skipped, and cheaper computations give the same
// result.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer/inspect/effects.h"
#include "renderer/optimisations/optimisations.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/agreed_scene.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class ShadingOptimisationsTest : public FrameTest {
protected:
    /// Returns the fragments of a freshly drawn frame that passed the depth test and were shaded.
    std::uint64_t written_fragments(const Scene& scene, const Settings& s, const OptimisationSet& forced) {
        FrameRequest request = small_request();
        request.force = true;
        request.forced = forced;
        renderer.render(scene, s, request);
        GLuint query = 0;
        glGenQueries(1, &query);
        glBeginQuery(GL_SAMPLES_PASSED, query);
        renderer.render(scene, s, request);
        glEndQuery(GL_SAMPLES_PASSED);
        GLuint64 count = 0;
        glGetQueryObjectui64v(query, GL_QUERY_RESULT, &count);
        glDeleteQueries(1, &query);
        return count;
    }
    /// Draws a lit picture of a plane straight below a parallel camera: every pixel has one colour.
    ByteImage plain_colour(double grey, const Sets& extra) {
        Scene scene;
        const int material = add_material(scene, "plain", glm::vec3(float(grey)));
        add_object(scene, "plane", -1, add_mesh(scene, "plane", make_plane(10, 10), material));
        finalise(scene);
        const Sets above = {{"camera.source", "manual"}, {"camera.elevation", "89"}, {"light.cast", "false"}};
        return picture(scene, settings_for(scene, joined(above, extra)), {.width = 16, .height = 16});
    }
};

/// Makes a row of plates along the view, each wider than the one before it, in the order of `near_first`.
Scene row_of_plates(int count, bool near_first) {
    Scene scene;
    const int mesh = add_mesh(scene, "plate", make_plane(1, 1), add_material(scene, "grey", glm::vec3(0.5f)));
    for (int i = 0; i < count; ++i) {
        const int place = near_first ? i : count - 1 - i;
        add_object(scene, "plate " + std::to_string(i), -1, mesh,
                   moved(0, -place, 0) * glm::scale(glm::dmat4(1.0), glm::dvec3(2.0 + place)));
    }
    finalise(scene);
    return scene;
}

const Sets kFromAbove = {{"camera.source", "manual"},
                         {"camera.elevation", "89.9"},
                         {"camera.distance", "20"},
                         {"light.cast", "false"},
                         {"shading.sky", "plain"}};

SI_TESTS_ARE(Repeated, ShadingOptimisationsTest);
TEST_F(ShadingOptimisationsTest, NearObjectsAreDrawnBeforeHiddenOnes) {
    const Scene far_first = row_of_plates(8, false);
    const Settings s = settings_for(far_first, kFromAbove);
    const std::uint64_t optimised = written_fragments(far_first, s, {}),
                        forced = written_fragments(far_first, s, {Optimisation::DepthOrder}),
                        least = written_fragments(row_of_plates(8, true), s, {Optimisation::DepthOrder});
    EXPECT_GT(least, 2000u);
    EXPECT_EQ(optimised, least) << "each pixel is shaded once";
    EXPECT_GT(forced, 2 * optimised);
}

TEST_F(ShadingOptimisationsTest, DrawingLargeMeshesLastShadesFewerHiddenPixels) {
    const Scene scene = test::agreed_scene(test::AgreedSize::Triangles100k);
    const Settings s = settings_for(scene, {{"light.cast", "false"}, {"shading.sky", "plain"}});
    FrameRequest request = small_request();
    request.outputs = {.colour = false, .surface_ids = true};
    const SurfaceIds ids = renderer.read_surface_ids(renderer.render(scene, s, request).surface_ids);
    const auto shown = std::ranges::count_if(ids.data, [](const glm::uvec2& id) { return id.x != 0; });
    EXPECT_GT(shown, 320 * 180 / 4) << "the scene fills much of the picture";
    EXPECT_LT(double(written_fragments(scene, s, {})), 1.05 * double(shown)) << "the ground is drawn last";
}

TEST_F(ShadingOptimisationsTest, OrderChangesNoPixel) {
    const Scene scene = test::agreed_scene(test::AgreedSize::Triangles100k);
    FrameRequest forced = small_request();
    forced.forced = {Optimisation::DepthOrder};
    const Settings s = settings_for(scene, {{"filter.kernel", "pcf3"}});
    EXPECT_EQ(different_pixels(picture(scene, s), picture(scene, s, forced)), 0u);
}

/// Makes a plate, and a small one at a distance to its side.
Mesh plates(double aside) {
    Mesh mesh = make_plane(2, 2);
    append(mesh, transformed(make_plane(0.2, 0.2), moved(aside, 0, 0)));
    return mesh;
}

TEST_F(ShadingOptimisationsTest, CoincidentPlatesShowTheSameOneFromEverySide) {
    Scene scene;
    const int red = add_material(scene, "red", {0.8f, 0.1f, 0.1f}),
              green = add_material(scene, "green", {0.1f, 0.8f, 0.1f});
    // Each plate is the farther one from one of the two sides.
    add_object(scene, "a", -1, add_mesh(scene, "a", plates(-3), red));
    add_object(scene, "b", -1, add_mesh(scene, "b", plates(3), green));
    finalise(scene);
    for (const char* azimuth : {"0", "90", "180", "270"}) {
        const Settings s = settings_for(scene, {{"camera.source", "manual"},
                                                {"camera.azimuth", azimuth},
                                                {"camera.elevation", "40"},
                                                {"camera.distance", "9"},
                                                {"light.cast", "false"}});
        const ByteImage seen = picture(scene, s);
        std::size_t reds = 0, greens = 0;
        for (std::size_t i = 0; i < seen.data.size(); i += 4) {
            reds += seen.data[i] > 2 * seen.data[i + 1];
            greens += seen.data[i + 1] > 2 * seen.data[i];
        }
        EXPECT_GT(reds, 5u) << azimuth << ": the small one";
        EXPECT_GT(greens, 20 * reds) << azimuth << ": of the large ones the one that is drawn last";
    }
}

TEST_F(ShadingOptimisationsTest, ObjectsOutsideThePictureAreNotDrawn) {
    Scene scene;
    const int mesh = add_mesh(scene, "ball", make_sphere(0.5, 16, 8), add_material(scene, "grey", glm::vec3(0.5f)));
    for (int x = -20; x <= 20; ++x) add_object(scene, "ball " + std::to_string(x), -1, mesh, moved(2 * x, 0, 0));
    finalise(scene);
    for (const char* orthographic : {"false", "true"})
        for (const char* target : {"0", "-38", "400"}) {
            const Settings s = settings_for(scene, {{"camera.source", "manual"},
                                                    {"camera.orthographic", orthographic},
                                                    {"camera.target_x", target},
                                                    {"camera.distance", "12"},
                                                    {"camera.height", "6"},
                                                    {"light.cast", "false"}});
            FrameRequest request = small_request();
            request.force = true;
            const FrameResult saved = renderer.render(scene, s, request);
            const PassInfo shading = *saved.pass("shading (with visibility)");
            const ByteImage seen = renderer.read_colour(saved.colour);
            request.forced = {Optimisation::FrustumCulling};
            const FrameResult forced = renderer.render(scene, s, request);
            const std::string what = std::string(orthographic) + " " + target;
            EXPECT_EQ(different_pixels(seen, renderer.read_colour(forced.colour)), 0u) << what;
            ASSERT_EQ(shading.parts.size(), 1u);
            const std::uint64_t left_out = shading.parts[0].left_out;
            EXPECT_EQ(shading.parts[0].by, Optimisation::FrustumCulling);
            EXPECT_GE(left_out, std::string(target) == "400" ? 41u : 20u) << what;
            EXPECT_LE(left_out, std::string(target) == "400" ? 41u : 38u) << what;
            const std::uint64_t ball = scene.meshes[0].indices.size() / 3;
            EXPECT_EQ(forced.pass("shading (with visibility)")->triangles, shading.triangles + left_out * ball) << what;
        }
}

TEST_F(ShadingOptimisationsTest, FusedVisibilityDrawsTheSceneOnce) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {{"filter.kernel", "pcf3"}});
    FrameRequest request = small_request();
    request.force = true;
    const FrameResult fused = renderer.render(scene, s, request);
    EXPECT_EQ(fused.pass("visibility")->state, PassState::Skipped);
    EXPECT_EQ(fused.pass("visibility")->draws, 0);
    request.forced = {Optimisation::FusedVisibility};
    const FrameResult forced = renderer.render(scene, s, request);
    EXPECT_EQ(forced.pass("visibility")->state, PassState::Drawn);
    EXPECT_GT(forced.pass("visibility")->draws, 0);
}

/// Returns the samplers that the current program may fetch from.
int active_samplers() {
    GLint program = 0, count = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    glGetProgramiv(GLuint(program), GL_ACTIVE_UNIFORMS, &count);
    int samplers = 0;
    for (GLint i = 0; i < count; ++i) {
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(GLuint(program), GLuint(i), 0, nullptr, &size, &type, nullptr);
        for (const GLenum sampler :
             {GL_SAMPLER_2D, GL_SAMPLER_2D_ARRAY, GL_SAMPLER_2D_SHADOW, GL_SAMPLER_2D_ARRAY_SHADOW})
            samplers += type == sampler;
    }
    return samplers;
}

TEST_F(ShadingOptimisationsTest, LightsThatReachNothingAreLeftOutOfTheProgram) {
    const Scene scene = load_scene("boxes");
    const Sets lone[] = {{{"light.intensity", "0"}},
                         {{"light.red", "0"}, {"light.green", "0"}, {"light.blue", "0"}, {"light.type", "point"}},
                         {{"light.type", "point"}, {"light.range", "2"}, {"light.distance", "200"}},
                         {{"light.type", "spot"}, {"light.range", "2"}, {"light.distance", "200"}}};
    for (const Sets& sets : lone) {
        const Sets sky = {{"filter.kernel", "pcf5"}, {"shading.sky", "plain"}};  // shading is then the last program
        const Settings s = settings_for(scene, joined(sky, sets));
        FrameRequest request = small_request();
        const FrameResult saved = renderer.render(scene, s, request);
        const int fetched = active_samplers();
        const ByteImage seen = renderer.read_colour(saved.colour);
        const Effect e = effect_named(frame_effects(scene, s, saved), "look-ups of light 0");
        EXPECT_EQ(e.state, EffectState::NotNeeded);
        EXPECT_EQ(e.optimisation, Optimisation::DeadPasses);
        EXPECT_NE(e.reason.find(sets.size() == 3 && sets[0].first == "light.type" ? "range" : "light"), e.reason.npos)
            << e.reason;
        request.forced = {Optimisation::DeadPasses};
        const FrameResult forced = renderer.render(scene, s, request);
        EXPECT_GT(active_samplers(), 0);
        EXPECT_EQ(fetched, 0) << sets[0].first;
        EXPECT_EQ(different_pixels(seen, renderer.read_colour(forced.colour)), 0u) << sets[0].first;
    }
    // The frame also has lights that reach the scene, or shows visibility only.
    for (const Sets& sets : {Sets{{"light.count", "3"}, {"light.1.intensity", "0"}, {"light.2.type", "point"}},
                             Sets{{"light.intensity", "0"}, {"shading.composition", "dim-lit"}},
                             Sets{{"light.intensity", "0"}, {"shading.separate_visibility", "true"}}}) {
        const Settings s = settings_for(scene, sets);
        FrameRequest forced = small_request();
        forced.forced = {Optimisation::DeadPasses};
        EXPECT_EQ(different_pixels(picture(scene, s), picture(scene, s, forced)), 0u) << sets.back().first;
    }
}

TEST_F(ShadingOptimisationsTest, MapsWithoutCastersAreNotLookedUp) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    add_object(scene, "Floor", -1, add_mesh(scene, "Floor", make_plane(20, 20), grey));
    add_object(scene, "Ball", -1, add_mesh(scene, "Ball", make_sphere(0.5), grey), moved(8, 0.5, 8));
    finalise(scene);
    const Sets over_floor = {
        {"filter.kernel", "pcf5"}, {"light.type", "spot"},    {"light.distance", "4"},
        {"light.elevation", "70"}, {"light.target_x", "-6"},  {"light.target_z", "-6"},
        {"bias.normal", "2"},      {"bias.kind", "constant"}, {"shading.sky", "plain"}};  // shading is then drawn last
    const auto settings = [&](const Sets& more, bool floor_casts) {
        Settings s = settings_for(scene, joined(over_floor, more));
        s.objects["Floor"].cast = floor_casts;
        return s;
    };
    const auto draw = [&](const Settings& s, OptimisationSet forced) {
        FrameRequest request = small_request();
        request.forced = forced;
        return renderer.render(scene, s, request);
    };
    for (const Sets& more : {Sets{}, Sets{{"map.reversed_z", "true"}}, Sets{{"filter.kernel", "pcss"}}}) {
        const Settings s = settings(more, false);
        const FrameResult saved = draw(s, {});
        EXPECT_EQ(active_samplers(), 0);
        const ByteImage seen = renderer.read_colour(saved.colour);
        EXPECT_EQ(saved.pass("shadow map 0 (spot)")->state, PassState::Skipped);
        const Effect e = effect_named(frame_effects(scene, s, saved), "look-ups of light 0");
        EXPECT_EQ(e.state, EffectState::NotNeeded);
        EXPECT_NE(e.reason.find("o caster lies in its map"), std::string::npos) << e.reason;
        const FrameResult forced = draw(s, {Optimisation::DeadPasses});
        EXPECT_GT(active_samplers(), 0);
        EXPECT_EQ(different_pixels(seen, renderer.read_colour(forced.colour)), 0u);
    }
    // Exceptions: a caster in the cone, a dark outside of the map, averages of depths.
    for (const Settings& s : {settings({{"light.target_x", "8"}, {"light.target_z", "8"}}, false),
                              settings({{"map.outside", "unlit"}}, false), settings({{"filter.kernel", "vsm"}}, false),
                              settings({}, true)}) {
        const FrameResult saved = draw(s, {});
        EXPECT_GT(active_samplers(), 0);
        const ByteImage seen = renderer.read_colour(saved.colour);
        EXPECT_EQ(different_pixels(seen, renderer.read_colour(draw(s, {Optimisation::DeadPasses}).colour)), 0u);
    }
}

// The encoding is a polynomial. Every 8-bit grey level under white light stays within one step, and mostly equal.
TEST_F(ShadingOptimisationsTest, ColoursAreEncodedAsSrgb) {
    int other = 0, levels = 0;
    for (int wanted = 0; wanted <= 255; wanted += 3) {
        const double encoded = wanted / 255.0;
        const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        const ByteImage p = plain_colour(linear, {{"shading.sky", "plain"},
                                                  {"shading.curve", "plain"},
                                                  {"shading.ambient", "1"},
                                                  {"shading.diffuse", "0"},
                                                  {"shading.specular", "0"}});
        const int found = p.data[4 * (8 * 16 + 8)];
        EXPECT_NEAR(found, wanted, 1) << "of " << linear;
        other += found != wanted;
        ++levels;
    }
    EXPECT_LE(other, levels / 20);
    const ByteImage bright =
        plain_colour(1, {{"shading.sky", "plain"}, {"shading.curve", "plain"}, {"shading.ambient", "10"}});
    EXPECT_EQ(bright.data[4 * (8 * 16 + 8)], 255) << "what is brighter than white is white";
}

// Powers of two are squared, others use pow(): the highlight grows evenly from one exponent to the next.
TEST_F(ShadingOptimisationsTest, HighlightsEqualPowersInEitherForm) {
    const Scene scene = load_scene("boxes");
    const auto mean = [&](const char* shininess) {
        const ByteImage p = picture(scene, settings_for(scene, {{"shading.specular", "1"},
                                                                {"shading.ambient", "0"},
                                                                {"shading.diffuse", "0"},
                                                                {"light.cast", "false"},
                                                                {"shading.shininess", shininess}}));
        return double(std::accumulate(p.data.begin(), p.data.end(), std::uint64_t(0))) / double(p.data.size());
    };
    for (const auto& [below, power, above] :
         {std::tuple{"1.99", "2", "2.01"}, {"15.9", "16", "16.1"}, {"31.8", "32", "32.2"}}) {
        const double low = mean(above), high = mean(below), squared = mean(power);
        EXPECT_GT(high, low) << power;
        EXPECT_NEAR(squared, 0.5 * (low + high), 0.6 * (high - low) + 0.02) << power;
    }
}

// Grey light computes one channel for three: a faint hue must look the same under coloured light.
TEST_F(ShadingOptimisationsTest, GreyLightIsAsBrightAsColouredLight) {
    const Scene scene = load_scene("boxes");
    const ByteImage grey = picture(scene, settings_for(scene, {}));
    const ByteImage tinted = picture(scene, settings_for(scene, {{"light.red", "0.999999"}}));
    EXPECT_EQ(different_pixels(grey, tinted, 1), 0u);
    const ByteImage red = picture(scene, settings_for(scene, {{"light.green", "0.2"}, {"light.blue", "0.2"}}));
    EXPECT_GT(different_pixels(grey, red, 10), grey.data.size() / 40);
}

}  // namespace
}  // namespace si
