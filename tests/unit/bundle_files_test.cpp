// Tests of the files of a bundle: folders and zip files, and hostile ones.
#include "renderer/bundle/bundle_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "tests/support/error_text.h"
#include "tests/support/process.h"
#include "tests/support/zip_bytes.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using test::ZipPart;

class BundleFilesTest : public testing::Test {
protected:
    fs::path folder =
        fs::path(SI_TEST_OUTPUT_DIR) / testing::UnitTest::GetInstance()->current_test_info()->name() / "bundles";

    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void put(const fs::path& name, std::string_view bytes) const {
        fs::create_directories((folder / name).parent_path());
        std::ofstream(folder / name, std::ios::binary) << bytes;
    }
    static std::string text(const std::vector<std::byte>& bytes) {
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    testing::AssertionResult zip_is_refused(const std::vector<ZipPart>& parts,
                                            std::initializer_list<std::string_view> said) const {
        std::vector<ZipPart> all = {{"frame.json", "{}"}};
        all.insert(all.end(), parts.begin(), parts.end());
        put("a.zip", test::zip_of(all));
        return test::fails_with([&] { BundleFiles(folder / "a.zip").read("evil", 1000); }, said);
    }
};

TEST_F(BundleFilesTest, FolderZipAndFrameJsonGiveTheSameFiles) {
    const BundleContents contents = {{"frame.json", "{}"}, {"maps/a.pfm", std::string("\0\1\2", 3)}, {"empty", ""}};
    write_bundle_files(contents, folder / "f.bundle");
    write_bundle_files(contents, folder / "f.zip");
    fs::rename(folder / "f.zip", folder / "zip.bundle");
    for (const fs::path& path :
         {folder / "f.bundle", folder / "f.bundle/frame.json", folder / "f.bundle/", folder / "zip.bundle"}) {
        EXPECT_TRUE(is_bundle_path(path)) << path;
        BundleFiles files(path);
        for (const auto& [name, bytes] : contents) {
            EXPECT_TRUE(files.has(name));
            EXPECT_EQ(text(files.read(name, 1000)), bytes) << path << " " << name;
        }
        EXPECT_FALSE(files.has("maps"));
        EXPECT_FALSE(files.has("other"));
        EXPECT_TRUE(test::fails_with([&] { files.read("other", 1000); }, {"other", "does not exist"}));
        EXPECT_TRUE(test::fails_with([&] { files.read("maps", 1000); }, {"maps: "}));
        EXPECT_TRUE(test::fails_with([&] { files.read("maps/a.pfm", 2); }, {"maps/a.pfm: has 3 bytes", "limit of 2"}));
        EXPECT_TRUE(test::fails_with([&] { files.read("../f.bundle/frame.json", 9); }, {"has .."}));
        EXPECT_TRUE(test::fails_with([&] { files.read("/etc/passwd", 9); }, {"begins with /"}));
        EXPECT_FALSE(files.files_read().empty());
        EXPECT_TRUE(files.files_read().front().stamp);
    }
    EXPECT_FALSE(is_bundle_path(folder / "a.glb"));
}

TEST_F(BundleFilesTest, ZipsInOneFolderAreRead) {
    put("a.zip", test::zip_of({{"f/", ""}, {"f/frame.json", "{}"}, {"f/evil", "good"}, {"__MACOSX/x", ""}}));
    EXPECT_EQ(text(BundleFiles(folder / "a.zip").read("evil", 10)), "good");
    put("b.zip", test::zip_of({{"f/frame.json", "{}"}, {"g/frame.json", "{}"}}));
    EXPECT_TRUE(test::fails_with([&] { BundleFiles(folder / "b.zip"); }, {"b.zip", "no frame.json"}));
}

TEST_F(BundleFilesTest, WrittenBundlesReplaceOnlyBundles) {
    const fs::path path = folder / "f.bundle";
    const BundleContents contents = {{"frame.json", "{}"}, {"a.pfm", "1"}};
    write_bundle_files(contents, path);
    write_bundle_files({{"frame.json", "{ }"}, {"a.pfm", "2"}}, path);
    EXPECT_EQ(file_bytes(path / "a.pfm"), "2");
    put("f.bundle/mine.txt", "x");
    EXPECT_TRUE(test::fails_with([&] { write_bundle_files(contents, path); }, {"f.bundle: the folder holds mine.txt"}));
    EXPECT_EQ(file_bytes(path / "a.pfm"), "2");
    put("file.bundle", "x");
    EXPECT_TRUE(test::fails_with([&] { write_bundle_files(contents, folder / "file.bundle"); }, {"is no folder"}));
    EXPECT_TRUE(
        test::fails_with([&] { write_bundle_files(contents, folder / "none/f.bundle"); }, {"cannot be written"}));
    EXPECT_TRUE(test::fails_with([&] { write_bundle_files({{"../x", ""}}, path); }, {"has .."}));
    for (const auto& entry : fs::directory_iterator(folder))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path() << " was left";
}

TEST_F(BundleFilesTest, FilesOfAnOlderBundleGoWithIt) {
    const std::string frame =
        R"({"bundle": 1, "lights": [{"type": "spot", "maps": [{"image": {"file": "old.pfm"}, "clip_from_world":
        [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1], "depth": {"range": "0..1"}}]}]})";
    write_bundle_files({{"frame.json", frame}, {"old.pfm", "1"}}, folder / "f.bundle");
    write_bundle_files({{"frame.json", "{}"}, {"new.pfm", "1"}}, folder / "f.bundle");
    EXPECT_FALSE(fs::exists(folder / "f.bundle/old.pfm"));
    EXPECT_TRUE(fs::exists(folder / "f.bundle/new.pfm"));
}

