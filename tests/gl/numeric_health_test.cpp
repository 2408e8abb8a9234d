// Tests the search for NaN and values out of range: faults are found at their place and nowhere else.
#include "renderer/frame/numeric_health.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "renderer/gl/driver_failure.h"
#include "renderer/inspect/effects.h"
#include "renderer/measure/measured_error.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

/// Faulty values for one texel of an image, written before the search.
struct FaultyTexel {
    std::string image;  ///< "shadow map"
    int layer = 0, level = 0;
    glm::ivec2 at{0};  ///< texel; row 0 is at the bottom
    std::vector<float> numbers;
    bool depth = false;
};

class NumericHealthTest : public FrameTest {
protected:
    void TearDown() override {
        gl::fault_injection() = {};
        FrameTest::TearDown();
    }
    static void inject_faults(const std::vector<FaultyTexel>& all) {
        gl::fault_injection().corrupt_image = [all](std::string_view image, GLuint texture) {
            for (const FaultyTexel& s : all) {
                if (s.image != image) continue;
                constexpr GLenum kFormats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
                const GLenum format = s.depth ? GLenum(GL_DEPTH_COMPONENT) : kFormats[s.numbers.size() - 1];
                GLint target = 0;
                glGetTextureParameteriv(texture, GL_TEXTURE_TARGET, &target);
                if (target == GL_TEXTURE_2D)
                    glTextureSubImage2D(texture, s.level, s.at.x, s.at.y, 1, 1, format, GL_FLOAT, s.numbers.data());
                else
                    glTextureSubImage3D(texture, s.level, s.at.x, s.at.y, s.layer, 1, 1, 1, format, GL_FLOAT,
                                        s.numbers.data());
            }
        };
    }
    NumericHealth health_of(const Scene& scene, const Settings& s) {
        FrameRequest request{.width = 96, .height = 54, .outputs = {.health = true}, .force = true};
        ReferenceCache references;
        trace_sources(renderer, scene, s, request, references);
        const FrameResult frame = renderer.render(scene, s, request);
        return *renderer.numeric_health(frame);
    }
    NumericHealth health_of(const char* scene, const Sets& sets) {
        const Scene loaded = load_scene(scene);
        Sets small = {"map.resolution=128"};
        small.insert(small.end(), sets.begin(), sets.end());
        return health_of(loaded, settings_for(loaded, small));
    }
    /// Expects the written fault as the only finding. @param place expected place of the finding
    void expect_alone(const char* scene, const Sets& sets, const FaultyTexel& s, NumberFault fault,
                      const std::string& place, glm::ivec2 at) {
        SCOPED_TRACE(fmt::format("{} in {}", fault_label(fault), place));
        inject_faults({s});
        const NumericHealth health = health_of(scene, sets);
        gl::fault_injection() = {};
        ASSERT_EQ(health.findings.size(), 1u) << health_text(health);
        const NumberFinding& f = health.findings[0];
        EXPECT_EQ(f.fault, fault) << health_text(health);
        EXPECT_EQ(f.place, place);
        EXPECT_EQ(f.count, 1u);
        EXPECT_EQ(f.first, at);
        EXPECT_EQ(f.worst, at);
        EXPECT_EQ(f.level, s.level);
    }
};

TEST_F(NumericHealthTest, FindsEachDepthFaultInEachKindOfMap) {
    struct Kind {
        const char* scene;
        Sets sets;
        const char* image;
        int layer;
        const char* place;
    };
    const Kind kinds[] = {
        {"boxes", {"map.format=colour"}, "shadow map", 0, "shadow map of light 0"},
        {"boxes", {"map.format=linear", "light.type=spot"}, "shadow map", 0, "shadow map of light 0"},
        {"stage", {"map.format=colour", "light.cascades=4"}, "shadow map", 2, "shadow map, cascade 3 of 4 of light 0"},
        {"boxes", {"map.format=linear", "light.type=point"}, "shadow map", 5, "shadow map, face -z of light 0"},
        {"boxes", {"map.format=colour", "light.count=2"}, "shadow map", 1, "shadow map of light 1"},
        {"boxes", {"map.format=colour", "map.blur_texels=2"}, "blurred shadow map", 0, "blurred shadow map of light 0"},
    };
    for (const Kind& k : kinds)
        for (const auto& [value, fault] : {std::pair{kNaN, NumberFault::NotANumber},
                                           {kInf, NumberFault::Infinite},
                                           {-kInf, NumberFault::Infinite},
                                           {-0.25f, NumberFault::OutsideRange},
                                           {1.5f, NumberFault::OutsideRange}}) {
            // The test tries each value of one kind, and for the others one value per way of detection.
            if (&k != kinds && (std::isinf(value) || value > 1)) continue;
            expect_alone(k.scene, k.sets, {.image = k.image, .layer = k.layer, .at = {77, 31}, .numbers = {value}},
                         fault, k.place, {77, 31});
        }
}

