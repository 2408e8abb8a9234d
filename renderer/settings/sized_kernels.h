// Short names of kernels at one size ("pcf5"), which --set, --vary, presets and searches take as values of
// filter.kernel. A list of kernels can so hold several sizes of one kernel. Files are written without them.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace si {

struct SizedKernel {
    std::string_view name;      ///< "pcf5"
    std::string_view kernel;    ///< key of the kernel's row (filters.h)
    int size = 0;               ///< value of filter.size
    std::optional<bool> point;  ///< value of filter.point, for kernels that read it
};

std::span<const SizedKernel> sized_kernels();
/// Returns the row called `name`; nullptr if there is none.
const SizedKernel* find_sized_kernel(std::string_view name);

}  // namespace si
