// Presets of one editor: built-in ones, files it has opened or saved, and the one that settings are compared with.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/session/presets.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Reader and writer of presets.
class PresetLoader {
public:
    PresetLoader();

    /// Guided presets that ship with the program, in order.
    const std::vector<PresetEntry>& entries() const { return entries_; }
    /// Hard cases that ship with the program, by number.
    const std::vector<PresetEntry>& hard_cases() const { return hard_cases_; }
    bool is_built_in(const std::string& key) const;

    /// Registers an opened preset, so that its file may be saved to. Returns its note.
    GuideNote opened(const std::string& name_or_path, const Preset& preset);

    /// Writes a preset. A file that was opened keeps its title, topic and sentence unless `about` is given. Returns
    /// false without writing if `replace` is false and the file exists but was neither opened nor saved here. @throws
    /// Error
    bool save(const std::filesystem::path& path, const std::string& scene, const Settings& settings,
              const std::optional<std::string>& about, bool replace);

    /// Returns true if the file was opened or saved here and holds exactly these settings.
    bool holds(const std::string& path, const std::string& scene, const Settings& settings) const;
    /// Returns true if the file was opened or saved here.
    bool knows(const std::string& path) const;

    /// Returns the settings to compare with. A preset's file is read at its first use, and again after save().
    const ComparisonFacts& compare(const CompareWith& with, const Settings& base, const std::string& scene,
                                   const std::optional<PinnedSettings>& pinned);

private:
    std::vector<PresetEntry> entries_;
    std::vector<PresetEntry> hard_cases_;
    std::map<std::string, Preset> files_;  ///< opened or saved presets by absolute path
    std::optional<ComparisonFacts> comparison_;
};

}  // namespace si
