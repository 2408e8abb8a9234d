// Search for settings by words, for the editor's search field and `list settings`.
#pragma once

#include <string_view>

#include "renderer/settings/param.h"

namespace si {

/// Returns true when the setting `ref` matches the search text. Each word of the text must occur in the label, key,
/// help or other names (Param::also) of the setting. The setting also matches if each word occurs in its label, key or
/// other names, or in the key or label of a single choice. Case does not matter; _ and - count as spaces, × as x. A
/// complete key matches its own setting only. An empty text matches all settings.
bool setting_matches(const SettingRef& ref, std::string_view text);

}  // namespace si
