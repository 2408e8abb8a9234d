// Tests the picture through the light: the camera is the light's view, and map coordinates are pixel coordinates.
#include <algorithm>
#include <cmath>

#include "renderer/inspect/texel_usage.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class LightCamera : public FrameTest {
protected:
    FrameResult frame(const Scene& scene, const Settings& s, int width, int height) {
        FrameRequest request{.width = width,
                             .height = height,
                             .outputs = {.colour = false, .shadow_map = true, .map_coordinates = true}};
        return renderer.render(scene, s, request);
    }
};

struct Kind {
    const char *type, *projection, *face;
};
constexpr Kind kKinds[] = {{"directional", "auto", "0"}, {"directional", "perspective", "0"},
                           {"spot", "auto", "0"},        {"spot", "orthographic", "0"},
                           {"point", "auto", "3"},       {"point", "auto", "0"}};

TEST_F(LightCamera, MapCoordinatesArePixelCoordinates) {
    const Scene scene = load_scene("boxes");
    for (const Kind& kind : kKinds)
        for (const glm::ivec2 size : {glm::ivec2(200, 200), {300, 180}, {150, 240}}) {
            const Settings s = settings_for(scene, {"camera.source=light",
                                                    {"light.type", kind.type},
                                                    {"light.projection", kind.projection},
                                                    {"view.face", kind.face},
                                                    "bias.normal=0"});
            const FrameResult f = frame(scene, s, size.x, size.y);
            const LightView& view = f.lights[0].views[std::size_t(std::atoi(kind.face))];
            EXPECT_EQ(f.camera.curve.near, view.curve.near);
            EXPECT_EQ(f.camera.curve.far, view.curve.far);
            const FloatImage at = renderer.read_float(f.map_coordinates, 4);
            const int side = std::min(size.x, size.y);
            int seen = 0;
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    if (at.at(x, y, 3) == 0 || at.at(x, y, 2) != std::atof(kind.face)) continue;
                    // The map's square lies in the middle of the picture.
                    const double u = (x + 0.5 - 0.5 * (size.x - side)) / side;
                    const double v = (size.y - y - 0.5 - 0.5 * (size.y - side)) / side;
                    ++seen;
                    ASSERT_NEAR(at.at(x, y, 0), u, 2e-5) << kind.type << " " << x << "," << y;
                    ASSERT_NEAR(at.at(x, y, 1), v, 2e-5) << kind.type << " " << x << "," << y;
                }
            // this face looks past the scene
            if (std::string(kind.face) == "0" && std::string(kind.type) == "point") continue;
            EXPECT_GT(seen, side * side / 8) << kind.type << " " << kind.projection << " " << size.x;
        }
}

TEST_F(LightCamera, SeesTheDepthThatTheMapStores) {
    const Scene scene = load_scene("boxes");
    for (const Kind& kind : kKinds) {
        const Settings s = settings_for(scene, {"camera.source=light",
                                                {"light.type", kind.type},
                                                {"light.projection", kind.projection},
                                                {"view.face", kind.face},
                                                "map.resolution=256",
                                                "map.reversed_z=true",  // as in the camera
                                                "view.map_source=camera"});
        const FrameResult f = frame(scene, s, 256, 256);
        const FloatImage camera = renderer.read_map_view_depth(f),
                         map = renderer.read_shadow_map(f, 0, std::atoi(kind.face));
        int apart = 0, drawn = 0;
        for (std::size_t i = 0; i < map.data.size(); ++i) {
            apart += std::abs(camera.data[i] - map.data[i]) > 1e-5;
            drawn += map.data[i] != 0;
        }
        // The scene's one-sided faces cast from both sides and are visible from one side; edges round differently.
        EXPECT_LE(apart, 256 * 256 / 400) << kind.type << " " << kind.projection << " " << kind.face;
        if (std::string(kind.type) != "point") {
            EXPECT_GT(drawn, 256 * 256 / 8) << kind.type;
        }
    }
}

TEST_F(LightCamera, WithoutLightsTheAutomaticCameraIsUsedAndReported) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {"camera.source=light", "light.count=0"});
    const FrameResult f = renderer.render(scene, s, small_request());
    const Settings automatic = settings_for(scene, {"light.count=0"});
    EXPECT_EQ(f.camera.eye, make_camera(scene, automatic, 320.0 / 180).eye);
    EXPECT_TRUE(std::any_of(f.notes.begin(), f.notes.end(),
                            [](const std::string& n) { return n.starts_with("camera.source light"); }));
}

SI_TEST_IS(Repeated, LightCamera, CanBecomeAManualCamera);
TEST_F(LightCamera, CanBecomeAManualCamera) {
    const Scene scene = load_scene("boxes");
    for (const Kind& kind : kKinds) {
        Settings s = settings_for(scene, {"camera.source=light",
                                          {"light.type", kind.type},
                                          {"light.projection", kind.projection},
                                          {"view.face", kind.face}});
        const Camera before = make_camera(scene, s, 1.5);
        s.camera = manual_camera(scene, s, 1.5);
        EXPECT_EQ(s.camera.source, CameraSource::Manual);
        const Camera after = make_camera(scene, s, 1.5);
        EXPECT_EQ(s.camera.near, 0);
        for (const glm::dvec3 p : {glm::dvec3(0), {1, 2, -1}, {-2, 0, 3}}) {
            const glm::dvec4 a = before.project(p, 300, 200), b = after.project(p, 300, 200);
            if (a.w <= 0) continue;
            EXPECT_NEAR(a.x, b.x, 1e-6) << kind.type;
            EXPECT_NEAR(a.y, b.y, 1e-6) << kind.type;
        }
    }
}

