// Presets of one editor: built-in presets, files that the editor has opened or saved, and the preset that settings are
// compared with.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/session/presets.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Reader and writer of presets, which knows the files that one editor has opened or saved.
class PresetLoader {
public:
    PresetLoader();

    /// Guided presets that ship with the program, in order.
    const std::vector<PresetEntry>& entries() const { return entries_; }
    /// Hard cases that ship with the program, by number.
    const std::vector<PresetEntry>& hard_cases() const { return hard_cases_; }
    /// Returns true if the key names a guided preset or hard case that ships with the program.
    bool is_built_in(const std::string& key) const;

    /// Registers an opened preset, so that saving may replace its file. Returns the note that the editor shows for the
    /// preset.
    GuideNote register_opened(const std::string& name_or_path, const Preset& preset);

    /// Writes settings as a preset file. A file that was opened keeps its title, topic and sentence. Returns false
    /// without writing if the file exists, was neither opened nor saved here, and `replace` is false.
    /// @param about sentence to store instead; none: keeps the old one @throws Error
    bool save(const std::filesystem::path& path, const std::string& scene, const Settings& settings,
              const std::optional<std::string>& about, bool replace);

    /// Returns true if the preset file was opened or saved by this editor and holds exactly these settings.
    bool file_holds(const std::string& path, const std::string& scene, const Settings& settings) const;
    /// Returns true if the preset file was opened or saved by this editor.
    bool has_file(const std::string& path) const;

    /// Returns the settings that the panel Compare compares with. Reads a preset's file at its first use, and again
    /// after save(). @param with choice @param base the scene's own settings @param pinned settings pinned as A
    const ComparisonFacts& compare(const CompareWith& with, const Settings& base, const std::string& scene,
                                   const std::optional<PinnedSettings>& pinned);

private:
    std::vector<PresetEntry> entries_;
    std::vector<PresetEntry> hard_cases_;
    std::map<std::string, Preset> files_;  ///< opened or saved presets by absolute path
    std::optional<ComparisonFacts> comparison_;
};

}  // namespace si
