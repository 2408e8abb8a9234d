// What the tests of the hard cases found, held to the table's limits and to docs/lab/stability.md, which is written of
// it: scripts/stability.sh.
#pragma once

#include <string>
#include <vector>

#include "renderer/scenes/hard_cases.h"

namespace si::test {

/// A number of a row with its remedy in force: fails beyond the row's limit, and where the document of this driver says
/// otherwise or nothing. The worst of a run is written.
void judge(int number, double value);

/// A number that shows that the row's fault is there without the remedy: fails below the row's `min_fault`. The least
/// of a run is written.
void expect_fault(int number, double value);

/// The driver at hand as the document calls it; empty: it has no section of it.
std::string stability_driver();

struct StabilityRow {
    int number = 0;
    std::vector<std::string> cells;  ///< of the table's row
    std::string verdict() const { return cells.empty() ? "" : cells.back(); }
};

/// The document's rows of a driver.
std::vector<StabilityRow> stability_rows(const std::string& driver);

/// What the cells before the run's own numbers must say of a row.
std::vector<std::string> stability_cells(const HardCase& row);

inline constexpr const char* kStabilityDrivers[] = {"llvmpipe", "zink"};

}  // namespace si::test
