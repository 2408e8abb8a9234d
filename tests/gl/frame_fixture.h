// Defines the fixture of the drawing tests: an OpenGL context and a renderer per test.
#pragma once

#include <gtest/gtest.h>

#include "app/context/headless_context.h"
#include "renderer/inspect/probe.h"
#include "renderer/render/renderer.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/support/requested_driver.h"

namespace si {

/// Changes of settings: keys with values.
using Sets = std::vector<std::pair<std::string, std::string>>;

/// Returns default settings with the scene's suggested changes and then `extra`. @throws Error for an unknown key or
/// value
inline Settings settings_for(const Scene& scene, const Sets& extra = {}) {
    Settings s;
    for (const auto& [key, value] : scene.suggested) set_setting(s, key, value);
    for (const auto& [key, value] : extra) set_setting(s, key, value);
    return s;
}

/// Fixture with a renderer that has drawn nothing, in a context of its own. A test fails if the driver reports a
/// message.
class FrameTest : public ::testing::Test {
protected:
    HeadlessContext context;
    Renderer renderer;

    void SetUp() override { test::expect_requested_driver(); }
    void TearDown() override {
        context.make_current();  // test::hard_renderer() has one of its own, whose objects are not this renderer's
        for (const std::string& message : renderer.take_gl_messages()) ADD_FAILURE() << "driver: " << message;
    }
    /// Returns a request for a picture of 320 x 180 pixels.
    static FrameRequest small_request() { return {.width = 320, .height = 180}; }
    /// Draws a scene and returns the shaded picture.
    ByteImage picture(const Scene& scene, const Settings& s, FrameRequest request = small_request()) {
        return renderer.read_colour(renderer.render(scene, s, request).colour);
    }
};

/// Counts the pixels of two pictures of equal size that differ by more than `tolerance` (0 to 255) in any channel.
/// Fails the test if the sizes differ.
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

/// Returns settings for the built-in scene "stage" with an orthographic camera straight above it. Pickets and walls are
/// then seen edge-on and cover pixels by rounding only.
/// @param map_resolution value of map.resolution
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
