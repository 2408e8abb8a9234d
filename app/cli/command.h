// Commands of the parser, with the options that several commands share.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/commands/commands.h"

namespace si {

/// Function of the command that the command line names.
using Run = std::function<void()>;

/// Makes a validator for an option that takes a finite number within [min, max]. CLI::Range accepts NaN and garbage.
CLI::Validator number_between(double min, double max);
/// Name of the validators that one_of() makes.
inline constexpr const char* kWordsValidator = "words";
/// Makes a validator for an option that takes one of `words`. The error message for another word lists them.
CLI::Validator one_of(const std::vector<std::string_view>& words);

/// One command of the parser, to which options are added. Use add_command(), which holds the options' values, too.
class CommandParser {
public:
    /// Returns the parser's own object, for options that only this command has.
    CLI::App& app() { return app_; }
    /// Adds an option with a value. @param type name of the value in the help
    template <class T>
    CLI::Option* add_value(const char* name, T& to, const char* type, const std::string& help) {
        return app_.add_option(name, to, help)->type_name(type);
    }
    /// Adds an option whose value becomes a setting, as by a --set after all others.
    template <class T>
    CLI::Option* add_setting(const char* name, const char* key, const char* type, const char* help) {
        const auto add = [this, key](const T& value) { sets_.push_back(fmt::format("{}={}", key, value)); };
        return app_.add_option_function<T>(name, add, help)->type_name(type);
    }
    /// Adds SCENE, --preset, --set and --no-cache.
    void add_session(bool scene_required = true);
    /// Adds SCENE alone.
    CLI::Option* add_scene();
    /// Adds --size, the size of the picture in pixels. @param standard size without the option
    /// @param bytes_per_pixel memory that the command takes, PixelBytes; 0: the command checks it
    void add_size(PictureSize standard = {}, std::uint64_t bytes_per_pixel = kDrawnPixelBytes);
    /// Adds -o, the file or folder to write.
    CLI::Option* add_output(const char* type, const char* help);
    /// Adds a further option that names a file to write. @param type name of the value in the help
    CLI::Option* add_file_to_write(const char* name, std::string& to, const char* type, const char* help);
    /// Adds --check-numeric, which searches frames for NaN, infinite and out-of-range numbers.
    void add_numeric();
    /// Adds --cost, the kind of frames to time.
    void add_cost();
    /// Adds --json.
    void add_json(const char* help = "As JSON");
    /// Adds --area, which compares with a light of a size.
    void add_area(const char* help =
                      "Compare with an area light (light.size), not a point or direction. As --set truth.area=true");
    /// Adds --max-error, --max-ms and --error. @param metric_help begin of the help of --error
    void add_limits(SearchLimits& limits, const char* error_help, const char* ms_help, const char* metric_help);
    /// Applies the values that are parsed as text to the options. @throws UsageError
    void finish();

protected:
    CommandParser(CLI::App& parent, const char* name, const char* about) : app_(*parent.add_subcommand(name, about)) {}

    CLI::App& app_;
    CommandOptions* options_ = nullptr;  ///< ParsedCommand::options

private:
    std::string size_;
    std::uint64_t bytes_per_pixel_ = 0;
    std::vector<const std::string*> files_to_write_;
    std::vector<std::string> sets_;  ///< KEY=VALUE
};

/// Command of the parser with the values of its options.
template <class Options>
struct ParsedCommand : CommandParser {
    Options options;

    ParsedCommand(CLI::App& parent, const char* name, const char* about) : CommandParser(parent, name, about) {
        options_ = &options;
    }
};

/// Adds a command to the parser. The returned object lives as long as the parser.
/// @param run receives the command's function when the command line names it @param execute function that runs the
/// command
template <class Options>
ParsedCommand<Options>& add_command(CLI::App& parent, Run& run, const char* name, const char* about,
                                    void (*execute)(const Options&)) {
    const auto made = std::make_shared<ParsedCommand<Options>>(parent, name, about);
    made->app().callback([made, &run, execute] {
        run = [made, execute] {
            made->finish();
            execute(made->options);
        };
    });
    return *made;
}

/// Adds the commands that measure (sweep, merge, tune, plan, advise, precision, shimmer) to the parser.
void add_measure_commands(CLI::App& app, Run& run);

}  // namespace si
