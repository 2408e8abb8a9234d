// Parts of self-contained HTML pages: assets of the program, embedded files, and pages without scripts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace si {

/// Returns the text of a file of assets/report/, which is embedded in the program: templates, styles and scripts of
/// pages. @throws Error when the program lacks the file
std::string report_asset(const std::string& name);

/// Replaces the first occurrence of `mark` in a text, used to fill page templates. @param by the replacement
/// @throws Error when the text lacks the mark
std::string replaced_mark(std::string text, std::string_view mark, std::string_view by);

/// Encodes the bytes of a file as a data URI, which embeds the file in an HTML page. @param type media type, such as
/// "image/png"
std::string data_uri(std::string_view bytes, const char* type);

/// Makes a page without scripts (assets/report/still.html) whose Content-Security-Policy allows embedded pictures and
/// style sheets named by hash: its own, and those of style elements in the body.
/// @param title text of the title, escaped here @param body HTML of the page, in which all foreign text is escaped
/// @param body_styles whole texts of the body's style elements
std::string still_page(const std::string& title, const std::string& body,
                       const std::vector<std::string>& body_styles = {});

}  // namespace si
