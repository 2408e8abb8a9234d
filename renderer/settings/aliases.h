// Names that settings and choices once had, and short names for a choice with settings of its own. Presets, --set,
// sweeps and files all read them; listings and error messages have the names of today only.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace si {

struct SettingAlias {
    std::string_view was, key;  ///< of the row; "light.X" stands for all lights
};

struct ChoiceAlias {
    struct Also {
        std::string_view key, value;
    };
    std::string_view key;           ///< of the setting, as its row has it
    std::string_view was, choice;   ///< of its choices
    std::array<Also, 2> also = {};  ///< what else the name says, where several settings say it
};

struct Aliases {
    std::span<const SettingAlias> settings;
    std::span<const ChoiceAlias> choices;
};

const Aliases& aliases();

/// Other aliases while it lives, so that tests can rename what has kept its name.
class TrialAliases {
public:
    explicit TrialAliases(const Aliases& trial);
    ~TrialAliases();
    TrialAliases(const TrialAliases&) = delete;
    TrialAliases& operator=(const TrialAliases&) = delete;

private:
    const Aliases* before_;
};

}  // namespace si
