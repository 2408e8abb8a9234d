#include "renderer/measure/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"
#include "renderer/settings/starting_values.h"

namespace si {
namespace {

constexpr std::size_t kMaxValues = 1000;

std::vector<std::string> split(std::string_view text, char at) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t end = std::min(text.find(at, from), text.size());
        parts.emplace_back(text.substr(from, end - from));
        from = end + 1;
        if (end + 1 == text.size()) parts.emplace_back();  // after a last separator
    }
    return parts;
}

double number(std::string_view text, std::string_view whole) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        throw UsageError(fmt::format(
            "--vary {}: '{}' is no number; from:to:step is wanted, such as 0:4:0.5 or 256:4096:*2", whole, text));
    return value;
}

/// Returns the numbers of "from:to:step", ends included up to rounding.
std::vector<double> step_values(const std::vector<std::string>& parts, std::string_view whole) {
    const bool geometric = parts[2].starts_with("*");
    const double from = number(parts[0], whole), to = number(parts[1], whole),
                 step = number(std::string_view(parts[2]).substr(geometric ? 1 : 0), whole);
    const bool upwards = to >= from;
    const bool moves = geometric
                           ? from * to > 0 && step > 0 && step != 1 && (std::abs(to) >= std::abs(from)) == (step > 1)
                           : step != 0 && (step > 0) == upwards;
    if (from != to && !moves)
        throw UsageError(fmt::format("--vary {}: the step does not lead from {} to {}", whole, parts[0], parts[1]));
    const double count = from == to ? 0 : geometric ? std::log(to / from) / std::log(step) : (to - from) / step;
    if (count >= double(kMaxValues))
        throw UsageError(fmt::format("--vary {}: more than {} values; take a larger step", whole, kMaxValues));
    std::vector<double> row;
    for (int i = 0; i <= int(std::floor(count + 1e-9)); ++i)
        row.push_back(geometric ? from * std::pow(step, i) : from + i * step);
    return row;
}

/// Formats a number with at most nine digits, so that 0.1 + 0.2 is "0.3".
std::string short_number(double value, const Value& like) {
    if (std::holds_alternative<int>(like)) return fmt::format("{}", std::lround(value));
    return fmt::format("{:.9g}", value);
}

/// Formats the remark that all but the `kept` values of an axis are equivalent to one of those.
std::string note_on_merged(const Settings& base, const SweepAxis& axis, const std::set<std::string>& kept) {
    const SettingRef ref = *find_setting(axis.key);
    std::string why;
    for (const std::string& value : axis.values) {
        Settings s = base;
        set_setting(s, axis.key, value);
        if (why.empty() && !kept.contains(value)) why = idle_reason(s, ref);
    }
    if (axis.key.starts_with("view.") && axis.key != "view.light") why = "without effect on what is measured";
    return fmt::format("{}: {} of {} values give no cases of their own{}{}", axis.key, axis.values.size() - kept.size(),
                       axis.values.size(), why.empty() ? "" : "; ", why);
}

/// Returns a text that is equal for equal settings only.
std::string fingerprint(const Settings& settings) {
    std::string text;
    for (const SettingRef& ref : changed_settings(settings))
        text += setting_key(ref) + "=" + value_text(*ref.param, get_value(settings, ref)) + "\n";
    return text;
}

}  // namespace

SweepAxis parse_axis(std::string_view text) {
    // Node paths may hold '='; values never do.
    const auto equals = text.rfind('=');
    if (equals == std::string_view::npos || equals + 1 == text.size())
        throw UsageError(fmt::format("--vary \"{}\": KEY=V1,V2,... or KEY=from:to:step is wanted", text));
    SweepAxis axis{std::string(text.substr(0, equals)), {}};
    const auto ref = find_setting(axis.key);
    if (!ref)
        throw UsageError(fmt::format("--vary {}: no such setting{}", axis.key, did_you_mean(nearest_key(axis.key))));
    axis.key = setting_key(*ref);
    if (is_text(*ref->param))
        throw UsageError(fmt::format("--vary {}: a text; nothing that is measured depends on it", axis.key));
    const std::string_view values = text.substr(equals + 1);
    const bool is_number = !ref->param->choices && !std::holds_alternative<bool>(default_value(*ref));
    const auto parts = split(values, ':');
    if (values == "*" && ref->param->swept) {
        const auto swept = ref->param->swept();
        axis.values.assign(swept.begin(), swept.end());
    } else if (values == "*" && ref->param->choices) {
        for (const Choice& choice : ref->param->choices()) axis.values.emplace_back(choice.key);
    } else if (values == "*" && std::holds_alternative<bool>(default_value(*ref))) {
        axis.values = {"false", "true"};
    } else if (is_number && parts.size() == 3) {
        for (const double v : step_values(parts, text)) axis.values.push_back(short_number(v, default_value(*ref)));
    } else {
        axis.values = split(values, ',');
    }
    if (axis.values.size() > kMaxValues)
        throw UsageError(fmt::format("--vary {}: more than {} values", axis.key, kMaxValues));
    std::vector<std::string> unique;
    for (const std::string& value : axis.values) {
        // A sized kernel's name stays as it is: the kernel's key alone leaves the size open.
        const std::string canonical =
            implied_values(*ref, value).empty() ? value_text(*ref->param, parse_value(*ref, value)) : value;
        if (std::find(unique.begin(), unique.end(), canonical) == unique.end()) unique.push_back(canonical);
    }
    axis.values = std::move(unique);
    return axis;
}

