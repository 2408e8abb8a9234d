// A renderer of the test's own in a context that all share; every test must leave the driver without complaint.
#pragma once

#include <gtest/gtest.h>

#include "app/context/headless_context.h"
#include "renderer/inspect/probe.h"
#include "renderer/render/renderer.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/support/requested_driver.h"
#include "tests/support/shared_context.h"

namespace si {

using Sets = std::vector<std::pair<std::string, std::string>>;  // keys and values

/// What the scene suggests, and then `extra`.
inline Settings settings_for(const Scene& scene, const Sets& extra = {}) {
    Settings s;
    for (const auto& [key, value] : scene.suggested) set_setting(s, key, value);
    for (const auto& [key, value] : extra) set_setting(s, key, value);
    return s;
}

/// Has a renderer that has drawn nothing, with the programs that earlier tests of the process compiled.
class FrameTest : public ::testing::Test {
protected:
    HeadlessContext& context = test::shared_context();
    Renderer renderer;

    /// @param programs of shared_context(); where compiling is the subject: a cache of the test's own
    explicit FrameTest(std::shared_ptr<gl::ProgramCache> programs = test::shared_programs())
        : renderer(std::move(programs)) {}
    void SetUp() override { test::expect_requested_driver(); }
    void TearDown() override {
        context.make_current();  // test::hard_renderer() has one of its own, whose objects are not this renderer's
        for (const std::string& message : renderer.take_gl_messages()) ADD_FAILURE() << "driver: " << message;
    }
    static FrameRequest small() { return {.width = 320, .height = 180}; }
    ByteImage picture(const Scene& scene, const Settings& s, FrameRequest request = small()) {
        return renderer.read_colour(renderer.render(scene, s, request).colour);
    }
};

/// Pixels of two pictures of one size that differ by more than `tolerance` in any channel.
inline std::size_t different_pixels(const ByteImage& a, const ByteImage& b, int tolerance = 0) {
    EXPECT_EQ(a.data.size(), b.data.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i + 3 < std::min(a.data.size(), b.data.size()); i += 4) {
        bool differs = false;
        for (std::size_t c = 0; c < 4; ++c) differs |= std::abs(int(a.data[i + c]) - int(b.data[i + c])) > tolerance;
        count += differs;
    }
    return count;
}

/// The stage from exactly above, where pickets and walls are seen edge-on and cover pixels by rounding alone.
inline Settings stage_from_above(const Scene& scene, const char* map_resolution) {
    return settings_for(scene, {{"map.resolution", map_resolution},
                                {"light.azimuth", "116"},
                                {"light.elevation", "25"},
                                {"camera.source", "manual"},
                                {"camera.target_x", "-0.23797406781627828"},
                                {"camera.target_y", "-0.16742197011035742"},
                                {"camera.target_z", "-2.2264730011999188"},
                                {"camera.azimuth", "83.80000000000001"},
                                {"camera.elevation", "90"},
                                {"camera.roll", "-164.22600139226103"},
                                {"camera.distance", "37.123769102030515"},
                                {"camera.orthographic", "true"},
                                {"camera.height", "14.140426469191436"}});
}

}  // namespace si
