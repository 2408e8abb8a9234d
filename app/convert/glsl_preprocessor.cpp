#include "app/convert/glsl_preprocessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>

#include "renderer/base/error.h"

namespace si {
namespace {

bool begins_name(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}

bool is_name_char(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

std::string_view glsl_trimmed(std::string_view s) {
    while (!s.empty() && std::isspace(static_cast<unsigned char>(s.front()))) s.remove_prefix(1);
    while (!s.empty() && std::isspace(static_cast<unsigned char>(s.back()))) s.remove_suffix(1);
    return s;
}

/// Macro of the preprocessor.
struct GlslMacro {
    bool takes_arguments = false;
    std::vector<std::string> parameters;
    std::string body;
};

using GlslMacros = std::map<std::string, GlslMacro, std::less<>>;

/// Returns the end of a line comment, number or name that starts at `at`; one character further for all else.
std::size_t token_end(std::string_view text, std::size_t at) {
    if (text.substr(at, 2) == "//") return std::min(text.find('\n', at), text.size());
    std::size_t end = at + 1;
    if (is_name_char(text[at])) {
        // A number takes its exponent along, whose sign is no operator.
        const bool number = std::isdigit(static_cast<unsigned char>(text[at]));
        while (end < text.size() && (is_name_char(text[end]) || (number && text[end] == '.') ||
                                     (number && (text[end] == '-' || text[end] == '+') &&
                                      (text[end - 1] == 'e' || text[end - 1] == 'E') && text.substr(at, 2) != "0x")))
            ++end;
    }
    return end;
}

/// Splits the arguments of a macro that begin after the bracket at `open`. @param[out] end place after the last bracket
std::vector<std::string> macro_arguments(std::string_view text, std::size_t open, std::size_t& end) {
    std::vector<std::string> out(1);
    int depth = 0;
    for (end = open; end < text.size(); ++end) {
        const char c = text[end];
        if ((c == '(' || c == '[') && depth++ == 0) continue;
        if ((c == ')' || c == ']') && --depth == 0) break;
        if (c == ',' && depth == 1)
            out.emplace_back();
        else
            out.back() += c;
    }
    end = std::min(end + 1, text.size());
    for (std::string& argument : out) argument = glsl_trimmed(argument);
    return out;
}

std::string expanded(std::string_view text, const GlslMacros& macros, const std::set<std::string>& hidden = {});

/// Returns a macro's body with its arguments put in.
std::string macro_text(const GlslMacro& macro, const std::vector<std::string>& arguments) {
    std::string out;
    for (std::size_t at = 0; at < macro.body.size();) {
        const std::size_t end = token_end(macro.body, at);
        const std::string token = macro.body.substr(at, end - at);
        const auto found = std::ranges::find(macro.parameters, token);
        const auto place = std::size_t(found - macro.parameters.begin());
        out += found == macro.parameters.end() || place >= arguments.size() ? token : arguments[place];
        at = end;
    }
    return out;
}

std::string expanded(std::string_view text, const GlslMacros& macros, const std::set<std::string>& hidden) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = token_end(text, at);
        const std::string token(text.substr(at, end - at));
        const auto macro = begins_name(token[0]) ? macros.find(token) : macros.end();
        at = end;
        if (macro == macros.end() || hidden.contains(token)) {
            out += token;
            continue;
        }
        std::vector<std::string> arguments;
        if (macro->second.takes_arguments) {
            std::size_t open = end;
            while (open < text.size() && std::isspace(static_cast<unsigned char>(text[open]))) ++open;
            if (open >= text.size() || text[open] != '(') {
                out += token;
                continue;
            }
            arguments = macro_arguments(text, open, at);
            for (std::string& argument : arguments) argument = expanded(argument, macros, hidden);
        }
        std::set<std::string> more = hidden;
        more.insert(token);
        out += expanded(macro_text(macro->second, arguments), macros, more);
    }
    return out;
}

/// Evaluator of the integer expressions of #if.
class GlslCondition {
public:
    explicit GlslCondition(std::string text) : text_(std::move(text)) {}
    long value() { return alternatives(0); }

private:
    std::string text_;
    std::size_t at_ = 0;

