// Settings found by words: the editor's search, and `list settings`.
#pragma once

#include <string_view>

#include "renderer/settings/param.h"

namespace si {

/// Whether each word of `text` stands in the row's label, key, help or names elsewhere (Param::also), or in its label,
/// key or those names and in the key or label of one of its choices. Without regard to case; _ and - are spaces, × is
/// x. A whole key finds its setting alone.
bool setting_matches(const SettingRef& ref, std::string_view text);

}  // namespace si
