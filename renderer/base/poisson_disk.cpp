#include "renderer/base/poisson_disk.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace si {
namespace {

constexpr glm::vec2 kPoissonDisk[] = {
    {0.0176f, 0.0156f},   {-0.4099f, -0.6259f}, {-0.7253f, 0.1984f},  {0.3960f, -0.6429f},  {-0.1782f, 0.7364f},
    {0.7500f, 0.1089f},   {0.4490f, 0.6640f},   {-0.7950f, -0.2763f}, {0.7650f, -0.3640f},  {-0.0042f, -0.8534f},
    {0.0078f, -0.4194f},  {-0.3095f, 0.2997f},  {-0.3811f, -0.1485f}, {-0.5918f, 0.6159f},  {0.4013f, -0.1557f},
    {0.3626f, 0.2594f},   {0.0389f, 0.4386f},   {0.1510f, 0.8523f},   {0.7455f, 0.4642f},   {-0.7025f, -0.5593f},
    {-0.2747f, -0.8624f}, {-0.8983f, -0.0216f}, {0.8914f, -0.1271f},  {0.2810f, -0.3944f},  {-0.2676f, -0.3971f},
    {0.6655f, -0.6218f},  {-0.1480f, -0.6311f}, {0.2590f, -0.8711f},  {-0.5397f, -0.3538f}, {-0.4699f, 0.0956f},
    {-0.4259f, 0.7980f},  {-0.7698f, 0.4414f},  {0.6437f, -0.1140f},  {0.1484f, -0.6358f},  {-0.3473f, 0.5547f},
    {-0.2246f, 0.0601f},  {-0.1176f, -0.1952f}, {-0.6436f, -0.0793f}, {0.2726f, 0.4922f},   {0.5222f, -0.3995f},
    {0.1299f, -0.1970f},  {0.2476f, 0.0549f},   {-0.5383f, 0.3779f},  {0.5126f, 0.0805f},   {0.5048f, 0.4379f},
    {-0.0684f, 0.2327f},  {-0.0592f, 0.9204f},  {0.1221f, 0.6418f},   {0.1404f, 0.2501f},   {0.8697f, 0.2935f},
    {0.3572f, 0.8534f},   {0.6288f, 0.2716f},   {0.6490f, 0.6620f},   {-0.1662f, 0.4662f},  {-0.9157f, 0.1838f},
    {-0.5612f, -0.7455f}, {0.4435f, -0.8260f},  {0.9330f, 0.0573f},   {-0.2444f, 0.9029f},  {-0.0539f, 0.5930f},
    {0.2851f, 0.6963f},   {-0.5514f, -0.5146f}, {-0.0038f, 0.7579f},  {-0.8287f, -0.4366f},
};
static_assert(std::size(kPoissonDisk) == kDiskTable);

}  // namespace

std::vector<glm::vec2> poisson_places(int n) {
    return {kPoissonDisk, kPoissonDisk + std::clamp(n, 0, kDiskTable)};
}

std::vector<glm::vec2> spiral_places(int n) {
    std::vector<glm::vec2> out;
    for (int i = 0; i < n; ++i) {
        // The golden angle in whole parts of a turn, of which whole turns fall away without rounding.
        const float angle = float(std::uint32_t(i) * 2654435769u) * (6.28318531f / 4294967296.f);
        out.push_back(std::sqrt((float(i) + 0.5f) / float(n)) * glm::vec2(std::cos(angle), std::sin(angle)));
    }
    return out;
}

}  // namespace si
