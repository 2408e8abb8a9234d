#include "app/cli/command_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/report/measure_json.h"
#include "app/report/views.h"
#include "app/session/presets.h"
#include "renderer/importers/importers.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/earlier.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Returns the words of the validator one_of(); none: the option has no such validator.
std::vector<std::string> validated_words(const CLI::Option& option) {
    std::vector<std::string> out;
    const CLI::Validator* validator = nullptr;
    try {
        // The parser's search by name is not const.
        validator = const_cast<CLI::Option&>(option).get_validator(kWordsValidator);
    } catch (const CLI::OptionNotFound&) {
        return out;
    }
    std::string rest = validator->get_description();
    while (!rest.empty()) {
        const std::size_t end = rest.find(", ");
        out.push_back(rest.substr(0, end));
        rest = end == std::string::npos ? std::string() : rest.substr(end + 2);
    }
    return out;
}

std::vector<std::string> setting_keys() {
    std::vector<std::string> out;
    for (const Param& p : params())
        if (p.scope != Scope::Object) out.push_back(setting_key(SettingRef{&p, 0, ""}));
    return out;
}

std::vector<std::string> scene_keys() {
    std::vector<std::string> out;
    for (const BuiltinScene& row : builtin_scenes()) out.emplace_back(row.key);
    return out;
}

std::vector<std::string> preset_keys() {
    std::vector<std::string> out;
    for (const BuiltinPreset& row : builtin_presets()) out.push_back(row.key);
    return out;
}

std::vector<std::string> view_keys() {
    std::vector<std::string> out;
    for (const View& row : views()) out.push_back(row.key);
    return out;
}

/// Row of the table of values whose words come from a table of the program.
struct NamedValues {
    std::string_view command, name;  ///< command ("": any) and option or argument
    OfferedWords offered;
    std::vector<std::string> (*words)();
};
constexpr NamedValues kNamedValues[] = {
    {"", "SCENE", OfferedWords::WordsOrFiles, scene_keys},
    {"", "--scene", OfferedWords::WordsOrFiles, scene_keys},
    {"", "--preset", OfferedWords::WordsOrFiles, preset_keys},
    {"", "--against", OfferedWords::WordsOrFiles, preset_keys},
    {"", "--fit-camera", OfferedWords::WordsOrFiles, preset_keys},
    {"preset check", "FILE", OfferedWords::WordsOrFiles, preset_keys},
    {"preset show", "FILE", OfferedWords::WordsOrFiles, preset_keys},
    {"preset diff", "A", OfferedWords::WordsOrFiles, preset_keys},
    {"preset diff", "B", OfferedWords::WordsOrFiles, preset_keys},
    {"list", "WHAT", OfferedWords::Words, list_kinds},
    {"", "--view", OfferedWords::Words, view_keys},
    {"", "--set", OfferedWords::Words, setting_keys},
    {"", "--vary", OfferedWords::Words, setting_keys},
    {"", "--along", OfferedWords::Words, setting_keys},
};

CommandOption option_row(const CLI::Option& option, const std::string& command) {
    CommandOption out;
    for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
    const bool argument = out.names.empty();
    const bool flag = !argument && option.get_items_expected_max() == 0;
    if (argument) out.value = option.get_name();
    // Names of types such as "WxH:A, B" end in what the validators say.
    if (!argument && !flag) out.value = option.get_type_name().substr(0, option.get_type_name().find(':'));
    out.help = option.get_description();
    out.required = option.get_required();
    if (flag) return out;
    out.offered = OfferedWords::Files;
    out.words = validated_words(option);
    if (!out.words.empty()) out.offered = OfferedWords::Words;
    const std::string& name = argument ? out.value : out.names.back();
    for (const NamedValues& row : kNamedValues) {
        if (row.name != name || (!row.command.empty() && row.command != command)) continue;
        out.words = row.words();
        out.offered = row.offered;
        out.is_setting = row.words == setting_keys;
    }
    return out;
}

void add_rows(std::vector<CommandRow>& rows, const CLI::App& app, const std::vector<std::string>& path) {
    CommandRow row{.path = path, .about = app.get_description()};
    for (const CLI::Option* option : app.get_options()) row.options.push_back(option_row(*option, command_name(row)));
    const std::vector<const CLI::App*> commands = app.get_subcommands([](const CLI::App*) { return true; });
    for (const CLI::App* command : commands) row.commands.push_back(command->get_name());
    rows.push_back(std::move(row));
    for (const CLI::App* command : commands) {
        std::vector<std::string> below = path;
        below.push_back(command->get_name());
        add_rows(rows, *command, below);
    }
}

/// Page that a command prints from the table of commands.
using TablePage = std::string (*)(const std::vector<CommandRow>&);

void add_page(CLI::App& app, CLI::App& command, Run& run, const std::shared_ptr<TablePage>& page) {
    command.callback([&app, &run, page] { run = [&app, page] { fmt::print("{}", (*page)(command_table(app))); }; });
}

}  // namespace

std::vector<CommandRow> command_table(const CLI::App& app) {
    std::vector<CommandRow> rows;
    add_rows(rows, app, {});
    return rows;
}

std::string command_name(const CommandRow& row) {
    return fmt::format("{}", fmt::join(row.path, " "));
}

void add_printed_tables(CLI::App& app, Run& run) {
    struct Shell {
        std::string_view name;
        TablePage page;
    };
    static constexpr Shell kShells[] = {
        {"bash", bash_completions}, {"zsh", zsh_completions}, {"fish", fish_completions}};
    CLI::App& completion =
        *app.add_subcommand("completion", "Print the completions of commands and options for a shell");
    std::vector<std::string_view> names;
    for (const Shell& shell : kShells) names.push_back(shell.name);
    const auto page = std::make_shared<TablePage>(bash_completions);
    completion
        .add_option_function<std::string>(
            "SHELL", [page](const std::string& name) { *page = std::ranges::find(kShells, name, &Shell::name)->page; },
            "The shell: bash, zsh or fish")
        ->required()
        ->check(one_of(names));
    add_page(app, completion, run, page);
    CLI::App& manual = *app.add_subcommand("man-page", "Print the manual page, for man -l or nroff -man");
    add_page(app, manual, run, std::make_shared<TablePage>(man_page));
}

std::string version_text() {
#ifdef SI_HAS_FILE_PORTAL
    constexpr std::string_view kDialog = "the desktop's, or the editor's own";
#else
    constexpr std::string_view kDialog = "the editor's own";
#endif
    std::string text = fmt::format("shadow-inspector {}\n", SI_VERSION);
    text += fmt::format("settings       version {}; presets of versions {} to {} are read\n", kSettingsVersion,
                        oldest_settings_version(), kSettingsVersion);
    text += fmt::format("errors         meaning {}\n", kErrorMeaning);
    text += fmt::format("models         {}\n", importer_labels());
    text += fmt::format("file dialog    {}\n", kDialog);
    text += fmt::format("compiler       {} {}", SI_COMPILER, __VERSION__);
    return text;
}

}  // namespace si
