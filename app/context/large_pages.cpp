#include "app/context/large_pages.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace si {
namespace {

constexpr const char* kVariable = "GLIBC_TUNABLES";
constexpr const char* kTunable = "glibc.malloc.hugetlb";

std::string tunables() {
    const char* text = std::getenv(kVariable);
    return text ? text : "";
}

/// Which of "always", "madvise" and "never" the system does; empty where it has no large pages.
std::string system_mode() {
    std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
    for (std::string word; file >> word;)
        if (word.size() > 2 && word.front() == '[') return word.substr(1, word.size() - 2);
    return {};
}

/// A C library that knows the tunable, and has malloc to itself.
constexpr bool has_tunable() {
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
    return __GLIBC__ > 2 || (__GLIBC__ == 2 && __GLIBC_MINOR__ >= 35);
#else
    return false;
#endif
}

}  // namespace

void restart_with_large_pages(char** arguments) {
    const std::string before = tunables();
    if (!has_tunable() || before.find(kTunable) != before.npos || system_mode() != "madvise") return;
    std::error_code error;
    // By its own name: processes are told apart by the name of what was started.
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    // Started by the dynamic linker's own name, that is what would be started, with the arguments of this program.
    if (error || !std::filesystem::exists(program, error) || program.filename().string().starts_with("ld")) return;
    const std::string with = (before.empty() ? "" : before + ":") + kTunable + "=1";
    if (setenv(kVariable, with.c_str(), 1) != 0) return;
    execv(program.c_str(), arguments);
    // Still here: it could not be started.
    if (before.empty())
        unsetenv(kVariable);
    else
        setenv(kVariable, before.c_str(), 1);
}

const char* memory_pages() {
    const std::string mode = system_mode();
    const bool asks = has_tunable() && tunables().find(std::string(kTunable) + "=1") != std::string::npos;
    return mode == "always" || (mode == "madvise" && asks) ? "large" : "small";
}

}  // namespace si
