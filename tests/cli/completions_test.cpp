// Tests of what the program prints for shells and for man: completions are compared with the texts of --help, which the
// parser prints by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/missing_reason.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Names = std::set<std::string>;

std::string program_output(const Words& words) {
    const ProcessResult r = run_program(words);
    EXPECT_EQ(r.code, 0) << r.err;
    return r.out;
}

/// Returns what --help prints for a command; each text is printed once a process.
const std::string& help_of(const std::string& command) {
    static std::map<std::string, std::string> texts;
    const auto [at, fresh] = texts.try_emplace(command);
    if (fresh) at->second = program_output(Words(command) + Words{"--help"});
    return at->second;
}

/// Returns the options that a help text lists: lines that begin with "  -o,--output" or "  --size".
Names help_options(const std::string& help) {
    static const std::regex line("^  (-[^ ]+)"), name("--?[A-Za-z][A-Za-z-]*");
    Names out;
    std::istringstream lines(help);
    for (std::string text; std::getline(lines, text);) {
        std::smatch found;
        if (!std::regex_search(text, found, line)) continue;
        const std::string names = found[1];
        for (std::sregex_iterator at(names.begin(), names.end(), name), end; at != end; ++at) out.insert(at->str());
    }
    return out;
}

/// Returns the commands that a help text lists below "Subcommands:".
std::vector<std::string> help_commands(const std::string& help) {
    static const std::regex line("^  ([a-z][a-z-]*)( |$)");
    std::vector<std::string> out;
    std::istringstream lines(help.substr(std::min(help.find("Subcommands:"), help.size())));
    for (std::string text; std::getline(lines, text);) {
        std::smatch found;
        if (std::regex_search(text, found, line)) out.push_back(found[1]);
    }
    return out;
}

/// Returns the command lines of all commands: "render", "preset check".
std::vector<std::string> all_commands() {
    std::vector<std::string> out;
    for (const std::string& command : help_commands(help_of(""))) {
        out.push_back(command);
        for (const std::string& below : help_commands(help_of(command))) out.push_back(command + " " + below);
    }
    return out;
}

Names words_of(const std::string& text) {
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

/// Writes a script that prints the completions of each command line of standard input in one line of words.
std::string bash_script() {
    return "eval \"$(\"$SI\" completion bash)\"\n"
           "while IFS= read -r line; do\n"
           "  COMP_WORDS=(${line//=/ = }) COMPREPLY=()\n"
           "  if [[ $line == *' ' || $line == *= ]]; then COMP_WORDS+=(''); fi\n"
           "  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
           "  _shadow_inspector\n"
           "  echo \"${COMPREPLY[*]}\"\n"
           "done\n";
}

/// Returns the words that bash offers at the end of command lines.
std::vector<Names> bash_offers(const std::vector<std::string>& lines) {
    const auto folder = fresh_test_folder();
    {
        std::ofstream script(folder / "offers.bash");
        script << bash_script();
        std::ofstream input(folder / "lines");
        for (const std::string& line : lines) input << "shadow-inspector " << line << "\n";
    }
    const ProcessResult r = run_shell("SI=$SI bash offers.bash <lines", folder);
    EXPECT_EQ(r.err, "");
    std::vector<Names> out;
    std::istringstream answers(r.out);
    for (std::string answer; std::getline(answers, answer);) out.push_back(words_of(answer));
    EXPECT_EQ(out.size(), lines.size());
    out.resize(lines.size());
    return out;
}

TEST(Completions, OfBashAreTheOptionsOfHelp) {
    const std::vector<std::string> commands = all_commands();
    EXPECT_GT(commands.size(), 25u);
    std::vector<std::string> lines;
    for (const std::string& command : commands) lines.push_back(command + " -");
    const std::vector<Names> offers = bash_offers(lines);
    for (std::size_t i = 0; i < commands.size(); ++i)
        EXPECT_EQ(offers[i], help_options(help_of(commands[i]))) << commands[i];
}

TEST(Completions, OfBashAreCommandsAndValues) {
    const std::vector<Names> offers =
        bash_offers({"", "preset ", "rend", "completion ", "edit --theme ", "import-map a.pfm --up ", "list ",
                     "render stage --set bias.ki", "render stage --set bias.kind=", "render stage --set bias.kind=con",
                     "render sta", "measure stage --preset peter"});
    const auto commands = help_commands(help_of(""));
    EXPECT_EQ(offers[0], Names(commands.begin(), commands.end()));
    EXPECT_EQ(offers[1], (Names{"check", "show", "save", "diff"}));
    EXPECT_EQ(offers[2], Names{"render"});
    EXPECT_EQ(offers[3], (Names{"bash", "zsh", "fish"}));
    EXPECT_EQ(offers[4], (Names{"dark", "light"}));
    EXPECT_EQ(offers[5], (Names{"y", "z", "x", "-y", "-z", "-x"}));
    EXPECT_TRUE(offers[6].contains("settings") && offers[6].contains("hard-cases"));
    EXPECT_EQ(offers[7], Names{"bias.kind="});
    EXPECT_TRUE(offers[8].contains("constant") && offers[8].contains("slope"));
    EXPECT_EQ(offers[9], Names{"constant"});
    EXPECT_TRUE(offers[10].contains("stage"));
    EXPECT_TRUE(offers[11].contains("peter-panning"));
}

SI_TEST_IS(Later, Completions, OfFishAreTheOptionsOfHelp);
TEST(Completions, OfFishAreTheOptionsOfHelp) {
    if (run_shell("command -v fish").code != 0) GTEST_SKIP() << test::kMissingReason << "fish";
    const auto folder = fresh_test_folder();
    const std::vector<std::string> commands = all_commands();
    std::ofstream script(folder / "offers.fish");
    script << "$SI completion fish | source\n";
    for (const std::string& command : commands)
        script << "echo '= " << command << "'\n"
               << "complete -C 'shadow-inspector " << command << " -'\n";
    script.close();
    const ProcessResult r = run_shell("HOME=$PWD XDG_CONFIG_HOME=$PWD XDG_DATA_HOME=$PWD fish offers.fish", folder);
    std::map<std::string, Names> offers;
    std::string command;
    std::istringstream lines(r.out);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("= "))
            command = line.substr(2);
        else
            offers[command].insert(line.substr(0, line.find('\t')));
    }
    for (const std::string& each : commands) EXPECT_EQ(offers[each], help_options(help_of(each))) << each << r.err;
}

