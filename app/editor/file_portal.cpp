#include "app/editor/file_portal.h"

#include <sdbus-c++/sdbus-c++.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "renderer/base/percent_decoded.h"
#include "renderer/importers/importers.h"

namespace si {
namespace {

constexpr const char *kService = "org.freedesktop.portal.Desktop", *kObject = "/org/freedesktop/portal/desktop",
                     *kChooser = "org.freedesktop.portal.FileChooser", *kRequest = "org.freedesktop.portal.Request",
                     *kToken = "shadow_inspector";
constexpr std::chrono::seconds kStart{20};  // the portal may have to start first

using VariantMap = std::map<std::string, sdbus::Variant>;
using Patterns = std::vector<sdbus::Struct<std::uint32_t, std::string>>;
using Filter = sdbus::Struct<std::string, Patterns>;

/// Makes a glob pattern that ignores the case of letters.
std::string in_either_case(const std::string& extension) {
    std::string glob = "*.";
    for (const char c : extension) {
        const auto letter = static_cast<unsigned char>(c);
        glob += std::isalpha(letter) ? std::string{'[', char(std::tolower(letter)), char(std::toupper(letter)), ']'}
                                     : std::string(1, c);
    }
    return glob;
}

Filter filter_of(const std::string& label, const std::vector<std::string>& extensions) {
    Patterns patterns;
    for (const std::string& e : extensions) patterns.emplace_back(std::uint32_t(0), in_either_case(e));
    return Filter{label, patterns};
}

VariantMap options_of(const DesktopFileDialog& dialog) {
    std::string folder = dialog.folder.string();
    std::vector<std::uint8_t> bytes(folder.begin(), folder.end());
    bytes.push_back(0);
    VariantMap options{{"handle_token", std::string(kToken)}, {"current_folder", bytes}};
    if (dialog.job == FileDialog::Job::SavePreset) {
        if (!dialog.name.empty()) options["current_name"] = dialog.name;
        options["filters"] = std::vector<Filter>{filter_of("Presets", {"json"})};
        return options;
    }
    std::vector<std::string> scenes;
    for (const Importer& importer : importers())
        for (const std::string_view extension : importer.extensions) scenes.emplace_back(extension.substr(1));
    for (const FrameFile& row : frame_files())
        for (const std::string_view extension : row.extensions) scenes.emplace_back(extension.substr(1));
    std::vector<std::string> all = scenes;
    all.emplace_back("json");
    const std::vector<Filter> filters{filter_of("Scenes and presets", all), filter_of("Scenes", scenes),
                                      filter_of("Presets", {"json"})};
    options["filters"] = filters;
    options["current_filter"] = filters[std::size_t(dialog.kind)];
    return options;
}

/// Returns the path of the bus object that will send the answer; the portal derives it from the sender.
std::string request_path(std::string unique_name) {
    unique_name.erase(0, 1);
    std::ranges::replace(unique_name, '.', '_');
    return std::string(kObject) + "/request/" + unique_name + "/" + kToken;
}

}  // namespace

/// Dialog that is open or opening. Runs on a thread of its own, because each step may wait for another process.
class FilePortal::Dialog {
public:
    Dialog(const DesktopFileDialog& dialog, const std::string& parent_window, std::function<void()> wake)
        : dialog_(dialog), parent_window_(parent_window), wake_(std::move(wake)), thread_([this] { run(); }) {}

    ~Dialog() {
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
            if (connection_) connection_->leaveEventLoop();
        }
        thread_.join();
    }

    std::optional<Answer> take_answer() {
        const std::lock_guard lock(mutex_);
        return std::exchange(answer_, std::nullopt);
    }

private:
    /// Scope in which other threads may leave the connection's loop, also if the bus breaks off.
    struct Leavable {
        Dialog& dialog;
        ~Leavable() {
            const std::lock_guard lock(dialog.mutex_);
            dialog.connection_ = nullptr;
        }
    };

