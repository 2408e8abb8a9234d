// Command-line options of the measuring commands (sweep, merge, tune, plan, advise, precision, shimmer).
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "app/commands/commands.h"

namespace si {

/// Variables that the options of the measuring commands are parsed into.
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

/// Function that adds SCENE, --preset and --set to a command.
using AddSessionOptions = std::function<void(CLI::App& command, SessionOptions& session)>;

/// Makes a validator for an option that takes a finite number within [min, max]. CLI::Range accepts NaN and garbage.
CLI::Validator number_between(double min, double max);

/// Adds the option --check-numeric (search frames for NaN, infinite and out-of-range numbers) to a command.
/// @param check receives the option's value
void add_numeric_option(CLI::App& command, bool& check);

/// Adds the option --cost (kind of frames to time) to a command. @param cost receives the option's value
void add_cost_option(CLI::App& command, CostCase& cost);

/// Adds the measuring commands (sweep, merge, tune, plan, advise, precision, shimmer) to the parser. Parsing sets `run`
/// to the function of the command that was named. @param options receives the options' values
void add_measure_commands(CLI::App& app, MeasureCliOptions& options, std::function<void()>& run,
                          const AddSessionOptions& add_session);

}  // namespace si
