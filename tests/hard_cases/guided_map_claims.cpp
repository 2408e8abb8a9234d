// What the sentences of the guided presets claim about the map's borders and its depths, counted.
#include <algorithm>
#include <cmath>

#include "app/session/presets.h"
#include "app/session/session.h"
#include "renderer/measure/measure.h"
#include "renderer/scenes/builtin.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/hard_cases/guided_claims.h"
#include "tests/support/guided.h"

namespace si::test {
namespace {

/// A little beyond the border, out of reach of rounding and of the normal offset.
bool beside(const glm::dvec4& p) {
    constexpr double kPad = 0.01;
    return p.x < -kPad || p.x > 1 + kPad || p.y < -kPad || p.y > 1 + kPad;
}
bool within(const glm::dvec4& p) {
    constexpr double kPad = 0.01;
    return p.x > kPad && p.x < 1 - kPad && p.y > kPad && p.y < 1 - kPad;
}

double lit_beside(const std::string& preset) {
    return Guided(preset).lit_where([](const glm::dvec4& p, bool shadow) { return beside(p) && !shadow; });
}

double lit_beyond_far(const std::string& preset) {
    return Guided(preset).lit_where([](const glm::dvec4& p, bool) { return p.z > 1.01 && within(p); });
}

/// Mean grey of what the map viewer shows of the scene, 0 to 1.
double mean_grey(const Guided& g) {
    EXPECT_EQ(g.map_view.width, g.shot.maps.at(0).width);
    return g.mean_of_drawn([&](int x, int y) {
        return g.map_view.data[(std::size_t(y) * std::size_t(g.map_view.width) + std::size_t(x)) * 4] / 255.0;
    });
}

/// Share of the picture's pixels of the kind `is` says.
double share(const ByteImage& image, bool (*is)(int r, int g, int b)) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.data.size(); i += 4)
        count += is(image.data[i], image.data[i + 1], image.data[i + 2]);
    return image.data.empty() ? -1 : double(count) / (double(image.data.size()) / 4);
}

/// A preset with some settings changed, drawn anew and held against the truth.
Classification classified(const std::string& preset, const std::vector<std::string>& changes = {}) {
    const Preset p = load_preset(preset);
    Settings s = p.settings;
    for (const std::string& change : changes) apply_set(s, change);
    return Measurer(hard_renderer(), 160, 90).classify(load_scene(p.scene), s);
}

/// Pages of a preset once more, after a change.
PageFacts pages_after(const std::string& preset, const std::vector<std::string>& changes) {
    const Preset p = load_preset(preset);
    const Scene scene = load_scene(p.scene);
    const FrameRequest request{.width = 160, .height = 90};
    Settings s = p.settings;
    hard_renderer().render(scene, s, request);
    s.camera = manual_camera(scene, s, 16.0 / 9);
    for (const std::string& change : changes) apply_set(s, change);
    return hard_renderer().render(scene, s, request).pages.value();
}

double wrong(const Classification& j) {
    return j.error.false_light + j.error.false_shadow;
}

}  // namespace

