// Tests of connected wrong pixels, over images made by hand.
#include "renderer/measure/artefact_clusters.h"

#include <gtest/gtest.h>

#include <string>

namespace si {
namespace {

constexpr int kWidth = 8;

/// Makes an image of classes: 'a' acne, 'l' a leak, anything else correct.
std::vector<ClassifiedPixel> classified(const std::string& picture) {
    std::vector<ClassifiedPixel> out;
    for (const char c : picture) {
        out.emplace_back();
        out.back().artefact = c == 'a' ? Artefact::Acne : c == 'l' ? Artefact::Leak : Artefact::None;
    }
    return out;
}

TEST(ArtefactClusters, AreConnectedPixelsOfOneCauseLargestFirst) {
    const auto picture = classified(
        "a......a"
        "......a."
        "..ll...."
        ".aaal..."
        ".aaa...."
        ".aaa...a");
    const auto found = artefact_clusters(picture, kWidth, Artefact::Acne, 10);
    ASSERT_EQ(found.size(), 4u);
    EXPECT_EQ(found[0].pixels, 9u);
    EXPECT_EQ(found[0].pixel, glm::ivec2(2, 4));
    EXPECT_EQ(found[0].first, glm::ivec2(1, 3));
    EXPECT_EQ(found[0].last, glm::ivec2(3, 5));
    EXPECT_EQ(found[1].pixels, 2u) << "across a corner";
    EXPECT_EQ(found[2].pixel, glm::ivec2(0, 0)) << "of one size row by row; rows do not go on at the other side";
    EXPECT_EQ(found[3].pixel, glm::ivec2(7, 5));
    EXPECT_EQ(artefact_clusters(picture, kWidth, Artefact::Acne, 2).size(), 2u);
    EXPECT_EQ(artefact_clusters(picture, kWidth, Artefact::Leak, 10).size(), 1u);
    EXPECT_TRUE(artefact_clusters(picture, kWidth, Artefact::Filter, 10).empty());
    EXPECT_TRUE(artefact_clusters({}, 0, Artefact::Acne, 10).empty());
}

TEST(ArtefactClusters, CentreIsAPixelOfTheCluster) {
    const auto ring = classified(
        "aaaaaaaa"
        "a......a"
        "a......a"
        "aaaaaaaa");
    const auto found = artefact_clusters(ring, kWidth, Artefact::Acne, 10);
    ASSERT_EQ(found.size(), 1u);
    const glm::ivec2 p = found[0].pixel;
    EXPECT_EQ(ring[std::size_t(p.y * kWidth + p.x)].artefact, Artefact::Acne);
}

}  // namespace
}  // namespace si
