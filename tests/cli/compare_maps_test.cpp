// Tests of `compare-maps`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.h"

namespace si {
namespace {

TEST(CompareMaps, NeedsImportedMaps) {
    const auto folder = fresh_test_folder();
    expect_error("compare-maps boxes", 1, "boxes: it has no imported maps; name a bundle, or set map.bundle to one",
                 folder);
    expect_error("compare-maps boxes --light 99", 2, "--light", folder);
    expect_error("compare-maps boxes --light 0", 1, "light 0 has no imported map to compare with", folder);
    expect_error("compare-maps boxes --border -1", 2, "--border", folder);
    expect_error("compare-maps boxes -o differences.jpg", 2, "must end in .png", folder);
    expect_error("compare-maps", 2, "SCENE", folder);
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace si
