// Access to settings by dotted key: search, read, write, list. Text forms are in param_text.cpp.
#include "renderer/settings/param.h"

#include <algorithm>

#include "renderer/base/lower_case.h"

namespace si {
namespace {

constexpr std::string_view kLightPrefix = "light.", kObjectPrefix = "object.";

/// Returns the row whose key is exactly `key` and whose scope is `scope`; nullptr if there is none.
const Param* find_row(std::string_view key, Scope scope) {
    for (const Param& p : params()) {
        if (p.scope == scope && p.key == key) return &p;
    }
    return nullptr;
}

std::optional<int> light_index(std::string_view digits) {
    for (int i = 0; i < kMaxLights; ++i)
        if (digits == std::to_string(i)) return i;
    return std::nullopt;
}

/// Splits "object.<path>.<member>" into path and member. The path may contain dots.
std::optional<std::pair<std::string_view, std::string_view>> split_object_key(std::string_view key) {
    if (!key.starts_with(kObjectPrefix)) return std::nullopt;
    const std::string_view rest = key.substr(kObjectPrefix.size());
    const auto dot = rest.rfind('.');
    if (dot == std::string_view::npos || dot == 0) return std::nullopt;
    return std::pair{rest.substr(0, dot), rest.substr(dot + 1)};
}

/// Returns the settings of the object that `ref` names; the defaults where it has none or `ref` names no object.
ObjectSettings object_of(const Settings& s, const SettingRef& ref) {
    const auto found = s.objects.find(ref.object);
    return found == s.objects.end() ? ObjectSettings() : found->second;
}

Value read(const FieldRef& field) {
    if (const auto* choice = std::get_if<EnumRef>(&field)) return choice->index();
    return std::visit(
        [](auto member) -> Value {
            if constexpr (std::is_pointer_v<decltype(member)>) return *member;
            return {};
        },
        field);
}

/// Returns the Damerau-Levenshtein distance (optimal string alignment): swapped neighbours count once.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before[j - 2] + 1);
            }
        }
        before = last;
        last = row;
    }
    return last[b.size()];
}

std::size_t common_prefix(std::string_view a, std::string_view b) {
    return std::size_t(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

/// Returns the distance of `name` from a known key: the least edit distance to the whole key, to as many leading parts
/// as `name` has ("filter" has distance 0 from "filter.kernel"), and to the last part plus one ("kernel" is near
/// "filter.kernel"). A name that begins the key has distance 0. Distances above `most` are not computed exactly.
std::size_t key_distance(std::string_view name, std::string_view known, std::size_t most) {
    if (name.size() > 2 && known.starts_with(name)) return 0;
    const auto distance = [&](std::string_view other) {
        const std::size_t longer = std::max(name.size(), other.size()), shorter = std::min(name.size(), other.size());
        return longer - shorter > most ? most + 1 : edit_distance(name, other);
    };
    std::size_t parts = 0;
    for (auto dots = std::count(name.begin(), name.end(), '.'); dots >= 0 && parts != known.npos; --dots)
        parts = known.find('.', parts + (parts > 0));
    const std::size_t last = name.find('.') == name.npos && name.size() > 2 ? known.rfind('.') : known.npos;
    return std::min({distance(known), parts == known.npos ? most + 1 : distance(known.substr(0, parts)),
                     last == known.npos ? most + 1 : distance(known.substr(last + 1)) + 1});
}

}  // namespace

std::optional<SettingRef> find_setting(std::string_view key) {
    if (const Param* p = find_row(key, Scope::Scene)) return SettingRef{p, 0, {}};
    if (const Param* p = find_row(key, Scope::Light)) return SettingRef{p, 0, {}};
    if (key.starts_with(kLightPrefix)) {
        const std::string_view rest = key.substr(kLightPrefix.size());
        const auto dot = rest.find('.');
        if (dot == std::string_view::npos) return std::nullopt;
        const auto light = light_index(rest.substr(0, dot));
        const Param* p = find_row(std::string(kLightPrefix).append(rest.substr(dot + 1)), Scope::Light);
        return light && p ? std::optional(SettingRef{p, *light, {}}) : std::nullopt;
    }
    if (const auto parts = split_object_key(key)) {
        if (const Param* p = find_row(std::string(kObjectPrefix).append(parts->second), Scope::Object)) {
            return SettingRef{p, 0, std::string(parts->first)};
        }
    }
    return std::nullopt;
}

std::string light_setting_key(std::size_t light, std::string_view setting) {
    SettingRef ref = *find_setting("light." + std::string(setting));
    ref.light = int(light);
    return setting_key(ref);
}

std::string setting_key(const SettingRef& ref) {
    const std::string key(ref.param->key);
    if (ref.param->scope == Scope::Light && ref.light > 0) {
        return "light." + std::to_string(ref.light) + "." + key.substr(kLightPrefix.size());
    }
    if (ref.param->scope == Scope::Object) {
        return std::string(kObjectPrefix) + ref.object + "." + key.substr(kObjectPrefix.size());
    }
    return key;
}

std::string nearest_name(std::string_view text, std::span<const std::string> names) {
    const std::string name = lower_ascii(text);
    // Names that differ in more than a third of the letters are not suggested.
    const std::size_t most = name.size() < 3 ? 1 : std::max<std::size_t>(2, name.size() / 3);
    std::pair best{most + 1, std::size_t(0)};
    const std::string* nearest = nullptr;
    for (const std::string& known : names) {
        const std::string like = lower_ascii(known);
        const std::pair far{key_distance(name, like, most), name.size() - common_prefix(name, like)};
        if (far < best) {
            best = far;
            nearest = &known;
        }
    }
    return nearest ? *nearest : std::string();
}

std::string nearest_key(std::string_view key) {
    // The light's number or the object's path is kept, and only the rest of the key is compared.
    int light = 0;
    std::string object = "PATH";
    std::string plain(key);
    if (lower_ascii(key).starts_with(kLightPrefix)) {
        const std::string_view rest = key.substr(kLightPrefix.size());
        const auto dot = rest.find('.');
        const auto digits = rest.substr(0, dot);
        if (dot != std::string_view::npos && !digits.empty() &&
            std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; })) {
            light = light_index(digits).value_or(kMaxLights - 1);
            plain = std::string(kLightPrefix).append(rest.substr(dot + 1));
        }
    } else if (const auto parts = split_object_key(key)) {
        object = parts->first;
        plain = std::string(kObjectPrefix).append(parts->second);
    }
    std::vector<std::string> keys;
    for (const Param& p : params()) keys.emplace_back(p.key);
    const std::string best = nearest_name(plain, keys);
    for (const Param& p : params()) {
        if (p.key == best) return setting_key({&p, light, object});
    }
    return best;
}

