#include "ui/widgets/file_dialog.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <utility>

#include "renderer/base/lower_case.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/importers/importers.h"
#include "renderer/settings/param.h"
#include "ui/state/panels.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxEntries = 5000;
constexpr const char *kOpenTitle = "Open a model, map, bundle, capture or preset", *kSaveTitle = "Save the preset as",
                     *kBundleTitle = "Choose a bundle", *kExportTitle = "Export the frame";

/// Row of the kinds of exported files.
struct ExportRow {
    const char* label;
    std::vector<std::string> extensions;  ///< the first is the default
};

/// Returns the row of a kind of exported files.
const ExportRow& export_row(ExportKind kind) {
    static const ExportRow kRows[] = {{"bundle (scene, camera, maps)", {".bundle", ".zip"}},
                                      {"picture as shown", {".png"}},
                                      {"shadow map", {".exr", ".pfm", ".png"}},
                                      {"engine code…", {}}};
    return kRows[std::size_t(kind)];
}

bool has_extension_of(const fs::path& file, ExportKind kind) {
    return std::ranges::find(export_row(kind).extensions, lower_extension(file)) != export_row(kind).extensions.end();
}

/// Returns true for a folder that is a bundle, which is listed and opened as a file.
bool is_bundle_folder(const fs::path& path) {
    std::error_code error;
    return lower_extension(path) == ".bundle" && fs::exists(path / kFrameJson, error);
}

bool is_shown(const fs::path& file, FileDialog::Job job, FileDialog::Kind kind, ExportKind exported) {
    const std::string extension = lower_extension(file);
    const bool model = find_importer(file) || find_frame_file(file);
    const bool preset = extension == ".json";
    if (job == FileDialog::Job::SavePreset) return preset;
    if (job == FileDialog::Job::ChooseBundle) return is_bundle_path(file);
    if (job == FileDialog::Job::Export) return has_extension_of(file, exported);
    return (model && kind != FileDialog::Kind::Presets) || (preset && kind != FileDialog::Kind::Models);
}

std::string date_of(const fs::directory_entry& entry) {
    std::error_code error;
    const auto changed = entry.last_write_time(error);
    if (error) return {};
    const auto at = std::chrono::file_clock::to_sys(changed);
    const std::time_t seconds =
        std::chrono::system_clock::to_time_t(std::chrono::time_point_cast<std::chrono::system_clock::duration>(at));
    std::tm local{};
    char text[32] = "";
    if (localtime_r(&seconds, &local)) std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
    return text;
}

fs::path home() {
    const char* folder = std::getenv("HOME");
    return folder ? fs::path(folder) : fs::path("/");
}

void read_folder(FileDialog& d, const fs::path& wanted) {
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(fs::absolute(wanted.empty() ? fs::path(".") : wanted, error), error);
    std::vector<FileDialog::Entry> entries;
    fs::directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
    if (error) {
        d.problem = fmt::format("{}: {}", wanted.string(), error.message());
        return;
    }
    for (const fs::directory_iterator end; it != end && !error && entries.size() < kMaxEntries; it.increment(error)) {
        const std::string name = it->path().filename().string();
        std::error_code unreadable;
        const bool is_folder = it->is_directory(unreadable) && !is_bundle_folder(it->path());
        if (!name.starts_with('.') && (is_folder || is_shown(it->path(), d.job, d.kind, d.exported)))
            entries.push_back({name, is_folder, date_of(*it)});
    }
    std::sort(entries.begin(), entries.end(), [](const FileDialog::Entry& a, const FileDialog::Entry& b) {
        return a.folder != b.folder ? a.folder : lower_ascii(a.name) < lower_ascii(b.name);
    });
    d.folder = folder;
    d.folder_input = folder.string();
    d.entries = std::move(entries);
    d.type_on = true;
    d.problem.clear();
}

