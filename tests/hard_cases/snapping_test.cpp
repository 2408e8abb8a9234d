// Tests hard case 12, stabilised maps: no probe changes its texel as the camera turns or moves by fractions of a
// texel.
#include <random>

#include "renderer/settings/splits.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/cascades/cascades.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/stability.h"

namespace si {
namespace {

constexpr int kResolution = 512;

/// Texel of a probe: its view, its centre across the light in metres, and the probe's distance from its border in
/// texels.
struct Texel {
    std::size_t view = 0;
    glm::dvec2 middle_m{0};
    double size_m = 0, to_border = 0;
};

Texel texel_of(const FittedLight& light, const glm::dvec3& probe, const glm::dvec3& shader_origin) {
    const ChosenView chosen = light.chooser.choose(light.views, probe);
    const LightView& view = light.views[chosen.view];
    const glm::dvec2 at = glm::dvec2(test::uvdw(view, probe)) * double(kResolution), part = glm::fract(at);
    const glm::dvec3 middle = view.position_ws((glm::floor(at) + 0.5) / double(kResolution), 0) - shader_origin;
    return {chosen.view,
            {glm::dot(middle, view.axes[0]), glm::dot(middle, view.axes[1])},
            view.texel_size(1, kResolution),
            std::min({part.x, part.y, 1 - part.x, 1 - part.y})};
}

struct Walk {
    std::size_t compared = 0, flips = 0;
    int widths = 0;  ///< changes of a map's width
};

/// Makes 1000 steps, with a full turn in 500. Each step moves the view frustum by less than a texel or turns it by
/// less than a degree.
Walk walk(const glm::dvec3& at, const char* fit, int cascades, double azimuth, double elevation) {
    const Scene scene = test::blocks_on_ground(at, 1);
    Settings s;
    set_setting(s, "light.fit", fit);
    s.map.resolution = kResolution;
    LightSettings& l = s.lights[0];
    l.cascades = cascades;
    l.azimuth = azimuth;
    l.elevation = elevation;
    l.split = Split::Logarithmic;
    CameraSettings& c = s.camera;
    c.source = CameraSource::Manual;
    c.target_x = at.x - 10;
    c.target_y = at.y + 1;
    c.target_z = at.z - 5;
    c.distance = 9;
    c.elevation = 12;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<glm::dvec3> probes;
    for (int i = 0; i < 60; ++i) probes.push_back(at + glm::dvec3(38 * unit(random), 0, 38 * unit(random)));
    std::vector<Texel> before;
    std::vector<double> widths;
    Walk out;
    for (int step = 0; step < 1500; ++step) {
        const Camera camera = make_camera(scene, s, 16.0 / 9);
        const FittedLight light = fit_lights(scene, s, &camera)[0];
        std::vector<double> now_wide;
        for (const LightView& view : light.views) now_wide.push_back(view.half_extent());
        out.widths += !widths.empty() && now_wide != widths;
        widths = now_wide;
        std::vector<Texel> now;
        for (const glm::dvec3& p : probes) now.push_back(texel_of(light, p, at));
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (now[i].view != before[i].view || std::min(now[i].to_border, before[i].to_border) < 1e-3) continue;
            ++out.compared;
            out.flips += glm::distance(now[i].middle_m, before[i].middle_m) > 1e-3 * now[i].size_m;
        }
        before = std::move(now);
        const double texel = light.views[0].texel_size(1, kResolution);
        if (step < 1000) {
            c.target_x += 0.6 * unit(random) * texel + 0.2 * texel;
            c.target_z += 0.6 * unit(random) * texel;
        } else
            c.azimuth += 0.72;
    }
    return out;
}

TEST(HardCase12, NoProbeChangesItsTexel) {
    for (const glm::dvec3& at : {glm::dvec3(0), glm::dvec3(115, 0, 3), glm::dvec3(-1e5, 40, 2e4)})
        for (const int cascades : {1, 4}) {
            const Walk steady = walk(at, "stabilised", cascades, cascades == 1 ? -40 : 90, cascades == 1 ? 45 : 60);
            test::expect_within_limit(12, double(steady.flips));
            EXPECT_EQ(steady.widths, 0);
            EXPECT_GT(steady.compared, 80000u);
        }
    const Walk tight = walk({0, 0, 0}, "view", 4, 90, 60);
    test::expect_fault(12, double(tight.flips) / double(tight.compared));
}

}  // namespace
}  // namespace si
