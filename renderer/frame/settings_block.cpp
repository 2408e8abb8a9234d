#include "renderer/frame/settings_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <span>

#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"
#include "shaders/shared/units.h"

namespace si {
namespace {

std::string identifier(std::string_view key) {
    std::string out(key);
    std::replace_if(
        out.begin(), out.end(), [](char c) { return c == '.' || c == '-'; }, '_');
    return out;
}

template <typename F>
void for_shader_params(F&& f) {
    for (const Param& p : params())
        if (p.shader && p.scope == Scope::Scene) f(p);
}

/// Returns the numeric settings of the block with their offsets, counted in numbers. Settings whose key begins with
/// another word begin at another texel, as shaders read settings of one group together.
template <typename F>
void for_block_params(F&& f) {
    std::size_t place = 0;
    std::string_view group;
    for_shader_params([&](const Param& p) {
        if (p.cost == Cost::Program || p.choices) return;
        const std::string_view key = p.key, word = key.substr(0, key.find('.'));
        if (word != group) place = (place + 3) / 4 * 4;
        group = word;
        f(p, place++);
    });
}

int as_int(const Value& v) {
    return int(numeric_value(v));
}

}  // namespace

std::vector<gl::Define> settings_defines(const Settings& s) {
    std::vector<gl::Define> out;
    for_shader_params([&](const Param& p) {
        if (p.cost == Cost::Program || p.choices)
            out.push_back({identifier(p.key), std::to_string(as_int(get_value(s, {&p, 0, {}})))});
    });
    return out;
}

std::string settings_block_text(bool as_image) {
    std::string choices, block, texels;
    for_shader_params([&](const Param& p) {
        if (!p.choices) return;
        const auto rows = p.choices();
        for (std::size_t i = 0; i < rows.size(); ++i)
            choices += fmt::format("#define {}_{} {}\n", identifier(p.key), identifier(rows[i].key), i);
    });
    for_block_params([&](const Param& p, std::size_t place) {
        const std::string name = identifier(p.key);
        Settings probe;
        const bool real = std::holds_alternative<double*>(p.field(probe, 0, nullptr));
        block += fmt::format("    layout(offset = {}) {} {};\n", 4 * place, real ? "float" : "int", name);
        texels += fmt::format("#define {} {}(settings_number({}))\n", name, real ? "uintBitsToFloat" : "int", place);
    });
    if (!as_image)
        return choices + fmt::format("layout(std140, binding = {}) uniform SettingsUniforms {{\n{}}};\n",
                                     shared::BLOCK_SETTINGS, block);
    return choices +
           fmt::format(
               "layout(rgba32ui, binding = {}) restrict readonly uniform uimageBuffer settings_texels;\n"
               "uint settings_number(int i) {{ return imageLoad(settings_texels, i >> 2)[i & 3]; }}\n",
               shared::IMAGE_SETTINGS_BLOCK) +
           texels;
}

std::vector<std::byte> settings_block_bytes(const Settings& s) {
    std::vector<std::byte> out;
    for_block_params([&](const Param& p, std::size_t place) {
        out.resize(4 * place);
        const Value v = get_value(s, {&p, 0, {}});
        const double* real = std::get_if<double>(&v);
        const std::int32_t bits = real ? std::bit_cast<std::int32_t>(float(*real)) : as_int(v);
        std::ranges::copy(std::as_bytes(std::span(&bits, 1)), std::back_inserter(out));
    });
    out.resize((out.size() + 15) / 16 * 16);
    return out;
}

void add_value(Key& key, const Settings& s, const SettingRef& ref) {
    std::visit([&](const auto& v) { key.add(v); }, get_value(s, ref));
}

void add_shader_settings(Key& key, const Settings& s) {
    for_shader_params([&](const Param& p) {
        if (unused_setting_reason(s, {&p, 0, {}}).empty()) add_value(key, s, {&p, 0, {}});
    });
}

}  // namespace si