TEST_F(NumericHealthTest, FindsFaultyValuesOfFloatDepthBuffers) {
    inject_faults({{.image = "shadow map", .at = {3, 127}, .numbers = {kNaN}, .depth = true}});
    const NumericHealth health = health_of("boxes", {"map.format=d32f"});
    // Drivers may refuse NaN.
    for (const NumberFinding& f : health.findings) EXPECT_EQ(f.first, glm::ivec2(3, 127)) << finding_text(f);
    EXPECT_TRUE(health_of("boxes", {"map.format=d16"}).findings.size() <= 1);
}

SI_TEST_IS(Later, NumericHealthTest, FindsNegativeVariancesAndOverflowsAtEveryLevel);
TEST_F(NumericHealthTest, FindsNegativeVariancesAndOverflowsAtEveryLevel) {
    const std::string moments = "moments of light 0";
    for (const char* format : {"16-bit", "32-bit"}) {
        const Sets vsm = {"filter.kernel=vsm", {"filter.moment_format", format}, "filter.blur=2"};
        expect_alone("boxes", vsm, {.image = "moments", .at = {9, 100}, .numbers = {0.5f, 0.125f}},
                     NumberFault::NegativeVariance, moments, {9, 100});
        expect_alone("boxes", vsm, {.image = "moments", .at = {0, 0}, .numbers = {kNaN, 0.5f}}, NumberFault::NotANumber,
                     moments, {0, 0});
        Sets mips = vsm;
        mips.insert(mips.end(), {"filter.mips=true", "filter.anisotropy=1"});
        expect_alone("boxes", mips, {.image = "moments", .level = 3, .at = {15, 2}, .numbers = {0.9f, 0.2f}},
                     NumberFault::NegativeVariance, moments + ", mip level 3", {15, 2});
        const Sets evsm = {"filter.kernel=evsm4", {"filter.moment_format", format}};
        expect_alone("boxes", evsm, {.image = "moments", .at = {64, 64}, .numbers = {2, kInf, -1, 1}},
                     NumberFault::Overflow, moments, {64, 64});
        expect_alone("boxes", evsm, {.image = "moments", .at = {64, 64}, .numbers = {2, 4, 0, 1}},
                     NumberFault::Overflow, moments, {64, 64});
        expect_alone("boxes", evsm, {.image = "moments", .at = {1, 64}, .numbers = {2, 4, -1, 0.5f}},
                     NumberFault::NegativeVariance, moments, {1, 64});
        expect_alone("boxes", {"filter.kernel=esm", {"filter.moment_format", format}},
                     {.image = "moments", .at = {127, 0}, .numbers = {kInf}}, NumberFault::Overflow, moments, {127, 0});
    }
    // The last of four faces' layers reports the number of its face.
    expect_alone("boxes", {"filter.kernel=msm_hausdorff", "filter.moment_format=32-bit", "light.type=point"},
                 {.image = "moments", .layer = 4, .at = {5, 6}, .numbers = {0.5f, 0.1f, 0.1f, 0.1f}},
                 NumberFault::NegativeVariance, "moments, face +z of light 0", {5, 6});
}

TEST_F(NumericHealthTest, FindsFaultyPixels) {
    // Rows of pixels count from the top.
    for (const auto& [value, fault] : {std::pair{kNaN, NumberFault::NotANumber}, {-0.1f, NumberFault::OutsideRange}})
        expect_alone("boxes", {"light.count=2"},
                     {.image = "visibility", .layer = 1, .at = {70, 53}, .numbers = {value}}, fault,
                     "visibility of light 1", {70, 0});
}

TEST_F(NumericHealthTest, ReportsFirstWorstAndCount) {
    inject_faults({{.image = "shadow map", .at = {90, 40}, .numbers = {1.25f}},
                   {.image = "shadow map", .at = {11, 41}, .numbers = {-7}},
                   {.image = "shadow map", .at = {12, 41}, .numbers = {1.5f}}});
    const NumericHealth health = health_of("boxes", {"map.format=colour"});
    ASSERT_EQ(health.findings.size(), 1u) << health_text(health);
    const NumberFinding& f = health.findings[0];
    EXPECT_EQ(f.count, 3u);
    EXPECT_EQ(f.first, glm::ivec2(90, 40));
    EXPECT_EQ(f.worst, glm::ivec2(11, 41));
    EXPECT_EQ(f.value, -7);
    EXPECT_EQ(finding_text(f),
              "a value outside 0 to 1 in 3 texels of the shadow map of light 0: first at texel 90, 40, worst at 11, 41 "
              "(-7)");
}