TEST_F(BundleFilesTest, EqualContentsGiveEqualZips) {
    const BundleContents contents = {{"frame.json", "{}"}, {"a.pfm", std::string(3'000'000, '\7')}};
    write_bundle_files(contents, folder / "a.zip");
    const std::string bytes = file_bytes(folder / "a.zip");
    write_bundle_files(contents, folder / "a.zip");
    EXPECT_EQ(file_bytes(folder / "a.zip"), bytes);
    EXPECT_EQ(BundleFiles(folder / "a.zip").read("a.pfm", 4'000'000).size(), 3'000'000u)
        << "a map that compresses well stays within the limit of the reader";
}

TEST_F(BundleFilesTest, LinksPipesAndDevicesAreNotOpened) {
    put("secret", "secret");
    put("f.bundle/frame.json", "{}");
    fs::create_symlink(folder / "secret", folder / "f.bundle/link");
    fs::create_directory_symlink(folder, folder / "f.bundle/dir");
    ASSERT_EQ(::mkfifo((folder / "f.bundle/pipe").c_str(), 0600), 0);
    BundleFiles files(folder / "f.bundle");
    EXPECT_TRUE(test::fails_with([&] { files.read("link", 100); }, {"link: is a link"}));
    EXPECT_TRUE(test::fails_with([&] { files.read("dir/secret", 100); }, {"dir/secret: has a link"}));
    EXPECT_TRUE(test::fails_with([&] { files.read("pipe", 100); }, {"pipe: is no regular file"}));
    EXPECT_FALSE(files.has("link"));
    EXPECT_FALSE(files.has("pipe"));
    fs::remove(folder / "f.bundle/frame.json");
    fs::create_symlink(folder / "secret", folder / "f.bundle/frame.json");
    EXPECT_TRUE(
        test::fails_with([&] { BundleFiles(folder / "f.bundle"); }, {"f.bundle: the folder has no frame.json"}));
    for (const char* name : {"secret", "f.bundle/pipe", "missing.bundle"})
        EXPECT_TRUE(test::fails_with([&] { BundleFiles(folder / name); }, {name, "; open a folder or zip file"}));
    EXPECT_TRUE(test::fails_with([&] { BundleFiles("/dev/zero"); }, {"is neither folder nor zip"}));
}

