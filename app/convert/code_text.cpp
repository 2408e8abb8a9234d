#include "app/convert/code_text.h"

#include <fmt/format.h>

#include "renderer/base/printable.h"

namespace si {

std::string comment_text(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        // Line and paragraph separators and the next-line character end a line in some languages.
        const std::string_view rest = text.substr(i);
        const bool separator = rest.starts_with("\xe2\x80\xa8") || rest.starts_with("\xe2\x80\xa9");
        const bool next_line = rest.starts_with("\xc2\x85");
        const auto c = static_cast<unsigned char>(text[i]);
        if (separator || next_line) {
            plain += ' ';
            i += separator ? 2 : 1;
        } else {
            plain += c < 0x20 || c == 0x7f ? ' ' : text[i];
        }
    }
    std::string out;
    for (const char c : printable(plain, 160)) {
        const char shown = c == '\\' ? '|' : c;
        const char before = out.empty() ? ' ' : out.back();
        const bool mark = (before == '/' && (shown == '/' || shown == '*')) || (before == '*' && shown == '/') ||
                          (before == '?' && shown == '?') || (before == '-' && shown == '-');
        if (mark) out += ' ';
        out += shown;
    }
    return out;
}

std::string code_number(double value) {
    if (value == 0) return "0";
    return fmt::format("{}", float(value));
}

std::string rust_float(double value) {
    std::string out = code_number(value);
    if (out.find_first_of(".e") == out.npos) out += ".0";
    return out;
}

std::string c_float(double value) {
    return rust_float(value) + "f";
}

double CodeInput::number(std::string_view key) const {
    const ConvertedParameter* written = values.find(key);
    return written ? written->value : engine_parameter(profile, key).standard;
}

std::string CodeInput::text(std::string_view key) const {
    const EngineParameter& parameter = engine_parameter(profile, key);
    return parameter.choices.empty() ? code_number(number(key)) : engine_value_text(parameter, number(key));
}

std::string CodeInput::line(std::string_view line, std::string_view key) const {
    if (!has(key)) return {};
    std::string out(line);
    if (const std::size_t at = out.find("{}"); at != out.npos) out.replace(at, 2, text(key));
    return out + "\n";
}

}  // namespace si
