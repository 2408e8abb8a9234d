// What the sentences of the guided presets claim about bias, culling and filters, counted.
#include "tests/hard_cases/guided_claims.h"
#include "tests/support/guided.h"

namespace si::test {

const Claims& guided_surface_claims() {
    static const Claims all = {
        // ---- Acne and bias
        {"acne",
         [] {
             const Guided g("acne");
             EXPECT_GT(g.wrongly_dark(), 0.25);
             const ErrorMetrics e = g.error();
             EXPECT_GT(e.acne, 0.95 * e.false_shadow);
         }},
        {"constant-bias",
         [] {
             const Guided g("constant-bias");
             EXPECT_GT(g.wrongly_dark({"Room/Back wall"}), 0.15);
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.01);
             EXPECT_LT(g.wrongly_dark({"Room/Ball"}), 0.10);
             const ErrorMetrics e = g.error();
             EXPECT_GT(e.acne, 0.9 * e.false_shadow);
             EXPECT_LT(share(e, Artefact::PeterPanning), 0.001);
         }},
        {"slope-bias",
         [] {
             const Guided g("slope-bias");
             EXPECT_LT(g.wrongly_dark({"Room/Back wall"}), 0.005);
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.01);
             EXPECT_LT(g.wrongly_lit({"Room/Floor"}), 0.15) << "the feet keep their shadows";
             const ErrorMetrics e = g.error();
             EXPECT_LT(e.acne, 0.001);
             EXPECT_LT(e.bias_false_light, 0.001);
         }},
        {"normal-offset",
         [] {
             const Guided g("normal-offset");
             EXPECT_LT(g.wrongly_dark({"Room/Back wall"}), 0.005);
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.02);
             EXPECT_LT(g.wrongly_lit({"Room/Floor"}), 0.15);
             EXPECT_GT(Guided("normal-offset", {"bias.normal=0"}).wrongly_dark(), 0.2) << "it is the offset that helps";
             const ErrorMetrics e = g.error();
             EXPECT_LT(e.acne, 0.001);
             EXPECT_GT(share(e, Artefact::PeterPanningOffset) + share(e, Artefact::OffsetShadow),
                       0.7 * (e.false_light + e.false_shadow))
                 << "what is wrong is that edges moved";
         }},
        {"receiver-plane",
         [] {
             const Guided g("receiver-plane");
             EXPECT_LT(g.wrongly_dark({"Room/Back wall"}), 0.005);
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.01);
             EXPECT_LT(g.wrongly_lit({"Room/Floor"}), 0.15) << "shadows start at the feet";
             EXPECT_GT(Guided("receiver-plane", {"bias.kind=constant"}).wrongly_dark(), 0.4) << "it is the plane";
             const ErrorMetrics e = g.error();
             EXPECT_LT(e.false_shadow, 0.01);
             EXPECT_EQ(e.bias_false_light, 0);
             EXPECT_EQ(e.artefacts[std::size_t(Artefact::PeterPanningOffset)], 0u);
         }},
        {"normal-offset-mapped",
         [] {
             const Guided frayed("normal-offset-mapped", {}, 320, 180);
             const Guided cured("normal-offset-mapped", {"bias.normal_source=geometric"}, 320, 180);
             EXPECT_GT(frayed.edges({"Relief/Floor"}), 1.3 * cured.edges({"Relief/Floor"}));
             const ErrorMetrics e = frayed.error();
             EXPECT_GT(share(e, Artefact::PeterPanningOffset) + share(e, Artefact::OffsetShadow),
                       0.85 * (e.false_light + e.false_shadow));
         }},
        {"slope-bias-mapped",
         [] {
             const Guided::Nodes floor{"Relief/Floor"};
             const Guided g("slope-bias-mapped");
             EXPECT_GT(g.wrongly_dark(floor), 0.02);
             const ErrorMetrics e = g.error();
             EXPECT_GT(e.acne, 0.85 * e.false_shadow);
             EXPECT_LT(Guided("slope-bias-mapped", {"bias.normal_source=geometric"}).wrongly_dark(floor), 0.002);
         }},
        {"peter-panning",
         [] {
             const Guided g("peter-panning");
             EXPECT_GT(g.wrongly_lit({"Room/Floor"}), 0.10);
             EXPECT_GT(g.wrongly_lit({"Room/Floor"}), 3 * Guided("front-culling").wrongly_lit({"Room/Floor"}));
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.01);
             const ErrorMetrics e = g.error();
             EXPECT_GT(share(e, Artefact::PeterPanning), 0.75 * e.false_light) << "edges are the rest";
             EXPECT_EQ(e.artefacts[std::size_t(Artefact::PeterPanningOffset)], 0u);
         }},
        {"too-much-normal-offset",
         [] {
             const Guided g("too-much-normal-offset");
             EXPECT_GT(g.wrongly_lit({"Boxes/Floor"}, {"Boxes/Flat"}), 0.9) << "the slab's shadow is gone";
             EXPECT_GT(g.wrongly_lit({"Boxes/Standing"}, {"Boxes/Leaning"}), 0.5) << "light behind the board";
             EXPECT_LT(g.wrongly_lit({"Boxes/Floor"}, {"Boxes/Tower"}), 0.7);
             EXPECT_GT(g.wrongly_lit({"Boxes/Floor"}, {"Boxes/Tower"}), 0.1);
             const ErrorMetrics e = g.error();
             EXPECT_GT(share(e, Artefact::PeterPanningOffset), 0.95 * e.false_light);
         }},
        // ---- Front-face culling
        {"front-culling",
         [] {
             const Guided g("front-culling");
             EXPECT_LT(g.wrongly_lit({"Room/Floor"}), 0.08);
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.02);
             const ErrorMetrics e = g.error(), biased = Guided("peter-panning").error();
             EXPECT_LT(e.bias_false_light, 0.05 * biased.bias_false_light);
         }},
        {"front-culling-floor",
         [] {
             const Guided g("front-culling-floor");
             EXPECT_GT(g.wrongly_lit({"Stage/Ground"}, {"Stage/Wall"}), 0.8) << "but for the tree behind it";
             EXPECT_LT(g.wrongly_lit({"Stage/Ground"}, {"Stage/Pedestal"}), 0.1) << "solid objects cast";
             const ErrorMetrics e = g.error();
             EXPECT_GT(share(e, Artefact::LostCaster), 0.9 * e.false_light);
         }},
        {"front-culling-exceptions",
         [] {
             const Guided g("front-culling-exceptions");
             EXPECT_LT(g.wrongly_lit({"Stage/Ground"}, {"Stage/Wall"}), 0.05);
             EXPECT_LT(g.wrongly_dark({"Stage/Ground"}), 0.02);
             EXPECT_LT(g.error().lost_false_light, 0.1 * Guided("front-culling-floor").error().lost_false_light);
         }},
        {"front-culling-open-meshes",
         [] {
             const Guided holes("front-culling-open-meshes");
             const Guided whole("front-culling-open-meshes", {"caster.cull=none", "bias.constant=0.003"});
             EXPECT_LT(holes.dark(), 0.85 * whole.dark());
             const ErrorMetrics e = holes.error();
             EXPECT_GT(e.lost_false_light, 0.7 * e.false_light);
             EXPECT_LT(whole.error().lost_false_light, 0.1 * e.lost_false_light);
         }},
        {"front-culling-close-objects",
         [] {
             const Guided::Nodes floor{"Boxes/Floor"}, slab{"Boxes/Flat"};
             const Guided g("front-culling-close-objects");
             const double gap = g.wrongly_lit(floor, slab);
             EXPECT_GT(gap, 0.2);
             const ErrorMetrics e = g.error();
             EXPECT_GT(share(e, Artefact::PeterPanning), 0.5 * e.false_light) << "the bias loses the underside";
             EXPECT_LT(Guided("front-culling-close-objects", {"caster.cull=none"}).wrongly_lit(floor, slab), 0.5 * gap);
         }},
        // ---- Resolution and filters
        {"resolution-1024",
         [] {
             const Guided coarse("resolution-1024", {}, 320, 180), fine("resolution-4096", {}, 320, 180);
             const Guided::Nodes ground{"Stage/Ground"}, pickets{"Stage/Fence/Picket*"};
             EXPECT_GT(coarse.wrongly_lit(ground, pickets), 1.5 * fine.wrongly_lit(ground, pickets));
             EXPECT_NEAR(coarse.shot.view().texel_size(1, 1024), 0.033, 0.0005);
             EXPECT_NEAR(fine.shot.view().texel_size(1, 4096), 0.008, 0.0005);
         }},
        {"resolution-4096", [] { EXPECT_EQ(Guided("resolution-4096").shot.frame.map_resolution, 4096); }},
        {"fit-casters",
         [] {
             const Guided narrow("fit-casters", {}, 320, 180), whole("fit-casters", {"light.fit=scene"}, 320, 180);
             const Guided::Nodes ground{"Stage/Ground"}, fence{"Stage/Fence/*"};
             EXPECT_NEAR(narrow.shot.view().texel_size(1, 1024), 0.012, 0.0008);
             EXPECT_NEAR(whole.shot.view().texel_size(1, 1024), 0.033, 0.0005);
             EXPECT_LT(narrow.wrongly_lit(ground, fence), 0.7 * whole.wrongly_lit(ground, fence));
             EXPECT_EQ(narrow.error().outside_map, 0);
         }},
        {"hard-edges", [] { EXPECT_EQ(Guided("hard-edges").grey(), 0); }},
        {"pcf-by-hand",
         [] {
             EXPECT_LE(Guided("pcf-by-hand").grey_levels(), 8) << "ten levels with black and white";
             EXPECT_GE(Guided("pcf-by-hand").grey_levels(), 6);
         }},
        {"tent",
         [] {
             EXPECT_GT(Guided("tent").grey_levels(), Guided("pcf-by-hand").grey_levels());
             EXPECT_LE(Guided("tent").grey_levels(), 15) << "sixteenths without black and white";
         }},
        {"poisson",
         [] {
             EXPECT_LE(Guided("poisson").grey_levels(), 15) << "sixteenths without black and white";
             EXPECT_GE(Guided("poisson").grey_levels(), 13);
             const Guided still("poisson", {"filter.rotate=false"}, 320, 180), turned("poisson", {}, 320, 180);
             EXPECT_GT(turned.edges({"Boxes/Floor"}), 1.2 * still.edges({"Boxes/Floor"})) << "noise in place of steps";
         }},
        {"pcss",
         [] {
             const double soft = Guided("pcss").error().mae;
             EXPECT_LT(soft, 0.75 * Guided("pcss", {"filter.kernel=pcf3"}).error().mae);
             EXPECT_LT(soft, 0.5 * Guided("pcss", {"filter.kernel=pcf9"}).error().mae);
         }},
        {"vsm",
         [] {
             const Guided g("vsm");
             EXPECT_GT(g.grey_levels(), 50);
             EXPECT_GT(g.wrongly_lit(), 1.3 * Guided("vsm", {"filter.bleed=0.4"}).wrongly_lit()) << "light bleeds in";
         }},
        {"hardware-pcf",
         [] {
             EXPECT_GT(Guided("hardware-pcf").grey_levels(), 50);
             EXPECT_LT(Guided("hardware-pcf").grey(), 0.7 * Guided("pcf-over-sampler").grey());
         }},
        {"cascades",
         [] {
             const Guided g("cascades"), one("cascades", {"light.cascades=1", "map.resolution=4096"});
             const ErrorMetrics four = g.error(), single = one.error();
             EXPECT_LT(four.false_light + four.false_shadow, 0.75 * (single.false_light + single.false_shadow));
             EXPECT_EQ(four.outside_map, 0);
             ASSERT_EQ(g.shot.light().views.size(), 4u);
             EXPECT_EQ(g.shot.frame.map_resolution, 1024);
             for (std::size_t i = 0; i + 1 < 4; ++i)
                 EXPECT_LT(g.shot.light().views[i].half_width, g.shot.light().views[i + 1].half_width);
         }},
        {"pcf-over-sampler", [] { EXPECT_GT(Guided("pcf-over-sampler").grey_levels(), 100); }},
        {"pcf-5x5", [] { EXPECT_GT(Guided("pcf-5x5").grey(), 1.3 * Guided("pcf-over-sampler").grey()); }},
        {"shadow-volumes",
         [] {
             const Guided g("shadow-volumes", {}, 320, 180);
             const ErrorMetrics e = g.error();
             EXPECT_LT(e.false_shadow + e.false_light, 1e-4);
             EXPECT_EQ(g.grey(), 0) << "a sharp edge";
             const ErrorMetrics map = Guided("shadow-volumes", {"light.source=map"}, 320, 180).error();
             EXPECT_GT(map.false_shadow + map.false_light, 20 * (e.false_shadow + e.false_light) + 1e-3);
             const ErrorMetrics inside = Guided("shadow-volumes", {"camera.distance=0.5"}, 320, 180).error();
             EXPECT_LT(inside.false_shadow + inside.false_light, 2e-4) << "close";
         }},
        {"adaptive-bias",
         [] {
             const Guided g("adaptive-bias");
             EXPECT_LT(g.wrongly_dark({"Room/Back wall"}), 0.005);
             EXPECT_EQ(g.error().acne, 0);
             EXPECT_GT(Guided("adaptive-bias", {"bias.kind=constant", "bias.constant=0"}).wrongly_dark(), 0.2);
         }},
        {"adaptive-bias-coarse",
         [] {
             const ErrorMetrics e = Guided("adaptive-bias-coarse").error();
             const ErrorMetrics fine = Guided("adaptive-bias-coarse", {"map.resolution=2048"}).error();
             EXPECT_EQ(e.acne, 0);
             EXPECT_GT(e.false_light, 0.005);
             EXPECT_GT(e.false_light, 3 * fine.false_light);
             EXPECT_EQ(e.bias_false_light, 0) << "less would be acne";
         }},
        {"receiver-plane-derivatives",
         [] {
             const Guided g("receiver-plane-derivatives");
             const ErrorMetrics e = g.error(), plane = Guided("receiver-plane").error();
             EXPECT_LT(g.wrongly_dark({"Room/Back wall"}), 0.005);
             EXPECT_LT(e.acne, 1e-3);
             EXPECT_LT(e.bias_false_light, 0.02) << "a little more gap";
             EXPECT_GE(e.bias_false_light, plane.bias_false_light);
         }},
        {"volumes-zpass",
         [] {
             const ErrorMetrics inside = Guided("volumes-zpass", {}, 320, 180).error();
             EXPECT_GT(inside.false_light + inside.false_shadow, 0.5);
             const ErrorMetrics right = Guided("volumes-zpass", {"light.source=volumes-zfail"}, 320, 180).error();
             EXPECT_LT(right.false_light + right.false_shadow, 2e-4);
         }},
        {"blob",
         [] {
             const Guided g("blob"), none("blob", {"light.source=none"});
             EXPECT_LT(g.error().mae, none.error().mae);
         }},
        {"blob-fails",
         [] {
             const ErrorMetrics e = Guided("blob-fails").error(),
                                map = Guided("blob-fails", {"light.source=map"}).error();
             EXPECT_GT(e.false_light + e.false_shadow, 5 * (map.false_light + map.false_shadow));
         }},
        {"light-map",
         [] {
             const Guided g("light-map", {}, 320, 180);
             const double mae = g.error().mae;
             EXPECT_GT(g.grey_levels(), 80);
             EXPECT_LT(mae, 0.004);
             for (const char* kernel : {"pcf", "pcss", "smrt"})
                 EXPECT_LT(mae, 0.5 * Guided("light-map", {"light.source=map", std::string("filter.kernel=") + kernel},
                                             320, 180)
                                          .error()
                                          .mae)
                     << kernel;
             EXPECT_LT(Guided("light-map", {"camera.azimuth=200"}, 320, 180).error().mae, 0.004) << "any camera";
         }},
        {"light-map-coarse",
         [] {
             const Guided coarse("light-map-coarse", {}, 320, 180),
                 fine("light-map-coarse", {"light_map.resolution=1024"}, 320, 180);
             EXPECT_GT(coarse.error().mae, 4 * fine.error().mae);
             EXPECT_GT(coarse.error().false_shadow, 10 * fine.error().false_shadow + 0.0005);
             EXPECT_GT(coarse.wrongly_dark({"Boxes/Floor"}), 10 * fine.wrongly_dark({"Boxes/Floor"}) + 0.0005)
                 << "fringes";
         }},
        {"contact-shadows",
         [] {
             const Guided with("contact-shadows", {}, 320, 180),
                 without("contact-shadows", {"light.contact=0"}, 320, 180);
             EXPECT_LT(with.error().bias_false_light, 0.7 * without.error().bias_false_light);
         }},
        {"contact-shadows-too-thick",
         [] {
             const ErrorMetrics e = Guided("contact-shadows-too-thick", {}, 320, 180).error();
             EXPECT_GT(e.contact_false_shadow, 0.01);
             EXPECT_GT(e.contact_false_shadow,
                       3 * Guided("contact-shadows-too-thick", {"contact.thickness=0.1"}, 320, 180)
                               .error()
                               .contact_false_shadow);
         }},
        {"dim-then-lit",
         [] {
             const auto levels = [](const Guided& g) {
                 std::set<int> out;
                 for (std::size_t i = 0; i < g.shot.colour.data.size(); i += 4) out.insert(g.shot.colour.data[i]);
                 return out.size();
             };
             EXPECT_LT(
                 levels(Guided("dim-then-lit", {"shading.specular=0"})),
                 0.8 * double(levels(Guided("dim-then-lit", {"shading.specular=0", "shading.composition=ambient"}))));
         }},
        {"texture-matrix",
         [] {
             const Guided g("texture-matrix"), world("texture-matrix", {"map.transform=world"});
             EXPECT_LT(differing_share(g.shot, world.shot), 1e-3) << "ten thousandths of a texel";
         }},
        {"depth-blur",
         [] {
             const Guided g("depth-blur"), sharp("depth-blur", {"map.blur_texels=0"});
             EXPECT_EQ(g.grey(), 0) << "every edge is as hard as before";
             EXPECT_GT(g.dark(), 1.2 * sharp.dark()) << "shadows grow";
             const ErrorMetrics e = g.error();
             EXPECT_GT(share(e, Artefact::Filter), 0.6 * e.false_shadow) << "the blur's, not the map's";
             EXPECT_LT(share(sharp.error(), Artefact::Filter), 0.05 * share(e, Artefact::Filter));
         }},
    };
    return all;
}

}  // namespace si::test