    bool take(std::string_view sign) {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
        if (text_.compare(at_, sign.size(), sign) != 0) return false;
        // "<" is not the beginning of "<=", and "!" not of "!=".
        const bool longer = sign.size() == 1 && at_ + 1 < text_.size() && text_[at_ + 1] == '=';
        if (longer && std::string_view("<>!=").find(sign[0]) != std::string_view::npos) return false;
        at_ += sign.size();
        return true;
    }
    /// Evaluates operators from a rank of binding strength on. @param rank 0 for ||, 5 for products
    long alternatives(int rank) {
        static const std::vector<std::vector<std::string_view>> kRanks{
            {"||"}, {"&&"}, {"==", "!="}, {"<=", ">=", "<", ">"}, {"+", "-"}, {"*", "/", "%"}};
        if (rank == int(kRanks.size())) return single();
        long left = alternatives(rank + 1);
        for (;;) {
            std::string_view sign;
            for (const std::string_view s : kRanks[std::size_t(rank)])
                if (sign.empty() && take(s)) sign = s;
            if (sign.empty()) return left;
            left = applied(sign, left, alternatives(rank + 1));
        }
    }
    static long applied(std::string_view sign, long a, long b) {
        if (sign == "||") return a || b;
        if (sign == "&&") return a && b;
        if (sign == "==") return a == b;
        if (sign == "!=") return a != b;
        if (sign == "<=") return a <= b;
        if (sign == ">=") return a >= b;
        if (sign == "<") return a < b;
        if (sign == ">") return a > b;
        if (sign == "+") return a + b;
        if (sign == "-") return a - b;
        if (sign == "*") return a * b;
        if (b == 0) return 0;
        return sign == "/" ? a / b : a % b;
    }
    long single() {
        if (take("!")) return !single();
        if (take("-")) return -single();
        if (take("(")) {
            const long inner = alternatives(0);
            take(")");
            return inner;
        }
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
        const std::size_t from = at_;
        while (at_ < text_.size() && is_name_char(text_[at_])) ++at_;
        const std::string word = text_.substr(from, at_ - from);
        if (word.empty()) throw Error(fmt::format("shaders: the condition '{}' cannot be read", text_));
        return std::isdigit(static_cast<unsigned char>(word[0])) ? std::stol(word, nullptr, 0) : 0;
    }
};

/// Returns a condition with `defined(NAME)` replaced by 1 or 0.
std::string with_defined(std::string_view text, const GlslMacros& macros) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = token_end(text, at);
        if (text.substr(at, end - at) != "defined") {
            out += text.substr(at, end - at);
            at = end;
            continue;
        }
        while (end < text.size() && !is_name_char(text[end])) ++end;
        const std::size_t from = end;
        while (end < text.size() && is_name_char(text[end])) ++end;
        out += macros.contains(text.substr(from, end - from)) ? " 1 " : " 0 ";
        while (end < text.size() && std::isspace(static_cast<unsigned char>(text[end]))) ++end;
        if (end < text.size() && text[end] == ')') ++end;
        at = end;
    }
    return out;
}

/// Adds the macro of a #define. @param rest text after the directive's name
void define_macro(GlslMacros& macros, std::string_view rest) {
    rest = glsl_trimmed(rest.substr(0, rest.find("//")));
    std::size_t end = 0;
    while (end < rest.size() && is_name_char(rest[end])) ++end;
    GlslMacro macro;
    const std::string name(rest.substr(0, end));
    if (end < rest.size() && rest[end] == '(') {
        macro.takes_arguments = true;
        macro.parameters = macro_arguments(rest, end, end);
    }
    macro.body = glsl_trimmed(rest.substr(end));
    macros.insert_or_assign(name, std::move(macro));
}

