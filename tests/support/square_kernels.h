// Square kernels at several sizes, for tests over all rows of the kernel table.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include "renderer/settings/filters.h"

namespace si::test {

/// Square kernel at one size.
struct SizedKernel {
    std::string key;
    int size = 3;
    bool point = false;     ///< filter.point: taps of single texels
    bool bilinear = false;  ///< filter.bilinear: taps of 2x2 texels
};

/// Returns all square kernels at these sizes. Kernels of a fixed size stand once, at size 3.
inline std::vector<SizedKernel> square_kernels(std::initializer_list<int> sizes) {
    std::vector<SizedKernel> out;
    for (const Filter& row : filters()) {
        if (!row.square()) continue;
        for (const bool point : {false, true})
            for (const int size : sizes)
                if ((size == 3 || owns_setting(row, "filter.size")) && (!point || owns_setting(row, "filter.point")))
                    out.push_back({std::string(row.key), size, point});
        if (owns_setting(row, "filter.bilinear")) out.push_back({.key = std::string(row.key), .bilinear = true});
    }
    return out;
}

/// Returns a name for parameterised tests, such as "pcf_size_2_points".
inline std::string test_name(const SizedKernel& kernel) {
    std::string name = kernel.key + "_size_" + std::to_string(kernel.size) + (kernel.point ? "_points" : "") +
                       (kernel.bilinear ? "_bilinear" : "");
    std::ranges::replace(name, '-', '_');
    return name;
}

}  // namespace si::test