bool is_text(const Param& p) {
    static Settings any;
    ObjectSettings object;
    return std::holds_alternative<std::string*>(p.field(any, 0, &object));
}

double numeric_value(const Value& v) {
    return std::visit(
        [](const auto& x) {
            if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(x)>>)
                return double(x);
            else
                return 0.0;
        },
        v);
}

Value get_value(const Settings& s, const SettingRef& ref) {
    ObjectSettings object = object_of(s, ref);
    // Rows return a pointer for writing, and reading uses the same pointer.
    return read(ref.param->field(const_cast<Settings&>(s), ref.light, &object));
}

void set_value(Settings& s, const SettingRef& ref, const Value& v) {
    ObjectSettings object = object_of(s, ref);
    std::visit(
        [](auto to, const auto& from) {
            if constexpr (std::is_same_v<decltype(to), EnumRef>) {
                if constexpr (std::is_convertible_v<decltype(from), int>) to.set_index(static_cast<int>(from));
            } else {
                using To = std::remove_reference_t<decltype(*to)>;
                if constexpr (std::is_convertible_v<decltype(from), To>) *to = static_cast<To>(from);
            }
        },
        ref.param->field(s, ref.light, &object), v);
    if (ref.param->scope != Scope::Object) return;
    // An override equal to the defaults is removed, so that equal settings compare equal.
    if (object == ObjectSettings{}) {
        s.objects.erase(ref.object);
    } else {
        s.objects[ref.object] = object;
    }
}

Value default_value(const SettingRef& ref) {
    static const Settings defaults;
    return get_value(defaults, ref);
}

std::vector<SettingRef> all_settings(const Settings& s) {
    std::vector<SettingRef> all;
    const auto rows = params();
    for (auto begin = rows.begin(), end = begin; begin != rows.end(); begin = end) {
        const Scope scope = begin->scope;
        end = std::find_if(begin, rows.end(), [&](const Param& p) { return p.scope != scope; });
        const auto add = [&](int light, const std::string& object) {
            for (const Param& p : std::span(begin, end)) all.push_back({&p, light, object});
        };
        if (scope == Scope::Light) {
            for (int i = 0; i < kMaxLights; ++i) add(i, {});
        } else if (scope == Scope::Object) {
            for (const auto& [path, object] : s.objects) add(0, path);
        } else {
            add(0, {});
        }
    }
    return all;
}

std::vector<SettingRef> changed_settings(const Settings& s) {
    std::vector<SettingRef> changed = all_settings(s);
    std::erase_if(changed, [&](const SettingRef& ref) { return get_value(s, ref) == default_value(ref); });
    return changed;
}

std::vector<SettingRef> differing_settings(const Settings& a, const Settings& b) {
    Settings both = a;
    both.objects.insert(b.objects.begin(), b.objects.end());
    std::vector<SettingRef> differing = all_settings(both);
    std::erase_if(differing, [&](const SettingRef& ref) { return get_value(a, ref) == get_value(b, ref); });
    return differing;
}

}  // namespace si