/// State of one #if and its branches.
struct GlslBranch {
    bool outer = true, active = true, taken = false;
};

}  // namespace

std::string preprocess_glsl(std::string_view text, std::span<const gl::Define> defines) {
    GlslMacros macros;
    for (const gl::Define& d : defines) macros[d.name] = {.body = d.value};
    std::vector<GlslBranch> branches;
    std::string out, pending;
    const auto active = [&] { return branches.empty() || branches.back().active; };
    const auto flush = [&] {
        out += expanded(pending, macros);
        pending.clear();
    };
    const auto holds = [&](std::string_view condition) {
        condition = condition.substr(0, condition.find("//"));
        return GlslCondition(expanded(with_defined(condition, macros), macros)).value() != 0;
    };
    while (!text.empty()) {
        std::string line;
        do {  // joins lines that end in a backslash
            if (!line.empty()) line.pop_back();
            const std::size_t end = text.find('\n');
            line += text.substr(0, end);
            text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
        } while (line.ends_with('\\') && !text.empty());
        std::string_view directive = glsl_trimmed(line);
        if (!directive.starts_with('#')) {
            if (active()) pending += line + "\n";
            continue;
        }
        flush();
        directive = glsl_trimmed(directive.substr(1));
        std::size_t end = 0;
        while (end < directive.size() && is_name_char(directive[end])) ++end;
        const std::string_view word = directive.substr(0, end), rest = glsl_trimmed(directive.substr(end));
        if (word == "if" || word == "ifdef" || word == "ifndef") {
            GlslBranch branch{.outer = active()};
            const std::string_view name = glsl_trimmed(rest.substr(0, rest.find("//")));
            branch.active = branch.outer && (word == "if" ? holds(rest) : macros.contains(name) == (word == "ifdef"));
            branch.taken = branch.active;
            branches.push_back(branch);
        } else if (word == "elif" || word == "else" || word == "endif") {
            if (branches.empty()) throw Error(fmt::format("shaders: #{} without #if", word));
            GlslBranch& branch = branches.back();
            if (word == "endif") {
                branches.pop_back();
                continue;
            }
            branch.active = branch.outer && !branch.taken && (word == "else" || holds(rest));
            branch.taken |= branch.active;
        } else if (active() && word == "define") {
            define_macro(macros, rest);
        } else if (active() && word == "undef") {
            macros.erase(std::string(rest));
        }
    }
    flush();
    if (!branches.empty()) throw Error("shaders: an #if is not closed");
    return out;
}

