#include "renderer/base/json_shape.h"

#include <algorithm>

namespace si {

JsonShape json_shape(std::string_view text) {
    JsonShape shape;
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        switch (text[i]) {
            case '"':
                for (++i; i < text.size() && text[i] != '"'; ++i) {
                    if (text[i] == '\\') ++i;
                }
                break;
            case '{':
            case '[':
                shape.depth = std::max(shape.depth, ++depth);
                ++shape.values;
                break;
            case '}':
            case ']':
                --depth;
                break;
            case ',':
                ++shape.values;
                break;
            default:
                break;
        }
    }
    return shape;
}

}  // namespace si
