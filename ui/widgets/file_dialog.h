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

/// State of the editor's own file dialog.
struct FileDialog {
    /// Purpose of the dialog.
    enum class Job { Open, SavePreset, ChooseBundle, Export };
    /// Kind of files that the dialog lists.
    enum class Kind { All, Models, Presets };
    /// File or folder that the dialog lists.
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

/// Request to open the desktop's own file dialog.
struct DesktopFileDialog {
    FileDialog::Job job = FileDialog::Job::Open;
    FileDialog::Kind kind = FileDialog::Kind::All;
    std::filesystem::path folder;
    std::string name;  ///< name that is proposed for saving
};

/// Opens the editor's file dialog in the folder of `path`, with the file's name when saving. @param about the sentence
/// to save in the preset, or the name of the exported file without its extension
void open_file_dialog(FileDialog& dialog, FileDialog::Job job, const std::filesystem::path& path,
                      const std::string& about = {});
/// Opens the editor's file dialog to choose the file of a setting. @param key key of the setting @param path its value
void open_bundle_dialog(FileDialog& dialog, const std::string& key, const std::filesystem::path& path);
/// Returns the path with the extension of a preset (.json) added if it is missing.
std::filesystem::path with_preset_extension(std::filesystem::path path);
/// Returns the path with the extension of a bundle (.bundle) added unless it names a bundle.
std::filesystem::path with_bundle_extension(std::filesystem::path path);
/// Returns the path with an extension of the exported kind added if it has none of them.
std::filesystem::path with_export_extension(std::filesystem::path path, ExportKind kind);
/// Completes a typed path as far as all matching files and folders agree, as Tab does in a shell. @param folder base of
/// relative paths
std::string completed_path(const std::filesystem::path& folder, const std::string& typed, FileDialog::Job job,
                           FileDialog::Kind kind, ExportKind exported = ExportKind::Bundle);
/// Draws the file dialog while it is open. The chosen file becomes a request. If the desktop's own dialog is available
/// and switched on, the request is to open that one instead.
void draw_file_dialog(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the question whether a file may be replaced that this editor has neither opened nor saved.
void draw_replace_dialog(EditorState& state, EditorRequests& requests);

}  // namespace si