std::vector<std::pair<std::string, std::string>> SweepCase::sets() const {
    std::vector<std::pair<std::string, std::string>> all = values;
    all.insert(all.end(), starts.begin(), starts.end());
    return all;
}

void protect_assigned_settings(std::vector<SweepAxis>& axes, const std::set<std::string>& assigned_keys) {
    for (SweepAxis& axis : axes)
        for (const std::string& key : keys_with_starting_values(*find_setting(axis.key)))
            if (assigned_keys.contains(key)) axis.held.insert(key);
}

Settings without_ineffective_settings(Settings settings) {
    // Effect is tested under the given settings, so that the order of the rows does not matter.
    const Settings given = settings;
    for (const SettingRef& ref : all_settings(given)) {
        const bool light_off = ref.param->scope == Scope::Light && ref.light >= given.light_count;
        if (light_off || !idle_reason(given, ref).empty()) set_value(settings, ref, default_value(ref));
    }
    return settings;
}

Settings measured_settings(Settings settings) {
    const int light = settings.view.light;
    settings.view = {};
    settings.view.light = light;
    return settings;
}

SweepPlan plan_sweep(const Settings& base, const std::vector<SweepAxis>& axes) {
    std::set<std::string> keys, held;
    SweepPlan plan;
    plan.product = 1;
    for (const SweepAxis& axis : axes) {
        if (!keys.insert(axis.key).second)
            throw UsageError(fmt::format("--vary {}: varied twice; put all its values into one --vary", axis.key));
        held.insert(axis.held.begin(), axis.held.end());
        plan.product *= std::max<std::size_t>(axis.values.size(), 1);
        if (plan.product > kMaxSweepCases)
            throw UsageError(fmt::format("the sweep has more than {} cases; vary fewer settings or take larger steps",
                                         kMaxSweepCases));
    }
    for (const SweepAxis& axis : axes)
        for (const std::string& value : axis.values)
            for (const auto& [other, meant] : implied_values(*find_setting(axis.key), value))
                if (keys.contains(setting_key(other)))
                    throw UsageError(fmt::format(
                        "--vary {0}: its value {1} stands for {2}={3} too, and {2} is varied by itself; name {0} by "
                        "choices that leave it open",
                        axis.key, value, setting_key(other), value_text(*other.param, meant)));
    held.insert(keys.begin(), keys.end());
    const bool scene_varies =
        std::any_of(axes.begin(), axes.end(), [](const SweepAxis& a) { return a.key.starts_with("scene."); });
    std::set<std::string> seen;
    std::vector<std::set<std::string>> kept(axes.size());
    for (std::size_t index = 0; index < plan.product; ++index) {
        SweepCase c;
        c.settings = base;
        std::size_t rest = index, stride = plan.product;
        for (const SweepAxis& axis : axes) {
            stride /= axis.values.size();
            const std::string& value = axis.values[rest / stride];
            rest %= stride;
            set_setting(c.settings, axis.key, value);
            c.values.emplace_back(axis.key, value);
            c.id += (c.id.empty() ? "" : " ") + axis.key + "=" + value;
        }
        for (const auto& [key, value] : starting_values(base, c.settings))
            if (!held.contains(std::string(key))) c.starts.emplace_back(key, value);
        set_settings(c.settings, c.starts);
        const Settings measured = measured_settings(c.settings);
        if (!seen.insert(fingerprint(scene_varies ? measured : without_ineffective_settings(measured))).second)
            continue;
        for (std::size_t a = 0; a < axes.size(); ++a) kept[a].insert(c.values[a].second);
        plan.cases.push_back(std::move(c));
    }
    for (std::size_t a = 0; a < axes.size(); ++a)
        if (kept[a].size() < axes[a].values.size()) plan.notes.push_back(note_on_merged(base, axes[a], kept[a]));
    return plan;
}

}  // namespace si
