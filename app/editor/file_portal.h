// The desktop's own dialog for files, asked for over the session's message bus.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "ui/widgets/file_dialog.h"

namespace si {

/// org.freedesktop.portal.FileChooser of xdg-desktop-portal (https://flatpak.github.io/xdg-desktop-portal). Nothing
/// waits for it: what a person chose, or that there is no such dialog, is an answer to be taken later.
class FilePortal {
public:
    struct Answer {
        enum class Kind { Chosen, Dismissed, NoDialog };
        Kind kind = Kind::NoDialog;
        FileDialog::Job job = FileDialog::Job::Open;
        std::filesystem::path file;  ///< where one was chosen
        std::string problem;         ///< why there is no dialog
    };

    /// @param wake called from another thread when there is an answer
    explicit FilePortal(std::function<void()> wake);
    /// Closes the dialog.
    ~FilePortal();
    FilePortal(const FilePortal&) = delete;
    FilePortal& operator=(const FilePortal&) = delete;

    /// Opens the dialog; one that is open is closed, and gives no answer any more.
    /// @param parent_window "x11:" and the window's id in hexadecimal digits, or "" where that is not known
    void ask(const DesktopFileDialog& dialog, const std::string& parent_window);
    /// The answer, once.
    std::optional<Answer> take_answer();

private:
    class Dialog;
    std::function<void()> wake_;
    std::unique_ptr<Dialog> dialog_;
};

/// The path that a file's URI names, %-escapes resolved; empty where it is none of a file of this machine.
std::filesystem::path path_of_file_uri(const std::string& uri);

}  // namespace si
