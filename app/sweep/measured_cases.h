// Conversion of sweep results for the frontier panel.
#pragma once

#include "app/sweep/results.h"
#include "ui/panels/frontier_panel.h"

namespace si {

/// Lists the columns of sweep results that the axes of the frontier plot (error against cost) can show, in the order of
/// columns().
/// @param cost kind of frames to which the times belong
std::vector<MeasuredColumn> measured_columns(CostCase cost = kFrontierCost);

/// Converts the results of one case of a sweep to a dot of the frontier plot (error against cost).
MeasuredCase measured_case(const SweepRow& row);
/// Converts numbers measured outside a sweep, such as those of the present or pinned settings, to a dot of the frontier
/// plot (error against cost).
MeasuredCase measured_case(const CaseNumbers& numbers);

/// Makes the data of a frontier plot (error against cost) from the results of a sweep. Cases form a line if they differ
/// only in map.resolution or, without that axis, in the first varied setting with numeric values. Cases without a value
/// on both axes, such as failed ones, are left out.
/// @param cost, error keys of the columns on the axes @param timed kind of frames to which the times belong
FrontierPlot frontier_plot(const std::vector<SweepRow>& rows, const std::string& cost, const std::string& error,
                           CostCase timed = kFrontierCost);
/// Makes the data of a frontier plot (error against cost) from the results of a sweep, with the columns SweepResults::x
/// and y on the axes. Also sets the cost of the base case (hard kernel, 1024 texels), as add_base() does.
FrontierPlot frontier_plot(const SweepResults& results);
/// Adds settings that are no case of the sweep, such as the present ones, to a frontier plot (error against cost). The
/// new spot is drawn below the spots that the plot already has. Does nothing if `numbers` lacks a value for an axis.
/// @param kind present, pinned or an engine's settings @param cost, error keys of the columns on the axes
void add_spot(FrontierPlot& plot, PlotSpot::Kind kind, const std::string& label, const CaseNumbers& numbers,
              const std::string& cost, const std::string& error);
/// Sets the cost of the base case (hard kernel, 1024 texels) in a frontier plot, so that the plot can show costs as
/// multiples of it. Leaves the cost unknown if it was not measured or is within its noise. @param cost key of the
/// column on the cost axis
void add_base(FrontierPlot& plot, const SweepResults& results, const std::string& cost);

/// Makes everything that the frontier panel shows: the dots of a sweep's cases (error against cost), their Pareto
/// front, and advice for the present settings. Cases without a value on both axes, such as failed ones, are left out.
/// @param present numbers of the present settings; null: none
/// @param cost, error keys of the columns on the axes
/// @param before numbers of pinned or earlier settings, shown for comparison; null: none
FrontierView frontier_view(const std::vector<SweepRow>& rows, const CaseNumbers* present, const std::string& cost,
                           const std::string& error, const CaseNumbers* before = nullptr);

}  // namespace si