    void answer(Answer a) {
        const std::lock_guard lock(mutex_);
        if (answered_ || closed_) return;
        answered_ = true;
        a.job = dialog_.job;
        answer_ = std::move(a);
        if (connection_) connection_->leaveEventLoop();
    }

    void run() {
        try {
            converse();
        } catch (const std::exception& e) {
            answer({.problem = e.what()});
        }
        if (answered_) wake_();
    }

    void converse() {
        const auto connection = sdbus::createSessionBusConnection();
        {
            const std::lock_guard lock(mutex_);
            if (closed_) return;
            connection_ = connection.get();
        }
        const Leavable leavable{*this};
        // The handler is registered before the request, so that no answer is missed.
        const auto request = sdbus::createProxy(*connection, kService, request_path(connection->getUniqueName()));
        request->uponSignal("Response")
            .onInterface(kRequest)
            .call([this](std::uint32_t code, const VariantMap& results) { hear(code, results); });
        request->finishRegistration();
        const auto portal = sdbus::createProxy(*connection, kService, kObject);
        const bool saving = dialog_.job == FileDialog::Job::SavePreset;
        portal->callMethodAsync(saving ? "SaveFile" : "OpenFile")
            .onInterface(kChooser)
            .withTimeout(kStart)
            .withArguments(parent_window_,
                           std::string(saving ? "Save the preset as" : "Open a model, map, bundle, capture or preset"),
                           options_of(dialog_))
            .uponReplyInvoke([this](const sdbus::Error* error, const sdbus::ObjectPath&) {
                if (error) answer({.problem = error->getMessage()});
            });
        connection->enterEventLoop();
        const bool unanswered = [this] {
            const std::lock_guard lock(mutex_);
            return closed_ && !answered_;
        }();
        if (unanswered) request->callMethod("Close").onInterface(kRequest).dontExpectReply();
    }

    void hear(std::uint32_t code, const VariantMap& results) {
        const auto uris = results.find("uris");
        if (code != 0 || uris == results.end()) return answer({.kind = Answer::Kind::Dismissed});
        const auto chosen = uris->second.get<std::vector<std::string>>();
        const std::filesystem::path file = chosen.empty() ? std::filesystem::path() : path_of_file_uri(chosen[0]);
        answer({.kind = file.empty() ? Answer::Kind::Dismissed : Answer::Kind::Chosen, .file = file});
    }

    const DesktopFileDialog dialog_;
    const std::string parent_window_;
    const std::function<void()> wake_;
    std::mutex mutex_;
    sdbus::IConnection* connection_ = nullptr;  ///< null: the loop must not be left
    bool closed_ = false, answered_ = false;
    std::optional<Answer> answer_;
    std::thread thread_;  // last: uses all members above
};

FilePortal::FilePortal(std::function<void()> wake) : wake_(std::move(wake)) {}
FilePortal::~FilePortal() = default;

void FilePortal::open_dialog(const DesktopFileDialog& dialog, const std::string& parent_window) {
    dialog_.reset();  // one dialog at a time: two would have the same name on the bus
    dialog_ = std::make_unique<Dialog>(dialog, parent_window, wake_);
}

std::optional<FilePortal::Answer> FilePortal::take_answer() {
    std::optional<Answer> answer = dialog_ ? dialog_->take_answer() : std::nullopt;
    if (answer) dialog_.reset();
    return answer;
}

std::filesystem::path path_of_file_uri(const std::string& uri) {
    constexpr std::string_view kScheme = "file://";
    if (!uri.starts_with(kScheme)) return {};
    const std::size_t slash = uri.find('/', kScheme.size());
    const std::string host = uri.substr(kScheme.size(), slash - kScheme.size());
    if (slash == uri.npos || (!host.empty() && host != "localhost")) return {};
    const std::string path = percent_decode(std::string_view(uri).substr(slash));
    return path.find('\0') == path.npos ? std::filesystem::path(path) : std::filesystem::path();
}

}  // namespace si
