// The commands that measure, for app/cli/cli.cpp.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "app/commands/commands.h"

namespace si {

/// What the options of the measuring commands are written to.
struct MeasureCliOptions {
    SweepOptions sweep;
    MergeOptions merge;
    TuneOptions tune;
    PlanOptions plan;
    AdviseOptions advise;
    PrecisionOptions precision;
    ShimmerCommandOptions shimmer;
    std::string size;
    bool no_time = false, area = false;
};

/// Adds SCENE, --preset and --set to a command.
using AddSessionOptions = std::function<void(CLI::App& command, SessionOptions& session)>;

/// Of an option that takes a finite number within bounds; CLI::Range lets what is no number pass.
CLI::Validator number_between(double least, double most);

/// Adds --check-numeric to a command.
void add_numeric_option(CLI::App& command, bool& check);

/// Adds --cost to a command.
void add_cost_option(CLI::App& command, CostCase& cost);

/// Adds the commands; `run` becomes what the one that is called does.
void add_measure_commands(CLI::App& app, MeasureCliOptions& options, std::function<void()>& run,
                          const AddSessionOptions& add_session);

}  // namespace si