TEST_F(LightCamera, UtilisationOfAFlatMapEqualsTheCoveredShare) {
    // Through the light at one pixel per texel, each texel with a lit surface is read by its own pixel.
    const Scene scene = load_scene("boxes");
    const int n = 128;
    Settings s = settings_for(scene, {"camera.source=light", "bias.normal=0", "filter.kernel=hard"});
    s.map.resolution = n;
    const FrameResult f = frame(scene, s, n, n);
    const FloatImage at = renderer.read_float(f.map_coordinates, 4);
    const TexelUsage usage = texel_usage(at, s, n);
    int reading = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const bool reads = at.at(x, y, 3) != 0;
            reading += reads;
            ASSERT_EQ(usage.pixels({x, n - 1 - y}), reads ? 1u : 0u) << x << "," << y;
            if (reads) {
                ASSERT_EQ(usage.readers({x, n - 1 - y}), (std::vector<glm::ivec2>{{x, y}}));
            }
        }
    EXPECT_DOUBLE_EQ(usage.utilisation(), double(reading) / (n * n));
    EXPECT_GT(reading, n * n / 8);
    // At half the extent a pixel is two texels wide, and a bilinear tap reads 2x2 texels: all texels again.
    const FrameResult half = frame(scene, s, n / 2, n / 2);
    const FloatImage coarse = renderer.read_float(half.map_coordinates, 4);
    set_setting(s, "filter.kernel", "hw2x2");
    const double read_by_half = texel_usage(coarse, s, n).utilisation();
    EXPECT_NEAR(read_by_half, usage.utilisation(), 0.02);
    set_setting(s, "filter.kernel", "hard");
    EXPECT_NEAR(texel_usage(coarse, s, n).utilisation(), usage.utilisation() / 4, 0.01);
}

SI_TEST_IS(Repeated, LightCamera, CoordinatesNameTheTexelOfTheProbe);
SI_TEST_IS(Later, LightCamera, CoordinatesNameTheTexelOfTheProbe);
TEST_F(LightCamera, CoordinatesNameTheTexelOfTheProbe) {
    const Scene scene = load_scene("boxes");
    for (const char* type : {"directional", "spot", "point"}) {
        // An offset of many texels: coordinates without it would name another texel.
        const Settings s = settings_for(scene, {{"light.type", type}, "bias.normal=12", "map.resolution=512"});
        FrameRequest request = small_request({.colour = false, .map_coordinates = true});
        const FloatImage at = renderer.read_float(renderer.render(scene, s, request).map_coordinates, 4);
        int tested = 0, apart = 0;
        for (int y = 3; y < 180; y += 19)
            for (int x = 5; x < 320; x += 21) {
                if (at.at(x, y, 3) == 0) continue;
                const Probe p = renderer.probe(scene, s, request, x, y);
                ASSERT_TRUE(p.hit);
                EXPECT_EQ(int(at.at(x, y, 2)), p.lights[0].face);
                ++tested;
                apart += glm::ivec2(int(at.at(x, y, 0) * 512), int(at.at(x, y, 1) * 512)) != p.lights[0].texel;
            }
        EXPECT_GT(tested, 30) << type;
        EXPECT_LE(apart, 1) << type << ": a coordinate on the border of two texels may round apart";
    }
}

SI_TEST_IS(Repeated, LightCamera, CoordinatesAreMarkedOnlyWithinTheKernel);
TEST_F(LightCamera, CoordinatesAreMarkedOnlyWithinTheKernel) {
    const Scene scene = load_scene("boxes");
    const auto reading = [&](const Sets& extra) {
        const Settings s = settings_for(scene, extra);
        FrameRequest request = small_request({.colour = false, .map_coordinates = true});
        const FrameResult f = renderer.render(scene, s, request);
        if (!f.map_coordinates.texture) return -1;
        const FloatImage at = renderer.read_float(f.map_coordinates, 4);
        int count = 0;
        for (std::size_t i = 3; i < at.data.size(); i += 4) count += at.data[i] != 0;
        return count;
    };
    const int all = reading({});
    EXPECT_GT(all, 320 * 180 / 4);
    EXPECT_LT(all, 320 * 180) << "the background reads nothing";
    EXPECT_LT(reading({{"object.Boxes/Floor.receive", "false"}}), all / 2);
    EXPECT_LT(reading({"light.elevation=-30"}), all / 2) << "what is turned away reads nothing";
    EXPECT_EQ(reading({"light.cast=false"}), -1) << "no map, no coordinates";
    // The map is much smaller than the scene: outside it nothing is read unless the map repeats.
    const Sets narrow = {"light.fit=manual", "light.extent=1"};
    for (const auto& [wrap, everywhere] :
         {std::pair{"border", false}, {"range", false}, {"clamp", true}, {"repeat", true}}) {
        auto extra = narrow;
        extra.push_back({"map.wrap", wrap});
        const int count = reading(extra);
        EXPECT_GT(count, 100) << wrap;
        EXPECT_EQ(count > all / 2, everywhere) << wrap;
    }
}

}  // namespace
}  // namespace si
