// Tests of the rules of docs/style.md that a search of the sources can check.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/source_tree.h"

namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

/// Returns the text after leading blanks.
std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    return first == text.npos ? std::string_view{} : text.substr(first);
}

/// Returns the first word of a text.
std::string_view first_word(std::string_view text) {
    text = trimmed(text);
    const auto end = std::ranges::find_if(text, [](char c) { return !std::isalpha(static_cast<unsigned char>(c)); });
    return text.substr(0, std::size_t(end - text.begin()));
}

/// Returns the doc comments of a header that begin with a question word instead of their subject: "LINE: WORD".
std::vector<std::string> comments_without_subject(const std::string& header) {
    constexpr std::array<std::string_view, 5> kQuestions = {"What", "Of", "Whether", "How", "Where"};
    std::vector<std::string> out;
    bool in_comment = false;
    std::size_t number = 0;
    for (const std::string& line : lines_of(header)) {
        ++number;
        const std::size_t start = line.find("///");
        const bool begins = start != line.npos && !in_comment;
        // A trailing comment ends with its line, a block goes on in the next.
        in_comment = trimmed(line).starts_with("///") && !trimmed(line).starts_with("///<");
        if (!begins) continue;
        std::string_view text = std::string_view(line).substr(start + 3);
        if (text.starts_with("<")) text.remove_prefix(1);
        const std::string_view word = first_word(text);
        if (std::ranges::find(kQuestions, word) != kQuestions.end())
            out.push_back(std::to_string(number) + ": " + std::string(word));
    }
    return out;
}

/// Returns a source with its comments and literals replaced by blanks. Lines stay lines.
std::string code_of(const std::string& source) {
    std::string out = source;
    const auto blank = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < std::min(to, out.size()); ++i)
            if (out[i] != '\n') out[i] = ' ';
    };
    for (std::size_t i = 0; i < source.size(); ++i) {
        std::size_t end = i;
        const auto after = [&](std::string_view mark, std::size_t from) {
            const std::size_t found = source.find(mark, from);
            return found == source.npos ? source.size() : found + mark.size();
        };
        if (source.compare(i, 2, "//") == 0) {
            end = after("\n", i) - 1;
        } else if (source.compare(i, 2, "/*") == 0) {
            end = after("*/", i + 2);
        } else if (source.compare(i, 2, "R\"") == 0) {
            const std::size_t open = source.find('(', i);
            if (open == source.npos) continue;
            end = after(")" + source.substr(i + 2, open - i - 2) + "\"", open);
        } else if (source[i] == '"' ||
                   (source[i] == '\'' && (i == 0 || !std::isalnum(static_cast<unsigned char>(source[i - 1]))))) {
            end = i + 1;
            while (end < source.size() && source[end] != source[i] && source[end] != '\n')
                end += source[end] == '\\' ? 2 : 1;
            ++end;
        }
        if (end == i) continue;
        blank(i, end);
        i = end - 1;
    }
    return out;
}

/// Returns the end of a bracketed group that starts at the first character of `text`; 0 if the group does not end.
std::size_t group_end(std::string_view text) {
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        depth += text[i] == '(' || text[i] == '[' || text[i] == '{';
        depth -= text[i] == ')' || text[i] == ']' || text[i] == '}';
        if (depth == 0) return i + 1;
    }
    return 0;
}

/// Returns a statement without `if (...)`, `for (...)`, `while (...)` and `else` in front.
std::string_view without_control(std::string_view statement) {
    for (;;) {
        statement = trimmed(statement);
        const std::string_view word = first_word(statement);
        if (word == "else") {
            statement.remove_prefix(word.size());
        } else if (word == "if" || word == "for" || word == "while") {
            const std::string_view rest = trimmed(statement.substr(word.size()));
            const std::size_t end = group_end(rest);
            if (!rest.starts_with("(") || end == 0) return {};
            statement = rest.substr(end);
        } else {
            return statement;
        }
    }
}

/// Returns whether a part of a statement, brackets removed, is an assignment to something declared before: "a.b += c".
/// A declaration has a type before the name, apart by a blank, `&` or `*`.
bool is_assignment(std::string_view part) {
    const std::size_t sign = part.find('=');
    if (sign == part.npos || sign == 0 || sign + 1 == part.size() || part[sign + 1] == '=') return false;
    if (std::string_view("=<>!").find(part[sign - 1]) != std::string_view::npos) return false;
    std::string_view target = trimmed(part.substr(0, sign));
    while (!target.empty() && std::string_view(" +-*/%&|^").find(target.back()) != std::string_view::npos)
        target.remove_suffix(1);
    if (target.empty() || target.front() == '.') return false;
    return target.find_first_of(" &") == target.npos && target.find('*', 1) == target.npos;
}

