// Table of all commands with their options, read from the parser itself: what man page and completions are made of.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/cli/command.h"

namespace si {

/// Kind of words that a shell offers for a value.
enum class OfferedWords {
    None,         ///< a flag takes no value
    Files,        ///< names of files
    Words,        ///< the words of `words` alone
    WordsOrFiles  ///< the words of `words`, and names of files
};

/// Option or argument of a command.
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

/// Command with its options, in the order of its help.
struct CommandRow {
    std::vector<std::string> path;  ///< names that call it: {"preset", "check"}; empty: the program without a command
    std::string about;
    std::vector<CommandOption> options;
    std::vector<std::string> commands;  ///< names of its own commands
};

/// Returns all commands of the parser, the program itself first, and each command before those below it.
std::vector<CommandRow> command_table(const CLI::App& app);

/// Returns the names of a command with spaces between: "preset check".
std::string command_name(const CommandRow& row);

/// Returns the page of ROFF that `man shadow-inspector` shows.
std::string man_page(const std::vector<CommandRow>& commands);

/// Returns the completions for bash. They need no other script.
std::string bash_completions(const std::vector<CommandRow>& commands);
/// Returns the completions for zsh.
std::string zsh_completions(const std::vector<CommandRow>& commands);
/// Returns the completions for fish.
std::string fish_completions(const std::vector<CommandRow>& commands);

/// Adds the commands `completion` and `man-page` to the parser.
void add_printed_tables(CLI::App& app, Run& run);

/// Returns the text of --version: the program's version, those of its files, and what it was built with.
std::string version_text();

}  // namespace si
