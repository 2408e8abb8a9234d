#include "renderer/inspect/effect.h"

#include <cctype>

namespace si {

std::string_view effect_state_key(EffectState state) {
    return state == EffectState::Drawn ? "simulated" : state == EffectState::Cached ? "reused" : "not called for";
}

std::string_view effect_state_label(EffectState state) {
    return state == EffectState::Drawn ? "drawn" : state == EffectState::Cached ? "cached" : "not needed";
}

std::string as_sentence(std::string_view text) {
    if (text.empty()) return {};
    std::string out(text);
    const std::string_view first = text.substr(0, text.find_first_of(" :,;"));
    if (first.find('.') == std::string_view::npos) out[0] = char(std::toupper(static_cast<unsigned char>(out[0])));
    if (out.back() != '.' && out.back() != '!' && out.back() != '?') out += '.';
    return out;
}

}  // namespace si
