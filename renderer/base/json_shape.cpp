#include "renderer/base/json_shape.h"

#include <algorithm>

namespace si {

JsonShape json_shape(std::string_view text) {
    JsonShape shape;
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') {
            for (++i; i < text.size() && text[i] != '"'; ++i)
                if (text[i] == '\\') ++i;
        }
        if (c == '{' || c == '[') shape.depth = std::max(shape.depth, ++depth);
        if (c == '}' || c == ']') --depth;
        shape.values += c == '{' || c == '[' || c == ',';
    }
    return shape;
}

}  // namespace si
