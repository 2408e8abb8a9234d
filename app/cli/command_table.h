// Table of all commands with their options, read from the parser itself: what man page and completions are made of.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/cli/command.h"

namespace si {

/// Kind of completions that a shell offers for the value of an option or argument.
enum class OfferedWords {
    None,         ///< a flag takes no value
    Files,        ///< names of files
    Words,        ///< the words of `words` alone
    WordsOrFiles  ///< the words of `words`, and names of files
};

/// Option or argument of a command, as man page and shell completions list it.
struct CommandOption {
    std::vector<std::string> names;  ///< "-o", "--output"; empty: an argument
    std::string value;               ///< name of the value or argument: "WxH"; empty: a flag
    std::string help;
    OfferedWords offered = OfferedWords::None;
    std::vector<std::string> words;  ///< values that are known by name
    bool is_setting = false;         ///< the value is KEY=VALUE, and `words` are the keys
    bool required = false;

    /// Returns true when names of files are offered for the value.
    bool offers_files() const { return offered == OfferedWords::Files || offered == OfferedWords::WordsOrFiles; }
};

/// Command with its options in the order of the help; row of command_table().
struct CommandRow {
    std::vector<std::string> path;  ///< names that call it: {"preset", "check"}; empty: the program without a command
    std::string about;
    std::vector<CommandOption> options;
    std::vector<std::string> commands;  ///< names of its own commands
};

/// Lists all commands of the command-line parser for man page and shell completions. The first row is the program
/// itself. Each command comes before its subcommands.
std::vector<CommandRow> command_table(const CLI::App& app);

/// Returns the full name of a command, with the commands above it: "preset check". Empty for the program itself.
std::string command_name(const CommandRow& row);

/// Formats the manual page of the program in the markup ROFF, for `man shadow-inspector`.
std::string man_page(const std::vector<CommandRow>& commands);

/// Formats the bash script that completes commands, options and values of the program. It needs no other script.
std::string bash_completions(const std::vector<CommandRow>& commands);
/// Formats the zsh script that completes commands, options and values of the program.
std::string zsh_completions(const std::vector<CommandRow>& commands);
/// Formats the fish script that completes commands, options and values of the program.
std::string fish_completions(const std::vector<CommandRow>& commands);

/// Adds the commands `completion` and `man-page` to the command-line parser, which print a shell's completions and the
/// manual page.
/// @param run receives the function of the command that the command line names
void add_printed_tables(CLI::App& app, Run& run);

/// Returns the text of --version: versions of the program, of presets and of error metrics, readable model formats,
/// file dialog and compiler.
std::string version_text();

}  // namespace si
