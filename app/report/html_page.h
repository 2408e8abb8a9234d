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

/// Makes a self-contained HTML page without scripts from assets/report/still.html. Its Content-Security-Policy allows
/// embedded pictures, and style elements only if it lists their hash.
/// @param title text of the title, escaped here @param body HTML of the page, in which all foreign text is escaped
/// @param body_styles whole texts of the style elements in `body`, whose hashes are listed
std::string still_page(const std::string& title, const std::string& body,
                       const std::vector<std::string>& body_styles = {});

}  // namespace si
