// Tests caching by random walks: after any steps of camera, casters, lights and evictions, a renderer draws the bytes
// of a new renderer.
#include <fmt/format.h>

#include <cstdlib>
#include <random>

#include "renderer/scene/animation.h"
#include "renderer/settings/filters.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/combinations.h"
#include "tests/support/traits.h"

namespace si {
namespace {

/// Scene, its settings, and the changes of a step.
struct Stop {
    Scene scene;
    Settings settings;
    int width = 64, height = 48;
};

class RandomWalk {
public:
    explicit RandomWalk(unsigned seed) : random_(seed) {
        for (const char* name : {"boxes", "figures"}) {
            Stop stop{.scene = load_scene(name), .settings = {}};
            stop.settings = settings_for(stop.scene, {"map.resolution=256", "camera.source=manual", "light.fit=scene"});
            const Bounds& b = stop.scene.bounds;
            CameraSettings& c = stop.settings.camera;
            set_target(c, b.centre());
            stops_.push_back(std::move(stop));
        }
    }

    Stop& here() { return stops_[at_]; }

    /// Changes one thing. @returns its description
    std::string step() {
        if (moving_ >= 0 && below(3) > 0) return move(here().scene.nodes[std::size_t(moving_)]);
        moving_ = -1;
        Settings& s = here().settings;
        const int light = below(s.light_count);
        switch (below(16)) {
            case 0:
                at_ = std::size_t(below(int(stops_.size())));
                return "another scene";
            case 1:
            case 2:
                s.camera.azimuth += between(-40, 40);
                s.camera.elevation = between(5, 85);
                return "camera turned";
            case 3:
                s.camera.distance = between(3, 25);
                s.camera.target_x += between(-1, 1);
                return "camera moved";
            case 4:
                return move_caster();
            case 5:
                return pose_scene();
            case 6: {
                const std::string& path = any_node().path;
                s.objects[path].cast = !s.objects[path].cast;
                return path + " casts or not";
            }
            case 7:
                s.lights[std::size_t(light)].azimuth += between(-50, 50);
                s.lights[std::size_t(light)].elevation = between(0, 1) < 0.2 ? 90 : between(10, 90);
                return "light turned";
            case 8:
                s.lights[std::size_t(light)].cast = !s.lights[std::size_t(light)].cast;
                return "light casts or not";
            case 9:
                return set(fmt::format("light.{}.type", light), {"directional", "spot", "point"});
            case 10:
                return set("light.count", {"1", "2", "3"});
            case 11:
                return set("map.resolution", {"64", "128", "256"});
            case 12:
                return set("map.virtual", {"true", "false"}) + set("map.page_size", {"16", "32"}) +
                       set("map.page_pool", {"16", "40", "200"});
            case 13:
                return set("filter.kernel",
                           {"hard", "pcf3", "pcf7", "gauss7", "poisson", "pcss", "smrt", "vsm", "savsm", "evsm4"});
            case 14:
                return set("bias.kind", {"adaptive", "receiver-plane", "slope"}) +
                       set("map.reversed_z", {"true", "false"}) + set("map.format", {"d16", "d32f", "linear"});
            default:
                return set("light.cascades", {"1", "3"}) + set("shading.separate_visibility", {"true", "false"}) +
                       set("light.fit", {"casters", "scene", "scene", "view", "stabilised"}) +
                       set("map.blur_texels", {"0", "0", "2"});
        }
    }

private:
    std::mt19937 random_;
    std::vector<Stop> stops_;
    std::size_t at_ = 0;
    int moving_ = -1;  ///< node moved by the last step, which may move again

    // The standard library's distributions differ between implementations.
    int below(int n) { return int(random_() % unsigned(n)); }
    double between(double lo, double hi) { return lo + (hi - lo) * double(random_() % 65536) / 65536; }

    Node& any_node() { return here().scene.nodes[std::size_t(below(int(here().scene.nodes.size())))]; }

