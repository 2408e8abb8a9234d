// Compares results of the hard cases with their limits and with docs/lab/stability.md, which scripts/stability.sh
// writes.
#pragma once

#include <string>
#include <vector>

#include "renderer/scenes/hard_cases.h"

namespace si::test {

/// Records a measured value of a hard case with its fix. Fails the test if the value exceeds the row's limit, or if
/// docs/lab/stability.md has another verdict or none for this driver. The page gets the worst value of a run.
/// @param number number of the hard case
/// @param value measured value, in the row's unit
void expect_within_limit(int number, double value);

/// Records a measured value of a hard case without its fix. Fails the test if the value is below the row's `min_fault`:
/// the test would then prove nothing. The page gets the least value of a run.
/// @param number number of the hard case
void expect_fault(int number, double value);

/// Returns the current driver's section title in docs/lab/stability.md; empty if the page has no section for the
/// driver.
std::string stability_driver();

/// Row of a driver's table in docs/lab/stability.md.
struct StabilityRow {
    int number = 0;                  ///< number of the hard case
    std::vector<std::string> cells;  ///< texts of the row's cells
    /// Returns the row's last cell: "holds" or "FAILS".
    std::string verdict() const { return cells.empty() ? "" : cells.back(); }
};

/// Reads a driver's table from docs/lab/stability.md. Empty if the page has no section for the driver.
std::vector<StabilityRow> stability_rows(const std::string& driver);

/// Returns the texts of a row's first cells (number, title, measure, limit, unit), which do not depend on a run.
std::vector<std::string> stability_cells(const HardCase& row);

/// Drivers with a section in docs/lab/stability.md, in the page's order.
inline constexpr const char* kStabilityDrivers[] = {"llvmpipe", "zink"};

}  // namespace si::test
