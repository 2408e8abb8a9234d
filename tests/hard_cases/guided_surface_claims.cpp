// What the sentences of the guided presets claim about bias, culling and filters, counted.
#include "tests/hard_cases/guided_claims.h"
#include "tests/support/guided.h"

namespace si::test {

const Claims& guided_surface_claims() {
    static const Claims all = {
        // ---- Acne and bias
        {"acne", [] { EXPECT_GT(Guided("acne").wrongly_dark(), 0.25); }},
        {"constant-bias",
         [] {
             const Guided g("constant-bias");
             EXPECT_GT(g.wrongly_dark({"Room/Back wall"}), 0.15);
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.01);
             EXPECT_LT(g.wrongly_dark({"Room/Ball"}), 0.10);
         }},
        {"slope-bias",
         [] {
             const Guided g("slope-bias");
             EXPECT_LT(g.wrongly_dark({"Room/Back wall"}), 0.005);
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.01);
             EXPECT_LT(g.wrongly_lit({"Room/Floor"}), 0.15) << "the feet keep their shadows";
         }},
        {"normal-offset",
         [] {
             const Guided g("normal-offset");
             EXPECT_LT(g.wrongly_dark({"Room/Back wall"}), 0.005);
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.02);
             EXPECT_LT(g.wrongly_lit({"Room/Floor"}), 0.15);
             EXPECT_GT(Guided("normal-offset", {"bias.normal=0"}).wrongly_dark(), 0.2) << "it is the offset that helps";
         }},
        {"normal-offset-mapped",
         [] {
             const Guided frayed("normal-offset-mapped", {}, 320, 180);
             const Guided cured("normal-offset-mapped", {"bias.normal_source=geometric"}, 320, 180);
             EXPECT_GT(frayed.edges({"Relief/Floor"}), 1.3 * cured.edges({"Relief/Floor"}));
         }},
        {"slope-bias-mapped",
         [] {
             const Guided::Nodes floor{"Relief/Floor"};
             EXPECT_GT(Guided("slope-bias-mapped").wrongly_dark(floor), 0.02);
             EXPECT_LT(Guided("slope-bias-mapped", {"bias.normal_source=geometric"}).wrongly_dark(floor), 0.002);
         }},
        {"peter-panning",
         [] {
             const Guided g("peter-panning");
             EXPECT_GT(g.wrongly_lit({"Room/Floor"}), 0.10);
             EXPECT_GT(g.wrongly_lit({"Room/Floor"}), 3 * Guided("front-culling").wrongly_lit({"Room/Floor"}));
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.01);
         }},
        {"too-much-normal-offset",
         [] {
             const Guided g("too-much-normal-offset");
             EXPECT_GT(g.wrongly_lit({"Boxes/Floor"}, {"Boxes/Flat"}), 0.9) << "the slab's shadow is gone";
             EXPECT_GT(g.wrongly_lit({"Boxes/Standing"}, {"Boxes/Leaning"}), 0.5) << "light leaks behind the board";
             EXPECT_LT(g.wrongly_lit({"Boxes/Floor"}, {"Boxes/Tower"}), 0.7);
             EXPECT_GT(g.wrongly_lit({"Boxes/Floor"}, {"Boxes/Tower"}), 0.1);
         }},
        // ---- Front-face culling
        {"front-culling",
         [] {
             const Guided g("front-culling");
             EXPECT_LT(g.wrongly_lit({"Room/Floor"}), 0.08);
             EXPECT_LT(g.wrongly_dark({"Room/Floor"}), 0.02);
         }},
        {"front-culling-floor",
         [] {
             const Guided g("front-culling-floor");
             EXPECT_GT(g.wrongly_lit({"Stage/Ground"}, {"Stage/Wall"}), 0.8) << "but for the tree behind it";
             EXPECT_LT(g.wrongly_lit({"Stage/Ground"}, {"Stage/Pedestal"}), 0.1) << "solid objects cast";
         }},
        {"front-culling-exceptions",
         [] {
             const Guided g("front-culling-exceptions");
             EXPECT_LT(g.wrongly_lit({"Stage/Ground"}, {"Stage/Wall"}), 0.05);
             EXPECT_LT(g.wrongly_dark({"Stage/Ground"}), 0.02);
         }},
        {"front-culling-open-meshes",
         [] {
             const double holes = Guided("front-culling-open-meshes").dark();
             const double whole =
                 Guided("front-culling-open-meshes", {"caster.cull=none", "bias.constant=0.003"}).dark();
             EXPECT_LT(holes, 0.85 * whole);
         }},
        {"front-culling-close-objects",
         [] {
             const Guided::Nodes floor{"Boxes/Floor"}, slab{"Boxes/Flat"};
             const double gap = Guided("front-culling-close-objects").wrongly_lit(floor, slab);
             EXPECT_GT(gap, 0.2);
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
        {"hard-edges", [] { EXPECT_EQ(Guided("hard-edges").grey(), 0); }},
        {"pcf-by-hand",
         [] {
             EXPECT_LE(Guided("pcf-by-hand").grey_levels(), 8) << "ten levels with black and white";
             EXPECT_GE(Guided("pcf-by-hand").grey_levels(), 6);
         }},
        {"hardware-pcf",
         [] {
             EXPECT_GT(Guided("hardware-pcf").grey_levels(), 50);
             EXPECT_LT(Guided("hardware-pcf").grey(), 0.7 * Guided("pcf-over-sampler").grey());
         }},
        {"pcf-over-sampler", [] { EXPECT_GT(Guided("pcf-over-sampler").grey_levels(), 100); }},
        {"pcf-5x5", [] { EXPECT_GT(Guided("pcf-5x5").grey(), 1.3 * Guided("pcf-over-sampler").grey()); }},
        {"depth-blur",
         [] {
             const Guided g("depth-blur"), sharp("depth-blur", {"map.blur_texels=0"});
             EXPECT_EQ(g.grey(), 0) << "every edge is as hard as before";
             EXPECT_GT(g.dark(), 1.2 * sharp.dark()) << "shadows grow";
             const Guided::Nodes floor{"Boxes/Floor"}, slab{"Boxes/Flat"};
             EXPECT_EQ(g.wrongly_lit(floor, slab), 1) << "thin ones vanish";
             EXPECT_LT(sharp.wrongly_lit(floor, slab), 0.97);
         }},
    };
    return all;
}

}  // namespace si::test