/// Draws the list of files. Returns the entry that was double-clicked.
std::optional<FileDialog::Entry> draw_entries(FileDialog& d, float height) {
    std::optional<FileDialog::Entry> entered;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::well());
    ImGui::BeginChild("entries", {0, height}, true);
    ImGuiListClipper clipper;
    clipper.Begin(int(d.entries.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const FileDialog::Entry& e = d.entries[std::size_t(i)];
            ImGui::PushID(i);
            const std::string label = e.folder ? e.name + "/" : e.name;
            if (ImGui::Selectable(label.c_str(), !e.folder && e.name == d.name,
                                  ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups)) {
                if (!e.folder) d.name = e.name;
                if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) entered = e;
            }
            ImGui::SameLine();
            const float width = ImGui::CalcTextSize(e.date.c_str()).x;
            if (const float right = ImGui::GetContentRegionAvail().x - width; right > ImGui::GetFontSize()) {
                ImGui::SetCursorPosX(ImGui::GetCursorPosX() + right);
                ImGui::TextDisabled("%s", e.date.c_str());
            } else {
                ImGui::NewLine();
            }
            ImGui::PopID();
        }
    if (d.entries.empty())
        ImGui::TextDisabled(d.job == FileDialog::Job::Open         ? "No folder or file that can be opened here."
                            : d.job == FileDialog::Job::SavePreset ? "No folder or preset here."
                            : d.job == FileDialog::Job::Export     ? "No folder or file of this kind here."
                                                                   : "No folder or bundle here.");
    ImGui::EndChild();
    ImGui::PopStyleColor();
    return entered;
}

/// Returns the folders of recently opened files, the latest first.
std::vector<std::string> recent_folders(const EditorFrame& frame) {
    std::vector<std::string> folders;
    for (const auto& paths : {frame.recent_scenes, frame.recent_presets})
        for (const std::string& path : paths) {
            const std::string folder = fs::path(path).parent_path().string();
            if (!folder.empty() && std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
        }
    return folders;
}

/// Draws the choice of the exported kind. The name keeps its stem and gets the kind's extension.
void draw_export_kinds(FileDialog& d) {
    if (!begin_combo("##exported", export_row(d.exported).label)) return;
    for (const ExportKind kind : {ExportKind::Bundle, ExportKind::Picture, ExportKind::Map, ExportKind::Code})
        if (ImGui::Selectable(export_row(kind).label, kind == d.exported)) {
            const fs::path name = has_extension_of(d.name, d.exported) ? fs::path(d.name).stem() : fs::path(d.name);
            d.exported = kind;
            if (!d.name.empty()) d.name = with_export_extension(name, kind).string();
            read_folder(d, d.folder);
        }
    ImGui::EndCombo();
}

/// Draws the folder and the kind of files.
void draw_places(FileDialog& d, const EditorFrame& frame) {
    const float em = ImGui::GetFontSize();
    if (ImGui::Button("Up")) read_folder(d, d.folder.parent_path());
    wrapped_tooltip("The folder above");
    ImGui::SameLine();
    if (ImGui::Button("Home")) read_folder(d, home());
    ImGui::SameLine();
    const std::vector<std::string> recent = recent_folders(frame);
    if (button_if(!recent.empty(), "Recent")) ImGui::OpenPopup("recent folders");
    wrapped_tooltip("Folders of scenes and presets that were opened lately");
    if (ImGui::BeginPopup("recent folders")) {
        for (const std::string& folder : recent)
            if (ImGui::Selectable(folder.c_str())) read_folder(d, folder);
        ImGui::EndPopup();
    }
    ImGui::SameLine();
    const bool opening = d.job == FileDialog::Job::Open, exporting = d.job == FileDialog::Job::Export;
    ImGui::SetNextItemWidth(opening ? -em * 7.5f : exporting ? -em * 14 : -FLT_MIN);
    if (ImGui::InputText("##folder", &d.folder_input, ImGuiInputTextFlags_EnterReturnsTrue))
        read_folder(d, d.folder_input);
    if (!opening && !exporting) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (exporting) return draw_export_kinds(d);
    int kind = int(d.kind);
    if (ImGui::Combo("##kind", &kind, "all files\0models\0presets\0")) {
        d.kind = FileDialog::Kind(kind);
        read_folder(d, d.folder);
    }
}

/// Completes the typed path at Tab.
int complete(ImGuiInputTextCallbackData* data) {
    const FileDialog& d = *static_cast<const FileDialog*>(data->UserData);
    const std::string completed = completed_path(d.folder, data->Buf, d.job, d.kind, d.exported);
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, completed.c_str());
    return 0;
}

