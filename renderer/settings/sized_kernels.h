// Short names of kernels at one size ("pcf5"), which --set, --vary, presets and searches accept as values of
// filter.kernel. A list of kernels can thus hold several sizes of one kernel. Files are written without these names.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace si {

/// Short name of a kernel at one size, and the settings that the name implies.
struct SizedKernel {
    std::string_view name;      ///< short name, such as "pcf5"
    std::string_view kernel;    ///< key of the kernel's row (filters.h)
    int size = 0;               ///< value of filter.size
    std::optional<bool> point;  ///< value of filter.point, for kernels that read it
};

/// Returns the table of short names, each with the kernel and the size that it stands for.
std::span<const SizedKernel> sized_kernels();
/// Returns the sized kernel with the short name `name`; nullptr if there is none.
const SizedKernel* find_sized_kernel(std::string_view name);

}  // namespace si
