// Tests virtual shadow maps: pictures equal those of whole maps for any cached, moved or evicted pages, and costs are
// reported.
#include <algorithm>
#include <cmath>
#include <random>

#include "renderer/measure/measure.h"
#include "renderer/scenes/shapes.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

Scene displaced(Scene scene, const glm::dvec3& by) {
    for (Node& node : scene.nodes)
        if (node.parent < 0) node.local = moved(by.x, by.y, by.z) * node.local;
    refresh(scene);
    return scene;
}

class PagesTest : public FrameTest {
protected:
    FloatImage visibility(Renderer& by, const Scene& scene, const Settings& s, FrameResult* frame = nullptr,
                          bool force = false) {
        FrameRequest request{
            .width = 160, .height = 90, .outputs = {.colour = false, .visibility = true}, .force = force};
        const FrameResult f = by.render(scene, s, request);
        if (frame) *frame = f;
        return by.read_float(f.visibility, 1);
    }
};

SI_TEST_IS(Repeated, PagesTest, PagesHoldTheTexelsOfTheWholeMap);
SI_TEST_IS(Slow, PagesTest, PagesHoldTheTexelsOfTheWholeMap);
// Pages are drawn with the map's own matrix, moved by whole texels. Differences come only from rounding a corner to
// 1/256 of a texel.
TEST_F(PagesTest, PagesHoldTheTexelsOfTheWholeMap) {
    std::size_t pixels = 0, wrong = 0, dark = 0;
    const Sets kinds[] = {{"filter.kernel=hard", "light.elevation=90"},
                          {"filter.kernel=pcf5", "map.reversed_z=true", "light.azimuth=90"},
                          {"filter.kernel=poisson", "light.type=spot", "map.format=d16"},
                          {"filter.kernel=pcf3", "light.type=point", "map.format=colour"},
                          {"filter.kernel=pcf3", "light.type=spot", "map.format=linear16"},
                          {"filter.kernel=pcf3_nearest", "light.cascades=3", "light.cascade_blend=0.5"},
                          {"filter.kernel=pcss", "light.fit=manual", "map.wrap=repeat"},
                          {"filter.kernel=tent3", "light.fit=manual", "map.wrap=clamp"}};
    const Scene home = load_scene("stage");
    for (const glm::dvec3& place : {glm::dvec3(0), glm::dvec3(115, 3, -40), glm::dvec3(1e5, 20, 1e5)}) {
        const Scene scene = displaced(home, place);
        for (std::size_t i = 0; i < std::size(kinds); ++i) {
            if (place.x > 0 && i % 3 != 1) continue;
            Settings s = settings_for(scene, kinds[i]);
            set_setting(s, "camera.index", "-1");  // the file's camera does not move with the scene
            set_all(s, {"map.resolution=450", "map.page_size=32"});
            const FloatImage whole = visibility(renderer, scene, s);
            set_all(s, {"map.virtual=true", "map.virtual_levels=1"});
            FrameResult frame;
            const FloatImage paged = visibility(renderer, scene, s, &frame);
            ASSERT_TRUE(frame.pages);
            EXPECT_GT(frame.pages->drawn, 10);
            EXPECT_LT(frame.pages->drawn, int(frame.lights[0].views.size()) * 225);
            const std::size_t differ = differing_values(whole, paged);
            EXPECT_LE(differ, whole.data.size() / 1000) << "kind " << i << " at " << place.x;
            pixels += whole.data.size();
            wrong += differ;
            dark += std::size_t(std::count_if(whole.data.begin(), whole.data.end(), [](float v) { return v < 0.5f; }));
        }
    }
    EXPECT_LE(double(wrong), 2e-4 * double(pixels)) << wrong << " of " << pixels;
    EXPECT_GT(dark, 500u);
}

