// Tests of run.sh with a fake build: progress, compiler errors, and the start of the program.
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <regex>
#include <stdexcept>

#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Fake cmake over ninja with twelve steps. FAKE names the failing step.
constexpr const char* kFakeCmake = R"(#!/bin/sh
build=$(dirname "$0")/../build/release
if [ "$1" = -S ]; then
  if [ "$FAKE" = configure ]; then echo "CMake Error: no wheels"; exit 3; fi
  mkdir -p "$build"
  : >"$build/build.ninja"
  exit
fi
tell() {
  status=$(printf %s "${NINJA_STATUS-[%f/%t] }" | sed "s,%p,$(printf %3d $((100 * $1 / $2)))%,; s,%f,$1,; s,%t,$2,")
  printf '%s%s\n' "$status" "$3"
}
tell 1 1 "Re-checking globbed directories..."
if [ -x "$build/shadow-inspector" ]; then echo "ninja: no work to do."; exit; fi
step=0
while [ $step -lt 12 ]; do
  step=$((step + 1))
  if [ "$FAKE" = compile ] && [ $step = 4 ]; then
    echo "FAILED: wheel.cpp.o"
    echo "wheel.cpp:7: error: no such spoke" >&2
    exit 2
  fi
  tell $step 12 "Building CXX object $step.cpp.o"
done
printf '#!/bin/sh\necho "told: $*"\nexit 7\n' >"$build/shadow-inspector"
chmod +x "$build/shadow-inspector"
)";

class RunScript : public testing::Test {
protected:
    const fs::path folder_ = fresh_test_folder();

    void SetUp() override {
        for (const char* folder : {"scripts", "bin", "home"}) fs::create_directory(folder_ / folder);
        for (const char* file : {"run.sh", "scripts/packages.sh"})
            fs::copy_file(fs::path(SI_SOURCE_DIR) / file, folder_ / file);
        put_command("cmake", kFakeCmake);
        for (const char* command : {"apt-get", "sudo"}) put_command(command, "#!/bin/sh\nexit 9\n");
    }
    void put_command(const char* name, const char* text) const {
        const fs::path file = folder_ / "bin" / name;
        std::ofstream(file) << text;
        fs::permissions(file, fs::perms::owner_all);
    }
    static std::string among_fakes(const std::string& command, const std::string& fails = {}) {
        return "export PATH=\"$PWD/bin:$PATH\" HOME=\"$PWD/home\" SI_SKIP_PACKAGES=1 FAKE=" + fails +
               "; unset NINJA_STATUS; " + command;
    }
    /// Runs a command with the fake build. @param fails failing part of the build; empty: none
    ProcessResult run(const std::string& command, const std::string& fails = {}) const {
        return run_shell(among_fakes(command, fails), folder_);
    }
    /// Runs a command on a terminal; `out` is the text that the terminal shows.
    ProcessResult run_on_terminal(const std::string& command) const {
        const std::string script = "cd '" + folder_.string() + "'; " + among_fakes(command);
        ProcessResult result;
        int terminal = -1;
        const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
        if (child == 0) {
            execl("/bin/sh", "sh", "-c", script.c_str(), nullptr);
            _exit(127);
        }
        if (child < 0) throw std::runtime_error("no terminal can be made");
        char some[4096];
        // Reading from a terminal fails once all writers have closed it.
        for (ssize_t n; (n = read(terminal, some, sizeof some)) > 0;) result.out.append(some, std::size_t(n));
        close(terminal);
        int status = 0;
        waitpid(child, &status, 0);
        result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return result;
    }
    static std::vector<int> percents(const std::string& text) {
        std::vector<int> out;
        const std::regex percent("Building: +([0-9]+) %");
        for (std::sregex_iterator at(text.begin(), text.end(), percent), end; at != end; ++at)
            out.push_back(std::stoi((*at)[1].str()));
        return out;
    }
    static void expect_rising_to_100(const std::vector<int>& told) {
        ASSERT_GE(told.size(), 5u);
        EXPECT_LE(told.front(), 10);
        EXPECT_EQ(told.back(), 100);
        EXPECT_TRUE(std::ranges::adjacent_find(told, std::greater_equal<>()) == told.end()) << "one does not rise";
    }
};

TEST_F(RunScript, PrintsBuildProgressInPercentAndRunsTheProgram) {
    const ProcessResult built = run("./run.sh list 'two words'");
    EXPECT_EQ(built.code, 7) << "the program's" << built.err;
    EXPECT_EQ(built.out, "told: list two words\n");
    expect_rising_to_100(percents(built.err));
    EXPECT_EQ(built.err.find("CXX object"), std::string::npos) << built.err;
    const ProcessResult again = run("./run.sh");
    EXPECT_EQ(again.code, 7);
    EXPECT_EQ(again.out, "told: \n");
    EXPECT_EQ(again.err, "") << "there is nothing to build";
}

TEST_F(RunScript, UpdatesProgressInPlaceOnATerminal) {
    const ProcessResult built = run_on_terminal("./run.sh");
    EXPECT_EQ(built.code, 7) << built.out;
    expect_rising_to_100(percents(built.out));
    EXPECT_NE(built.out.find("\rBuilding:  25 %\rBuilding:  33 %"), std::string::npos) << built.out;
    EXPECT_NE(built.out.find("\rBuilding: 100 %\r\ntold: "), std::string::npos) << built.out;
}

TEST_F(RunScript, PrintsCompilerErrorsOnFailure) {
    const ProcessResult built = run("./run.sh", "compile");
    EXPECT_EQ(built.code, 1);
    EXPECT_EQ(built.out, "");
    for (const char* line : {"FAILED: wheel.cpp.o\n", "wheel.cpp:7: error: no such spoke\n"})
        EXPECT_NE(built.err.find(line), std::string::npos) << built.err;
    EXPECT_EQ(percents(built.err), (std::vector{8, 25}));
    const ProcessResult configured = run("rm -r build; ./run.sh", "configure");
    EXPECT_EQ(configured.code, 1);
    EXPECT_EQ(configured.out, "");
    EXPECT_NE(configured.err.find("CMake Error: no wheels\n"), std::string::npos) << configured.err;
}

}  // namespace
}  // namespace si
