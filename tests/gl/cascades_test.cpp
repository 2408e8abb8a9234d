// Tests drawn cascades: each pixel reads the map of its interval, a band mixes two maps, and nothing outside is read.
#include <algorithm>
#include <cmath>

#include "renderer/bias/account.h"
#include "renderer/bias/light_receiver.h"
#include "renderer/measure/measure.h"
#include "renderer/reference/reference_task.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class CascadesTest : public FrameTest {
protected:
    FloatImage visibility(const Scene& scene, const Settings& s, FrameResult* frame = nullptr) {
        FrameRequest request = small_request({.colour = false, .shadow_map = true, .visibility = true});
        const FrameResult f = renderer.render(scene, s, request);
        if (frame) *frame = f;
        return renderer.read_float(f.visibility, 1);
    }
};

TEST_F(CascadesTest, OneCascadeEqualsASingleMap) {
    const Scene scene = load_scene("stage");
    for (const Sets& plain : {Sets{}, {"light.fit=manual", "light.extent=4"}, {"light.type=point"}}) {
        const Settings s = settings_for(scene, plain);
        Settings with = s;
        set_all(with, {"light.split_lambda=0.9", "light.cascade_blend=0.7", "light.cascade_choice=map"});
        if (!plain.empty()) set_setting(with, "light.cascades", "4");  // no effect for these lights
        EXPECT_EQ(picture(scene, s), picture(scene, with));
    }
}

// The band mixes two maps by the share that the chooser returns. The test looks up the nearest texels itself.
TEST_F(CascadesTest, PixelsReadTheMapOfTheirCascade) {
    Scene near = load_scene("stage");
    for (const char* reversed : {"false", "true"}) {
        const Settings s = settings_for(near, {"light.cascades=3",
                                               "light.cascade_blend=0.5",
                                               "filter.kernel=hard",
                                               "map.resolution=128",
                                               {"map.reversed_z", reversed},
                                               "bias.normal_source=geometric"});
        FrameResult frame;
        const FloatImage drawn = visibility(near, s, &frame);
        const FittedLight& light = frame.lights[0];
        std::vector<FloatImage> maps;
        for (int v = 0; v < 3; ++v) maps.push_back(renderer.read_shadow_map(frame, 0, v));
        const ReferenceTask task = reference_task(renderer, near, s, small_request(), 0);
        const Receivers receivers = reconstruct_receivers(*task.geometry, task.camera, task.ids, task.raster, {});
        std::size_t compared = 0, mixed = 0, wrong = 0;
        for (int y = 0; y < drawn.height; ++y)
            for (int x = 0; x < drawn.width; ++x) {
                const Receiver& at = receivers.at(x, y);
                if (!at.hit()) continue;
                const ChosenView chosen = light.chooser.choose(light.views, at.position_ws);
                double wanted = 0;
                bool sure = true;
                for (const auto& [view, share] :
                     {std::pair{chosen.view, 1 - chosen.share}, {chosen.other, chosen.share}}) {
                    if (share == 0) continue;
                    FittedLight alone = light;
                    alone.views = {light.views[view]};
                    alone.chooser = {};
                    const LightReceiver r =
                        bias_breakdown(alone, s, frame.map_resolution,
                                       {at.position_ws, at.normal_ws, at.normal_ws, frame.camera.origin()},
                                       renderer.driver())
                            .receiver;
                    if (!(r.n_dot_l > 1e-3)) sure = false;
                    const glm::dvec2 texel = glm::dvec2(r.tap) * 128.0, part = glm::fract(texel);
                    const glm::ivec2 t(glm::clamp(texel, 0.0, 127.0));
                    const double stored = maps[view].at(t.x, 127 - t.y);
                    const double edge = std::min({part.x, part.y, 1 - part.x, 1 - part.y});
                    if (edge < 1e-3 || std::abs(stored - r.compared) < 1e-5) sure = false;
                    wanted += share * (s.map.reversed_z ? r.compared >= stored : r.compared <= stored);
                }
                if (!sure) continue;
                ++compared;
                mixed += chosen.share > 0 && wanted > 0 && wanted < 1;
                wrong += std::abs(drawn.at(x, y) - wanted) > 1e-3;
            }
        EXPECT_GT(compared, 10000u);
        EXPECT_GT(mixed, 20u);
        EXPECT_LE(wrong, compared / 2000) << "of " << compared;
    }
}

