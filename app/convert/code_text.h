// Pieces of generated code: comments from foreign text, and numbers of an engine.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "renderer/profiles/engine_profile.h"
#include "renderer/settings/settings.h"

namespace si {

/// Makes a text from a file safe inside a one-line comment of generated code, in any language. Control characters and
/// line ends (U+2028 among them) become blanks or visible escapes, backslashes become bars, and blanks split comment
/// marks and trigraphs. Texts above 160 bytes are cut before marks are split.
std::string comment_text(std::string_view text);

/// Formats a number for generated code: the shortest text that gives the same single-precision number.
std::string code_number(double value);

/// Formats a number as a float literal of Rust, such as "0.0", for generated code.
std::string rust_float(double value);

/// Formats a number as a float literal of C and C++, such as "0.0f", for generated code.
std::string c_float(double value);

/// Input of a template that writes shadow settings as code of an engine: the engine's numbers and the settings from
/// which they were converted.
struct CodeInput {
    const EngineProfile& profile;
    const WrittenValues& values;
    const MapFacts& facts;
    const Settings& settings;

    /// Returns true when the conversion gives the engine's parameter a number. @param key EngineParameter::key
    bool has(std::string_view key) const { return values.find(key) != nullptr; }
    /// Returns the value of an engine's parameter as text for the code: the converted number, else the engine's
    /// default. @param key EngineParameter::key
    std::string text(std::string_view key) const;
    /// Returns the value of an engine's parameter (number()) as a float literal of C and C++.
    std::string c_text(std::string_view key) const { return c_float(number(key)); }
    /// Returns the value of an engine's parameter: the converted number, else the engine's default. For a parameter
    /// with named choices it is the index of the choice. @param key EngineParameter::key
    double number(std::string_view key) const;
    /// Returns one line of code with "{}" replaced by the value of an engine's parameter. Empty if the conversion has
    /// no number for this parameter. @param key EngineParameter::key
    std::string line(std::string_view line, std::string_view key) const;
    /// Returns the settings of the light that view.light selects.
    const LightSettings& light() const { return settings.lights[std::size_t(settings.view.light)]; }
};

}  // namespace si
