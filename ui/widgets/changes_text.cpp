#include "ui/widgets/changes_text.h"

#include <fmt/format.h>

#include "renderer/settings/param.h"

namespace si {
namespace {

/// Returns the label and the new value of a changed setting. @param with settings after all changes
std::string change_of(const Settings& with, const std::string& key) {
    const auto ref = find_setting(key);
    return fmt::format("{}: {}", ref->param->label, shown_value(with, *ref, get_value(with, *ref)));
}

}  // namespace

std::string changes_list(const Settings& settings, ShownChanges changes) {
    Settings with = settings;
    set_settings(with, changes);
    std::string text;
    for (const auto& [key, value] : changes) text += fmt::format("{}   {}\n", change_of(with, key), key);
    return text;
}

std::string changes_line(const Settings& settings, ShownChanges changes) {
    Settings with = settings;
    set_settings(with, changes);
    std::string text;
    for (const auto& [key, value] : changes) text += (text.empty() ? "" : ", ") + change_of(with, key);
    return text;
}

}  // namespace si