SI_TEST_IS(Repeated, CascadesTest, NothingIsReadOutsideAMap);
// A tap outside a map or past its far plane would show the outside mode's value.
SI_TEST_IS(Later, CascadesTest, NothingIsReadOutsideAMap);
TEST_F(CascadesTest, NothingIsReadOutsideAMap) {
    for (const char* name : {"stage", "landscape"}) {
        const Scene scene = load_scene(name);
        for (const char* elevation : {"90", "35"})
            for (const Sets& more : {Sets{"filter.kernel=pcf9", "bias.normal=6"},
                                     {"filter.kernel=pcf3", "map.blur_texels=3"},
                                     {"filter.kernel=pcf9", "light.cascade_choice=map"},
                                     {"camera.source=manual", "camera.elevation=8"}}) {
                Settings s = settings_for(
                    scene,
                    {"light.cascades=4", {"light.elevation", elevation}, "light.azimuth=90", "map.resolution=256"});
                set_all(s, more);
                const FloatImage lit = visibility(scene, s);
                s.map.outside = Outside::Unlit;
                const FloatImage unlit = visibility(scene, s);
                // The border's colour equals that of empty texels under either setting.
                EXPECT_EQ(differing_values(lit, unlit), 0u) << name << " " << elevation << " " << more[0].second;
            }
    }
}

SI_TEST_IS(Repeated, CascadesTest, FourMissLessThanOneAtTheSameResolution);
SI_TEST_IS(Later, CascadesTest, FourMissLessThanOneAtTheSameResolution);
TEST_F(CascadesTest, FourMissLessThanOneAtTheSameResolution) {
    const Scene scene = load_scene("landscape");
    for (const char* choice : {"interval", "map"}) {
        Settings s = settings_for(scene, {"light.cascades=1", "map.resolution=512", {"light.cascade_choice", choice}});
        Measurer measurer(renderer, 320, 180);
        const ErrorMetrics one = measurer.classify(scene, s).error;
        s.lights[0].cascades = 4;
        const Classification four = measurer.classify(scene, s);
        EXPECT_GT(one.mae, 0.005);
        EXPECT_LT(four.error.mae, 0.6 * one.mae) << choice;
        EXPECT_EQ(four.error.outside_map, 0) << choice;
        EXPECT_EQ(four.cost.map_texels, 4u * 512 * 512) << "cascades count as maps";
    }
}

TEST_F(CascadesTest, OnlyCascadesFollowTheCamera) {
    const Scene scene = load_scene("boxes");
    const auto map_state = [&](const Settings& s) {
        for (const PassInfo& p : renderer.render(scene, s, small_request()).passes)
            if (p.name.starts_with("shadow map 0")) return p.state;
        return PassState::Skipped;
    };
    for (const bool cascaded : {false, true}) {
        Settings s = settings_for(scene, {"camera.source=manual", {"light.cascades", cascaded ? "2" : "1"}});
        EXPECT_EQ(map_state(s), PassState::Drawn);
        s.camera.azimuth += 20;
        EXPECT_EQ(map_state(s), cascaded ? PassState::Drawn : PassState::Cached);
        s.shading.ambient = 0.1;
        EXPECT_EQ(map_state(s), PassState::Cached);
    }
}

SI_TEST_IS(Repeated, CascadesTest, TheProbeNamesTheCascade);
SI_TEST_IS(Later, CascadesTest, TheProbeNamesTheCascade);
TEST_F(CascadesTest, TheProbeNamesTheCascade) {
    const Scene scene = load_scene("stage");
    const Settings s = settings_for(scene, {"light.cascades=4", "light.cascade_blend=0.3"});
    FrameResult frame;
    const FloatImage drawn = visibility(scene, s, &frame);
    int blended = 0;
    for (int y = 20; y < 180; y += 12) {
        const Probe probe = renderer.probe(scene, s, small_request(), 160, y);
        if (!probe.hit) continue;
        const Probe::PerLight& p = probe.lights[0];
        const ChosenView chosen = frame.lights[0].chooser.choose(frame.lights[0].views, probe.position_ws);
        EXPECT_EQ(p.face, int(chosen.view));
        EXPECT_TRUE(p.view.starts_with("cascade " + std::to_string(p.face + 1) + " of 4")) << p.view;
        EXPECT_NE(p.verdict.find(p.view), std::string::npos);
        EXPECT_EQ(p.view.find("blended") != std::string::npos, chosen.share > 0);
        EXPECT_NEAR(p.visibility, drawn.at(160, y), 1e-6);
        EXPECT_NEAR(p.account.receiver.texel_m, frame.lights[0].views[chosen.view].texel_size(1, frame.map_resolution),
                    1e-12);
        blended += chosen.share > 0;
    }
    EXPECT_GT(blended, 0);
}

TEST_F(CascadesTest, ACameraThroughTheLightHasTheWholeScenesMap) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"camera.source=light"});
    const Camera one = renderer.render(scene, s, small_request()).camera;
    s.lights[0].cascades = 3;
    const FrameResult several = renderer.render(scene, s, small_request());
    EXPECT_EQ(several.camera.eye, one.eye);
    EXPECT_EQ(several.camera.projection(), one.projection());
    EXPECT_EQ(several.lights[0].views.size(), 3u);
}

}  // namespace
}  // namespace si
