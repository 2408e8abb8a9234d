// Private message bus and fake desktop portal.
#if defined(SI_FILE_PORTAL)
#include "tests/ui/fake_portal.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace si::test {
namespace {

namespace fs = std::filesystem;

constexpr const char *kChooser = "org.freedesktop.portal.FileChooser", *kRequest = "org.freedesktop.portal.Request";

/// Returns whether somebody listens at the socket; the file exists a moment earlier.
bool takes_clients(const fs::path& socket_file) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    socket_file.string().copy(address.sun_path, sizeof address.sun_path - 1);
    const int client = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool taken = ::connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    ::close(client);
    return taken;
}

}  // namespace

bool within_minutes(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

PrivateBus::PrivateBus(const fs::path& folder)
    : socket_(fs::temp_directory_path() / fmt::format("shadow-inspector-bus-{}", getpid())) {
    // The desktop's own configuration would start services of the machine under test.
    std::ofstream(folder / "bus.conf") << fmt::format(
        "<busconfig><type>session</type><listen>unix:path={}</listen><auth>EXTERNAL</auth>\n"
        "<policy context=\"default\"><allow send_destination=\"*\" eavesdrop=\"true\"/><allow eavesdrop=\"true\"/>\n"
        "<allow own=\"*\"/></policy></busconfig>\n",
        socket_.string());
    fs::remove(socket_);
    daemon_ = std::make_unique<Process>(std::vector<std::string>{"dbus-daemon", "--nofork", "--nopidfile",
                                                                 "--config-file=" + (folder / "bus.conf").string()},
                                        folder, "bus.log");
    EXPECT_TRUE(within_minutes([&] { return takes_clients(socket_) || !daemon_->running(); }));
    EXPECT_TRUE(daemon_->running()) << "is the package dbus installed?";
    setenv("DBUS_SESSION_BUS_ADDRESS", ("unix:path=" + socket_.string()).c_str(), 1);
}

PrivateBus::~PrivateBus() {
    unsetenv("DBUS_SESSION_BUS_ADDRESS");
    daemon_.reset();
    std::error_code error;
    fs::remove(socket_, error);
}

FakePortal::FakePortal() : connection_(sdbus::createSessionBusConnection("org.freedesktop.portal.Desktop")) {
    chooser_ = sdbus::createObject(*connection_, "/org/freedesktop/portal/desktop");
    for (const char* method : {"OpenFile", "SaveFile"})
        chooser_->registerMethod(method).onInterface(kChooser).implementedAs(
            [this, method = std::string(method)](const std::string& parent_window, const std::string& title,
                                                 const Options& options) {
                return ask(method, parent_window, title, options);
            });
    chooser_->finishRegistration();
    connection_->enterEventLoopAsync();
}

FakePortal::~FakePortal() {
    connection_->leaveEventLoop();
}

sdbus::ObjectPath FakePortal::ask(const std::string& method, const std::string& parent_window, const std::string& title,
                                  const Options& options) {
    std::string sender = chooser_->getCurrentlyProcessedMessage()->getSender().substr(1);
    std::ranges::replace(sender, '.', '_');
    const std::string path = fmt::format("/org/freedesktop/portal/desktop/request/{}/{}", sender,
                                         options.at("handle_token").get<std::string>());
    auto request = sdbus::createObject(*connection_, path);
    request->registerMethod("Close").onInterface(kRequest).implementedAs([this] {
        const std::lock_guard lock(mutex_);
        ++closed_;
    });
    request->registerSignal("Response").onInterface(kRequest).withParameters<std::uint32_t, Options>();
    request->finishRegistration();
    const std::lock_guard lock(mutex_);
    requests_.push_back(std::move(request));
    questions_.push_back({method, parent_window, title, path, options});
    return path;
}

std::vector<FakePortal::Question> FakePortal::questions() const {
    const std::lock_guard lock(mutex_);
    return questions_;
}

bool FakePortal::wait_for_questions(std::size_t count) const {
    return within_minutes([&] { return questions().size() >= count; });
}

void FakePortal::answer(const Question& question, std::uint32_t code, const std::vector<std::string>& uris) {
    Options results;
    if (!uris.empty()) results["uris"] = uris;
    const std::lock_guard lock(mutex_);
    for (const auto& request : requests_)
        if (request->getObjectPath() == question.request)
            request->emitSignal("Response").onInterface(kRequest).withArguments(code, results);
}

int FakePortal::closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
}

bool FakePortal::wait_for_closed(int count) const {
    return within_minutes([&] { return closed() >= count; });
}

}  // namespace si::test
#endif
