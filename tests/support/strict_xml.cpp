#include "tests/support/strict_xml.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

#include "tests/support/text.h"

namespace si::test {
namespace {

class XmlReader {
public:
    explicit XmlReader(std::string_view text) : text_(text) {}

    std::string fault() {
        for (const char32_t c : code_points(text_))
            if ((c < 0x20 && c != '\n' && c != '\t' && c != '\r') || c >= 0xfffd) return "a character that is none";
        skip_space();
        std::vector<std::string> open;
        do {
            if (!take("<")) return open.empty() ? "no element" : words(open.back());
            if (take("/")) {
                const std::string name = read_name();
                if (open.empty() || name != open.back() || !take(">")) return at("an end of " + name + " that is none");
                open.pop_back();
            } else {
                const std::string name = read_name();
                if (name.empty()) return at("no name");
                std::set<std::string> seen;
                for (skip_space(); !take("/>"); skip_space()) {
                    if (take(">")) {
                        open.push_back(name);
                        break;
                    }
                    const std::string key = read_name();
                    if (key.empty() || !seen.insert(key).second) return at("an attribute without a name of its own");
                    if (!take("=\"")) return at("an attribute without a value");
                    const std::size_t end = text_.find('"', place_);
                    if (end == std::string_view::npos) return at("an open quote");
                    if (const std::string bad = content(text_.substr(place_, end - place_)); !bad.empty()) return bad;
                    place_ = end + 1;
                }
            }
            if (!open.empty()) {
                const std::size_t end = std::min(text_.find('<', place_), text_.size());
                if (const std::string bad = content(text_.substr(place_, end - place_)); !bad.empty()) return bad;
                place_ = end;
            }
        } while (!open.empty());
        skip_space();
        return place_ == text_.size() ? "" : at("more than one element");
    }

private:
    std::string_view text_;
    std::size_t place_ = 0;

    std::string at(const std::string& what) const { return what + " at byte " + std::to_string(place_); }
    std::string words(const std::string& open) const { return at("no end of " + open); }
    bool take(std::string_view what) {
        if (text_.substr(place_, what.size()) != what) return false;
        place_ += what.size();
        return true;
    }
    void skip_space() {
        while (place_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[place_]))) ++place_;
    }
    std::string read_name() {
        std::string name;
        while (place_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[place_])) ||
                                         std::string_view("-_:.").find(text_[place_]) != std::string_view::npos))
            name += text_[place_++];
        return name;
    }
    std::string content(std::string_view words) const {
        if (words.find('<') != std::string_view::npos) return at("< in a value");
        if (words.find("]]>") != std::string_view::npos) return at("]]>");
        for (std::size_t i = words.find('&'); i != std::string_view::npos; i = words.find('&', i + 1)) {
            bool known = false;
            for (const std::string_view entity : {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"})
                known |= words.substr(i, entity.size()) == entity;
            if (!known) return at("an unknown entity");
        }
        return {};
    }
};

}  // namespace

std::string xml_fault(std::string_view text) {
    return XmlReader(text).fault();
}

}  // namespace si::test
