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

/// Makes the data of a frontier plot (error against cost) from the results of a sweep. Cases of one kernel form a line
/// through its resolutions. Failed cases are left out.
/// @param cost, error keys of the columns on the axes @param timed kind of frames to which the times belong
FrontierPlot frontier_plot(const std::vector<SweepRow>& rows, const std::string& cost, const std::string& error,
                           CostCase timed = kFrontierCost);
/// Makes the data of a frontier plot (error against cost) from the results of a sweep, with the axes that the results
/// name. Also marks the base of cost multiples (base_case()).
FrontierPlot frontier_plot(const SweepResults& results);
/// Adds settings that are no case of the sweep, such as the present ones, to a frontier plot (error against cost). They
/// are drawn below spots that the plot already has. Does nothing if `numbers` lacks a value for an axis.
/// @param kind present, pinned or an engine's settings @param cost, error keys of the columns on the axes
void add_spot(FrontierPlot& plot, PlotSpot::Kind kind, const std::string& label, const CaseNumbers& numbers,
              const std::string& cost, const std::string& error);
/// Sets the cost of the base case (hard kernel, 1024 texels) in a frontier plot, so that the plot can show costs as its
/// multiples. Leaves the cost unknown if it was not measured. @param cost key of the column on the cost axis
void add_base(FrontierPlot& plot, const SweepResults& results, const std::string& cost);

/// Makes everything that the frontier panel shows: the dots of a sweep's cases (error against cost), their Pareto
/// front, and advice for the present settings. Failed cases are left out.
/// @param present numbers of the present settings; null: none
/// @param cost, error keys of the columns on the axes
/// @param before numbers of the earlier settings; null: none
FrontierView frontier_view(const std::vector<SweepRow>& rows, const CaseNumbers* present, const std::string& cost,
                           const std::string& error, const CaseNumbers* before = nullptr);

}  // namespace si
