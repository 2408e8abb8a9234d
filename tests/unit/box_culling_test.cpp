// Tests of box culling by a map's view, compared with corners and inner points.
#include "renderer/view/culling/box_culling.h"

#include <gtest/gtest.h>

#include "renderer/projection/projection.h"
#include "renderer/scenes/shapes.h"

namespace si {
namespace {

struct TestView {
    glm::dmat4 clip;
    glm::dvec3 origin{110, 2, -7};
    DepthCurve curve;

    TestView(bool perspective, DepthConvention convention) {
        curve = {.perspective = perspective, .near = 1, .far = 20};
        curve.convention = convention;
        clip = clip_from_relative(projection_matrix(curve, perspective ? 1 : 8, perspective ? 1 : 8), glm::dmat3(1),
                                  {115, 0, 0}, origin);
    }
    /// Returns the distance of a point from the view's border as a share of clip-space w; negative outside.
    double inside(const glm::dvec3& p) const {
        const glm::dvec4 h = clip * glm::dvec4(p - origin, 1);
        const double low = curve.convention.zero_to_one ? h.z : h.w + h.z;
        return std::min({h.w + h.x, h.w - h.x, h.w + h.y, h.w - h.y, low, h.w - h.z});
    }
};

SkewBox random_box(Random& random) {
    const auto point = [&](double r) { return glm::dvec3(random.in(-r, r), random.in(-r, r), random.in(-r, r)); };
    Bounds bounds;
    bounds.add(point(2));
    bounds.add(point(2));
    const glm::dvec3 at = glm::dvec3(115, 0, -8) + point(25);
    return {bounds, moved(at.x, at.y, at.z) * turned(random.in(0, 360), random.direction())};
}

TEST(BoxCuller, FindsEveryBoxWithAVisiblePoint) {
    Random random(5);
    int missed = 0, before = 0, all = 0;
    for (const bool perspective : {false, true})
        for (const DepthConvention convention : {DepthConvention{true, false}, DepthConvention{false, false},
                                                 DepthConvention{true, true}, DepthConvention{false, true}}) {
            const TestView looker(perspective, convention);
            const BoxCuller sight(looker.clip, looker.origin, convention, false, 512);
            for (int i = 0; i < 400; ++i, ++all) {
                const SkewBox box = random_box(random);
                double most = -1e9, nearest = 1e9;
                for (int k = 0; k < 400; ++k) {
                    glm::dvec3 at(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
                    if (k < 8) at = {k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1};
                    const glm::dvec3 p = box.centre + box.half * at;
                    most = std::max(most, looker.inside(p));
                    nearest = std::min(nearest, -p.z);
                }
                if (most >= 0) {
                    EXPECT_FALSE(sight.is_outside(box));
                }
                EXPECT_EQ(sight.is_in_front(box), nearest > 1 + 1e-4) << nearest;
                missed += sight.is_outside(box);
                before += sight.is_in_front(box);
            }
        }
    EXPECT_GT(missed, all / 4);
    EXPECT_LT(missed, all);
    EXPECT_GT(before, all / 8);
}

TEST(BoxCuller, ClampedDepthsCullNothingByDepth) {
    const TestView looker(false, {});
    const BoxCuller clamps(looker.clip, looker.origin, {}, true, 512),
        clips(looker.clip, looker.origin, {}, false, 512);
    Bounds unit;
    unit.add({-1, -1, -1});
    unit.add({1, 1, 1});
    const SkewBox behind_eye(unit, moved(115, 0, 5)), far(unit, moved(115, 0, -40)), cut(unit, moved(115, 0, -1));
    EXPECT_TRUE(clips.is_outside(behind_eye) && clips.is_outside(far));
    EXPECT_FALSE(clamps.is_outside(behind_eye) || clamps.is_outside(far));
    EXPECT_FALSE(clips.is_in_front(cut));
    EXPECT_TRUE(clamps.is_in_front(cut));
}

}  // namespace
}  // namespace si