TEST_F(NumericHealthTest, FindsFaultsInPagesOfAMap) {
    // The page may lie anywhere in the pool: every texel of the pool is faulty.
    gl::fault_injection().corrupt_image = [](std::string_view image, GLuint texture) {
        if (image != "shadow map") return;
        const float nan = kNaN;
        glClearTexImage(texture, 0, GL_RED, GL_FLOAT, &nan);
    };
    const Sets sets = {"map.format=colour", "map.virtual=true", "map.resolution=512", "map.page_size=32"};
    const NumericHealth health = health_of("boxes", sets);
    ASSERT_FALSE(health.findings.empty());
    std::uint64_t texels = 0;
    for (const NumberFinding& f : health.findings) {
        EXPECT_EQ(f.fault, NumberFault::NotANumber);
        EXPECT_EQ(f.light, 0);
        EXPECT_EQ(f.first % 32, glm::ivec2(0)) << "where a page begins";
        EXPECT_EQ(f.count % (32 * 32), 0u) << "pages that nothing reads are counted";
        texels += f.count;
    }
    const Scene scene = load_scene("boxes");
    FrameRequest request{.width = 96, .height = 54, .outputs = {.health = true}};
    const FrameResult frame = renderer.render(scene, settings_for(scene, sets), request);
    ASSERT_TRUE(frame.pages);
    EXPECT_EQ(texels, frame.pages->read_texels());
    // One texel of the pool: the page table names its owner, and maps are read back by that table.
    inject_faults({{.image = "shadow map", .at = {5, 7}, .numbers = {kNaN}}});
    request.force = true;
    const FrameResult spoilt = renderer.render(scene, settings_for(scene, sets), request);
    const auto found = renderer.numeric_health(spoilt);
    ASSERT_EQ(found->findings.size(), 1u) << health_text(*found);
    const NumberFinding& one = found->findings[0];
    EXPECT_EQ(one.count, 1u);
    const FloatImage map = renderer.read_shadow_map(spoilt, one.light, one.view);
    EXPECT_TRUE(std::isnan(map.at(one.first.x, map.height - 1 - one.first.y))) << finding_text(one);
}

TEST_F(NumericHealthTest, FindsMatricesThatSinglePrecisionCannotHold) {
    Scene scene = load_scene("boxes");
    scene.objects[1].world[3].x = 1e39;
    const NumericHealth health = health_of(scene, settings_for(scene, {"map.resolution=64"}));
    ASSERT_FALSE(health.sound());
    bool found = false;
    for (const NumberFinding& f : health.findings)
        found |= f.fault == NumberFault::Infinite && f.place.starts_with("matrix of object") &&
                 f.first == glm::ivec2(3, 0) && f.count == 1;
    EXPECT_TRUE(found) << health_text(health);
}

// From exactly above, walls and pickets are seen edge-on: a pixel covered by rounding alone has no position.
TEST_F(NumericHealthTest, SurfacesSeenEdgeOnHaveNoFault) {
    const Scene scene = load_scene("stage");
    Settings s = stage_from_above(scene, "1024");
    const auto expect_sound = [&] {
        FrameRequest request{.width = 295, .height = 332, .outputs = {.visibility = true, .health = true}};
        const auto health = renderer.numeric_health(renderer.render(scene, s, request));
        EXPECT_TRUE(health->sound()) << health_text(*health);
    };
    expect_sound();
    for (int turn = 0; turn < 8; ++turn) {
        s.camera.roll += 45;
        s.camera.target_x += 0.01;
        expect_sound();
    }
}

TEST_F(NumericHealthTest, BuiltInScenesHaveNoFault) {
    for (const BuiltinScene& scene : builtin_scenes()) {
        const NumericHealth health = health_of(std::string(scene.key).c_str(), {});
        EXPECT_TRUE(health.sound()) << scene.key << ": " << health_text(health);
        EXPECT_GE(health.images, 3u);
        EXPECT_GT(health.numbers, 128u * 128 + 2 * 96 * 54);
    }
}

TEST_F(NumericHealthTest, RunsOnlyWhenEnabledAndChangesNoPixel) {
    const Scene scene = load_scene("stage");
    const Settings s = settings_for(scene, {"map.resolution=256"});
    FrameRequest request{.width = 96, .height = 54};
    const FrameResult plain = renderer.render(scene, s, request);
    const ByteImage before = renderer.read_colour(plain.colour);
    const PassInfo* pass = plain.pass("numeric health");
    ASSERT_TRUE(pass);
    EXPECT_EQ(pass->state, PassState::Skipped);
    EXPECT_EQ(pass->draws, 0u);
    EXPECT_THROW(renderer.numeric_health(plain), Error);
    const Effect search = effect_named(frame_effects(scene, s, plain), "numeric health");
    EXPECT_EQ(search.state, EffectState::NotNeeded);
    EXPECT_EQ(search.reason, "Not needed: the numbers are not checked.");
    request.outputs.health = true;
    const FrameResult searched = renderer.render(scene, s, request);
    EXPECT_EQ(searched.pass("numeric health")->state, PassState::Drawn);
    EXPECT_EQ(renderer.read_colour(searched.colour), before);
    const auto health = renderer.numeric_health(searched);
    ASSERT_TRUE(health);
    EXPECT_EQ(renderer.render(scene, s, request).pass("numeric health")->state, PassState::Cached);
    EXPECT_EQ(renderer.numeric_health(searched), health) << "read back once";
}

}  // namespace
}  // namespace si
