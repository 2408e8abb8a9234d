// Parts of self-contained HTML pages: assets of the program, embedded files, and pages without scripts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace si {

/// Returns a file of assets/report/. @throws Error when the program lacks it
std::string report_asset(const std::string& name);

/// Replaces the first `mark` of a text. @throws Error when the text lacks the mark
std::string replaced_mark(std::string text, std::string_view mark, std::string_view by);

/// Formats bytes as a data URI. @param type media type: "image/png"
std::string data_uri(std::string_view bytes, const char* type);

/// Makes a page without scripts (assets/report/still.html) whose Content-Security-Policy allows embedded pictures and
/// style sheets named by hash: its own, and those of style elements in the body.
/// @param title text of the title, escaped here @param body HTML of the page, in which all foreign text is escaped
/// @param body_styles whole texts of the body's style elements
std::string still_page(const std::string& title, const std::string& body,
                       const std::vector<std::string>& body_styles = {});

}  // namespace si
