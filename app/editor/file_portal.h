// The desktop's own file dialog, requested over the session's message bus.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "ui/widgets/file_dialog.h"

namespace si {

/// Client of org.freedesktop.portal.FileChooser (https://flatpak.github.io/xdg-desktop-portal). Calls do not wait: the
/// chosen file, or the lack of a dialog, is an answer to be taken later.
class FilePortal {
public:
    /// End of a dialog.
    struct Answer {
        enum class Kind { Chosen, Dismissed, NoDialog };
        Kind kind = Kind::NoDialog;
        FileDialog::Job job = FileDialog::Job::Open;
        std::filesystem::path file;  ///< set if Chosen
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
    /// Returns the answer once; nothing before there is one.
    std::optional<Answer> take_answer();

private:
    class Dialog;
    std::function<void()> wake_;
    std::unique_ptr<Dialog> dialog_;
};

/// Returns the path of a file:// URI with %-escapes resolved; empty if it names no file of this machine.
std::filesystem::path path_of_file_uri(const std::string& uri);

}  // namespace si
