#include "app/report/html_page.h"

#include <fmt/format.h>

#include "app/report/xml_text.h"
#include "renderer/base/base64.h"
#include "renderer/base/embedded.h"
#include "renderer/base/error.h"
#include "renderer/base/sha256.h"

namespace si {

std::string report_asset(const std::string& name) {
    for (const EmbeddedFile& file : embedded_files())
        if (file.path == "assets/report/" + name) return std::string(file.text);
    throw Error(fmt::format("assets/report/{} is not in this program", name));
}

std::string replaced_mark(std::string text, std::string_view mark, std::string_view by) {
    const auto at = text.find(mark);
    if (at == std::string::npos) throw Error(fmt::format("a page of assets/report lacks {}", mark));
    return text.replace(at, mark.size(), by);
}

std::string data_uri(std::string_view bytes, const char* type) {
    return fmt::format("data:{};base64,{}", type, base64(bytes));
}

std::string still_page(const std::string& title, const std::string& body, const std::vector<std::string>& body_styles) {
    const auto hash_of = [](const std::string& style) {
        const auto hash = sha256(style);
        return base64({reinterpret_cast<const char*>(hash.data()), hash.size()});
    };
    const std::string style = report_asset("style.css") + report_asset("still.css");
    std::string hashes = hash_of(style);
    for (const std::string& more : body_styles) hashes += "' 'sha256-" + hash_of(more);
    std::string page = report_asset("still.html");
    // From the last mark to the first: text that is put in cannot hold the mark that is looked for next.
    page = replaced_mark(page, "@BODY@", body);
    page = replaced_mark(page, "@STYLE@", style);
    page = replaced_mark(page, "@TITLE@", xml_text(title));
    return replaced_mark(page, "@HASH@", hashes);
}

}  // namespace si
