#include "app/editor/clipboard.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>
#include <vector>

extern char** environ;

namespace si {
namespace {

enum class Drawn { Well, Badly, NotThere };

/// Runs a program with a file as its standard input and waits until the program has read the file.
Drawn run(std::vector<std::string> words, const std::filesystem::path& input) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, input.c_str(), O_RDONLY, 0);
    for (const int out : {1, 2}) posix_spawn_file_actions_addopen(&files, out, "/dev/null", O_WRONLY, 0);
    pid_t child = -1;
    const int problem = posix_spawnp(&child, arguments[0], &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (problem != 0) return problem == ENOENT ? Drawn::NotThere : Drawn::Badly;
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return Drawn::Badly;
    return !WIFEXITED(status)           ? Drawn::Badly
           : WEXITSTATUS(status) == 127 ? Drawn::NotThere
           : WEXITSTATUS(status) == 0   ? Drawn::Well
                                        : Drawn::Badly;
}

}  // namespace

std::string copy_png(const std::filesystem::path& png) {
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value;
    };
    if (!set("DISPLAY") && !set("WAYLAND_DISPLAY")) return "there is no display";
    const std::vector<std::string> xclip{"xclip", "-selection", "clipboard", "-target", "image/png", "-in"},
        wl_copy{"wl-copy", "--type", "image/png"};
    Drawn ran = Drawn::NotThere;
    if (set("WAYLAND_DISPLAY")) ran = run(wl_copy, png);
    if (ran == Drawn::NotThere && set("DISPLAY")) ran = run(xclip, png);
    if (ran == Drawn::NotThere)
        return set("WAYLAND_DISPLAY") ? "install wl-clipboard to copy pictures" : "install xclip to copy pictures";
    return ran == Drawn::Well ? "" : "the display took no picture";
}

}  // namespace si
