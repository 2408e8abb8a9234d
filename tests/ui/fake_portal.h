// A message bus of the test's own, and a desktop's portal on it that does what the test says.
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

/// Waits until it is so, against a hang only: no machine is so slow.
bool within_minutes(const std::function<bool()>& done);

/// A bus on which nobody offers anything. $DBUS_SESSION_BUS_ADDRESS names it while it lives.
class PrivateBus {
public:
    explicit PrivateBus(const std::filesystem::path& folder);
    ~PrivateBus();
    PrivateBus(const PrivateBus&) = delete;
    PrivateBus& operator=(const PrivateBus&) = delete;

private:
    std::filesystem::path socket_;
    std::unique_ptr<Process> daemon_;
};

/// org.freedesktop.portal.Desktop as its documentation describes it, without a person.
class FakePortal {
public:
    using Options = std::map<std::string, sdbus::Variant>;
    struct Question {
        std::string method, parent_window, title, request;  ///< `request`: the path of the object that answers
        Options options;
    };

    FakePortal();
    ~FakePortal();
    FakePortal(const FakePortal&) = delete;
    FakePortal& operator=(const FakePortal&) = delete;

    /// All so far.
    std::vector<Question> questions() const;
    /// Waits until so many were put.
    bool wait_for_questions(std::size_t count) const;
    /// The answer to one of them: 0 with what was chosen, 1 where the person closed the dialog.
    void answer(const Question& question, std::uint32_t code, const std::vector<std::string>& uris);
    /// How many dialogs their programs closed.
    int closed() const;
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
