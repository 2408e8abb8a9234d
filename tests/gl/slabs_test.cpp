// Tests texel slabs in real frames: each lies where the texel's depth lies in the scene.
#include <algorithm>
#include <cmath>

#include "renderer/passes/texel_slabs.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/combinations.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class SlabsTest : public FrameTest {
protected:
    /// Returns the slabs of a frame, from the map read back.
    std::vector<TexelSlab> slabs(const FrameResult& f, const Settings& s, Slabs which) {
        const int face = std::clamp(s.view.face, 0, int(f.lights[0].views.size()) - 1), n = f.map_resolution;
        const FloatImage map = renderer.read_shadow_map(f, 0, face);
        const TexelRegion region = slab_region(s.view, n);
        std::vector<float> depths;
        for (int y = 0; y < region.size.y; ++y)
            for (int x = 0; x < region.size.x; ++x)
                depths.push_back(map.at(region.first.x + x, n - 1 - (region.first.y + y)));
        return texel_slabs(f.lights[0].views[std::size_t(face)], s.bias, n, region, depths, which);
    }
};

/// Returns by how much b is bluer (x) and redder (y) than a at a pixel.
glm::ivec2 tint(const ByteImage& a, const ByteImage& b, int x, int y) {
    const std::size_t i = (std::size_t(y) * std::size_t(a.width) + std::size_t(x)) * 4;
    const auto d = [&](std::size_t c) { return int(b.data[i + c]) - int(a.data[i + c]); };
    return {d(2) - d(0), d(0) - d(2)};
}

/// Returns whether a pixel lies at least a pixel and a half within the slab's picture.
bool covers(const TexelSlab& slab, const Camera& camera, int width, int height, glm::dvec2 pixel) {
    double least = 1e9, most = -1e9;
    for (const auto& [a, b] : {std::pair{0, 1}, {1, 3}, {3, 2}, {2, 0}}) {
        const glm::dvec2 p(camera.project(slab.corners[std::size_t(a)], width, height)),
            q(camera.project(slab.corners[std::size_t(b)], width, height)), along = glm::normalize(q - p),
                                                                            d = pixel - p;
        const double aside = along.x * d.y - along.y * d.x;
        least = std::min(least, aside);
        most = std::max(most, aside);
    }
    return least > 1.5 || most < -1.5;
}

/// Returns world points spread over each slab.
std::vector<std::pair<glm::dvec3, TexelSlab>> points_on(const std::vector<TexelSlab>& slabs) {
    std::vector<std::pair<glm::dvec3, TexelSlab>> out;
    for (const TexelSlab& slab : slabs)
        for (int i = 0; i < 49; ++i) {
            const double s = (i % 7 + 0.5) / 7, t = (i / 7 + 0.5) / 7;
            out.push_back({glm::mix(glm::mix(slab.corners[0], slab.corners[1], s),
                                    glm::mix(slab.corners[2], slab.corners[3], s), t),
                           slab});
        }
    return out;
}

SI_TEST_IS(Repeated, SlabsTest, LieAtTheStoredDepth);
SI_TEST_IS(Product, SlabsTest, LieAtTheStoredDepth);
SI_TEST_IS(Later, SlabsTest, LieAtTheStoredDepth);
TEST_F(SlabsTest, LieAtTheStoredDepth) {
    const Scene scene = load_scene("boxes");
    const FrameRequest size{.width = 640, .height = 360};
    for (const auto& [light, format, reversed] :
         test::combinations<std::pair<const char*, const char*>, const char*, const char*>(
             {{"directional", "scene"}, {"directional", "lispsm"}, {"spot", "scene"}, {"point", "scene"}},
             {"d16", "d32f", "colour", "linear16"}, {"false", "true"})) {
        const auto& [type, fit] = light;
        const Settings plain = settings_for(scene, {{"light.type", type},
                                                    {"light.fit", fit},
                                                    {"map.format", format},
                                                    {"map.reversed_z", reversed},
                                                    {"map.resolution", "64"},
                                                    {"view.face", "3"},
                                                    {"view.slabs_texels", "64"}});
        const ByteImage without = picture(scene, plain, size);
        Settings s = plain;
        s.view.slabs = Slabs::Stored;
        FrameRequest request = size;
        request.outputs.shadow_map = true;
        const FrameResult f = renderer.render(scene, s, request);
        const ByteImage with = renderer.read_colour(f.colour);
        Settings camera = s;
        camera.view.map_source = MapSource::Camera;
        const FloatImage depth = renderer.read_map_view_depth(renderer.render(scene, camera, request));
        int visible = 0, tinted = 0, hidden = 0, strong = 0;
        for (const auto& [point, slab] : points_on(slabs(f, s, Slabs::Stored))) {
            const glm::dvec4 p = f.camera.project(point, size.width, size.height);
            const int x = int(std::lround(p.x)), y = int(std::lround(p.y));
            if (p.w <= 0 || x < 0 || y < 0 || x >= size.width || y >= size.height) continue;
            if (!covers(slab, f.camera, size.width, size.height, {x, y})) continue;
            const double surface = f.camera.curve.distance(double(depth.at(x, y))), own = p.w;
            const int blue = tint(without, with, x, y).x;
            if (own < surface - 0.05) {
                ++visible;
                tinted += blue > 25;
            } else if (own > surface + 0.3) {
                ++hidden;
                strong += blue > 45;
            }
        }
        const std::string where = std::string(type) + " " + fit + " " + format + " " + reversed;
        EXPECT_GT(visible, 200) << where;
        EXPECT_EQ(tinted, visible) << where;
        // A slab behind a surface shows faintly, unless a nearer slab covers the same pixel.
        EXPECT_LE(strong, hidden / 2) << where;
    }
}

