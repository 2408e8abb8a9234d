// What the sentences of the guided presets claim about kernels that read averages, counted.
#include <cmath>

#include "tests/hard_cases/guided_claims.h"
#include "tests/support/guided.h"
#include "tests/support/ray_truth.h"

namespace si::test {
namespace {

/// How much visibility changes from pixel to pixel of a row, in all.
double roughness(const Guided& g) {
    double sum = 0;
    const FloatImage& v = g.shot.visibility;
    for (int y = 0; y < v.height; ++y)
        for (int x = 1; x < v.width; ++x) sum += std::abs(double(v.at(x, y)) - v.at(x - 1, y));
    return sum;
}

/// Means over what no edge of a shadow is near: of visibility in shadow, and of what lit places lack.
struct Amiss {
    double bled = 0, darkened = 0;
};

Amiss amiss(const Guided& g) {
    const ReferenceImage reference = trace_reference(RayReference(g.scene), g.shot.frame.camera, g.shot.light(),
                                                     g.shot.width, g.shot.height, g.shot.frame.map_resolution, 6);
    Amiss sum;
    int dark = 0, lit = 0;
    for (int y = 0; y < g.shot.height; ++y)
        for (int x = 0; x < g.shot.width; ++x) {
            const double v = g.shot.visibility.at(x, y);
            if (reference.at(x, y) == Lit::Shadow) {
                ++dark;
                sum.bled += v;
            }
            if (reference.at(x, y) == Lit::Lit) {
                ++lit;
                sum.darkened += 1 - v;
            }
        }
    EXPECT_GT(dark, 40);
    EXPECT_GT(lit, 1000);
    return {sum.bled / dark, sum.darkened / lit};
}

}  // namespace

const Claims& guided_moment_claims() {
    static const Claims all = {
        {"savsm",
         [] {
             const Guided wide("savsm"), narrow("savsm", {"filter.window=3"});
             EXPECT_GT(wide.grey(), 2 * narrow.grey());
             hard_renderer().render(wide.scene, wide.settings, {.width = 16, .height = 9});
             const FrameResult dragged =
                 hard_renderer().render(wide.scene, narrow.settings, {.width = 16, .height = 9});
             EXPECT_EQ(dragged.pass("moments")->state, PassState::Cached) << "nothing is made anew";
         }},
        {"savsm-float-sums",
         [] {
             const Guided g("savsm-float-sums"), integers("savsm-float-sums", {"filter.sums=integer"});
             EXPECT_GT(roughness(g), 2 * roughness(integers)) << "noise";
             EXPECT_GT(amiss(g).darkened, 20 * amiss(integers).darkened + 1e-3);
         }},
        {"esm",
         [] {
             const Guided g("esm");
             EXPECT_LT(amiss(g).bled, 0.1 * amiss(Guided("vsm")).bled);
             EXPECT_GT(g.grey_levels(), 50);
         }},
        {"esm-contact",
         [] {
             EXPECT_GT(amiss(Guided("esm-contact")).bled, 0.1);
             EXPECT_LT(amiss(Guided("esm-contact", {"filter.exponent=40"})).bled, 0.001);
         }},
        {"evsm4",
         [] {
             const Guided g("evsm4"), variance("vsm");
             EXPECT_LT(amiss(g).bled, 0.2 * amiss(variance).bled);
             EXPECT_GT(g.grey(), 0.9 * variance.grey()) << "soft";
         }},
        {"evsm2",
         [] {
             const Guided g("evsm2"), low("evsm2", {"filter.exponent=5"});
             EXPECT_GT(g.wrongly_lit(), 1.5 * low.wrongly_lit()) << "shadows shrink";
             EXPECT_LT(g.grey(), 0.5 * low.grey()) << "stairs";
         }},
        {"msm", [] { EXPECT_LT(amiss(Guided("msm")).bled, 0.2 * amiss(Guided("vsm")).bled); }},
        {"msm-16-bit",
         [] {
             const Guided g("msm-16-bit"), biased("msm-16-bit", {"filter.moment_bias=0.0003"});
             EXPECT_GT(amiss(g).darkened, 2 * amiss(biased).darkened);
             EXPECT_GT(roughness(g), 1.05 * roughness(biased)) << "specks";
             const FrameResult frame = hard_renderer().render(g.scene, g.settings, {.width = 160, .height = 90});
             const ByteImage marked = hard_renderer().read_colour(frame.panes.at(1).picture);
             int red = 0;
             for (std::size_t i = 0; i < marked.data.size(); i += 4)
                 red += marked.data[i] > 150 && marked.data[i + 1] < 90;
             EXPECT_GT(red, 100);
         }},
        {"moment-mips",
         [] {
             const Guided g("moment-mips"), fine("moment-mips", {"filter.mips=false"});
             EXPECT_LT(roughness(g), 0.9 * roughness(fine));
         }},
        {"mips-block",
         [] {
             const double melted = amiss(Guided("mips-block")).bled;
             EXPECT_GT(melted, 10 * amiss(Guided("mips-block", {"filter.mips=false"})).bled + 0.1);
             EXPECT_GT(melted, 1.8 * amiss(Guided("mips-block", {"filter.anisotropy=16"})).bled);
         }},
        {"map-samples",
         [] { EXPECT_GT(Guided("map-samples").grey(), 1.15 * Guided("map-samples", {"map.samples=1"}).grey()); }},
    };
    return all;
}

}  // namespace si::test
