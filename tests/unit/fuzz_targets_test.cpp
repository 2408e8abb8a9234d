// Tests that run the fuzz targets (tests/fuzz) over earlier findings, seeds, and seeded mutations of both.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "tests/fuzz/targets.h"
#include "tests/support/process.h"

namespace si::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxSeedBytes = 20'000;

std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.file_size() <= kMaxSeedBytes) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> texts;
    for (const fs::path& path : paths) texts.push_back(file_bytes(path));
    return texts;
}

/// Returns the bytes with some changed, removed or inserted, or with the end of another input.
std::string changed(std::string text, const std::vector<std::string>& others, std::mt19937& random) {
    static constexpr std::string_view kTelling[] = {"\"", "{",     "}",    "[",   "]", ",", ":",
                                                    "-",  "1e999", "\xff", "nan", "0", "="};
    for (unsigned n = 1 + random() % 4; n > 0 && !text.empty(); --n) {
        const std::size_t at = random() % text.size();
        switch (random() % 5) {
            case 0:
                text[at] = char(random());
                break;
            case 1:
                text.erase(at, 1 + random() % 8);
                break;
            case 2:
                text.insert(at, kTelling[random() % std::size(kTelling)]);
                break;
            case 3:
                text.insert(at, text.substr(random() % text.size(), random() % 40));
                break;
            default:
                const std::string& other = others[random() % others.size()];
                text = text.substr(0, at) + other.substr(std::min(other.size(), std::size_t(random() % (at + 1))));
                break;
        }
    }
    return text;
}

void run_over(const Target& target, const std::string& text) {
    try {
        target.run({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    } catch (const std::exception& e) {
        ADD_FAILURE() << target.name << ": " << e.what() << " of\n" << text.substr(0, 2000);
    }
}

class FuzzTargets : public testing::TestWithParam<Target> {};

TEST_P(FuzzTargets, AcceptOrRefuseAnyInput) {
    const fs::path root = SI_SOURCE_DIR;
    std::vector<std::string> seeds = files_below(root / "tests/data/fuzz" / GetParam().name);
    ASSERT_GE(seeds.size(), 3u);
    if (GetParam().name == "preset")
        for (std::string& text : files_below(root / "assets/presets")) seeds.push_back(std::move(text));
    if (const fs::path bad = root / "../shared/bad-gltf"; GetParam().name == "gltf" && fs::exists(bad))
        for (std::string& text : files_below(bad)) seeds.push_back(std::move(text));
    for (const std::string& text : seeds) run_over(GetParam(), text);
    std::mt19937 random(1);
    for (int i = 0; i < 500; ++i) run_over(GetParam(), changed(seeds[random() % seeds.size()], seeds, random));
}

INSTANTIATE_TEST_SUITE_P(All, FuzzTargets, testing::ValuesIn(targets()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace si::fuzz