const Claims& guided_map_claims() {
    static const Claims all = {
        // ---- Virtual maps
        {"virtual-map",
         [] {
             const Classification pages = classified("virtual-map"),
                                  whole = classified("virtual-map", {"map.virtual=false"});
             EXPECT_LT(wrong(pages), 0.75 * wrong(whole));
             EXPECT_EQ(pages.error.outside_map, 0);
             EXPECT_LT(pages.pages->drawn_texels(), 4096u * 4096u);
             const PageFacts turned = pages_after("virtual-map", {"camera.azimuth=-19"});
             EXPECT_GT(turned.kept, turned.drawn);
         }},
        {"full-page-pool",
         [] {
             const Classification full = classified("full-page-pool"),
                                  room = classified("full-page-pool", {"map.page_pool=1024"});
             EXPECT_GT(wrong(full), 1.3 * wrong(room));
             EXPECT_GT(full.pages->coarser, 10);
             EXPECT_LE(full.pages->drawn, 8);
             EXPECT_EQ(full.error.outside_map, 0);
             EXPECT_EQ(room.pages->coarser, 0);
             EXPECT_TRUE(std::any_of(full.notes.begin(), full.notes.end(), [](const std::string& note) {
                 return note.find("map.page_pool") != std::string::npos;
             }));
             EXPECT_EQ(pages_after("full-page-pool", {"map.page_pool=1024", "light.azimuth=-41"}).kept, 0);
         }},
        // ---- Outside of the map
        {"repeat",
         [] {
             EXPECT_LT(lit_beside("repeat"), 0.75) << "copies of shadows and a dark side";
             EXPECT_GT(lit_beside("repeat"), 0.2);
             const ErrorMetrics e = Guided("repeat").error();
             EXPECT_GT(e.outside_false_shadow, 0.95 * e.false_shadow);
         }},
        {"clamp-to-border", [] { EXPECT_EQ(lit_beside("clamp-to-border"), 1); }},
        {"outside-lit",
         [] {
             EXPECT_EQ(lit_beside("outside-lit"), 1);
             const Guided g("outside-lit", {}, 320, 180), whole("outside-lit", {"light.extent=2.6"}, 320, 180);
             const Guided::Nodes floor{"Boxes/Floor"};
             for (const char* cut : {"Boxes/Tower", "Boxes/Flat"})
                 EXPECT_GT(g.wrongly_lit(floor, {cut}), whole.wrongly_lit(floor, {cut}) + 0.1) << cut;
             const ErrorMetrics e = g.error();
             EXPECT_GT(e.outside_false_light, 0.9 * e.false_light);
         }},
        {"outside-unlit",
         [] {
             EXPECT_EQ(lit_beside("outside-unlit"), 0);
             const ErrorMetrics e = Guided("outside-unlit").error();
             EXPECT_GT(e.outside_false_shadow, 0.95 * e.false_shadow);
             EXPECT_GT(Guided("outside-unlit").lit_where([](const glm::dvec4& p, bool shadow) {
                 return within(p) && !shadow;
             }),
                       0.95);
         }},
        {"far-plane",
         [] {
             EXPECT_EQ(lit_beyond_far("far-plane"), 0);
             const ErrorMetrics e = Guided("far-plane").error();
             EXPECT_GT(e.outside_false_shadow, 0.95 * e.false_shadow);
         }},
        {"far-guard",
         [] {
             EXPECT_EQ(lit_beyond_far("far-guard"), 1);
             const ErrorMetrics e = Guided("far-guard").error();
             EXPECT_GT(e.outside_false_light, 0.95 * e.false_light) << "the shadows that fell there";
             EXPECT_EQ(e.outside_false_shadow, 0);
         }},
        {"near-cut-off",
         [] {
             const Guided g("near-cut-off");
             for (const char* lost : {"Boxes/Standing", "Boxes/Hovering", "Boxes/Leaning"})
                 EXPECT_GT(g.wrongly_lit({"Boxes/Floor", "Boxes/Tower"}, {lost}), 0.85) << lost;
             EXPECT_LT(g.wrongly_lit({"Boxes/Floor"}, {"Boxes/Tower"}), 0.1);
             const ErrorMetrics e = g.error();
             EXPECT_GT(e.lost_false_light, 0.9 * e.false_light);
         }},
        {"far-cut-off",
         [] {
             const auto shadows = [](bool beyond) {
                 return Guided("far-cut-off").lit_where([=](const glm::dvec4& p, bool shadow) {
                     return shadow && (beyond ? p.z > 1.01 : p.z < 0.99);
                 });
             };
             EXPECT_EQ(shadows(true), 1) << "none is left";
             EXPECT_LT(shadows(false), 0.3) << "the others stay";
             const ErrorMetrics e = Guided("far-cut-off").error();
             EXPECT_GT(e.outside_false_light, 0.85 * e.false_light);
         }},
        // ---- Depth
        {"orthographic",
         [] { EXPECT_NEAR(mean_grey(Guided("orthographic")), 0.5, 0.1) << "an even ramp about the light's distance"; }},
        {"perspective",
         [] {
             const Guided g("perspective"), parallel("orthographic");
             EXPECT_GT(mean_grey(g), 0.9) << "nearly white all over";
             EXPECT_GT(g.dark(), 1.1 * parallel.dark()) << "shadows spread";
             const FittedLight& light = g.shot.light();
             EXPECT_TRUE(light.views.at(0).curve.perspective);
         }},
        {"linear-view",
         [] {
             const Guided linear("linear-view"), raw("perspective");
             EXPECT_EQ(linear.shot.visibility.data, raw.shot.visibility.data) << "only the view differs";
             EXPECT_LT(mean_grey(linear), mean_grey(raw) - 0.35);
         }},
        {"ninety-ten",
         [] {
             const Guided g("ninety-ten");
             const double red = share(g.map_view, [](int r, int gr, int b) { return r > gr + 20 && r > b + 20; });
             const double green = share(g.map_view, [](int r, int gr, int b) { return gr > r + 20 && gr > b + 20; });
             const double blue = share(g.map_view, [](int r, int gr, int b) { return b > r + 20 && b > gr + 20; });
             // Depth is linear in the picture's height, of which the plane takes 0.92; the rest is the background's
             // farthest depth.
             EXPECT_NEAR(red / (red + green), 0.9 / 0.925, 0.01);
             EXPECT_NEAR(red, 0.9 * 0.92, 0.02);
             EXPECT_GT(blue, 0.05);
             EXPECT_NEAR(red + green + blue, 1, 0.01);
         }},
        {"depth-as-colour",
         [] {
             const Guided g("depth-as-colour"), buffer("depth-as-colour", {"map.format=d32f"});
             EXPECT_EQ(differing_share(g.shot, buffer.shot), 0);
             EXPECT_LT(g.wrongly_dark(), 0.02);
         }},
        {"depth-16-bit",
         [] {
             const Guided::Nodes floor{"Boxes/Floor"};
             const Guided g("depth-16-bit");
             EXPECT_GT(g.wrongly_dark(floor), 0.02);
             const ErrorMetrics e = g.error();
             EXPECT_GT(e.acne, 0.7 * e.false_shadow);
             EXPECT_LT(Guided("depth-16-bit", {"map.format=d24"}).wrongly_dark(floor), 0.003);
         }},
        {"standard-depth",
         [] {
             const Guided g("standard-depth");
             EXPECT_GT(g.wrongly_dark(), 0.2);
             const ErrorMetrics e = g.error();
             EXPECT_GT(e.acne, 0.95 * e.false_shadow);
         }},
        {"reversed-depth",
         [] {
             const Guided g("reversed-depth");
             EXPECT_LT(g.wrongly_dark(), 0.01);
             EXPECT_LT(g.error().acne, 0.001);
         }},
        // ---- Together
        {"good-defaults",
         [] {
             // The tree apart, whose leaves the truth sees whole.
             const Guided g("good-defaults", {}, 240, 135);
             EXPECT_LT(g.wrongly_dark({"Stage/Ramp", "Stage/Sphere", "Stage/Pedestal"}), 0.02) << "no acne";
             EXPECT_LT(g.wrongly_lit({"Stage/Ground"}, {"Stage/Sphere", "Stage/Pedestal"}), 0.1)
                 << "feet on the ground";
             EXPECT_GT(g.grey(), 0.01) << "soft edges";
             EXPECT_LT(g.error().acne, 0.005) << "all objects, the tree with them";
             Settings chosen = g.settings;
             chosen.lights[0].azimuth = Settings{}.lights[0].azimuth;
             chosen.lights[0].elevation = Settings{}.lights[0].elevation;
             EXPECT_EQ(chosen, Settings{}) << "all but the light is as the program starts";
         }},
    };
    return all;
}

}  // namespace si::test
