#include "tests/support/flip_pairs.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "renderer/base/regular_file.h"
#include "renderer/gltf/image_decode.h"
#include "renderer/reference/flip.h"

namespace si::test {
namespace {

/// Reads a table of pairs below its heading. @param has_ppd third column: pixels per degree
std::vector<FlipPair> pairs_in(const std::filesystem::path& folder, bool has_ppd) {
    std::vector<FlipPair> out;
    std::ifstream table(folder / "VALUES.tsv");
    std::string line, a, b;
    for (std::getline(table, line); std::getline(table, line);) {
        std::istringstream fields(line);
        FlipPair pair{.pixels_per_degree = kFlipPixelsPerDegree};
        fields >> a >> b;
        if (has_ppd) fields >> pair.pixels_per_degree;
        fields >> pair.mean >> pair.max;
        pair.a = folder / a;
        pair.b = folder / b;
        out.push_back(std::move(pair));
    }
    return out;
}

}  // namespace

std::vector<FlipPair> committed_flip_pairs() {
    return pairs_in(std::filesystem::path(SI_SOURCE_DIR) / "tests/data/flip", true);
}

std::vector<FlipPair> shared_flip_pairs() {
    return pairs_in(std::filesystem::path(SI_SOURCE_DIR) / "../shared/flip", false);
}

ByteImage picture_in(const std::filesystem::path& file) {
    const ReadResult read = read_regular_file(file, std::size_t{1} << 26);
    EXPECT_EQ(read.error, "") << file;
    gltf::Image image = gltf::decode_image(read.bytes.span());
    EXPECT_EQ(image.error, "") << file;
    return {image.width, image.height, std::move(image.rgba)};
}

}  // namespace si::test
