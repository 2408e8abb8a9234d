// The desktop's own file dialog, requested over the session's message bus.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "ui/widgets/file_dialog.h"

namespace si {

/// Client of the desktop's file dialog, org.freedesktop.portal.FileChooser
/// (https://flatpak.github.io/xdg-desktop-portal). Calls do not wait; take_answer() returns the chosen file later.
class FilePortal {
public:
    /// Outcome of one file dialog: a chosen file, dismissal, or the reason why no dialog opened.
    struct Answer {
        /// Kind of outcome of a file dialog.
        enum class Kind { Chosen, Dismissed, NoDialog };
        Kind kind = Kind::NoDialog;
        FileDialog::Job job = FileDialog::Job::Open;
        std::filesystem::path file;  ///< set if Chosen
        std::string problem;         ///< why there is no dialog
    };

    /// Makes a client of the desktop's file portal. Opens no dialog yet.
    /// @param wake called from another thread when take_answer() has an answer
    explicit FilePortal(std::function<void()> wake);
    /// Closes the dialog that is still open, if any.
    ~FilePortal();

    /// Opens the desktop's file dialog and returns at once. An earlier dialog that is still open is closed first, and
    /// gives no answer.
    /// @param parent_window "x11:" and the window's id in hexadecimal digits; empty: unknown
    void open_dialog(const DesktopFileDialog& dialog, const std::string& parent_window);
    /// Returns the answer of the file dialog once, and forgets it. Returns nothing while the dialog is open, or if no
    /// dialog was opened.
    std::optional<Answer> take_answer();

private:
    class Dialog;
    std::function<void()> wake_;
    std::unique_ptr<Dialog> dialog_;
};

/// Converts a file:// URI to a path, with %-escapes decoded. Returns an empty path if the URI names no file on this
/// machine.
std::filesystem::path path_of_file_uri(const std::string& uri);

}  // namespace si
