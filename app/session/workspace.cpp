#include "app/session/workspace.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "app/base/json_text.h"
#include "app/base/output.h"
#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "renderer/base/index_of.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWorkspaceFormat = "shadow-inspector-workspace";
constexpr int kWorkspaceVersion = 1;
constexpr std::size_t kMaxRecent = 12;
constexpr const char* kFile = "workspace.json";

/// Calls visit(section, key, member) for each member of the file, in the file's order. Members outside all sections
/// have an empty one; numbers come with their bounds.
template <class Data, class Visit>
void visit_members(Data& d, const Visit& visit) {
    visit("layout", "settings_width", d.layout.settings_width, 4, 400);
    visit("layout", "bottom_height", d.layout.bottom_height, 4, 400);
    visit("layout", "strip_open", d.layout.strip_open);
    visit("layout", "map_share", d.layout.map_share, 0.05, 0.95);
    visit("layout", "map_height", d.layout.map_height, 0.05, 0.95);
    visit("layout", "map_inset", d.layout.map_inset, 4, 400);
    visit("layout", "map_place", d.layout.map_place, 0, index_of(MapSpot::Hidden));
    visit("layout", "map_plots", d.layout.map_plots);
    visit("layout", "light_theme", d.layout.light_theme);
    visit("layout", "desktop_dialogs", d.layout.desktop_dialogs);
    visit("window", "width", d.window_width, 200, 32768);
    visit("window", "height", d.window_height, 150, 32768);
    visit("window", "maximised", d.maximised);
    visit("", "welcomed", d.welcomed);
    visit("", "capture_warned", d.capture_warned);
    visit("", "recent_scenes", d.recent_scenes);
    visit("", "recent_presets", d.recent_presets);
}

/// Reads a member of its type and within its bounds; else keeps `value`.
template <class T>
void read_member(const Json& json, T& value, double least, double most) {
    if (!json.is_number()) return;
    const double number = json.get<double>();
    if (number >= least && number <= most) value = T(number);
}

void read_member(const Json& json, bool& value) {
    if (json.is_boolean()) value = json.get<bool>();
}

void read_member(const Json& json, std::vector<std::string>& list) {
    if (!json.is_array()) return;
    list.clear();
    for (const Json& entry : json)
        if (entry.is_string() && list.size() < kMaxRecent) list.push_back(entry.get<std::string>());
}

WorkspaceData from_json(const Json& json) {
    WorkspaceData d;
    visit_members(d, [&](const std::string& section, const char* key, auto& value, auto... bounds) {
        const Json part = section.empty() ? json : json.value(section, Json());
        if (const auto it = part.find(key); it != part.end()) read_member(*it, value, bounds...);
    });
    if (d.window_width == 0 || d.window_height == 0) d.window_width = d.window_height = 0;
    return d;
}

std::string to_text(const WorkspaceData& d) {
    Json json{{"format", kWorkspaceFormat}, {"version", kWorkspaceVersion}};
    visit_members(d, [&](const std::string& section, const char* key, const auto& value, auto...) {
        Json& part = section.empty() ? json : json[section];
        part[key] = value;
    });
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Returns the program's folder below an XDG base directory. @param below_home default of the base directory, below
/// $HOME
fs::path own_folder(const char* variable, const char* below_home) {
    const auto absolute = [](const char* name) -> fs::path {
        const char* value = std::getenv(name);
        // The XDG specification ignores relative paths.
        return value && *value == '/' ? fs::path(value) : fs::path();
    };
    if (const fs::path base = absolute(variable); !base.empty()) return base / "shadow-inspector";
    if (const fs::path home = absolute("HOME"); !home.empty()) return home / below_home / "shadow-inspector";
    return {};
}

}  // namespace

fs::path state_folder() {
    return own_folder("XDG_STATE_HOME", ".local/state");
}

fs::path cache_folder() {
    return own_folder("XDG_CACHE_HOME", ".cache");
}

LockFile::LockFile(const fs::path& path, bool wait) {
    for (;;) {
        const int fd = ::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
        if (fd < 0) return;
        struct stat locked {
        }, named{};
        if (::flock(fd, wait ? LOCK_EX : LOCK_EX | LOCK_NB) != 0 || ::fstat(fd, &locked) != 0) {
            ::close(fd);
            return;
        }
        // Another process may have removed the file between open and lock; the lock would then protect nothing.
        if (::stat(path.c_str(), &named) == 0 && named.st_ino == locked.st_ino && named.st_dev == locked.st_dev) {
            fd_ = fd;
            return;
        }
        ::close(fd);
    }
}

void LockFile::release() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
}

Workspace::Workspace(fs::path folder) : folder_(std::move(folder)) {
    if (!folder_.empty()) read(data_);
}

/// Returns true if the workspace file may be written.
bool Workspace::read(WorkspaceData& data) {
    const fs::path path = folder_ / kFile;
    if (!is_taken(path)) return true;
    try {
        const Json json = parse_json_text(read_text_file(path), path.string());
        if (!json.is_object() || json.value("format", Json()) != kWorkspaceFormat ||
            json.value("version", Json()) != kWorkspaceVersion)
            throw Error(
                fmt::format("{}: not a workspace of this version; move it away to have layout and recent files "
                            "remembered again",
                            path.string()));
        data = from_json(json);
        return true;
    } catch (const std::exception& e) {
        if (!foreign_) remarks_.emplace_back(e.what());
        foreign_ = true;
        return false;
    }
}

void Workspace::change(const std::function<void(WorkspaceData&)>& edit) {
    WorkspaceData wanted = data_;
    edit(wanted);
    if (wanted == data_) return;
    if (folder_.empty() || foreign_) {
        data_ = std::move(wanted);
        return;
    }
    try {
        make_folders(folder_);
        const LockFile lock(folder_ / "workspace.lock", true);
        WorkspaceData stored = data_;
        const bool ours = read(stored);
        edit(stored);
        data_ = std::move(stored);
        if (ours) write_regular_file(folder_ / kFile, to_text(data_));
    } catch (const std::exception& e) {
        data_ = std::move(wanted);
        remarks_.push_back(fmt::format("layout and recent files are not remembered: {}", e.what()));
        foreign_ = true;  // reported once
    }
}

void put_first(std::vector<std::string>& recent, const std::string& path) {
    std::erase(recent, path);
    recent.insert(recent.begin(), path);
    if (recent.size() > kMaxRecent) recent.resize(kMaxRecent);
}

}  // namespace si