TEST_F(SlabsTest, NothingIsDrawnOutsideTheRegionOrOverTheBackground) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"light.fit=scene", "map.resolution=256", "view.slabs_texels=16"});
    const ByteImage without = picture(scene, s);
    s.view.slabs = Slabs::Both;
    const FrameResult f = renderer.render(scene, s, small_request());
    const ByteImage with = renderer.read_colour(f.colour);
    // Bounds of all slabs' corners on screen.
    glm::dvec2 lo(1e9), hi(-1e9);
    for (const TexelSlab& slab : slabs(f, s, Slabs::Both))
        for (const glm::dvec3& c : slab.corners) {
            const glm::dvec2 p(f.camera.project(c, 320, 180));
            lo = glm::min(lo, p);
            hi = glm::max(hi, p);
        }
    int inside = 0, outside = 0;
    for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 320; ++x) {
            const glm::ivec2 t = tint(without, with, x, y);
            const bool in = x >= lo.x - 1 && y >= lo.y - 1 && x <= hi.x + 1 && y <= hi.y + 1;
            (in ? inside : outside) += t.x != 0;
        }
    EXPECT_GT(inside, 50);
    EXPECT_EQ(outside, 0);
    // This corner of the map holds only the far plane.
    s.view.slabs_u = s.view.slabs_v = 0;
    EXPECT_EQ(different_pixels(without, picture(scene, s)), 0u);
}

TEST_F(SlabsTest, EnoughBiasHidesThemInTheSurfacesThatTheyComeFrom) {
    // Light straight down on the floor: as stored, its slabs lie in the floor and show; with bias they lie beneath.
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"light.elevation=90", "map.resolution=128", "view.slabs_u=0.25",
                                      "view.slabs_v=0.25", "view.slabs_texels=24", "bias.kind=constant",
                                      "bias.unit=metres", "bias.constant=0.3", "bias.normal=3"});
    const ByteImage without = picture(scene, s);
    const auto strongly = [&](Slabs which) {
        s.view.slabs = which;
        const ByteImage with = picture(scene, s);
        std::size_t blue = 0, orange = 0;
        for (int y = 0; y < 180; ++y)
            for (int x = 0; x < 320; ++x) {
                const glm::ivec2 t = tint(without, with, x, y);
                blue += t.x > 45;
                orange += t.y > 45;
            }
        return std::pair(blue, orange);
    };
    const auto stored = strongly(Slabs::Stored), biased = strongly(Slabs::Biased);
    EXPECT_GT(stored.first, 500u);
    EXPECT_EQ(stored.second, 0u);
    EXPECT_EQ(biased, (std::pair<std::size_t, std::size_t>(0, 0)));
    s.bias.constant = 0;
    EXPECT_EQ(strongly(Slabs::Biased).second, stored.first);
}

TEST_F(SlabsTest, AreDrawnInEveryPane) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"view.panes=two", "view.overlay_2=n-dot-l", "map.resolution=128"});
    const auto panes = [&] {
        std::vector<ByteImage> out;
        for (const Pane& p : renderer.render(scene, s, small_request()).panes)
            out.push_back(renderer.read_colour(p.picture));
        return out;
    };
    const auto without = panes();
    s.view.slabs = Slabs::Stored;
    const auto with = panes();
    for (std::size_t i = 0; i < 2; ++i) EXPECT_GT(different_pixels(without[i], with[i], 20), 500u) << i;
    set_setting(s, "light.cast", "false");
    const FrameResult dark = renderer.render(scene, s, small_request());
    EXPECT_EQ(dark.pass("stored-depth quads")->reason, "view.light has no shadow map");
}

}  // namespace
}  // namespace si