void choose(EditorState& state, EditorRequests& requests) {
    FileDialog& d = state.files.dialog;
    fs::path path = d.folder / d.name;
    std::error_code error;
    if (fs::is_directory(path, error) && !is_bundle_folder(path)) {
        read_folder(d, path);
        d.name.clear();
        return;
    }
    if (d.job == FileDialog::Job::Open) {
        requests.open_file = path.string();
    } else if (d.job == FileDialog::Job::ChooseBundle) {
        if (const auto ref = find_setting(d.setting)) set_value(state.settings, *ref, path.string());
    } else if (d.job == FileDialog::Job::Export && d.exported == ExportKind::Code) {
        state.convert.output = path.string();
        state.convert.asked = true;
    } else if (d.job == FileDialog::Job::Export) {
        requests.export_file = ExportRequest{d.exported, with_export_extension(path, d.exported).string()};
    } else {
        requests.save_preset = with_preset_extension(path).string();
        requests.save_about = d.about;
    }
    ImGui::CloseCurrentPopup();
}

}  // namespace

void open_file_dialog(FileDialog& d, FileDialog::Job job, const fs::path& path, const std::string& about) {
    d.job = job;
    d.about = about;
    d.name = job == FileDialog::Job::SavePreset ? path.filename().string()
             : job == FileDialog::Job::Export   ? with_export_extension(about, d.exported).string()
                                                : std::string();
    d.entries.clear();
    std::error_code error;
    const fs::path folder = path.parent_path();
    read_folder(d, fs::is_directory(folder, error) ? folder : fs::path("."));
    d.asked = true;
}

void open_bundle_dialog(FileDialog& d, const std::string& key, const fs::path& path) {
    open_file_dialog(d, FileDialog::Job::ChooseBundle, path);
    d.setting = key;
}

fs::path with_preset_extension(fs::path path) {
    if (lower_extension(path) != ".json") path += ".json";
    return path;
}

fs::path with_bundle_extension(fs::path path) {
    const std::string extension = lower_extension(path);
    if (extension != ".bundle" && extension != ".zip") path += ".bundle";
    return path;
}

fs::path with_export_extension(fs::path path, ExportKind kind) {
    const std::vector<std::string>& extensions = export_row(kind).extensions;
    if (!extensions.empty() && !has_extension_of(path, kind)) path += extensions.front();
    return path;
}

std::string completed_path(const fs::path& folder, const std::string& typed, FileDialog::Job job, FileDialog::Kind kind,
                           ExportKind exported) {
    const auto slash = typed.rfind('/');
    const std::string lead = slash == std::string::npos ? std::string() : typed.substr(0, slash + 1);
    const std::string begun = typed.substr(lead.size());
    std::string common;
    bool any = false;
    std::error_code error;
    fs::directory_iterator it(folder / lead, fs::directory_options::skip_permission_denied, error);
    for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
        std::string name = it->path().filename().string();
        std::error_code unreadable;
        const bool is_folder = it->is_directory(unreadable);
        if (!name.starts_with(begun) || (begun.empty() && name.starts_with('.'))) continue;
        if (!is_folder && !is_shown(it->path(), job, kind, exported)) continue;
        if (is_folder) name += '/';
        const auto differs = std::ranges::mismatch(common, name);
        common = any ? std::string(common.begin(), differs.in1) : name;
        any = true;
    }
    return any ? lead + common : typed;
}

