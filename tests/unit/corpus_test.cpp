// Tests of every file of the model and the broken-file collections, with a time limit. Skipped without the collections.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "renderer/base/error.h"
#include "renderer/gltf/gltf.h"
#include "tests/support/missing_reason.h"
#include "tests/unit/gltf_test_file.h"

namespace si::test {
namespace {

struct Case {
    std::string file, expected, also;
};

std::vector<Case> read_table(const std::filesystem::path& table) {
    std::vector<Case> out;
    std::ifstream in(table);
    std::string line;
    std::getline(in, line);  // headings
    while (std::getline(in, line)) {
        std::istringstream row(line);
        Case c;
        std::getline(row, c.file, '\t');
        std::getline(row, c.expected, '\t');
        std::getline(row, c.also, '\t');
        out.push_back(c);
    }
    return out;
}

/// Loads a file and returns "load" or "refuse"; other exceptions than si::Error fail the test.
std::string verdict(const std::filesystem::path& file, std::string& why) {
    try {
        const Scene scene = load_gltf(file);
        why = std::to_string(scene.triangle_count()) + " triangles";
        return "load";
    } catch (const Error& error) {
        why = error.what();
        return "refuse";
    }
}

/// Returns the resources that the process has used so far.
rusage resource_usage() {
    rusage usage{};
    EXPECT_EQ(getrusage(RUSAGE_SELF, &usage), 0);
    return usage;
}
/// Returns the peak memory of the process, KiB.
long peak_kib() {
    return resource_usage().ru_maxrss;
}
/// Returns the processor seconds of all threads so far: waits for other processes do not count.
double processor_seconds() {
    const rusage usage = resource_usage();
    return double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) * 1e-6;
}

/// Current folder, restored by the destructor.
class CurrentFolder {
public:
    explicit CurrentFolder(const std::filesystem::path& path) : before_(std::filesystem::current_path()) {
        std::filesystem::current_path(path);
    }
    CurrentFolder(const CurrentFolder&) = delete;
    CurrentFolder& operator=(const CurrentFolder&) = delete;
    ~CurrentFolder() { std::filesystem::current_path(before_); }

private:
    std::filesystem::path before_;
};

void run(const std::filesystem::path& folder, const char* table, std::size_t at_least) {
    if (!std::filesystem::exists(folder / table)) GTEST_SKIP() << test::kMissingReason << folder;
    const std::vector<Case> cases = read_table(folder / table);
    ASSERT_GE(cases.size(), at_least);
    [[maybe_unused]] const long most_kib = std::max(1L << 20, peak_kib());  // of tests in the same process, too
    for (const Case& c : cases) {
        std::optional<CurrentFolder> current;
        if (c.file == "uri_only_in_cwd.gltf") current.emplace(folder / "outside");
        const double before = processor_seconds();
        std::string why;
        const std::string got = verdict(folder / c.file, why);
        EXPECT_TRUE(got == c.expected || (!c.also.empty() && c.also.rfind(got, 0) == 0))
            << c.file << ": " << got << ": " << why;
        EXPECT_LT(processor_seconds() - before, 30.0) << c.file;  // a bound against hangs: one takes a second
        for (const char ch : why)
            EXPECT_GE(static_cast<unsigned char>(ch), 0x20) << c.file << ": control character in " << why;
        EXPECT_LT(why.size(), 1200u) << c.file;
    }
#if !defined(__SANITIZE_ADDRESS__)  // which keeps freed memory
    EXPECT_LE(peak_kib(), most_kib) << "KiB: more than 1 GiB was taken";
#endif
}

const std::filesystem::path kShared = std::filesystem::path(SI_SOURCE_DIR) / ".." / "shared";

TEST(Corpus, EveryModelLoadsOrIsRefusedWithItsReason) {
    run(kShared / "models", "EXPECT.tsv", 70);
}
TEST(Corpus, EveryBrokenFileGetsItsError) {
    run(kShared / "bad-gltf", "MANIFEST.tsv", 200);
}

/// Note that a real file's loading has to give: a part of it.
struct RealFile {
    const char *file, *note;
};
constexpr RealFile kRealFiles[] = {
    {"pmndrs_diamond/diamond.glb", "textures[1].source: image 1 does not exist"},
    {"webxr_stereo/stereo.gltf", "255 is the restart value of its type"},
    {"sketches_bunny/bunny.glb", "BLEND with alpha 1 everywhere; drawn and cast as opaque"},
    {"unigltf_tile/tile.glb", "node 1 is no root, it is a child of node 0"},
    {"png_deflate_block_type_3.gltf", "images[0]: the PNG's compressed data is damaged; drawn untextured"},
    {"jpeg_sos_unknown_component.gltf", "images[0]: the JPEG's scan names component"},
    {"tex_noimage.glb", "textures[0].source: image 0 does not exist"},
    {"zero_view_unused.gltf", "bufferViews[2]: its byteLength is 0; no accessor reads it"},
};

TEST(Corpus, FilesOfWebSitesLoadWithANote) {
    const std::filesystem::path folder = kShared / "real-files";
    if (!std::filesystem::exists(folder / "EXPECT.tsv")) GTEST_SKIP() << test::kMissingReason << folder;
    run(folder, "EXPECT.tsv", 10);
    for (const RealFile& row : kRealFiles) {
        const Scene scene = load_gltf(folder / row.file);
        EXPECT_TRUE(mentions(scene.warnings, row.note)) << row.file << ": " << testing::PrintToString(scene.warnings);
    }
}

}  // namespace
}  // namespace si::test
