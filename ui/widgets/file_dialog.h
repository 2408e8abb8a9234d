// File dialog: opens scenes and presets, or asks for a name to save a preset under.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace si {

struct EditorState;
struct EditorRequests;
struct EditorFrame;

/// State of the dialog.
struct FileDialog {
    enum class Job { Open, SavePreset };
    enum class Kind { All, Models, Presets };
    struct Entry {
        std::string name;
        bool folder = false;
        std::string date;  ///< time of its last change, local time
    };
    bool asked = false;  ///< opens in the next frame
    Job job = Job::Open;
    std::filesystem::path folder;
    std::string folder_input;    ///< path of the folder while it is being typed
    std::string name;            ///< name of the file
    std::string about;           ///< sentence to save in the preset
    Kind kind = Kind::All;       ///< files that are listed when opening
    std::vector<Entry> entries;  ///< content of `folder`, folders first
    std::string problem;         ///< reason why the folder cannot be read; empty: it can
    bool type_on = false;        ///< a folder was read; the next typed text is a name in it
};

/// Request for the desktop's own dialog.
struct DesktopFileDialog {
    FileDialog::Job job = FileDialog::Job::Open;
    FileDialog::Kind kind = FileDialog::Kind::All;
    std::filesystem::path folder;
    std::string name;  ///< name that is proposed for saving
};

/// Opens the dialog in the folder of `path`, with its name when saving.
void open_file_dialog(FileDialog& dialog, FileDialog::Job job, const std::filesystem::path& path,
                      const std::string& about = {});
/// Returns the path with the extension of a preset.
std::filesystem::path preset_path(std::filesystem::path path);
/// Returns the typed path, completed as far as all matching files and folders agree. @param folder base of the path
std::string completed_path(const std::filesystem::path& folder, const std::string& typed, FileDialog::Job job,
                           FileDialog::Kind kind);
/// Draws the dialog while it is open. The chosen file becomes a request; if the desktop's own dialog is available and
/// switched on, opening that becomes the request instead.
void draw_file_dialog(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the question before a file is replaced that was neither opened nor saved here.
void draw_replace_dialog(EditorState& state, EditorRequests& requests);

}  // namespace si
