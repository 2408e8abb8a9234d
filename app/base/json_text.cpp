#include "app/base/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "renderer/base/error.h"
#include "renderer/base/json_shape.h"
#include "renderer/base/printable.h"

namespace si {
namespace {

constexpr std::size_t kQuotedBytes = 60;

std::string line_and_column(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const auto start = before.rfind('\n');
    const auto column = before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1;
    return fmt::format("line {}, column {}", line, column);
}

/// Returns the JSON library's message without its prefix and its own place, which counts columns differently.
std::string plain_message(std::string message) {
    if (const auto at = message.find("] "); at != std::string::npos) message.erase(0, at + 2);
    if (const auto at = message.find(": "); message.starts_with("parse error at") && at != std::string::npos)
        message.erase(0, at + 2);
    return printable(message, 300);
}

/// Builder of a JSON tree from the library's parse events. The library's own builders search all earlier members for
/// each new one, which takes quadratic time.
class TreeBuilder {
public:
    Json tree;
    std::string duplicate;  ///< first member that occurs twice
    std::size_t problem_byte = 0;
    std::string problem;  ///< the library's message; empty: none

    bool null() { return put(nullptr); }
    bool boolean(bool v) { return put(v); }
    bool number_integer(Json::number_integer_t v) { return put(v); }
    bool number_unsigned(Json::number_unsigned_t v) { return put(v); }
    bool number_float(Json::number_float_t v, const std::string&) { return put(v); }
    bool string(std::string& v) { return put(std::move(v)); }
    bool binary(Json::binary_t&) { return false; }  // JSON text holds no binary values
    bool start_object(std::size_t) { return open(Json::object()); }
    bool start_array(std::size_t) { return open(Json::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string& name) {
        Level& level = open_.back();
        if (!level.keys.insert(name).second && duplicate.empty()) duplicate = name;
        auto& members = level.node->get_ref<Json::object_t&>();
        static_cast<Json::object_t::Container&>(members).emplace_back(std::move(name), nullptr);
        return true;
    }
    bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception& e) {
        problem_byte = byte;
        problem = e.what();
        return false;
    }

private:
    struct Level {
        Json* node;  ///< stable pointer: only the innermost open node grows
        std::unordered_set<std::string> keys;
    };
    Json* place(Json value) {
        if (open_.empty()) return &(tree = std::move(value));
        Json& parent = *open_.back().node;
        if (parent.is_array()) return &parent.get_ref<Json::array_t&>().emplace_back(std::move(value));
        return &(parent.get_ref<Json::object_t&>().back().second = std::move(value));
    }
    bool put(Json value) {
        place(std::move(value));
        return true;
    }
    bool open(Json value) {
        open_.push_back({place(std::move(value)), {}});
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    std::vector<Level> open_;
};

}  // namespace

Json parse_json_text(std::string_view text, const std::string& name) {
    const auto refuse = [&](const std::string& why) { throw Error(fmt::format("{}: {}", name, why)); };
    if (const auto nul = text.find('\0'); nul != std::string_view::npos)  // the library would end there
        refuse(fmt::format("{}: not JSON: a NUL character", line_and_column(text, nul + 1)));
    if (const int depth = json_shape(text).depth; depth > kMaxJsonDepth)
        refuse(fmt::format("it nests {} levels deep, at most {} are read", depth, kMaxJsonDepth));
    TreeBuilder builder;
    if (!Json::sax_parse(text, &builder)) {
        const std::string message = plain_message(builder.problem);
        if (!builder.problem.starts_with("[json.exception.out_of_range"))
            refuse(fmt::format("{}: not JSON: {}", line_and_column(text, builder.problem_byte), message));
        // A number out of range: the message quotes it, and its end is the place.
        const auto quote = message.find('\'');
        const std::string number =
            quote == std::string::npos ? "" : message.substr(quote + 1, message.size() - quote - 2);
        refuse(fmt::format("{}: {} is beyond the range of numbers", line_and_column(text, text.find(number) + 1),
                           number.empty() ? "a number" : number));
    }
    if (!builder.duplicate.empty())
        refuse(fmt::format("\"{}\" occurs twice; keep one", printable(builder.duplicate, kQuotedBytes)));
    return std::move(builder.tree);
}

std::string quoted(const Json& value) {
    return printable(value.dump(-1, ' ', false, Json::error_handler_t::replace), kQuotedBytes);
}

}  // namespace si
