// File dialog: opens scenes and presets, or chooses a name to save a preset or a bundle under.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ui/widgets/export_kind.h"

namespace si {

struct EditorState;
struct EditorRequests;
struct EditorFrame;

/// State of the file dialog that the editor draws itself.
struct FileDialog {
    /// Purpose of the editor's file dialog.
    enum class Job { Open, SavePreset, ChooseBundle, Export };
    /// Kind of files that the editor's file dialog lists.
    enum class Kind { All, Models, Presets };
    /// File or folder that the editor's file dialog lists.
    struct Entry {
        std::string name;
        bool folder = false;
        std::string date;  ///< time of its last change, local time
    };
    bool asked = false;  ///< opens in the next frame
    Job job = Job::Open;
    std::filesystem::path folder;
    std::string folder_input;                  ///< path of the folder while it is being typed
    std::string name;                          ///< name of the file
    std::string about;                         ///< sentence to save in the preset
    Kind kind = Kind::All;                     ///< files that are listed when opening
    ExportKind exported = ExportKind::Bundle;  ///< kind of the exported file
    std::vector<Entry> entries;                ///< content of `folder`, folders first
    std::string setting;                       ///< key of the setting that ChooseBundle sets
    std::string problem;                       ///< reason why the folder cannot be read; empty: it can
    bool type_on = false;                      ///< a folder was read; the next typed text is a name in it
};

/// Request to open the file dialog of the desktop in place of the editor's own.
struct DesktopFileDialog {
    FileDialog::Job job = FileDialog::Job::Open;
    FileDialog::Kind kind = FileDialog::Kind::All;
    std::filesystem::path folder;
    std::string name;  ///< name that is proposed for saving
};

/// Opens the editor's file dialog in the folder of `path`. For saving, the dialog proposes the name of the file.
/// @param job purpose of the dialog
/// @param about the sentence to save in the preset, or the name of the exported file without its extension
void open_file_dialog(FileDialog& dialog, FileDialog::Job job, const std::filesystem::path& path,
                      const std::string& about = {});
/// Opens the editor's file dialog to choose the bundle (a frame of an engine as files) that a setting names.
/// @param key key of the setting @param path present value of the setting
void open_bundle_dialog(FileDialog& dialog, const std::string& key, const std::filesystem::path& path);
/// Returns the path of a preset with its extension (.json), which is added if it is missing.
std::filesystem::path with_preset_extension(std::filesystem::path path);
/// Returns the path of a bundle (a frame of an engine as files) with the extension .bundle added, unless it ends with
/// .bundle or .zip.
std::filesystem::path with_bundle_extension(std::filesystem::path path);
/// Returns the path of an exported file with the usual extension of its kind added, unless it has an extension of this
/// kind.
std::filesystem::path with_export_extension(std::filesystem::path path, ExportKind kind);
/// Completes a path that the user types, as the Tab key does in a shell: as far as all matching files and folders
/// agree. Returns the typed text if nothing matches.
/// @param folder base of relative paths @param job, kind, exported select the files that match
std::string completed_path(const std::filesystem::path& folder, const std::string& typed, FileDialog::Job job,
                           FileDialog::Kind kind, ExportKind exported = ExportKind::Bundle);
/// Draws the editor's file dialog while it is open. The chosen file becomes a request to the application, the value of
/// a setting, or the output of the dialog Convert. For scenes and presets, requests the desktop's own dialog instead,
/// if it is available and switched on.
void draw_file_dialog(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the dialog that asks the user whether to replace an existing file which this editor has neither opened nor
/// saved.
void draw_replace_dialog(EditorState& state, EditorRequests& requests);

}  // namespace si