TEST(Completions, OfZshNameAllOptionsOfHelp) {
    const std::string text = program_output({"completion", "zsh"});
    for (const std::string& command : all_commands()) {
        const std::size_t begin = text.find("  '" + command + "')\n");
        ASSERT_NE(begin, std::string::npos) << command;
        const std::string branch = text.substr(begin, text.find(";;", begin) - begin);
        static const std::regex option("'\\*(--?[A-Za-z][A-Za-z-]*)\\[");
        Names names;
        for (std::sregex_iterator at(branch.begin(), branch.end(), option), end; at != end; ++at)
            names.insert((*at)[1]);
        EXPECT_EQ(names, help_options(help_of(command))) << command;
    }
    if (run_shell("command -v zsh").code != 0) GTEST_SKIP() << test::kMissingReason << "zsh";
    const ProcessResult r =
        run_shell("$SI completion zsh >_shadow-inspector && zsh -n _shadow-inspector", fresh_test_folder());
    EXPECT_EQ(r.code, 0) << r.err;
}

TEST(ManPage, HasAllOptionsOfHelp) {
    const std::string page = std::regex_replace(program_output({"man-page"}), std::regex("\\\\-"), "-");
    for (const std::string& command : all_commands()) {
        const std::size_t begin = page.find("\n.SS " + command + "\n");
        ASSERT_NE(begin, std::string::npos) << command;
        const std::string section = page.substr(begin, page.find("\n.S", begin + 1) - begin);
        for (const std::string& option : help_options(help_of(command)))
            EXPECT_NE(section.find("\\fB" + option + "\\fR"), std::string::npos) << command << " " << option;
    }
    if (run_shell("command -v man").code != 0) GTEST_SKIP() << test::kMissingReason << "man";
    const ProcessResult r = run_shell("$SI man-page >page.1 && man --warnings -l page.1", fresh_test_folder());
    EXPECT_EQ(r.err, "");
    EXPECT_NE(r.out.find("import-capture"), std::string::npos);
}

TEST(Version, NamesProgramAndSettings) {
    const std::string text = program_output({"--version"});
    EXPECT_TRUE(std::regex_search(text, std::regex("^shadow-inspector [0-9]+\\.[0-9]+\\.[0-9]+\n"))) << text;
    for (const char* line :
         {"\nsettings       version ", "\nerrors         meaning ", "\nmodels         glTF", "\ncompiler "})
        EXPECT_NE(text.find(line), std::string::npos) << text;
    const std::string changes = file_bytes(std::filesystem::path(SI_SOURCE_DIR) / "CHANGELOG.md");
    const std::string version = text.substr(text.find(' ') + 1, text.find('\n') - text.find(' ') - 1);
    EXPECT_NE(changes.find("\n## " + version + ", "), std::string::npos) << "CHANGELOG.md lacks " << version;
}

}  // namespace
}  // namespace si
