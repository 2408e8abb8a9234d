// Chooses a file: folders and the files that the editor can read, or a name to save a preset under.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace si {

struct EditorState;
struct EditorRequests;
struct EditorFrame;

struct FileDialog {
    enum class Job { Open, SavePreset };
    enum class Kind { All, Models, Presets };
    struct Entry {
        std::string name;
        bool folder = false;
        std::string date;  ///< of its last change, local time
    };
    bool asked = false;  ///< to be opened in the next frame
    Job job = Job::Open;
    std::filesystem::path folder;
    std::string folder_input, name, about;
    Kind kind = Kind::All;       ///< that is listed when opening
    std::vector<Entry> entries;  ///< of `folder`, folders first
    std::string problem;         ///< why the folder cannot be read
    bool type_on = false;        ///< a folder was read: what is typed next is a name in it
};

/// What a desktop's own dialog is to show.
struct DesktopFileDialog {
    FileDialog::Job job = FileDialog::Job::Open;
    FileDialog::Kind kind = FileDialog::Kind::All;
    std::filesystem::path folder;
    std::string name;  ///< that is proposed for saving
};

/// Opens the dialog in the folder of `path`, with its name when saving.
void ask_for_file(FileDialog& dialog, FileDialog::Job job, const std::filesystem::path& path,
                  const std::string& about = {});
/// With the extension of a preset.
std::filesystem::path preset_path(std::filesystem::path path);
/// The path as typed, from `folder`, as far on as folders and files that the dialog lists go on alike.
std::string completed_path(const std::filesystem::path& folder, const std::string& typed, FileDialog::Job job,
                           FileDialog::Kind kind);
/// Draws it while it is open; the chosen file becomes a wish. Where the desktop's own dialog can be had and is wanted,
/// that is the wish.
void draw_file_dialog(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Asks before a file is replaced that was neither opened nor saved before.
void draw_replace_dialog(EditorState& state, EditorRequests& requests);

}  // namespace si
