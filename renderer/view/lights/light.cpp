#include "renderer/view/lights/light.h"

#include <cmath>

namespace si {

double ClipLevel::texel_m() const {
    return std::exp2(double(exponent));
}

}  // namespace si