// Over a hundred steps of everything that moves, cached pages equal freshly drawn ones.
TEST_F(PagesTest, CachedPagesEqualDrawnPages) {
    Scene scene = displaced(load_scene("boxes"), {115, 3, -40});
    std::mt19937 engine(2);
    const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine); };
    Settings s = settings_for(scene, {"map.virtual=true", "map.resolution=512", "map.page_size=32", "map.page_pool=150",
                                      "camera.source=manual", "camera.distance=9", "camera.target_x=115",
                                      "camera.target_y=3", "camera.target_z=-40", "light.elevation=90"});
    Renderer cold;
    std::size_t kept = 0, evicted = 0, coarser = 0;
    for (int step = 0; step < 110; ++step) {
        switch (step % 11) {
            case 3:
                s.lights[0].azimuth += 10;
                s.lights[0].elevation = between(20, 90);
                break;
            case 6: {  // one box moves
                Node& node = scene.nodes[std::size_t(1 + step % int(scene.nodes.size() - 1))];
                node.local = moved(between(-0.3, 0.3), 0, between(-0.3, 0.3)) * node.local;
                refresh(scene);
                break;
            }
            case 9:
                s.map.page_pool = step % 2 ? 150 : 40;
                break;
            default:
                s.camera.azimuth += between(-15, 15);
                s.camera.target_x += between(-0.4, 0.4);
                s.camera.distance = between(4, 14);
        }
        FrameResult frame;
        const FloatImage a = visibility(renderer, scene, s, &frame);
        const FloatImage b = visibility(cold, scene, s, nullptr, true);
        ASSERT_EQ(differing_values(a, b), 0u) << "step " << step;
        kept += std::size_t(frame.pages->kept);
        evicted += std::size_t(frame.pages->evicted);
        coarser += std::size_t(frame.pages->coarser);
        EXPECT_EQ(std::count_if(a.data.begin(), a.data.end(), [](float v) { return std::isnan(v); }), 0) << step;
    }
    EXPECT_GT(kept, 1000u);
    EXPECT_GT(evicted, 100u);
    EXPECT_GT(coarser, 20u);
}

TEST_F(PagesTest, OnlyPagesOfMovedCastersAreDrawnAgain) {
    Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"map.virtual=true", "map.resolution=2048", "map.page_size=64"});
    const auto pages = [&] {
        FrameResult frame;
        visibility(renderer, scene, s, &frame);
        return *frame.pages;
    };
    const PageFacts first = pages();
    EXPECT_EQ(first.drawn, first.wanted);
    EXPECT_EQ(first.kept, 0);
    EXPECT_GT(first.fixed_map_texels, 2.0 * double(first.drawn_texels()));
    EXPECT_EQ(pages().drawn, 0) << "nothing changed";
    s.shading.ambient += 0.1;
    EXPECT_EQ(pages().drawn, 0) << "what maps do not read";
    s.camera = manual_camera(scene, s);
    s.camera.azimuth += 1;
    const PageFacts turned = pages();
    EXPECT_GT(turned.kept, turned.drawn);
    Node& node = scene.nodes.back();
    node.local = moved(0.05, 0, 0) * node.local;
    refresh(scene);
    const PageFacts pushed = pages();
    EXPECT_GT(pushed.drawn, 0);
    EXPECT_GT(pushed.kept, pushed.drawn) << "those that the box has no part in";
    s.lights[0].azimuth += 1;
    EXPECT_EQ(pages().kept, 0) << "the light moved";
}

// With too small a pool coarser pages replace the missing ones: without holes, and with a note.
TEST_F(PagesTest, AFullPoolReducesSharpnessOnly) {
    const Scene scene = load_scene("stage");
    Settings s = settings_for(scene, {"map.virtual=true", "map.resolution=1024", "map.page_size=32"});
    FrameResult frame;
    const FloatImage all = visibility(renderer, scene, s, &frame);
    EXPECT_EQ(frame.pages->coarser, 0);
    const int wanted = frame.pages->wanted;
    s.map.page_pool = wanted / 3;
    const FloatImage few = visibility(renderer, scene, s, &frame);
    EXPECT_GT(frame.pages->coarser, wanted / 8);
    EXPECT_LE(frame.pages->drawn + frame.pages->kept, wanted / 3);
    EXPECT_TRUE(std::any_of(frame.notes.begin(), frame.notes.end(),
                            [](const std::string& note) { return note.find("map.page_pool") != std::string::npos; }));
    // Away from edges both are equal.
    std::size_t inner = 0, wrong = 0;
    for (int y = 3; y < all.height - 3; ++y)
        for (int x = 3; x < all.width - 3; ++x) {
            bool even = true;
            for (int dy = -3; dy <= 3; ++dy)
                for (int dx = -3; dx <= 3; ++dx) even &= all.at(x + dx, y + dy) == all.at(x, y);
            if (!even) continue;
            ++inner;
            wrong += std::abs(few.at(x, y) - all.at(x, y)) > 0.5;
        }
    EXPECT_GT(inner, 4000u);
    EXPECT_LT(double(wrong), 0.01 * double(inner));
}

