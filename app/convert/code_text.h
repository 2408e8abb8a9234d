// Pieces of generated code: comments from foreign text, and numbers of an engine.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "renderer/profiles/engine_profile.h"
#include "renderer/settings/settings.h"

namespace si {

/// Makes a text from a file safe inside a one-line comment of any language: no control characters, line ends (U+2028
/// among them), comment marks, trigraphs or backslashes, and at most 160 bytes.
std::string comment_text(std::string_view text);

/// Formats a number as the shortest text that gives the same single-precision number.
std::string code_number(double value);

/// Formats a number as a float literal of C and C++, such as "0.0f".
std::string c_float(double value);

/// Input of a code template: an engine's numbers, and the settings that they come from.
struct CodeInput {
    const EngineProfile& profile;
    const WrittenValues& values;
    const MapFacts& facts;
    const Settings& settings;

    /// Returns true when the conversion gives the parameter a number.
    bool has(std::string_view key) const { return values.find(key) != nullptr; }
    /// Returns the value of a parameter as text: the written one, else the engine's default.
    std::string text(std::string_view key) const;
    /// Returns the value of a parameter as a float literal of C and C++.
    std::string c_text(std::string_view key) const { return c_float(number(key)); }
    /// Returns the value of a parameter: the written one, else the engine's default.
    double number(std::string_view key) const;
    /// Returns `line` with "{}" replaced by the parameter's value, and a line end; empty if no number is written.
    std::string line(std::string_view line, std::string_view key) const;
    /// Returns the settings of light view.light.
    const LightSettings& light() const { return settings.lights[std::size_t(settings.view.light)]; }
};

}  // namespace si
