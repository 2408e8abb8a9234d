#include "renderer/settings/aliases.h"

namespace si {
namespace {

// {.was = "shadow.bias", .key = "bias.constant"} would be a row of the first; no setting has been renamed so far.
constexpr std::span<const SettingAlias> kSettings;

/// A kernel of a size: what was a row of its own, or is called so in sweeps.
constexpr ChoiceAlias sized(std::string_view was, std::string_view kernel, std::string_view size) {
    return {.key = "filter.kernel", .was = was, .choice = kernel, .also = {{{"filter.size", size}}}};
}
constexpr ChoiceAlias square(std::string_view was, std::string_view size, std::string_view point) {
    return {.key = "filter.kernel",
            .was = was,
            .choice = "pcf",
            .also = {{{"filter.size", size}, {"filter.point", point}}}};
}
constexpr ChoiceAlias kChoices[] = {
    square("pcf2", "2", "false"),        square("pcf3", "3", "false"),  square("pcf5", "5", "false"),
    square("pcf7", "7", "false"),        square("pcf9", "9", "false"),  square("pcf3_nearest", "3", "true"),
    square("pcf5_nearest", "5", "true"), sized("tent5", "tent", "5"),   sized("tent7", "tent", "7"),
    sized("gauss5", "gauss", "5"),       sized("gauss7", "gauss", "7"),
};

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