void draw_file_dialog(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    FileDialog& d = state.files.dialog;
    // The desktop's dialog chooses either files or folders, and a bundle may be both.
    const bool any_kind = d.job == FileDialog::Job::ChooseBundle || d.job == FileDialog::Job::Export;
    if (d.asked && frame.desktop_dialogs && state.layout.desktop_dialogs && !any_kind) {
        d.asked = false;
        requests.open_desktop_dialog = {d.job, d.kind, d.folder, d.name};
    }
    const bool saves_preset = d.job == FileDialog::Job::SavePreset;
    const bool exporting = d.job == FileDialog::Job::Export;
    const bool saving = saves_preset || exporting;
    const char* title = saves_preset ? kSaveTitle : exporting ? kExportTitle : any_kind ? kBundleTitle : kOpenTitle;
    if (d.asked) ImGui::OpenPopup(title);
    const bool appearing = std::exchange(d.asked, false);
    const float em = ImGui::GetFontSize();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(em * 44, screen.x - 2 * em), std::min(em * 32, screen.y - 2 * em)});
    bool open = true;
    if (!ImGui::BeginPopupModal(title, &open, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) return;
    draw_places(d, frame);
    const float rows = ImGui::GetFrameHeightWithSpacing() * (saves_preset ? 3 : 2) +
                       (d.problem.empty() ? 0 : ImGui::GetTextLineHeightWithSpacing());
    const auto entered = draw_entries(d, std::max(ImGui::GetContentRegionAvail().y - rows, em * 3));
    if (!d.problem.empty()) coloured_text(d.problem, theme::error());
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (std::exchange(d.type_on, false) || appearing) ImGui::SetKeyboardFocusHere();
    bool done = ImGui::InputTextWithHint("##name", saving ? "file name" : "file or path; Tab completes it", &d.name,
                                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
                                             ImGuiInputTextFlags_CallbackCompletion,
                                         complete, &d);
    if (saves_preset) {
        ImGui::SetNextItemWidth(-FLT_MIN);
        done |= ImGui::InputTextWithHint("##about", "what to look at, a sentence (optional)", &d.about,
                                         ImGuiInputTextFlags_EnterReturnsTrue);
    }
    if (entered && entered->folder) read_folder(d, d.folder / entered->name);
    ImGui::BeginDisabled(d.name.empty());
    done |= ImGui::Button(saving ? "Save" : "Open", {em * 6, 0}) || (entered && !entered->folder);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {em * 6, 0}) || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
        ImGui::CloseCurrentPopup();
    if (done && !d.name.empty()) choose(state, requests);
    ImGui::EndPopup();
}

void draw_replace_dialog(EditorState& state, EditorRequests& requests) {
    constexpr const char* kTitle = "Replace the file?";
    if (state.files.replace && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(kTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove)) return;
    if (!state.files.replace) {
        ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
        return;
    }
    ImGui::PushTextWrapPos(std::min(em * 34, screen.x - 3 * em));
    const bool is_preset = !state.files.replace->exported && !state.files.replace->errors;
    const char* const unknown = is_preset ? ", and this editor has neither opened nor saved it" : "";
    ImGui::TextUnformatted(
        fmt::format("{} exists{}. Its contents would be lost.", state.files.replace->path, unknown).c_str());
    ImGui::PopTextWrapPos();
    if (ImGui::Button("Replace", {em * 6, 0}) ||
        (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false) && !ImGui::GetIO().NavVisible)) {
        if (state.files.replace->exported) {
            requests.export_file = ExportRequest{*state.files.replace->exported, state.files.replace->path};
        } else if (state.files.replace->errors) {
            requests.save_error = state.files.replace->path;
        } else {
            requests.save_preset = state.files.replace->path;
            requests.save_about = state.files.replace->about;
        }
        requests.replace = true;
        state.files.replace.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {em * 6, 0}) || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
        state.files.replace.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

}  // namespace si
