#include "renderer/frame/numeric_health.h"

#include <fmt/format.h>

#include <algorithm>

namespace si {
namespace {

struct FaultWords {
    std::string_view key, label;
};
constexpr FaultWords kWords[] = {{"nan", "NaN"},
                                 {"infinite", "an infinite value"},
                                 {"outside_range", "a value outside 0 to 1"},
                                 {"negative_variance", "a variance below 0"},
                                 {"overflow", "an exponent's overflow"}};
static_assert(std::size(kWords) == kNumberFaults);

constexpr std::size_t kMostTold = 3;

}  // namespace

std::string_view fault_key(NumberFault fault) {
    return kWords[std::size_t(fault)].key;
}
std::string_view fault_label(NumberFault fault) {
    return kWords[std::size_t(fault)].label;
}

std::string finding_text(const NumberFinding& f) {
    const bool has_value = f.fault == NumberFault::OutsideRange || f.fault == NumberFault::NegativeVariance ||
                           f.fault == NumberFault::Overflow;
    std::string out = fmt::format("{} in {} {}{} of the {}: first at {} {}, {}", fault_label(f.fault), f.count, f.unit,
                                  f.count == 1 ? "" : "s", f.place, f.unit, f.first.x, f.first.y);
    if (has_value && f.worst != f.first)
        out += fmt::format(", worst at {}, {} ({:.6g})", f.worst.x, f.worst.y, f.value);
    else if (has_value)
        out += fmt::format(" ({:.6g})", f.value);
    return out;
}

std::string health_text(const NumericHealth& health) {
    if (health.sound())
        return fmt::format("all numbers are sound: {} in {} image{}", health.numbers, health.images,
                           health.images == 1 ? "" : "s");
    std::string out;
    const std::size_t told = std::min(health.findings.size(), kMostTold);
    for (std::size_t i = 0; i < told; ++i) out += (i ? "; " : "") + finding_text(health.findings[i]);
    if (const std::size_t more = health.findings.size() - told; more > 0)
        out += fmt::format("; and {} more finding{}", more, more == 1 ? "" : "s");
    return out;
}

}  // namespace si
