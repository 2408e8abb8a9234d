// Short names of kernels at one size.
#include "renderer/settings/sized_kernels.h"

#include <algorithm>

namespace si {
namespace {

constexpr SizedKernel kSizedKernels[] = {
    {"pcf2", "pcf", 2, false},
    {"pcf3", "pcf", 3, false},
    {"pcf5", "pcf", 5, false},
    {"pcf7", "pcf", 7, false},
    {"pcf9", "pcf", 9, false},
    {"pcf3_nearest", "pcf", 3, true},
    {"pcf5_nearest", "pcf", 5, true},
    {"tent5", "tent", 5, std::nullopt},
    {"tent7", "tent", 7, std::nullopt},
    {"gauss5", "gauss", 5, std::nullopt},
    {"gauss7", "gauss", 7, std::nullopt},
};

}  // namespace

std::span<const SizedKernel> sized_kernels() {
    return kSizedKernels;
}

const SizedKernel* find_sized_kernel(std::string_view name) {
    const auto row = std::ranges::find(kSizedKernels, name, &SizedKernel::name);
    return row == std::end(kSizedKernels) ? nullptr : &*row;
}

}  // namespace si
