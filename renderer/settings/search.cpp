// Search for settings by words.
#include "renderer/settings/search.h"

#include <algorithm>
#include <string>

#include "renderer/base/words_match.h"
#include "renderer/settings/sized_kernels.h"

namespace si {
namespace {

/// Returns the text normalised for the search: "shadow_normal_bias" as "shadow normal bias", "Tent 3×3" as "Tent 3x3".
std::string as_searched(std::string_view text) {
    constexpr std::string_view kTimes = "×";
    std::string out(text);
    for (auto at = out.find(kTimes); at != out.npos; at = out.find(kTimes, at)) out.replace(at, kTimes.size(), "x");
    for (const char mark : {'_', '-'}) std::ranges::replace(out, mark, ' ');
    return out;
}

}  // namespace

bool setting_matches(const SettingRef& ref, std::string_view text) {
    if (text.empty()) return true;
    const Param& p = *ref.param;
    const std::string key = setting_key(ref);
    if (p.key == text || key == text) return true;
    if (find_setting(text)) return false;  // the key of another setting: that one alone is meant
    const std::string wanted = as_searched(text), label = as_searched(p.label), also = as_searched(p.also),
                      own_key = as_searched(key);
    if (matches_all_words(wanted, {label, own_key, as_searched(p.help), also})) return true;
    if (!p.choices) return false;
    const auto is_wanted = [&](std::string_view choice, std::string_view choice_label) {
        return matches_all_words(wanted, {label, own_key, also, as_searched(choice), as_searched(choice_label)});
    };
    if (std::ranges::any_of(p.choices(), [&](const Choice& c) { return is_wanted(c.key, c.label); })) return true;
    if (p.key != "filter.kernel") return false;
    return std::ranges::any_of(sized_kernels(), [&](const SizedKernel& sized) { return is_wanted(sized.name, {}); });
}

}  // namespace si
