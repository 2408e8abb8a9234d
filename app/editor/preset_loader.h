// The presets of one editor: those that ship with the program, the files it opened or saved, and the one that the
// present state is compared with.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/session/presets.h"
#include "ui/state/editor_ui.h"

namespace si {

class PresetLoader {
public:
    PresetLoader();

    /// Those that ship with the program, in order.
    const std::vector<PresetEntry>& entries() const { return entries_; }
    /// The hard cases among them, which stand apart, by number.
    const std::vector<PresetEntry>& hard_cases() const { return hard_cases_; }
    bool is_built_in(const std::string& key) const;

    /// A preset was opened: what it says, and from now on its file may be saved to.
    GuideNote opened(const std::string& name_or_path, const Preset& preset);

    /// Writes the present state. A file that was opened keeps its title, topic and sentence unless `about` is given.
    /// Returns whether it did: not when the file exists, was neither opened nor saved here and `replace` is false.
    /// @throws Error
    bool save(const std::filesystem::path& path, const std::string& scene, const Settings& settings,
              const std::optional<std::string>& about, bool replace);

    /// Whether the file was opened or saved here and holds just this.
    bool holds(const std::string& path, const std::string& scene, const Settings& settings) const;
    bool knows(const std::string& path) const;

    /// The other side of a comparison; a preset is read when it is first asked for, and again after save().
    const ComparisonFacts& compare(const CompareWith& with, const Settings& base, const std::string& scene,
                                   const std::optional<PinnedSettings>& pinned);

private:
    std::vector<PresetEntry> entries_, hard_cases_;
    std::map<std::string, Preset> files_;  ///< as opened or saved, by absolute path
    std::optional<ComparisonFacts> comparison_;
};

}  // namespace si
