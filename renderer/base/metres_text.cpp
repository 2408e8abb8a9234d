#include "renderer/base/metres_text.h"

#include <fmt/format.h>

#include <cmath>

namespace si {

std::string metres_text(double metres) {
    const double a = std::abs(metres);
    if (!std::isfinite(metres)) return "no distance";
    if (a == 0) return "0 m";
    if (a < 1e-3) return fmt::format("{:.3g} µm", metres * 1e6);
    if (a < 1) return fmt::format("{:.3g} mm", metres * 1e3);
    if (a < 1e4) return fmt::format("{:.4g} m", metres);
    return fmt::format("{:.4g} km", metres * 1e-3);
}

}  // namespace si
