#include <fmt/format.h>

#include "app/cli/command_table.h"

namespace si {
namespace {

/// Returns a text as ROFF prints it: no character of it is a command.
std::string roff_text(std::string_view text) {
    std::string out;
    bool line_begins = true;
    for (const char c : text) {
        if (line_begins && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
        line_begins = c == '\n';
    }
    return out;
}

std::string roff_bold(std::string_view text) {
    return "\\fB" + roff_text(text) + "\\fR";
}

std::string roff_italic(std::string_view text) {
    return "\\fI" + roff_text(text) + "\\fR";
}

/// Returns the names of an option with its value: "-o, --output OUT".
std::string option_heading(const CommandOption& option) {
    std::string out;
    for (const std::string& name : option.names) out += (out.empty() ? "" : ", ") + roff_bold(name);
    if (!option.value.empty()) out += (out.empty() ? "" : " ") + roff_italic(option.value);
    return out;
}

/// Returns a command line with the arguments of a command, and required options.
std::string synopsis_line(const CommandRow& row) {
    std::string out = roff_bold("shadow-inspector " + command_name(row));
    for (const CommandOption& option : row.options)
        if (option.names.empty())
            out += " " + (option.required ? roff_italic(option.value) : "[" + roff_italic(option.value) + "]");
    for (const CommandOption& option : row.options)
        if (!option.names.empty() && option.required)
            out += " " + roff_bold(option.names.front()) + " " + roff_italic(option.value);
    return out + (row.commands.empty() ? " [options]" : " command");
}

/// Row of the table of sections that no option describes.
struct ManSection {
    std::string_view title;
    std::vector<std::pair<std::string_view, std::string_view>> entries;
};

std::vector<ManSection> last_sections() {
    return {
        {"EXIT STATUS",
         {{"0", "Done; for check: all limits are kept."},
          {"1",
           "A file, the driver or memory stood in the way. One line on standard error says which, and what to do."},
          {"2", "The command line is wrong."},
          {"3", "A limit of check is exceeded."}}},
        {"ENVIRONMENT",
         {{"DISPLAY, WAYLAND_DISPLAY", "Display of the editor. Without one, pictures are drawn into the folder out."},
          {"XDG_STATE_HOME", "Folder of layout, recent files and autosaves, by default ~/.local/state."},
          {"XDG_CACHE_HOME", "Folder of baked light maps, by default ~/.cache."}}},
        {"FILES",
         {{"/usr/share/doc/shadow-inspector/", "Documents: the tutorial, all settings, all commands, bundles."},
          {"/usr/share/shadow-inspector/assets/", "Writers of bundles for other engines, and presets to begin with."}}},
        {"SEE ALSO", {{"renderdoc(1)", "Makes the captures that import-capture reads."}}}};
}

}  // namespace

std::string man_page(const std::vector<CommandRow>& commands) {
    std::string out = fmt::format(
        ".\\\" Printed by `shadow-inspector man-page`.\n"
        ".TH SHADOW\\-INSPECTOR 1 \"\" \"shadow-inspector {}\" \"User Commands\"\n"
        ".SH NAME\nshadow\\-inspector \\- inspect shadow maps interactively and headless\n"
        ".SH SYNOPSIS\n",
        SI_VERSION);
    out += roff_bold("shadow-inspector") + "\n.br\n";
    for (const CommandRow& row : commands)
        if (!row.path.empty() && row.commands.empty()) out += synopsis_line(row) + "\n.br\n";
    out += ".SH DESCRIPTION\n";
    out += roff_text(
               "Shadow Inspector shows a scene beside its live shadow map, explains why a pixel is lit or in shadow, "
               "and measures what accuracy costs.") +
           "\n.PP\n" +
           roff_text(
               "Without a command it opens the editor. Without a display it draws everything into the folder out. "
               "Every command but edit draws through EGL, and needs neither a display nor a GPU.") +
           "\n";
    for (const CommandRow& row : commands) {
        if (row.path.empty())
            out += ".SH OPTIONS\n";
        else if (row.path.size() == 1 && &row == &commands[1])
            out += ".SH COMMANDS\n";
        if (!row.path.empty()) out += fmt::format(".SS {}\n{}.\n", roff_text(command_name(row)), roff_text(row.about));
        for (const CommandOption& option : row.options)
            out += fmt::format(".TP\n{}\n{}\n", option_heading(option), roff_text(option.help));
    }
    for (const ManSection& section : last_sections()) {
        out += fmt::format(".SH {}\n", section.title);
        for (const auto& [name, text] : section.entries)
            out += fmt::format(".TP\n{}\n{}\n", roff_bold(name), roff_text(text));
    }
    return out;
}

}  // namespace si