    std::string set(const std::string& key, const std::vector<const char*>& values) {
        const char* value = values[std::size_t(below(int(values.size())))];
        set_setting(here().settings, key, value);
        return key + " = " + value + "; ";
    }
    std::string move_caster() {
        Node& node = any_node();
        moving_ = int(&node - here().scene.nodes.data());
        return move(node);
    }
    std::string move(Node& node) {
        node.local[3] += glm::dvec4(between(-0.5, 0.5), between(0, 0.3), between(-0.5, 0.5), 0);
        refresh(here().scene);
        return node.path + " moved";
    }
    std::string pose_scene() {
        if (!here().scene.rig || here().scene.rig->animations.empty()) return move_caster();
        pose(here().scene, below(int(here().scene.rig->animations.size())), between(0, 3));
        return "animated";
    }
};

class RandomWalkTest : public FrameTest {
protected:
    struct Drawn {
        ByteImage picture, map;
        std::vector<float> visibility;
        bool operator==(const Drawn&) const = default;
    };
    int kept_apart = 0;  ///< maps in which only moving casters were drawn

    Drawn draw(Renderer& by, Stop& stop, FrameRequest request) {
        request.width = stop.width;
        request.height = stop.height;
        request.outputs.shadow_map = true;
        Drawn out;
        const FrameResult frame = by.render(stop.scene, stop.settings, request);
        for (const PassInfo& pass : frame.passes)
            for (const PartInfo& part : pass.parts)
                kept_apart += part.by == Optimisation::StaticCasterCache && part.left_out > 0;
        out.picture = by.read_colour(frame.colour);
        if (frame.map_view.texture) out.map = by.read_colour(frame.map_view);
        request.outputs = {.colour = false, .visibility = true};
        out.visibility = by.read_float(by.render(stop.scene, stop.settings, request).visibility, 1).data;
        return out;
    }

    Renderer other;  ///< draws everything again

    /// @param checked number of steps between comparisons with a new renderer
    void walk(unsigned seed, int steps, int checked) {
        RandomWalk way(seed);
        std::string taken;
        for (int i = 1; i <= steps; ++i) {
            taken += way.step() + "\n";
            const Drawn kept = draw(renderer, way.here(), {.force = false});
            Drawn fresh = draw(other, way.here(), {.force = true});
            if (i % checked == 0) {
                HeadlessContext fresh_context;
                Renderer cold;
                fresh = draw(cold, way.here(), {});
            }
            context.make_current();
            ASSERT_EQ(kept.picture == fresh.picture, true) << "picture, seed " << seed << ", step " << i << "\n"
                                                           << taken;
            ASSERT_EQ(kept.map == fresh.map, true) << "map, seed " << seed << ", step " << i << "\n" << taken;
            ASSERT_EQ(kept.visibility == fresh.visibility, true)
                << "visibility, seed " << seed << ", step " << i << "\n"
                << taken;
            taken = fmt::format("... {} steps\n", i) + taken.substr(taken.size() > 2000 ? taken.size() - 2000 : 0);
        }
    }
};

SI_TESTS_ARE(Repeated, RandomWalkTest);
SI_TESTS_ARE(DriverIndependent, RandomWalkTest);
// One step changes one thing; two at once may keep the number of maps and swap their lights.
TEST_F(RandomWalkTest, MapsReplacedByAnotherLightAreDrawnAgain) {
    const Scene scene = load_scene("boxes");
    Stop stops[2];
    for (int i = 0; i < 2; ++i) {
        stops[i].scene = scene;
        stops[i].settings = settings_for(
            scene,
            {"light.count=2", "light.1.azimuth=200", {fmt::format("light.{}.cast", i), "false"}, "map.resolution=128"});
    }
    for (const int i : {0, 1, 0, 1})
        EXPECT_EQ(draw(renderer, stops[i], {}) == draw(other, stops[i], {.force = true}), true) << i;
}

SI_TEST_IS(Product, RandomWalkTest, CachedFramesEqualColdOnesAfterAnySteps);
SI_TEST_IS(Slow, RandomWalkTest, CachedFramesEqualColdOnesAfterAnySteps);
/// SI_LONG_WALK sets the number of seeds, of 1000 steps each.
TEST_F(RandomWalkTest, CachedFramesEqualColdOnesAfterAnySteps) {
    const char* seeds = std::getenv("SI_LONG_WALK");
    if (!seeds) {
        const bool full = test::full_products();
        walk(1, full ? 250 : 125, 25);
        EXPECT_GE(kept_apart, full ? 5 : 1) << "the walk lacks maps drawn over static casters";
        return;
    }
    for (int seed = 2; seed < 2 + std::atoi(seeds) && !HasFatalFailure(); ++seed) walk(unsigned(seed), 1000, 20);
}

}  // namespace
}  // namespace si