TEST_F(BundleFilesTest, HostileZipsAreRefused) {
    EXPECT_TRUE(zip_is_refused({{"../evil", "x"}}, {"a.zip: the entry \"../evil\" has ..", "; write the zip"}));
    EXPECT_TRUE(zip_is_refused({{"a/../../evil", "x"}}, {"has .."}));
    EXPECT_TRUE(zip_is_refused({{"/evil", "x"}}, {"begins with /"}));
    EXPECT_TRUE(zip_is_refused({{"a\\evil", "x"}}, {"a backslash"}));
    EXPECT_TRUE(zip_is_refused({{"c:evil", "x"}}, {"a colon"}));
    EXPECT_TRUE(zip_is_refused({{"a\nb", "x"}}, {"\\x0a", "a control character"}));
    EXPECT_TRUE(zip_is_refused({{"evil", "/etc/passwd", 0, 0, 0120777}}, {"\"evil\" is a link"}));
    EXPECT_TRUE(zip_is_refused({{"evil", "", 0, 0, 0010644}}, {"is neither file nor folder"}));
    EXPECT_TRUE(zip_is_refused({{"evil", "x", 0, 1}}, {"is encrypted"}));
    EXPECT_TRUE(zip_is_refused({{"evil", "x", 12}}, {"by another method than deflate"}));
    EXPECT_TRUE(zip_is_refused({{"evil", "x"}, {"evil", "y"}}, {"twice"}));
    EXPECT_TRUE(zip_is_refused({{"evil", "x"}, {"evil/", ""}}, {"twice"}));
    EXPECT_TRUE(zip_is_refused({{"evil", "x", 0, 0, 0100644, ~0u, true}}, {"evil: cannot be read"}));
    EXPECT_TRUE(zip_is_refused({{"evil", std::string("\3\0", 2), 8, 0, 0100644, 5}}, {"evil: cannot be read"}))
        << "an empty stream in place of five bytes";
    EXPECT_TRUE(zip_is_refused({{"evil", "x", 8, 0, 0100644, 900'000}}, {"holds 900002 bytes", "1000 to one"}));
    EXPECT_TRUE(zip_is_refused({{"a", "x", 8, 0, 0100644, 0xfffffff0u}, {"b", "x", 8, 0, 0100644, 0x7ffffff0u}},
                               {"above 4294967296 bytes"}));
    EXPECT_TRUE(zip_is_refused({{"evil", std::string(1001, 'x')}}, {"evil: has 1001 bytes, more than the limit"}));
    std::vector<ZipPart> many;
    for (int i = 0; i < 4096; ++i) many.push_back({std::to_string(i), ""});
    EXPECT_TRUE(zip_is_refused(many, {"4097 entries"}));
    EXPECT_FALSE(zip_is_refused({{"evil", "good"}}, {}));
}

TEST_F(BundleFilesTest, DamagedZipsAreRefused) {
    const std::string good = test::zip_of({{"frame.json", "{}"}, {"evil", std::string(200, 'x')}});
    for (std::size_t size = 0; size < good.size(); size += 7) {
        put("a.zip", good.substr(0, size));
        EXPECT_TRUE(test::fails_with([&] { BundleFiles(folder / "a.zip"); }, {"a.zip: ", "; "})) << size;
    }
    for (std::size_t at = 0; at < good.size(); ++at) {
        std::string other = good;
        other[at] = char(other[at] ^ 0x55);
        put("a.zip", other);
        try {
            BundleFiles files(folder / "a.zip");
            files.read("frame.json", 1000);
            files.read("evil", 1000);
        } catch (const Error& e) {
            EXPECT_TRUE(test::mentions(e.what(), {"a.zip", "; "}));
        }
    }
    put("a.zip", "PK\3\4 no zip");
    EXPECT_TRUE(test::fails_with([&] { BundleFiles(folder / "a.zip"); }, {"is no zip file that can be read"}));
}

}  // namespace
}  // namespace si
