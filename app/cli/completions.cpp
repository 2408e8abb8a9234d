#include <fmt/format.h>

#include <algorithm>

#include "app/cli/command_table.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Returns a text between single quotes, as sh, bash and zsh read it.
std::string shell_quoted(std::string_view text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

/// Returns a text between single quotes, as fish reads it.
std::string fish_quoted(std::string_view text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') out += '\\';
        out += c;
    }
    return out + "'";
}

/// Returns a help text up to the end of its first sentence or part, on one line.
std::string first_part(const std::string& help) {
    std::string out = help.substr(0, std::min({help.find(". "), help.find("; "), help.find('\n'), help.size()}));
    if (out.ends_with('.')) out.pop_back();
    return out;
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

/// Returns the keys of settings with a list of choices, each with its choices.
std::vector<std::pair<std::string, std::vector<std::string>>> setting_choices() {
    std::vector<std::pair<std::string, std::vector<std::string>>> out;
    for (const Param& p : params()) {
        const SettingRef ref{&p, 0, ""};
        if (p.scope == Scope::Object) continue;
        std::vector<std::string> words;
        if (p.choices) {
            for (const Choice& c : p.choices()) words.emplace_back(c.key);
        } else if (std::holds_alternative<bool>(default_value(ref))) {
            words = {"true", "false"};
        }
        if (!words.empty()) out.emplace_back(setting_key(ref), std::move(words));
    }
    return out;
}

std::vector<std::string> option_names(const CommandRow& row) {
    std::vector<std::string> out;
    for (const CommandOption& option : row.options) out.insert(out.end(), option.names.begin(), option.names.end());
    return out;
}

/// Returns the assignments of a branch of bash: the words and whether files are offered.
std::string bash_offer(const CommandOption& option) {
    std::string out = "words=" + shell_quoted(joined(option.words));
    if (option.offers_files()) out += " files=yes";
    if (option.is_setting) out += " setting=yes";
    return out;
}

/// Returns the choices of a value as _arguments of zsh takes them.
std::string zsh_action(const CommandOption& option) {
    if (option.is_setting) return "_shadow_inspector_settings";
    const std::string words = joined(option.words);
    if (option.offered == OfferedWords::Files) return "_files";
    if (option.offered == OfferedWords::Words) return "(" + words + ")";
    return "{_alternative \"words:word:(" + words + ")\" \"files:file:_files\"}";
}

/// Returns a text within a specification of _arguments of zsh, where : and brackets end a part.
std::string zsh_part(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == ':' || c == '[' || c == ']' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

void add_zsh_options(std::string& out, const CommandRow& row) {
    for (const CommandOption& option : row.options) {
        const std::string value = option.value.empty() ? "" : ":" + zsh_part(option.value) + ":" + zsh_action(option);
        if (option.names.empty())
            out += " \\\n        " + shell_quoted("*" + value);
        else
            for (const std::string& name : option.names)
                out +=
                    " \\\n        " + shell_quoted("*" + name + "[" + zsh_part(first_part(option.help)) + "]" + value);
    }
}

}  // namespace

std::string bash_completions(const std::vector<CommandRow>& commands) {
    std::string out =
        "# Completions of shadow-inspector for bash, printed by `shadow-inspector completion bash`.\n"
        "_shadow_inspector() {\n"
        "  local cur=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} command= key= words= files= "
        "setting=\n"
        "  if ((COMP_CWORD > 1)); then command=${COMP_WORDS[1]}; fi\n"
        "  # A word such as bias.kind=constant is three words to bash.\n"
        "  if [[ $cur == = ]]; then\n"
        "    key=$option option=${COMP_WORDS[COMP_CWORD - 2]} cur=\n"
        "  elif [[ $option == = ]]; then\n"
        "    key=${COMP_WORDS[COMP_CWORD - 2]} option=${COMP_WORDS[COMP_CWORD - 3]}\n"
        "  fi\n"
        "  if [[ $key == --* ]]; then option=$key key=; fi\n"
        "  case $command in\n";
    for (const CommandRow& row : commands)
        if (row.path.size() == 1 && !row.commands.empty())
            out +=
                fmt::format("  {}) if ((COMP_CWORD > 2)); then command+=\" ${{COMP_WORDS[2]}}\"; fi ;;\n", row.path[0]);
    out += "  esac\n  if [[ -n $key ]]; then\n    case $key in\n";
    for (const auto& [key, words] : setting_choices())
        out += fmt::format("    {}) words={} ;;\n", key, shell_quoted(joined(words)));
    out += "    esac\n  else\n    case $command:$option in\n";
    for (const CommandRow& row : commands)
        for (const CommandOption& option : row.options)
            if (!option.names.empty() && !option.value.empty())
                for (const std::string& name : option.names)
                    out += fmt::format("    {}:{}) {} ;;\n", shell_quoted(command_name(row)), name, bash_offer(option));
    out += "    *)\n      case $command in\n";
    for (const CommandRow& row : commands) {
        out += fmt::format("      {})\n", shell_quoted(command_name(row)));
        out += fmt::format("        if [[ $cur == -* ]]; then\n          words={}\n        else\n",
                           shell_quoted(joined(option_names(row))));
        const auto argument = std::ranges::find_if(row.options, [](const CommandOption& o) { return o.names.empty(); });
        if (!row.commands.empty())
            out += "          words=" + shell_quoted(joined(row.commands)) + "\n";
        else if (argument != row.options.end())
            out += "          " + bash_offer(*argument) + "\n";
        else
            out += "          :\n";
        out += "        fi\n        ;;\n";
    }
    out +=
        "      esac\n"
        "      ;;\n"
        "    esac\n"
        "  fi\n"
        "  COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n"
        "  if [[ -n $setting ]]; then\n"
        "    COMPREPLY=(\"${COMPREPLY[@]/%/=}\")\n"
        "    compopt -o nospace 2>/dev/null\n"
        "  fi\n"
        "  if [[ -n $files ]]; then\n"
        "    local IFS=$'\\n'\n"
        "    COMPREPLY+=($(compgen -f -- \"$cur\"))\n"
        "    compopt -o filenames 2>/dev/null\n"
        "  fi\n"
        "}\n"
        "complete -F _shadow_inspector shadow-inspector\n";
    return out;
}

std::string zsh_completions(const std::vector<CommandRow>& commands) {
    std::string out =
        "#compdef shadow-inspector\n"
        "# Completions of shadow-inspector for zsh, printed by `shadow-inspector completion zsh`.\n"
        "_shadow_inspector_settings() {\n"
        "  if compset -P 1 '*='; then\n"
        "    case ${IPREFIX%=} in\n";
    for (const auto& [key, words] : setting_choices())
        out += fmt::format("    *{}) compadd {} ;;\n", key, joined(words));
    out += "    esac\n  else\n    compadd -S = --";
    std::vector<std::string> keys;
    for (const Param& p : params())
        if (p.scope != Scope::Object) keys.push_back(setting_key(SettingRef{&p, 0, ""}));
    out += " " + joined(keys) + "\n  fi\n}\n";
    out += "_shadow_inspector() {\n  local -a commands\n  local name=${words[2]}\n";
    for (const CommandRow& row : commands) {
        if (row.commands.empty()) continue;
        out += row.path.empty()
                   ? "  if ((CURRENT == 2)) && [[ ${words[2]} != -* ]]; then\n"
                   : fmt::format("  if ((CURRENT == 3)) && [[ $name == {} ]] && [[ ${{words[3]}} != -* ]]; then\n",
                                 row.path[0]);
        out += "    commands=(\n";
        for (const CommandRow& below : commands)
            if (below.path.size() == row.path.size() + 1 &&
                std::equal(row.path.begin(), row.path.end(), below.path.begin()))
                out += "      " + shell_quoted(below.path.back() + ":" + first_part(below.about)) + "\n";
        out += "    )\n    _describe command commands\n    return\n  fi\n";
    }
    for (const CommandRow& row : commands)
        if (row.path.size() == 1 && !row.commands.empty())
            out += fmt::format("  if ((CURRENT > 3)) && [[ $name == {} ]]; then name+=\" ${{words[3]}}\"; fi\n",
                               row.path[0]);
    out +=
        "  # The options of a command begin after its name.\n"
        "  local -i names=${#${=name}}\n"
        "  if ((CURRENT > 2)); then\n    shift $names words\n    ((CURRENT -= names))\n  else\n    name=\n  fi\n"
        "  case $name in\n";
    for (const CommandRow& row : commands) {
        out += fmt::format("  {})\n    _arguments", shell_quoted(command_name(row)));
        add_zsh_options(out, row);
        out += "\n    ;;\n";
    }
    out +=
        "  esac\n}\nif [[ $funcstack[1] == _shadow-inspector ]]; then\n  _shadow_inspector \"$@\"\nelse\n  compdef "
        "_shadow_inspector shadow-inspector\nfi\n";
    return out;
}

std::string fish_completions(const std::vector<CommandRow>& commands) {
    std::string out =
        "# Completions of shadow-inspector for fish, printed by `shadow-inspector completion fish`.\n"
        "function __shadow_inspector_calls\n"
        "    set -l words (commandline -opc)\n"
        "    set -e words[1]\n"
        "    for i in (seq (count $argv))\n"
        "        test \"$words[$i]\" = $argv[$i]; or return 1\n"
        "    end\n"
        "end\n"
        "function __shadow_inspector_at\n"
        "    test (count (commandline -opc)) -eq (math 1 + (count $argv)); and __shadow_inspector_calls $argv\n"
        "end\n"
        "complete -c shadow-inspector -f\n";
    std::vector<std::string> assignments;
    for (const auto& [key, choices] : setting_choices())
        for (const std::string& choice : choices) assignments.push_back(fmt::format("{}={}", key, choice));
    for (const CommandRow& row : commands) {
        const std::string name = command_name(row);
        if (!row.path.empty()) {
            std::vector<std::string> above(row.path.begin(), row.path.end() - 1);
            out += fmt::format("complete -c shadow-inspector -n '__shadow_inspector_at {}' -a {} -d {}\n",
                               joined(above), row.path.back(), fish_quoted(first_part(row.about)));
        }
        const std::string condition = row.path.empty() ? "__shadow_inspector_at" : "__shadow_inspector_calls " + name;
        for (const CommandOption& option : row.options) {
            std::string line = "complete -c shadow-inspector -n " + fish_quoted(condition);
            for (const std::string& each : option.names)
                line += each.starts_with("--") ? " -l " + each.substr(2) : " -s " + each.substr(1);
            if (!option.value.empty() && !option.names.empty()) line += " -r";
            if (option.offers_files()) line += " -F";
            if (!option.words.empty()) {
                std::vector<std::string> words = option.words;
                if (option.is_setting) {
                    for (std::string& word : words) word += '=';
                    words.insert(words.end(), assignments.begin(), assignments.end());
                }
                line += " -a " + fish_quoted(joined(words));
            }
            if (!option.names.empty()) line += " -d " + fish_quoted(first_part(option.help));
            out += line + "\n";
        }
    }
    return out;
}

}  // namespace si
