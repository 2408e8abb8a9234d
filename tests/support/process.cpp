#include "tests/support/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace si {
namespace {

namespace fs = std::filesystem;

void redirect(const fs::path& file, int descriptor) {
    const int to = ::open(file.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
    if (to < 0 || ::dup2(to, descriptor) < 0) ::_exit(126);
}

}  // namespace

std::string signal_once(std::string_view condition, std::string_view signal) {
    return fmt::format("for i in $(seq 300); do {} && break; sleep 0.1; done; kill -{} $!; wait $!; echo code $?\n",
                       condition, signal);
}

fs::path fresh_test_folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    const fs::path folder = fs::path(SI_TEST_OUTPUT_DIR) / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

std::string file_bytes(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + path.string());
    return {std::istreambuf_iterator<char>(in), {}};
}

Words::Words(const std::string& line) {
    std::istringstream in(line);
    for (std::string word; in >> word;) push_back(word);
}

namespace {

ProcessResult run(const Words& words, const fs::path& folder) {
    const fs::path base = fs::temp_directory_path() / ("si-process-" + std::to_string(::getpid()));
    const fs::path out = base.string() + ".out", err = base.string() + ".err";
    std::vector<char*> argv;
    for (const std::string& a : words) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) {
        redirect("/dev/null", STDIN_FILENO);
        redirect(out, STDOUT_FILENO);
        redirect(err, STDERR_FILENO);
        if (::chdir(folder.c_str()) != 0) ::_exit(126);
        ::unsetenv("DISPLAY");
        ::unsetenv("WAYLAND_DISPLAY");
        ::setenv("SI", SI_PROGRAM, 1);
        ::setenv("XDG_STATE_HOME", SI_TEST_OUTPUT_DIR "/state", 1);
        ::setenv("XDG_CACHE_HOME", SI_TEST_OUTPUT_DIR "/cache", 1);
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ProcessResult result{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), file_bytes(out),
                         file_bytes(err)};
    fs::remove(out);
    fs::remove(err);
    return result;
}

}  // namespace

ProcessResult run_program(const Words& arguments, const fs::path& folder) {
    return run(Words{SI_PROGRAM} + arguments, folder);
}

nlohmann::json program_json(const Words& arguments, const fs::path& folder, Caller caller) {
    const ProcessResult r = run_program(arguments + "--json", folder);
    const testing::ScopedTrace trace(caller.file, caller.line, testing::PrintToString(arguments));
    EXPECT_EQ(r.code, 0) << r.err;
    return nlohmann::json::parse(r.out, nullptr, false);
}

Words set_words(const nlohmann::json& settings) {
    Words words;
    for (const auto& [key, value] : settings.items())
        words.insert(words.end(), {"--set", key + "=" + value.get<std::string>()});
    return words;
}

ProcessResult expect_error(const Words& arguments, int code, std::string_view text, const fs::path& folder,
                           Caller caller) {
    const ProcessResult r = run_program(arguments, folder);
    const testing::ScopedTrace trace(caller.file, caller.line, testing::PrintToString(arguments));
    EXPECT_EQ(r.code, code) << r.err;
    EXPECT_NE(r.err.find(text), std::string::npos) << text << " is missing in: " << r.err;
    return r;
}

ProcessResult run_shell(const std::string& script, const fs::path& folder) {
    return run({"/bin/sh", "-c", script}, folder);
}

}  // namespace si