// A renderer that has drawn other pages has the pool of a new one: no larger pool stays.
TEST_F(PagesTest, ThePoolFollowsItsSettings) {
    const Scene scene = load_scene("stage");
    // A single level gives no page up, so its pool grows past map.page_pool.
    Settings s = settings_for(scene, {"map.virtual=true", "map.virtual_levels=1", "map.resolution=1024"});
    s.map.page_size = 16;
    s.map.page_pool = 8;
    FrameResult used, first;
    visibility(renderer, scene, s, &used);
    EXPECT_GT(used.pages->pool, 100);
    for (const char* change : {"map.page_size=128", "map.page_pool=300", "map.page_pool=20", "map.format=d16"}) {
        SCOPED_TRACE(change);
        set_all(s, Sets{change});
        Renderer fresh;
        const FloatImage expected = visibility(fresh, scene, s, &first);
        EXPECT_EQ(differing_values(visibility(renderer, scene, s, &used), expected), 0u);
        EXPECT_EQ(used.pages->pool, first.pages->pool);
    }
}

// Glass is absent from the depth that selects pages and still reads the map; so do masks and several lights.
TEST_F(PagesTest, BlendedSurfacesReadTheirPages) {
    Scene scene;
    scene.materials.push_back({.name = "glass", .base_colour = {1, 1, 1, 0.9f}, .alpha = AlphaMode::Blend});
    scene.meshes = {make_quad(4, 4), make_quad(1, 1)};
    scene.meshes[0].material = 0;
    // The camera does not see the last object.
    scene.nodes = {{.name = "glass", .local = moved(0, 0, 0)},
                   {.name = "card", .local = moved(0.4, 0.3, 1)},
                   {.name = "behind", .local = moved(0, 0, 9)}};
    scene.objects = {{.node = 0, .mesh = 0}, {.node = 1, .mesh = 1}, {.node = 2, .mesh = 1}};
    finalise(scene);
    Settings s = settings_for(scene, {"map.resolution=512", "map.page_size=16", "light.count=2", "light.azimuth=20",
                                      "light.1.type=spot", "light.1.azimuth=-30", "camera.source=manual",
                                      "camera.azimuth=0", "camera.elevation=0", "camera.distance=6"});
    const ByteImage whole = picture(scene, s);
    s.map.paged = true;
    s.map.virtual_levels = 1;
    EXPECT_LE(different_pixels(whole, picture(scene, s), 1), 20u);
    s.lights[0].cast = s.lights[1].cast = false;
    EXPECT_GT(different_pixels(whole, picture(scene, s), 1), 200u) << "there is a shadow on the glass";
}

SI_TEST_IS(Repeated, PagesTest, PagesAreSharperThanAFixedMapOfMoreTexels);
// On two kilometres of terrain fewer pixels are wrong than with one map of 4096 texels, for far fewer drawn texels.
SI_TEST_IS(Later, PagesTest, PagesAreSharperThanAFixedMapOfMoreTexels);
TEST_F(PagesTest, PagesAreSharperThanAFixedMapOfMoreTexels) {
    const Scene scene = load_scene("landscape");
    Measurer measurer(renderer, 160, 90);
    Settings s = settings_for(
        scene, {"light.cascades=1", "map.resolution=4096", "bias.kind=slope", "bias.constant=0.1", "bias.normal=3"});
    const Classification fixed = measurer.classify(scene, s);
    set_all(s, {"map.virtual=true", "map.virtual_bias=-1"});
    const Classification paged = measurer.classify(scene, s);
    ASSERT_TRUE(paged.pages);
    const auto wrong = [](const Classification& j) { return j.error.false_shadow + j.error.false_light; };
    const double drawn = double(paged.pages->drawn_texels());
    EXPECT_LT(wrong(paged), 0.7 * wrong(fixed));
    EXPECT_LT(drawn, 0.5 * 4096 * 4096);
    EXPECT_GT(paged.pages->fixed_map_texels, 10 * drawn);
    std::printf("wrong %.4f %% of pixels by pages (%.2f M texels drawn; as sharp a map has %.3g M), %.4f %% by 4096²\n",
                100 * wrong(paged), 1e-6 * drawn, 1e-6 * paged.pages->fixed_map_texels, 100 * wrong(fixed));
}

}  // namespace
}  // namespace si