namespace {

/// Returns the text with its line comments replaced by blanks.
std::string without_comments(std::string_view text) {
    std::string out(text);
    for (std::size_t at = 0; at < out.size();) {
        const std::size_t end = token_end(out, at);
        if (out.compare(at, 2, "//") == 0)
            std::fill(out.begin() + std::ptrdiff_t(at), out.begin() + std::ptrdiff_t(end), ' ');
        at = end;
    }
    return out;
}

std::set<std::string> names_of_code(std::string_view code) {
    std::set<std::string> out;
    for (std::size_t at = 0; at < code.size();) {
        const std::size_t end = token_end(code, at);
        if (begins_name(code[at])) out.insert(std::string(code.substr(at, end - at)));
        at = end;
    }
    return out;
}

/// Declaration at the top of a GLSL text, with the comment before it.
struct GlslDeclaration {
    std::string text;
    std::set<std::string> names, uses;
};

/// Returns the names that a declaration without comments introduces.
std::set<std::string> declared_names(std::string_view code) {
    std::string_view rest = glsl_trimmed(code);
    if (rest.starts_with("layout")) {
        std::size_t end = 0;
        macro_arguments(rest, rest.find('('), end);
        rest = glsl_trimmed(rest.substr(end));
    }
    if (rest.starts_with("struct")) {
        rest = glsl_trimmed(rest.substr(6));
        std::size_t end = 0;
        while (end < rest.size() && is_name_char(rest[end])) ++end;
        return {std::string(rest.substr(0, end))};
    }
    std::set<std::string> out;
    std::string last;
    int depth = 0;
    bool value = false;
    for (std::size_t at = 0; at < rest.size();) {
        const std::size_t end = token_end(rest, at);
        const std::string token(rest.substr(at, end - at));
        at = end;
        if (token == "(" && depth == 0 && !value) return {last};  // a function
        const bool opens = token == "(" || token == "[" || token == "{";
        const bool ends_name = depth == 0 && (token == "=" || token == "," || token == ";" || token == "[");
        if (ends_name && !value && !last.empty()) out.insert(last);
        if (ends_name) {
            value = token == "=" || (value && token != "," && token != ";") || (token == "[" && value);
            last.clear();
        }
        depth += opens;
        depth -= token == ")" || token == "]" || token == "}";
        if (depth == 0 && begins_name(token[0])) last = token;
    }
    return out;
}

std::vector<GlslDeclaration> declarations_of(std::string_view text) {
    std::vector<GlslDeclaration> out;
    std::string part, code;
    int braces = 0, brackets = 0;
    char before = ' ';  // last character of code
    bool function = false;
    std::size_t at = 0;
    const auto close = [&] {
        // A comment behind a declaration belongs to it.
        const std::size_t line_end = std::min(text.find('\n', at), text.size());
        if (glsl_trimmed(text.substr(at, line_end - at)).starts_with("//")) {
            part += text.substr(at, line_end - at);
            at = line_end;
        }
        const std::string plain = without_comments(part);
        out.push_back({part, declared_names(plain), names_of_code(plain)});
        part.clear();
        before = ' ';
        function = false;
    };
    while (at < text.size()) {
        const std::size_t end = token_end(text, at);
        const std::string_view token = text.substr(at, end - at);
        at = end;
        part += token;
        if (token.starts_with("//") || std::isspace(static_cast<unsigned char>(token[0]))) continue;
        const char c = token[0];
        if (c == '{' && braces++ == 0 && before == ')') function = true;
        brackets += c == '(';
        brackets -= c == ')';
        if (c == '}' && --braces == 0 && function)
            close();
        else if (c == ';' && braces == 0 && brackets == 0)
            close();
        if (!part.empty()) before = token.back();
    }
    return out;
}

}  // namespace

bool names_in_code(std::string_view text, std::string_view name) {
    return names_of_code(without_comments(text)).contains(std::string(name));
}

std::string used_glsl(std::string_view text, std::span<const std::string> roots) {
    const std::vector<GlslDeclaration> all = declarations_of(text);
    std::set<std::string> wanted(roots.begin(), roots.end());
    std::vector<bool> used(all.size());
    for (bool grown = true; grown;) {
        grown = false;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (used[i] || std::ranges::none_of(all[i].names, [&](const auto& n) { return wanted.contains(n); }))
                continue;
            used[i] = grown = true;
            wanted.insert(all[i].uses.begin(), all[i].uses.end());
        }
    }
    std::string out;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!used[i]) continue;
        // The comment at the head of a file stands before its first declaration, apart by an empty line.
        std::string_view shown = glsl_trimmed(all[i].text);
        for (std::size_t gap; (gap = shown.find("\n\n")) != shown.npos && shown.starts_with("//");) {
            const std::string_view head = shown.substr(0, gap);
            if (!glsl_trimmed(without_comments(head)).empty()) break;
            shown = glsl_trimmed(shown.substr(gap));
        }
        out += std::string(shown) + "\n\n";
    }
    // Lines of directives leave runs of empty lines.
    for (std::size_t at; (at = out.find("\n\n\n")) != out.npos;) out.erase(at, 1);
    return out;
}

}  // namespace si
