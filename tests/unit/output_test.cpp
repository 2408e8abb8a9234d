// Tests of written files: complete or absent, whatever is in their place.
#include "app/base/output.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>
#include <utility>

#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "tests/support/environment_number.h"
#include "tests/support/error_text.h"
#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;

mode_t mode_of(const fs::path& file) {
    struct stat status {};
    EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
    return status.st_mode & 07777;
}

std::size_t files_in(const fs::path& folder) {
    return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFiles, KeepTheModeOfTheReplacedFile) {
    const fs::path folder = fresh_test_folder();
    for (const mode_t mode : {mode_t(0600), mode_t(0640), mode_t(0755)}) {
        std::ofstream(folder / "a.json") << "old";
        ASSERT_EQ(::chmod((folder / "a.json").c_str(), mode), 0);
        write_file(folder / "a.json", "new");
        EXPECT_EQ(mode_of(folder / "a.json"), mode);
        EXPECT_EQ(file_bytes(folder / "a.json"), "new");
    }
    const mode_t mask = ::umask(022);
    write_file(folder / "b.json", "new");
    ::umask(mask);
    EXPECT_EQ(mode_of(folder / "b.json"), 0644u);
}

TEST(OutputFiles, ReadOnlyOnesAreRefused) {
    const fs::path folder = fresh_test_folder(), file = folder / "a.json";
    std::ofstream(file) << "old";
    ASSERT_EQ(::chmod(file.c_str(), 0444), 0);
    EXPECT_TRUE(test::fails_with([&] { require_writable(file); }, {"a.json: cannot be written: it is read-only"}));
    EXPECT_THROW(write_file(file, "new"), Error);
    EXPECT_EQ(file_bytes(file), "old");
    EXPECT_EQ(files_in(folder), 1u);
}

TEST(OutputFiles, TemporariesAreUnpredictableAndFollowNoLinks) {
    const fs::path folder = fresh_test_folder(), mine = folder / "mine.txt";
    std::ofstream(mine) << "mine";
    // A link to another file under a predictable temporary name.
    for (int i = 0; i < 50; ++i)
        fs::create_symlink("mine.txt",
                           folder / ("a.json." + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp"));
    const std::size_t before = files_in(folder);
    for (int i = 0; i < 20; ++i) write_file(folder / "a.json", "new");
    EXPECT_EQ(file_bytes(mine), "mine");
    EXPECT_EQ(files_in(folder), before + 1);
}

TEST(OutputFiles, NamesMayHaveTheMaximumLength) {
    const fs::path folder = fresh_test_folder();
    const fs::path longest = folder / (std::string(250, 'n') + ".json"),
                   beyond = folder / (std::string(251, 'n') + ".json");
    write_file(longest, "new");
    EXPECT_EQ(file_bytes(longest), "new");
    EXPECT_TRUE(test::fails_with([&] { require_writable(beyond); }, {"name too long"}));
}

TEST(OutputFiles, DanglingLinksAreRefused) {
    const fs::path folder = fresh_test_folder();
    fs::create_symlink("gone.json", folder / "dangling.json");
    fs::create_symlink("b.json", folder / "a.json");
    fs::create_symlink("a.json", folder / "b.json");
    EXPECT_TRUE(
        test::fails_with([&] { require_writable(folder / "dangling.json"); },
                         {"dangling.json: cannot be written: it is a link to gone.json, which does not exist"}));
    EXPECT_TRUE(test::fails_with([&] { require_writable(folder / "a.json"); }, {"Too many levels of symbolic links"}));
    EXPECT_THROW(write_atomically(folder / "dangling.json", {"new"}), Error);
    EXPECT_FALSE(fs::exists(folder / "gone.json"));
    std::ofstream(folder / "real.json") << "old";
    fs::create_symlink("real.json", folder / "link.json");
    write_atomically(folder / "link.json", {"n", "ew"});
    EXPECT_TRUE(fs::is_symlink(folder / "link.json"));
    EXPECT_EQ(file_bytes(folder / "real.json"), "new");
}

TEST(OutputFiles, TwoFilesOfOneNameAreRefused) {
    const fs::path folder = fresh_test_folder();
    fs::create_directory(folder / "d");
    std::ofstream(folder / "a.png") << "old";
    fs::create_symlink("a.png", folder / "b.png");
    const auto refused = [&](const fs::path& a, const fs::path& b) {
        return !test::error_text([&] { require_distinct(a, "-o", b, "--report"); }).empty();
    };
    EXPECT_TRUE(refused(folder / "new.png", folder / "new.png"));
    EXPECT_TRUE(refused(folder / "new.png", folder / "d" / ".." / "new.png"));
    EXPECT_TRUE(refused(folder / "a.png", folder / "b.png"));
    EXPECT_FALSE(refused(folder / "a.png", folder / "d" / "a.png"));
    EXPECT_FALSE(refused(folder / "a.png", ""));
    EXPECT_FALSE(refused("/dev/null", "/dev/null"));
}

// SI_KILLS=200 for a thorough run.
TEST(OutputFiles, KillAtAnyTimeLeavesTheOldOrTheNewFile) {
    const fs::path folder = fresh_test_folder(), file = folder / "a.bin";
    const std::string one(3'000'001, '1'), two(2'000'003, '2');
    const int kills = int(test::environment_number("SI_KILLS", 20));
    std::mt19937 random(1);
    for (int i = 0; i < kills; ++i) {
        write_file(file, one);
        int written[2];  // a byte after the first complete new file
        ASSERT_EQ(::pipe(written), 0);
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0)
            for (bool second = true;; second = !second) {
                const auto part = std::string_view(second ? two : one);
                write_atomically(file, {part.substr(0, 1000), part.substr(1000)});
                if (i % 2 == 0 && written[1] >= 0 && ::write(written[1], "x", 1) == 1)
                    ::close(std::exchange(written[1], -1));
            }
        ::close(written[1]);
        // Every other kill comes during later writes, however slow the machine is, the others at any time.
        char byte = 0;
        if (i % 2 == 0) {
            EXPECT_EQ(::read(written[0], &byte, 1), 1) << "it does not write";
        }
        ::close(written[0]);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 20'000));
        ::kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
        const std::string left = file_bytes(file);
        ASSERT_TRUE(left == one || left == two) << i << ": " << left.size() << " bytes";
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path() != file) {
                EXPECT_TRUE(entry.path().filename().string().starts_with(".a.bin.")) << entry.path();
                fs::remove(entry.path());
            }
    }
}

}  // namespace
}  // namespace si
