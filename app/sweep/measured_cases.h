// Conversion of sweep results for the frontier panel.
#pragma once

#include "app/sweep/results.h"
#include "ui/panels/frontier_panel.h"

namespace si {

/// Lists the columns of sweep results that may be axes of the frontier plot (error against cost), in order. @param cost
/// kind of frames that the times belong to
std::vector<MeasuredColumn> measured_columns(CostCase cost = kFrontierCost);

/// Converts a row of sweep results to a dot of the frontier plot.
MeasuredCase measured_case(const SweepRow& row);
/// Converts numbers measured outside a sweep (present or pinned settings) to a dot of the frontier plot.
MeasuredCase measured_case(const CaseNumbers& numbers);

/// Makes the data of a sweep's frontier plot: a line a kernel through its resolutions. Failed rows are left out.
/// @param cost, error keys of the columns on the axes @param timed kind of frames that the times belong to
FrontierPlot frontier_plot(const std::vector<SweepRow>& rows, const std::string& cost, const std::string& error,
                           CostCase timed = kFrontierCost);
/// Makes the data of a sweep's frontier plot, with the base of cost multiples, at the axes of the results.
FrontierPlot frontier_plot(const SweepResults& results);
/// Adds a spot below those that the plot has, if its numbers have values on both axes.
void add_spot(FrontierPlot& plot, PlotSpot::Kind kind, const std::string& label, const CaseNumbers& numbers,
              const std::string& cost, const std::string& error);
/// Adds the base of cost multiples to a frontier plot, if results of the column `cost` are known for it.
void add_base(FrontierPlot& plot, const SweepResults& results, const std::string& cost);

/// Makes the frontier plot of a sweep: dots, Pareto front and advice. Failed rows are left out.
/// @param present numbers of the present settings; null: none
/// @param cost, error keys of the columns on the axes
/// @param before numbers of the earlier settings; null: none
FrontierView frontier_view(const std::vector<SweepRow>& rows, const CaseNumbers* present, const std::string& cost,
                           const std::string& error, const CaseNumbers* before = nullptr);

}  // namespace si
