// Defines the fixture of the drawing tests: an OpenGL context and a renderer per test.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <iterator>

#include "app/context/headless_context.h"
#include "renderer/inspect/effects.h"
#include "renderer/inspect/probe.h"
#include "renderer/render/renderer.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/support/requested_driver.h"
#include "tests/support/sets.h"

namespace si {

/// Returns default settings with the scene's suggested changes and then `extra`. @throws Error for an unknown key or
/// value
inline Settings settings_for(const Scene& scene, const Sets& extra = {}) {
    Settings s;
    for (const auto& [key, value] : scene.suggested) set_setting(s, key, value);
    return settings_with(std::move(s), extra);
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
    static FrameRequest small_request(Outputs outputs = {}) {
        return {.width = 320, .height = 180, .outputs = outputs};
    }
    /// Draws a scene and returns the shaded picture.
    ByteImage picture(const Scene& scene, const Settings& s, FrameRequest request = small_request()) {
        return renderer.read_colour(renderer.render(scene, s, request).colour);
    }
    /// Draws the visibility of view.light alone, without the shaded picture.
    /// @param frame receives the frame's result
    FloatImage visibility(const Scene& scene, const Settings& s, FrameRequest request = small_request(),
                          FrameResult* frame = nullptr) {
        request.outputs = {.colour = false, .visibility = true};
        const FrameResult drawn = renderer.render(scene, s, request);
        if (frame) *frame = drawn;
        return renderer.read_float(drawn.visibility, 1);
    }
    /// Draws the values of an overlay alone: four numbers a pixel, the last above 0 where there is a value.
    /// @param frame receives the frame's result
    FloatImage overlay_values(const Scene& scene, Settings s, const char* overlay,
                              FrameRequest request = small_request(), FrameResult* frame = nullptr) {
        set_setting(s, "view.overlay", overlay);
        request.outputs = {.colour = false, .overlay = true};
        const FrameResult drawn = renderer.render(scene, s, request);
        if (frame) *frame = drawn;
        return renderer.read_float(drawn.overlay, 4);
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

/// Counts the values of two images of equal size that differ by more than `tolerance`. NaN differs from all values.
inline std::size_t differing_values(const FloatImage& a, const FloatImage& b, float tolerance = 0) {
    EXPECT_EQ(a.data.size(), b.data.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i)
        count += !(a.data[i] == b.data[i] || std::abs(a.data[i] - b.data[i]) <= tolerance);
    return count;
}

/// Counts the values of an image between the two bounds.
inline std::size_t values_between(const FloatImage& image, float low, float high) {
    return std::size_t(std::ranges::count_if(image.data, [&](float v) { return v > low && v < high; }));
}

/// Returns two lists of setting changes as one. Where both change a setting, `more` counts.
inline Sets joined(Sets sets, const Sets& more) {
    sets.insert(sets.end(), more.begin(), more.end());
    return sets;
}

/// Returns the report on the pass that draws a light's maps. Fails the test if there is none.
inline const PassInfo& map_pass(const FrameResult& frame, int light = 0) {
    static const PassInfo none;
    const auto pass = std::ranges::find_if(
        frame.passes, [&](const PassInfo& p) { return p.light == light && p.makes == Result::DrawnMaps; });
    EXPECT_NE(pass, frame.passes.end()) << "no map of light " << light;
    return pass == frame.passes.end() ? none : *pass;
}

/// Reads back the texels of all maps of a frame, one map after another.
inline std::vector<float> map_texels(Renderer& renderer, const FrameResult& frame) {
    std::vector<float> out;
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
        for (std::size_t v = 0; frame.lights[i].casts && v < frame.lights[i].views.size(); ++v)
            std::ranges::copy(renderer.read_shadow_map(frame, int(i), int(v)).data, std::back_inserter(out));
    return out;
}

/// Counts the numbers of two lists of equal size that differ in any bit. Fails the test if the sizes differ.
inline std::size_t differing_floats(const std::vector<float>& a, const std::vector<float>& b) {
    EXPECT_EQ(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        count += std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i]);
    return count;
}

/// Returns an effect of a list by its name. Fails the test if the list has none.
inline Effect effect_named(const std::vector<Effect>& effects, std::string_view name) {
    const auto found = std::ranges::find(effects, name, &Effect::name);
    EXPECT_NE(found, effects.end()) << "no effect " << name;
    return found == effects.end() ? Effect{} : *found;
}

/// Returns settings for the built-in scene "stage" with an orthographic camera straight above it. Pickets and walls are
/// then seen edge-on and cover pixels by rounding only.
/// @param map_resolution value of map.resolution
inline Settings stage_from_above(const Scene& scene, const char* map_resolution) {
    return settings_for(scene, {{"map.resolution", map_resolution},
                                "light.azimuth=116",
                                "light.elevation=25",
                                "camera.source=manual",
                                "camera.target_x=-0.23797406781627828",
                                "camera.target_y=-0.16742197011035742",
                                "camera.target_z=-2.2264730011999188",
                                "camera.azimuth=83.80000000000001",
                                "camera.elevation=90",
                                "camera.roll=-164.22600139226103",
                                "camera.distance=37.123769102030515",
                                "camera.orthographic=true",
                                "camera.height=14.140426469191436"});
}

}  // namespace si
