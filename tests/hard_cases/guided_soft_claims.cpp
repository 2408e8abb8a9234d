// What the sentences of the guided presets claim about kernels that sample and penumbrae, counted.
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "tests/hard_cases/guided_claims.h"
#include "tests/support/guided.h"

namespace si::test {

const Claims& guided_soft_claims() {
    static const Claims all = {
        {"tent-bilinear",
         [] {
             const Guided g("tent-bilinear"), pcf("tent-bilinear", {"filter.kernel=pcf"});
             EXPECT_EQ(cost_of(g.settings).sampler_taps, 9);
             EXPECT_EQ(cost_of(pcf.settings).sampler_taps, 25);
             EXPECT_GT(g.grey_levels(), 80);
             EXPECT_LT(g.grey(), pcf.grey()) << "its weights end in nothing";
             EXPECT_GT(g.grey(), 0.6 * pcf.grey());
         }},
        {"vogel",
         [] {
             const auto grey = [](std::vector<std::string> changes) {
                 return Guided("vogel", changes, 320, 180).grey();
             };
             const double coarse = grey({"map.resolution=512"});
             EXPECT_NEAR(grey({"map.resolution=2048"}), coarse, 0.15 * coarse);
             const std::vector<std::string> texels = {"filter.radius_unit=texels", "filter.radius=4"};
             EXPECT_LT(grey({"map.resolution=2048", texels[0], texels[1]}),
                       0.6 * grey({"map.resolution=512", texels[0], texels[1]}))
                 << "it is the unit that does it";
         }},
        {"vogel-noise",
         [] {
             const Guided few("vogel-noise"), many("vogel");
             EXPECT_LE(few.grey_levels(), 3) << "quarters";
             EXPECT_GT(few.edges({"Boxes/Floor"}), 1.5 * many.edges({"Boxes/Floor"}));
         }},
        {"pcss-misses",
         [] {
             const Guided misses("pcss-misses", {}, 320, 180),
                 finds("pcss-misses", {"filter.blocker_taps=16"}, 320, 180);
             EXPECT_GT(misses.error().mae, 1.3 * finds.error().mae);
             EXPECT_LT(misses.grey(), 0.7 * finds.grey()) << "what misses is lit";
         }},
        {"dpcf",
         [] {
             const Guided g("dpcf");
             EXPECT_EQ(cost_of(g.settings).texels, 32);
             EXPECT_LT(g.error().mae, 0.65 * Guided("dpcf", {"filter.kernel=pcf3"}).error().mae);
         }},
        {"dpcf-thin",
         [] {
             const double lost = Guided("dpcf-thin").error().false_light;
             EXPECT_GT(lost, 0.004);
             EXPECT_GT(lost,
                       4 * Guided("dpcf-thin", {"filter.kernel=pcss", "filter.blocker_taps=32"}).error().false_light);
         }},
        {"smrt",
         [] { EXPECT_LT(Guided("smrt").error().mae, 0.65 * Guided("smrt", {"filter.kernel=pcf3"}).error().mae); }},
        {"smrt-thick",
         [] {
             const Guided thick("smrt-thick"), thin("smrt");
             EXPECT_GT(thick.error().mae, 1.3 * thin.error().mae);
             EXPECT_LT(thick.grey(), 0.8 * thin.grey()) << "the inner half of each penumbra is dark";
         }},
    };
    return all;
}

}  // namespace si::test
