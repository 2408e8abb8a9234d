// What the sentences of the guided presets claim about maps that follow the camera, counted.
#include <algorithm>
#include <cmath>

#include "app/session/presets.h"
#include "app/session/session.h"
#include "renderer/measure/measured_error.h"
#include "renderer/scenes/builtin.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/hard_cases/guided_claims.h"
#include "tests/support/hard_case.h"

namespace si::test {
namespace {

/// By how much of a texel, at most, the texels of a preset's maps slide over the ground as its camera turns a little:
/// 0.5 is as much as can be. Maps that change their width count as that.
double slides(const std::string& key) {
    const Preset preset = load_preset(key);
    const Scene scene = load_scene(preset.scene);
    Settings s = preset.settings;
    s.camera = manual_camera(scene, s);
    std::vector<LightView> before;
    double most = 0;
    for (int i = 0; i < 8; ++i) {
        const Camera camera = make_camera(scene, s, 16.0 / 9);
        const std::vector<LightView> now = fit_lights(scene, s, &camera)[0].views;
        for (std::size_t v = 0; v < before.size(); ++v) {
            if (before[v].half_width != now[v].half_width) return 0.5;
            const glm::dvec3 moved = glm::transpose(now[v].axes) * (now[v].eye - before[v].eye);
            const glm::dvec2 texels = glm::dvec2(moved) / now[v].texel_size(1, s.map.resolution);
            const glm::dvec2 part = glm::abs(texels - glm::round(texels));
            most = std::max({most, part.x, part.y});
        }
        before = now;
        s.camera.azimuth += 0.7;
    }
    return most;
}

/// A preset as it is drawn, without the rays against every triangle that Guided traces: on land they take long.
struct Drawn {
    Scene scene;
    Settings settings;
    Shot shot;
    explicit Drawn(const std::string& key, const std::vector<std::string>& changes = {}) {
        const Preset preset = load_preset(key);
        scene = load_scene(preset.scene);
        settings = preset.settings;
        for (const std::string& change : changes) apply_set(settings, change);
        shot = shoot(scene, settings, 160, 90);
    }
    /// Pixels between shadow and light.
    std::ptrdiff_t grey() const {
        return std::ranges::count_if(shot.visibility.data, [](float v) { return v > 0.02f && v < 0.98f; });
    }
    double mae() const {
        ReferenceCache cache;
        return measure_error(hard_renderer(), scene, settings, {.width = 160, .height = 90}, 0, {}, cache).metrics.mae;
    }
    double depths_m() const {
        double sum = 0;
        for (const LightView& view : shot.light().views) sum += view.curve.far - view.curve.near;
        return sum;
    }
};

}  // namespace

const Claims& guided_view_claims() {
    static const Claims all = {
        {"cascade-seams",
         [] {
             // A kernel of one texel greys nothing but where two maps that are mixed differ.
             const Drawn cut("cascade-seams"), mixed("cascade-seams", {"light.cascade_blend=0.3"});
             EXPECT_EQ(cut.grey(), 0);
             EXPECT_GT(mixed.grey(), 5);
             for (std::size_t i = 0; i < 2; ++i)
                 EXPECT_GT(cut.shot.view(i + 1).half_width, 1.3 * cut.shot.view(i).half_width);
         }},
        {"split-even",
         [] {
             const Drawn even("split-even"), ratio("split-even", {"light.split=logarithmic"});
             EXPECT_GT(even.shot.view(0).half_width, 4 * ratio.shot.view(0).half_width);
             EXPECT_GT(even.mae(), 1.1 * ratio.mae());
             const auto& spans = even.shot.light().chooser.spans;
             EXPECT_NEAR(spans[3].ends - spans[2].ends, spans[1].ends - spans[0].ends, 1e-6 * spans[3].ends);
         }},
        {"split-by-ratio",
         [] {
             const Drawn g("split-by-ratio");
             const auto& views = g.shot.light().views;
             const auto& spans = g.shot.light().chooser.spans;
             double least = 1e300, most = 0;
             for (std::size_t i = 0; i < views.size(); ++i) {
                 const double share = views[i].half_width / spans[i].ends;
                 least = std::min(least, share);
                 most = std::max(most, share);
                 if (i > 1) {
                     EXPECT_NEAR(spans[i].ends / spans[i - 1].ends, spans[1].ends / spans[0].ends, 1e-6);
                 }
             }
             EXPECT_LT(most, 4 * least) << "texels cover about as many pixels in each";
             const Drawn even("split-by-ratio", {"light.split=uniform"});
             EXPECT_GT(even.shot.view(0).half_width, 4 * g.shot.view(0).half_width);
         }},
        {"shimmering",
         [] {
             EXPECT_GT(slides("shimmering"), 0.2);
             EXPECT_LT(slides("stabilised"), 1e-6);
         }},
        {"stabilised",
         [] {
             EXPECT_LT(slides("stabilised"), 1e-6);
             const Drawn steady("stabilised"), tight("stabilised", {"light.fit=view"});
             EXPECT_GT(steady.mae(), 1.2 * tight.mae()) << "larger texels";
         }},
        {"depths-measured",
         [] {
             const Drawn measured("depths-measured"), boxes("depths-measured", {"light.depth_bounds=boxes"});
             EXPECT_LT(measured.mae(), 0.9 * boxes.mae());
             EXPECT_LT(boxes.shot.light().chooser.spans[0].ends, measured.shot.frame.seen_m.value().from_m)
                 << "the nearest map of the boxes holds nothing";
         }},
        {"lispsm",
         [] {
             const Drawn warped("lispsm"), even("lispsm", {"light.fit=view"});
             const TexelSize sizes = warped.shot.view().texel_size_range(1024);
             EXPECT_GT(sizes.longest, 100 * sizes.shortest);
             EXPECT_LT(sizes.shortest, 0.25 * even.shot.view().texel_size(1, 1024));
             EXPECT_LT(warped.mae(), 0.65 * even.mae());
         }},
        {"lispsm-duel",
         [] {
             // By how much w grows over the map: near texels are finer by that, and by its square.
             const auto warps = [](const Drawn& d) { return 1 / (1 + d.shot.view().curve.warp->rise); };
             const Drawn duel("lispsm-duel"), before("lispsm"), even("lispsm-duel", {"light.fit=view"});
             EXPECT_LT(warps(duel), 0.5 * warps(before)) << warps(before);
             const auto at_the_feet = [](const Drawn& d) {
                 const LightView& view = d.shot.view();
                 return view.texel_size_at(view.position_ws({0.5, 0}, 0), 1024).longest;
             };
             EXPECT_GT(at_the_feet(duel), 3 * at_the_feet(before)) << at_the_feet(before);
             EXPECT_GT(duel.mae(), 3 * before.mae());
             EXPECT_GT(duel.mae(), 0.65 * even.mae()) << "little is gained";
         }},
        {"pancaking",
         [] {
             const Drawn flat("pancaking"), whole("pancaking", {"light.near_far=fitted"});
             EXPECT_LT(flat.depths_m(), 0.6 * whole.depths_m());
             EXPECT_LT(differing_share(flat.shot, whole.shot), 1e-3);
             EXPECT_GT(shadow_share(flat.shot), 0.02);
         }},
    };
    return all;
}

}  // namespace si::test
