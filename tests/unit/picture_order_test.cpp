// Tests of the drawing order of objects, by a few boxes with a known order and by random ones.
#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/scenes/shapes.h"
#include "renderer/view/culling/draw_order.h"

namespace si {
namespace {

SkewBox box_at(const glm::dvec3& centre, double half = 1) {
    SkewBox box;
    box.centre = centre;
    box.half = glm::dmat3(half);
    return box;
}

TEST(PictureOrder, FindsExactlyTheTouchingBoxes) {
    Random random(3);
    std::vector<SkewBox> boxes;
    for (int i = 0; i < 200; ++i)
        boxes.push_back(box_at({random.in(-20, 20), random.in(-20, 20), random.in(-20, 20)}, random.in(0.1, 3)));
    std::vector<BoxPair> expected;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        for (std::uint32_t k = i + 1; k < boxes.size(); ++k) {
            const glm::dvec3 gap = glm::abs(boxes[i].centre - boxes[k].centre);
            const double room = boxes[i].half[0][0] + boxes[k].half[0][0];
            if (gap.x <= room && gap.y <= room && gap.z <= room) expected.emplace_back(i, k);
        }
    ASSERT_GT(expected.size(), 50u);
    auto found = touching_boxes(boxes, 0);
    ASSERT_TRUE(found);
    std::sort(found->begin(), found->end());
    EXPECT_EQ(*found, expected);
}

TEST(PictureOrder, AdjacentBoxesTouchWithinTheTolerance) {
    const std::vector<SkewBox> boxes = {box_at({0, 0, 0}), box_at({2.001, 0, 0})};
    EXPECT_TRUE(touching_boxes(boxes, 0)->empty());
    EXPECT_EQ(touching_boxes(boxes, 0.001)->size(), 1u);
}

TEST(PictureOrder, GivesUpIfAllBoxesTouch) {
    EXPECT_TRUE(touching_boxes(std::vector<SkewBox>(500, box_at({0, 0, 0})), 0));
    EXPECT_FALSE(touching_boxes(std::vector<SkewBox>(3000, box_at({0, 0, 0})), 0));
}

TEST(PictureOrder, IsNearestFirstWithinGroupsOfVisibleObjects) {
    const std::vector<SortedBox> boxes = {{.far_m = 9, .seen = true},
                                          {.far_m = 3, .seen = true},
                                          {.far_m = 1, .seen = false},
                                          {.group = 1, .far_m = 2, .seen = true},
                                          {.far_m = 5, .seen = true}};
    EXPECT_EQ(sort_front_to_back(boxes, {}), (std::vector<std::uint32_t>{1, 4, 0, 3}));
}

TEST(PictureOrder, TouchingObjectsKeepTheirOrder) {
    std::vector<SortedBox> boxes = {{.far_m = 9, .seen = true}, {.far_m = 3, .seen = true}, {.far_m = 5, .seen = true}};
    const std::vector<BoxPair> touching = {{0, 1}};
    EXPECT_EQ(sort_front_to_back(boxes, touching), (std::vector<std::uint32_t>{2, 0, 1}));
    boxes[0].seen = false;  // hidden boxes delay nothing
    EXPECT_EQ(sort_front_to_back(boxes, touching), (std::vector<std::uint32_t>{1, 2}));
}

TEST(PictureOrder, ManyObjectsAreDrawnOnceAndPairsInOrder) {
    Random random(11);
    std::vector<SortedBox> boxes(5000);
    std::size_t seen = 0;
    for (SortedBox& b : boxes) {
        b = {.group = random.in(0, 1) < 0.5 ? 0 : 1, .far_m = random.in(0, 100), .seen = random.in(0, 1) < 0.8};
        seen += b.seen;
    }
    std::vector<BoxPair> touching;
    for (int i = 0; i < 9000; ++i) {
        const auto a = std::uint32_t(random.in(0, 4999)), b = std::uint32_t(random.in(0, 4999));
        if (a != b) touching.emplace_back(std::min(a, b), std::max(a, b));
    }
    const std::vector<std::uint32_t> order = sort_front_to_back(boxes, touching);
    ASSERT_EQ(order.size(), seen);
    std::vector<std::size_t> place(boxes.size(), boxes.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(place[order[i]], boxes.size()) << "drawn twice";
        place[order[i]] = i;
    }
    for (const auto& [a, b] : touching)
        if (boxes[a].seen && boxes[b].seen && boxes[a].group == boxes[b].group) {
            EXPECT_LT(place[a], place[b]);
        }
    EXPECT_TRUE(
        std::is_sorted(order.begin(), order.end(), [&](auto a, auto b) { return boxes[a].group < boxes[b].group; }));
}

}  // namespace
}  // namespace si
