#include "renderer/settings/aliases.h"

namespace si {
namespace {

// {.was = "shadow.bias", .key = "bias.constant"} would be a row of the first; nothing has been renamed so far.
constexpr std::span<const SettingAlias> kSettings;
constexpr std::span<const ChoiceAlias> kChoices;

constexpr Aliases kAliases{kSettings, kChoices};
const Aliases* in_use = &kAliases;

}  // namespace

const Aliases& aliases() {
    return *in_use;
}

TrialAliases::TrialAliases(const Aliases& trial) : before_(in_use) {
    in_use = &trial;
}

TrialAliases::~TrialAliases() {
    in_use = before_;
}

}  // namespace si
