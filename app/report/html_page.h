// Parts of self-contained HTML pages: assets of the program, embedded files, and pages without scripts.
#pragma once

#include <string>
#include <string_view>

namespace si {

/// Returns a file of assets/report/. @throws Error when the program lacks it
std::string report_asset(const std::string& name);

/// Replaces the first `mark` of a text. @throws Error when the text lacks the mark
std::string replaced_mark(std::string text, std::string_view mark, std::string_view by);

/// Formats bytes as a data URI. @param type media type: "image/png"
std::string data_uri(std::string_view bytes, const char* type);

/// Makes a page without scripts (assets/report/still.html) whose Content-Security-Policy allows embedded pictures and
/// its own style sheet, named by hash.
/// @param title text of the title, escaped here @param body HTML of the page, in which all foreign text is escaped
std::string still_page(const std::string& title, const std::string& body);

}  // namespace si
