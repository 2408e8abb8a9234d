#include "ui/widgets/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/lengths_text.h"

namespace si {
namespace {

constexpr double kMillion = 1e6, kBillion = 1e9;

std::string short_number(double value) {
    const double a = std::abs(value);
    if (a >= 0.9995 * kBillion) return digits_text(value / kBillion) + " billion";
    if (a >= 0.9995 * kMillion) return digits_text(value / kMillion) + " million";
    return digits_text(value);
}

/// Takes zeros from the end of a decimal fraction.
std::string without_trailing_zeros(std::string text) {
    if (text.find('.') == text.npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
}

}  // namespace

std::string quantity_text(double value, std::string_view unit) {
    if (!std::isfinite(value)) return "no value";
    if (unit == "m") return metres_text(value);
    if (unit == "texels") return texels_text(value);
    const std::string number = short_number(value);
    if (unit == "deg") return number + "°";
    return unit.empty() ? number : fmt::format("{} {}", number, unit);
}

std::string percent_text(double share) {
    return std::isfinite(share) ? digits_text(100 * share) + " %" : "no value";
}

std::string stored_text(double value, int digits) {
    if (!std::isfinite(value)) return fmt::format("{}", value);
    constexpr int kMostPower = 15, kMostDecimals = 45;  // the smallest float has 45 decimals
    const int power = value == 0 ? 0 : int(std::floor(std::log10(std::abs(value))));
    if (power >= kMostPower)
        return fmt::format("{} × 10^{}",
                           without_trailing_zeros(fmt::format("{:.{}f}", value / std::pow(10.0, power), digits - 1)),
                           power);
    return without_trailing_zeros(fmt::format("{:.{}f}", value, std::clamp(digits - 1 - power, 0, kMostDecimals)));
}

}  // namespace si
