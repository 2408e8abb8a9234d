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

/// Function that runs the command which the command line names.
using Run = std::function<void()>;

/// Makes a validator for an option of the command line that takes a finite number within [min, max]. CLI::Range would
/// also accept NaN and trailing garbage.
CLI::Validator number_between(double min, double max);
/// Name of the validators that one_of() makes for options that take one of several words.
inline constexpr const char* kWordsValidator = "words";
/// Makes a validator for an option of the command line that takes one of `words`. For any other value the error message
/// lists the words.
CLI::Validator one_of(const std::vector<std::string_view>& words);

/// Builder for the options of one command in the command-line parser (CLI11). Make it with add_command(), which also
/// stores the options' values.
class CommandParser {
public:
    /// Returns the CLI11 parser of this command, to add options that no other command has.
    CLI::App& app() { return app_; }
    /// Adds an option with a value to the command. @param to receives the value @param type name of the value in the
    /// help
    template <class T>
    CLI::Option* add_value(const char* name, T& to, const char* type, const std::string& help) {
        return app_.add_option(name, to, help)->type_name(type);
    }
    /// Adds an option to the command whose value is assigned to a setting, like a --set KEY=VALUE after all others.
    /// @param key key of the setting
    template <class T>
    CLI::Option* add_setting(const char* name, const char* key, const char* type, const char* help) {
        const auto add = [this, key](const T& value) { sets_.push_back(fmt::format("{}={}", key, value)); };
        return app_.add_option_function<T>(name, add, help)->type_name(type);
    }
    /// Adds the argument SCENE and the options --preset, --set, --profile and --no-cache to the command. They choose
    /// the scene and the settings that the command works on.
    /// @param scene_required false: SCENE may be left out
    void add_session(bool scene_required = true);
    /// Adds the argument SCENE to the command: a model file or a built-in scene. Returns the argument for further
    /// rules.
    CLI::Option* add_scene();
    /// Adds the option --size to the command, the size of the picture in pixels. @param standard size without the
    /// option
    /// @param bytes_per_pixel memory that the command needs (PixelBytes), checked by finish(); 0: the command checks it
    void add_size(PictureSize standard = {}, std::uint64_t bytes_per_pixel = kDrawnPixelBytes);
    /// Adds the option -o to the command, which names the file or folder to write.
    /// @param type name of the value in the help, such as "FILE"
    CLI::Option* add_output(const char* type, const char* help);
    /// Adds an option to the command that names a further file to write.
    /// @param to receives the file's name @param type name of the value in the help, such as "F.json"
    CLI::Option* add_file_to_write(const char* name, std::string& to, const char* type, const char* help);
    /// Adds the option --check-numeric to the command, which searches frames for NaN, infinite and out-of-range
    /// numbers.
    void add_numeric();
    /// Adds the option --cost to the command. It chooses the frames to time: with every pass drawn again, with a moving
    /// camera, or with a moving light.
    void add_cost();
    /// Adds the flag --json to the command, which prints JSON instead of text. @param help its text in --help
    void add_json(const char* help = "As JSON");
    /// Adds the flag --area to the command: the reference is traced for a light of its real size (light.size), not for
    /// a point or direction.
    void add_area(const char* help =
                      "Compare with an area light (light.size), not a point or direction. As --set truth.area=true");
    /// Adds the options --max-error, --max-ms and --error to the command. They limit error and frame time of the
    /// settings that a search finds.
    /// @param limits receives the values @param error_help, ms_help help of --max-error and of --max-ms
    /// @param metric_help beginning of the help of --error, which a list of metrics follows
    void add_limits(SearchLimits& limits, const char* error_help, const char* ms_help, const char* metric_help);
    /// Completes the options after the command line is parsed: the picture's size, the list of files to write, and the
    /// settings of add_setting(). @throws UsageError; Error if the picture does not fit into memory
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

/// Command of the command-line parser with the values of its options.
template <class Options>
struct ParsedCommand : CommandParser {
    Options options;

    ParsedCommand(CLI::App& parent, const char* name, const char* about) : CommandParser(parent, name, about) {
        options_ = &options;
    }
};

/// Adds a command to the command-line parser. The returned object lives as long as the parser.
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

/// Adds the commands that measure to the command-line parser: sweep, merge, tune, plan, advise, precision, shimmer and
/// report.
/// @param run receives the function of the command that the command line names
void add_measure_commands(CLI::App& app, Run& run);

}  // namespace si
