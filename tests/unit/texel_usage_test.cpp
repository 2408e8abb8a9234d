// Tests of the texels that a picture reads, in cases countable by hand.
#include "renderer/inspect/texel_usage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderer/settings/filters.h"

namespace si {
namespace {

/// Makes a picture of one row whose pixels look up the given map coordinates.
FloatImage look_up_picture(const std::vector<glm::vec4>& pixels) {
    FloatImage image{int(pixels.size()), 1, 4, {}};
    for (const glm::vec4& p : pixels) image.data.insert(image.data.end(), {p.x, p.y, p.z, p.w});
    return image;
}

/// Returns the map coordinates of a texel's centre.
glm::vec4 centre_of(int x, int y, int n, float layer = 0) {
    return {(float(x) + 0.5f) / float(n), (float(y) + 0.5f) / float(n), layer, 1};
}

TEST(TexelUsage, FootprintsMatchTheFetchesOfKernels) {
    // Shaders fetch floor(u n) +- size/2 (nearest), or floor(u n - 1/2) - size/2 and size + 1 texels (bilinear).
    const int n = 64;
    for (std::size_t row = 0; row < filters().size(); ++row) {
        const Filter& filter = filters()[row];
        if (!filter.square()) continue;
        Settings s;
        s.filter.kernel = int(row);
        const int across = taps_across(filter, s);
        for (const float u : {0.1f, 0.25f, 0.4999f, 0.5f, 0.507f, 0.9f}) {
            const KernelFootprint f = kernel_footprint(u, 1 - u, n, reach_of(s).read);
            const auto first = [&](float at) {
                const float x = at * float(n);
                return int(std::floor(filter.bilinear ? x - 0.5f : x)) - across / 2;
            };
            EXPECT_EQ(f.first, glm::ivec2(first(u), first(1 - u))) << filter.key << " " << u;
            EXPECT_EQ(f.count, filter.bilinear ? across + 1 : across) << filter.key;
        }
    }
}

TEST(TexelUsage, OnePixelReadsTheSquareOfItsKernel) {
    const int n = 16;
    for (const auto& [reach, side] : {std::pair{0.5, 1}, {1.5, 3}, {2.5, 5}}) {
        const TexelUsage usage(look_up_picture({centre_of(7, 4, n)}), n, reach, MapWrap::Border);
        EXPECT_DOUBLE_EQ(usage.utilisation(), double(side * side) / (n * n));
        EXPECT_EQ(usage.pixels({7, 4}), 1u);
        const int r = side / 2;
        EXPECT_EQ(usage.pixels({7 - r, 4 + r}), 1u);
        EXPECT_EQ(usage.pixels({7 - r - 1, 4}), 0u);
        EXPECT_EQ(usage.pixels({7, 4 + r + 1}), 0u);
    }
}

TEST(TexelUsage, BilinearTapReadsFourTexels) {
    const TexelUsage usage(look_up_picture({{8.0f / 16, 8.0f / 16, 0, 1}}), 16, 1, MapWrap::Border);
    for (const glm::ivec2 t : {glm::ivec2(7, 7), {8, 7}, {7, 8}, {8, 8}}) EXPECT_EQ(usage.pixels(t), 1u);
    EXPECT_DOUBLE_EQ(usage.utilisation(), 4.0 / 256);
}

TEST(TexelUsage, CountsAndReadersMatchBruteForce) {
    const int n = 12;
    std::vector<glm::vec4> pixels;
    unsigned seed = 7;
    const auto random = [&] { return float((seed = seed * 1664525u + 1013904223u) >> 8) / float(1 << 24); };
    for (int i = 0; i < 300; ++i)
        pixels.push_back({random() * 1.6f - 0.3f, random() * 1.6f - 0.3f, float(i % 3 == 0), float(i % 7 != 0)});
    const FloatImage image = look_up_picture(pixels);
    for (const MapWrap wrap : {MapWrap::Border, MapWrap::Clamp, MapWrap::Repeat, MapWrap::Range})
        for (const double reach : {0.5, 1.0, 2.0, 5.0, 8.0}) {
            const TexelUsage usage(image, n, reach, wrap, 0);
            std::size_t read = 0;
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    std::vector<glm::ivec2> expected;
                    for (std::size_t i = 0; i < pixels.size(); ++i) {
                        if (pixels[i].w == 0 || pixels[i].z != 0) continue;
                        const KernelFootprint f = kernel_footprint(pixels[i].x, pixels[i].y, n, reach);
                        bool reads = false;
                        for (int dy = 0; dy < f.count; ++dy)
                            for (int dx = 0; dx < f.count; ++dx) {
                                glm::ivec2 t = f.first + glm::ivec2(dx, dy);
                                if (wrap == MapWrap::Repeat) t = ((t % n) + n) % n;
                                if (wrap == MapWrap::Clamp) t = glm::clamp(t, glm::ivec2(0), glm::ivec2(n - 1));
                                reads |= t == glm::ivec2(x, y);
                            }
                        if (reads) expected.emplace_back(int(i), 0);
                    }
                    ASSERT_EQ(usage.readers({x, y}), expected) << int(wrap) << " " << reach << " " << x << "," << y;
                    ASSERT_EQ(usage.pixels({x, y}), expected.size());
                    read += !expected.empty();
                }
            EXPECT_DOUBLE_EQ(usage.utilisation(), double(read) / (n * n));
        }
}

TEST(TexelUsage, OnlyTheSelectedLayerAndReadingPixelsCount) {
    const int n = 8;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    glm::vec4 silent = centre_of(5, 5, n);
    silent.w = 0;
    const FloatImage image = look_up_picture({centre_of(1, 1, n, 0), centre_of(2, 2, n, 3), silent, {nan, 0.5f, 0, 1}});
    EXPECT_DOUBLE_EQ(TexelUsage(image, n, 0.5, MapWrap::Border, 0).utilisation(), 1.0 / 64);
    EXPECT_EQ(TexelUsage(image, n, 0.5, MapWrap::Border, 3).pixels({2, 2}), 1u);
    EXPECT_DOUBLE_EQ(TexelUsage(image, n, 0.5, MapWrap::Border, 1).utilisation(), 0);
    EXPECT_DOUBLE_EQ(TexelUsage().utilisation(), 0);
    EXPECT_EQ(TexelUsage().pixels({0, 0}), 0u);
    EXPECT_TRUE(TexelUsage().readers({0, 0}).empty());
}

TEST(TexelUsage, ReadersAreListedRowByRow) {
    FloatImage image{3, 2, 4, {}};
    for (int i = 0; i < 6; ++i) {
        const glm::vec4 p = i == 1 || i == 5 ? centre_of(2, 3, 8) : glm::vec4(0);
        image.data.insert(image.data.end(), {p.x, p.y, p.z, p.w});
    }
    const TexelUsage usage(image, 8, 0.5, MapWrap::Border);
    EXPECT_EQ(usage.readers({2, 3}), (std::vector<glm::ivec2>{{1, 0}, {2, 1}}));
    const FloatImage counts = usage.counts();
    EXPECT_EQ(counts.at(2, 8 - 1 - 3), 2);
    EXPECT_EQ(usage.max_pixels(), 2u);
}

}  // namespace
}  // namespace si