/// Returns the parts of a statement between commas outside brackets, with brackets and their content removed.
std::vector<std::string> parts_of(std::string_view statement) {
    std::vector<std::string> parts(1);
    int depth = 0;
    for (const char c : statement) {
        depth += c == '(' || c == '[' || c == '{';
        if (depth == 0 && c == ',') {
            parts.emplace_back();
        } else if (depth == 0) {
            parts.back() += c;
        }
        depth -= c == ')' || c == ']' || c == '}';
    }
    return parts;
}

/// Returns the numbers of lines that chain assignments by a comma: `a = 1, b = 2;` as a statement of one line.
std::vector<std::size_t> chained_assignments(const std::string& source) {
    std::vector<std::size_t> out;
    char before = ';';  // the last character of the code in front
    std::size_t number = 0;
    for (const std::string& line : lines_of(code_of(source))) {
        ++number;
        const std::size_t last = line.find_last_not_of(" \t\r");
        if (last == line.npos) continue;
        const bool begins = std::string_view(";{}:)").find(before) != std::string_view::npos;
        before = line[last];
        if (!begins || line[last] != ';') continue;
        const std::vector<std::string> parts = parts_of(without_control(line));
        if (parts.size() > 1 && is_assignment(parts[0]) && is_assignment(parts[1])) out.push_back(number);
    }
    return out;
}

TEST(Style, DocCommentsBeginWithTheirSubject) {
    std::size_t read = 0;
    for (const fs::path& path : si::test::source_files({"renderer", "ui", "app"}, {".h"})) {
        for (const std::string& found : comments_without_subject(si::file_bytes(path)))
            ADD_FAILURE() << path << ":" << found;
        ++read;
    }
    EXPECT_GT(read, 200u);
}

TEST(Style, DocCommentSearchFindsQuestionWords) {
    using Found = std::vector<std::string>;
    EXPECT_EQ(comments_without_subject("/// Where a caster is.\nint at();\n"), Found{"1: Where"});
    EXPECT_EQ(comments_without_subject("struct A {\n    int b;  ///< of a map\n    int c;  ///< Of a map\n};\n"),
              Found{"3: Of"});
    EXPECT_EQ(comments_without_subject("/// Returns the sum.\n/// How it is found: by adding.\nint sum();\n"), Found{});
    EXPECT_EQ(comments_without_subject("int a;  ///< a sum\n/// What is left.\nint rest();\n"), Found{"2: What"});
    EXPECT_EQ(comments_without_subject("/// Whatever is left.\n// How it is found.\nint rest();\n"), Found{});
}

TEST(Style, StatementsDoNotChainAssignments) {
    std::size_t read = 0;
    for (const fs::path& path : si::test::source_files({"renderer", "ui", "app", "tests"}, {".h", ".cpp"})) {
        for (const std::size_t line : chained_assignments(si::file_bytes(path))) ADD_FAILURE() << path << ":" << line;
        ++read;
    }
    EXPECT_GT(read, 500u);
}

TEST(Style, ChainSearchFindsChainedAssignments) {
    using Found = std::vector<std::size_t>;
    EXPECT_EQ(chained_assignments("a = 1, b = 2;\n"), Found{1});
    EXPECT_EQ(chained_assignments("x();\nif (f(a, b)) p->q[i + 1] += 1, r.s = {2, 3};\n"), Found{2});
    EXPECT_EQ(chained_assignments("for (a = 0, b = 1; a < b; ++a)\n    c = a, d = b;\n"), Found{2});
    EXPECT_EQ(chained_assignments("int a = 1, b = 2;\nconst A *p = &q,\n        *r = &s, *t = &u;\n"), Found{});
    EXPECT_EQ(chained_assignments("List<T>&a = f(), &b = g();\n"), Found{});
    EXPECT_EQ(chained_assignments("// a = 1, b = 2;\nf(\"a = 1, b = 2;\");\nconst char c = ',';\n"), Found{});
    EXPECT_EQ(chained_assignments("f({.a = 1, .b = 2});\na = f(1, b = 2);\na == 1, b == 2;\n"), Found{});
    EXPECT_EQ(chained_assignments("const char* t = R\"(\na = 1, b = 2;\n)\";\na = 1, b = 2;\n"), Found{4});
}

}  // namespace
