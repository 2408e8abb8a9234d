// Tests map.blur_texels: every stored depth is the mean of its neighbours in every format and light type; 0 runs no
// pass.
#include <algorithm>
#include <cmath>

#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

/// Returns the mean of the map's texels within `radius` along both axes, in double.
std::vector<double> box_blur(const FloatImage& map, int radius) {
    std::vector<double> out(map.data.size());
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            double sum = 0;
            int count = 0;
            for (int v = std::max(0, y - radius); v <= std::min(map.height - 1, y + radius); ++v)
                for (int u = std::max(0, x - radius); u <= std::min(map.width - 1, x + radius); ++u) {
                    sum += map.at(u, v);
                    ++count;
                }
            out[std::size_t(y) * std::size_t(map.width) + std::size_t(x)] = sum / count;
        }
    return out;
}

class DepthBlur : public FrameTest {
protected:
    static FrameRequest maps() { return {.width = 64, .height = 48, .outputs = {.colour = false, .shadow_map = true}}; }
};

TEST_F(DepthBlur, EqualsTheMeanOfNeighboursInEveryFormatAndLightType) {
    const Scene scene = load_scene("boxes");
    const std::pair<const char*, double> formats[] = {
        {"d16", 2.0 / 65535}, {"d24", 1e-6}, {"d32f", 1e-6}, {"colour", 1e-6}};
    for (const auto& [format, step] : formats)
        for (const char* light : {"directional", "spot", "point"})
            for (const char* reversed : {"false", "true"}) {
                Settings s = settings_for(scene, {"light.fit=scene",
                                                  "map.resolution=48",
                                                  "bias.normal=3",
                                                  {"map.format", format},
                                                  {"light.type", light},
                                                  {"map.reversed_z", reversed}});
                for (const int radius : {1, 4}) {
                    // The faces of a point light overlap by the reach of look-ups: a blur needs as much as an offset
                    // of equal size.
                    Settings unblurred = s;
                    unblurred.map.blur_texels = 0;
                    unblurred.bias.normal += radius;
                    const FrameResult plain = renderer.render(scene, unblurred, maps());
                    const auto faces = plain.lights.at(0).views.size();
                    std::vector<FloatImage> sharp;
                    for (std::size_t face = 0; face < faces; ++face)
                        sharp.push_back(renderer.read_shadow_map(plain, 0, int(face)));
                    s.map.blur_texels = radius;
                    const FrameResult soft = renderer.render(scene, s, maps());
                    double moved = 0;
                    for (std::size_t face = 0; face < faces; ++face) {
                        const FloatImage blurred = renderer.read_shadow_map(soft, 0, int(face));
                        const std::vector<double> expected = box_blur(sharp[face], radius);
                        double worst = 0;
                        for (std::size_t i = 0; i < expected.size(); ++i) {
                            worst = std::max(worst, std::abs(blurred.data[i] - expected[i]));
                            moved = std::max(moved, std::abs(double(blurred.data[i]) - sharp[face].data[i]));
                        }
                        EXPECT_LE(worst, step) << format << " " << light << " face " << face << " radius " << radius;
                    }
                    EXPECT_GT(moved, 0.005)
                        << "no edge was blurred, so the case proves nothing: " << format << " " << light;
                }
            }
}

TEST_F(DepthBlur, BlursTheLayersOfEveryLight) {
    const Scene scene = load_scene("boxes");
    Settings s =
        settings_for(scene, {"light.fit=scene", "map.resolution=32", "light.count=3", "light.1.type=point",
                             "light.2.fit=scene", "light.2.type=spot", "light.1.azimuth=90", "light.2.azimuth=150"});
    const FrameResult plain = renderer.render(scene, s, maps());
    const FloatImage first = renderer.read_shadow_map(plain, 0, 0), last = renderer.read_shadow_map(plain, 2, 0);
    s.map.blur_texels = 2;
    const FrameResult soft = renderer.render(scene, s, maps());
    for (const auto& [sharp, light] : {std::pair{&first, 0}, {&last, 2}}) {
        const FloatImage blurred = renderer.read_shadow_map(soft, light, 0);
        const std::vector<double> expected = box_blur(*sharp, 2);
        for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(blurred.data[i], expected[i], 1e-6) << light;
    }
}

TEST_F(DepthBlur, RunsOnlyWhenEnabledAndIsCached) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"map.resolution=256"});
    const FrameResult off = renderer.render(scene, s, small_request());
    ASSERT_NE(off.pass("depth blur"), nullptr);
    EXPECT_EQ(off.pass("depth blur")->state, PassState::Skipped);
    EXPECT_NE(off.pass("depth blur")->reason.find("map.blur_texels is 0"), std::string::npos);
    const ByteImage sharp = renderer.read_colour(off.colour);
    s.map.blur_texels = 3;
    const FrameResult on = renderer.render(scene, s, small_request());
    EXPECT_EQ(on.pass("depth blur")->state, PassState::Drawn);
    for (const PassInfo& pass : on.passes)
        EXPECT_EQ(pass.category == PassCategory::Maps, pass.name == "depth blur" || pass.name == "moments" ||
                                                           pass.name == "map bounds" ||
                                                           pass.name.starts_with("shadow map"))
            << pass.name;
    const FrameResult again = renderer.render(scene, s, small_request());
    EXPECT_EQ(again.pass("depth blur")->state, PassState::Cached);
    const ByteImage blurred = renderer.read_colour(again.colour);
    EXPECT_GT(different_pixels(sharp, blurred, 2), 100u);
    s.lights[0].azimuth += 20;  // changes the blur's input
    EXPECT_EQ(renderer.render(scene, s, small_request()).pass("depth blur")->state, PassState::Drawn);
    s.lights[0].azimuth -= 20;
    s.map.blur_texels = 0;
    EXPECT_EQ(picture(scene, s).data, sharp.data) << "switching it off leaves a trace";
    s.light_count = 0;
    s.map.blur_texels = 3;
    EXPECT_EQ(renderer.render(scene, s, small_request()).pass("depth blur")->state, PassState::Skipped);
}

// The blur is wrong on purpose: unlike filters of comparisons it makes no greys at shadow edges.
TEST_F(DepthBlur, SoftensNoEdge) {
    const Scene scene = load_scene("boxes");
    const auto greys = [&](const Settings& s) { return values_between(visibility(scene, s), 0.01f, 0.99f); };
    EXPECT_EQ(greys(settings_for(scene, {"filter.kernel=hard", "map.blur_texels=4"})), 0u);
    EXPECT_GT(greys(settings_for(scene, {"filter.kernel=pcf9"})), 100u);
}

}  // namespace
}  // namespace si
