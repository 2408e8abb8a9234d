// Tests of compressed models against their decoded twins: the report of `scene` and the picture of `render`.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(SI_SOURCE_DIR) / "tests/data/compressed";

std::vector<std::string> model_names() {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(kFolder))
        if (const std::string stem = entry.path().stem().string();
            entry.path().extension() == ".glb" && !stem.ends_with(".twin"))
            out.push_back(stem);
    std::ranges::sort(out);
    return out;
}

class CompressedModel : public testing::TestWithParam<std::string> {};

TEST_P(CompressedModel, IsReportedAndDrawnAsItsTwin) {
    const fs::path folder = fresh_test_folder();
    const std::string file = (kFolder / GetParam()).string() + ".glb";
    const std::string twin = (kFolder / GetParam()).string() + ".twin.glb";
    nlohmann::json report = program_json(Words{"scene", file}), other = program_json(Words{"scene", twin});
    for (nlohmann::json* j : {&report, &other}) j->erase("scene");
    EXPECT_EQ(report, other);
    for (const auto& [model, picture] : {std::pair(file, "a.png"), std::pair(twin, "b.png")}) {
        const ProcessResult r = run_program(Words{"render", model, "-o", picture, "--size", "200x120"}, folder);
        ASSERT_EQ(r.code, 0) << r.err;
    }
    EXPECT_TRUE(file_bytes(folder / "a.png") == file_bytes(folder / "b.png"));
}

INSTANTIATE_TEST_SUITE_P(All, CompressedModel, testing::ValuesIn(model_names()), [](const auto& test) {
    std::string name = test.param;
    std::ranges::replace(name, '-', '_');
    return name;
});

TEST(CompressedModels, AreTen) {
    EXPECT_EQ(model_names().size(), 10u);
}

TEST(CompressedModels, DamagedModelsEndInOneSentence) {
    const fs::path folder = fresh_test_folder();
    std::string bytes = file_bytes(kFolder / "draco-boxes.glb");
    const std::size_t draco = bytes.find("DRACO");
    ASSERT_NE(draco, std::string::npos);
    bytes[draco] = 'X';
    std::ofstream(folder / "damaged.glb", std::ios::binary) << bytes;
    expect_error("scene damaged.glb", 1, "KHR_draco_mesh_compression: its data are no Draco mesh, or damaged; ",
                 folder);
}

}  // namespace
}  // namespace si
