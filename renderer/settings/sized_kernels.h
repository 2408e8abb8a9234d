// Short names of kernels at one size ("pcf5"), which --set, --vary, presets and searches accept as values of
// filter.kernel. A list of kernels can thus hold several sizes of one kernel. Files are written without these names.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace si {

/// Short name of a kernel at one size ("pcf5"), and the settings that the name stands for.
struct SizedKernel {
    std::string_view name;      ///< short name, such as "pcf5"
    std::string_view kernel;    ///< key of the kernel's row (filters.h)
    int size = 0;               ///< value of filter.size
    std::optional<bool> point;  ///< value of filter.point, for kernels that read it
};

/// Returns the table of short names of kernels at one size ("pcf5"), each with its kernel and size.
std::span<const SizedKernel> sized_kernels();
/// Returns the kernel and size for a short name such as "pcf5"; nullptr if there is no such name.
const SizedKernel* find_sized_kernel(std::string_view name);

}  // namespace si
