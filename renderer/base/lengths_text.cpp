#include "renderer/base/lengths_text.h"

#include <fmt/format.h>

#include <cmath>

namespace si {

std::string digits_text(double value) {
    constexpr int kMostDecimals = 12;
    const double a = std::abs(value);
    if (!(a < 999.5)) return fmt::format("{:.0f}", value);  // NaN too
    if (a >= 1e-4 || a < std::pow(10.0, -kMostDecimals)) return fmt::format("{:.3g}", a < 1e-4 ? 0 : value);
    return fmt::format("{:.{}f}", value, int(std::ceil(-std::log10(a))));
}

std::string signed_text(double value) {
    return (value < 0 ? "" : "+") + digits_text(value);
}

std::string metres_text(double metres) {
    const double a = std::abs(metres);
    if (!std::isfinite(metres)) return "no distance";
    if (a == 0) return "0 m";
    if (a < 1e-9) return "less than 1 nm";
    if (a < 0.9995e-3) return digits_text(metres * 1e6) + " µm";
    if (a < 0.9995) return digits_text(metres * 1e3) + " mm";
    if (a < 9999.5) return digits_text(metres) + " m";
    if (a < 1e9) return digits_text(metres * 1e-3) + " km";
    return digits_text(metres * 1e-9) + " million km";
}

std::string texels_text(double texels) {
    if (!std::isfinite(texels)) return "infinitely many texels";
    const std::string number =
        std::abs(texels) < 999'500 ? digits_text(texels) : digits_text(texels * 1e-6) + " million";
    return number + (number == "1" ? " texel" : " texels");
}

}  // namespace si
