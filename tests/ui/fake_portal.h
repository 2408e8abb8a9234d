// Private message bus with a fake desktop portal that tests control.
#pragma once

#include <sdbus-c++/sdbus-c++.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tests/ui/window_fixture.h"

namespace si::test {

/// Waits until `done` returns true. Returns false after minutes, as a bound against hangs.
bool within_minutes(const std::function<bool()>& done);

/// Message bus without services. $DBUS_SESSION_BUS_ADDRESS names the bus during the lifetime of the object.
class PrivateBus {
public:
    /// Starts the bus with its socket in `folder`.
    explicit PrivateBus(const std::filesystem::path& folder);
    ~PrivateBus();
    PrivateBus(const PrivateBus&) = delete;
    PrivateBus& operator=(const PrivateBus&) = delete;

private:
    std::filesystem::path socket_;
    std::unique_ptr<Process> daemon_;
};

/// Fake of org.freedesktop.portal.Desktop: records file dialogs and answers them as the test says.
class FakePortal {
public:
    using Options = std::map<std::string, sdbus::Variant>;
    /// One request for a file dialog.
    struct Question {
        std::string method, parent_window, title, request;  ///< `request`: path of the D-Bus object that answers
        Options options;
    };

    FakePortal();
    ~FakePortal();
    FakePortal(const FakePortal&) = delete;
    FakePortal& operator=(const FakePortal&) = delete;

    /// Returns all requests so far.
    std::vector<Question> questions() const;
    /// Waits for `count` requests. Returns false after minutes.
    bool wait_for_questions(std::size_t count) const;
    /// Answers a request: code 0 with chosen file URIs, code 1 for a closed dialog.
    void answer(const Question& question, std::uint32_t code, const std::vector<std::string>& uris);
    /// Returns how many dialogs were closed by their programs.
    int closed() const;
    /// Waits for `count` closed dialogs. Returns false after minutes.
    bool wait_for_closed(int count) const;

private:
    sdbus::ObjectPath ask(const std::string& method, const std::string& parent_window, const std::string& title,
                          const Options& options);
    std::unique_ptr<sdbus::IConnection> connection_;
    mutable std::mutex mutex_;
    std::vector<Question> questions_;
    int closed_ = 0;
    std::vector<std::unique_ptr<sdbus::IObject>> requests_;
    std::unique_ptr<sdbus::IObject> chooser_;
};

}  // namespace si::test
