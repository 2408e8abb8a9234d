// A sweep's results as the frontier panel shows them.
#pragma once

#include "app/sweep/results.h"
#include "ui/panels/frontier_panel.h"

namespace si {

/// The columns that may be axes of the plot, in order. @param cost of which frames the times are
std::vector<MeasuredColumn> measured_columns(CostCase cost = kDefaultCost);

MeasuredCase measured_case(const SweepRow& row);
/// Of settings that are no case.
MeasuredCase measured_case(const CaseNumbers& numbers);

/// Rows that failed are left out. @param present, before numbers of other settings; null: none @param cost, error keys
/// of columns
FrontierView frontier_view(const std::vector<SweepRow>& rows, const CaseNumbers* present, const std::string& cost,
                           const std::string& error, const CaseNumbers* before = nullptr);

}  // namespace si
