// Tests of docs/techniques.md: a row and a picture for each technique. Its figures are tested with the drawing tests.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"
#include "tests/support/source_tree.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHow = "run: scripts/document_technique.sh KEY=CHOICE";

TEST(TechniquesPage, HasARowAndAPictureForEachTechnique) {
    const fs::path docs = test::source_tree() / "docs", pictures = docs / "techniques";
    std::ifstream in(docs / "techniques.md");
    ASSERT_TRUE(in) << kHow;
    std::stringstream read;
    read << in.rdbuf();
    const std::string page = read.str();
    std::set<std::string> keys;
    for (const std::string_view name : sweep_kernels()) keys.emplace(name);
    for (const Choice& c : bias_choices()) keys.emplace(c.key);
    for (const Source& s : sources()) keys.emplace(s.key);
    for (const auto& f : fits()) keys.emplace(f.key);
    for (const char* setting : {"map.format", "light.split", "light.near_far", "shading.composition"})
        for (const Choice& c : find_setting(setting)->param->choices()) keys.emplace(c.key);
    for (const std::string& key : keys) EXPECT_NE(page.find("`" + key + "`"), std::string::npos) << key << "; " << kHow;
    std::size_t shown = 0, there = 0;
    for (std::size_t at = page.find("](techniques/"); at != std::string::npos;
         at = page.find("](techniques/", at + 1)) {
        const std::string file = page.substr(at + 2, page.find(')', at) - at - 2);
        EXPECT_TRUE(fs::exists(docs / file)) << file << "; " << kHow;
        ++shown;
    }
    for (const auto& entry : fs::directory_iterator(pictures)) there += entry.path().extension() == ".png";
    EXPECT_EQ(shown, there) << "a picture of no row lies in " << pictures << "; delete the folder, then " << kHow;
    EXPECT_GE(shown, keys.size());
}

}  // namespace
}  // namespace si
