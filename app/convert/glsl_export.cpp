#include "app/convert/glsl_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "app/convert/glsl_preprocessor.h"
#include "renderer/base/error.h"
#include "renderer/base/index_of.h"
#include "renderer/base/poisson_disk.h"
#include "renderer/frame/settings_block.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/map_storage.h"
#include "renderer/settings/paging.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

std::string name_of_key(std::string_view key) {
    std::string out(key);
    std::ranges::replace_if(
        out, [](char c) { return c == '.' || c == '-'; }, '_');
    return out;
}

/// Calls `work` with each setting that shaders read.
template <typename Work>
void for_each_shader_setting(Work&& work) {
    for (const Param& p : params())
        if (p.shader && p.scope == Scope::Scene) work(p);
}

/// Formats a number as a float literal of GLSL and C++ that gives the same single-precision number.
std::string float_literal(double value) {
    std::string out = fmt::format("{:.9g}", double(float(value)));
    if (out.find_first_of(".e") == out.npos) out += ".0";
    return out;
}

/// Returns the settings as the renderer uses them: valid, and with exponents that the moments' format can hold.
Settings settings_for_export(Settings s, std::vector<std::string>& notes) {
    for (std::string& repair : sanitise(s)) notes.push_back(std::move(repair));
    const double most = safe_exponent(s);
    if (s.filter.exponent > most) s.filter.exponent = most;
    if (s.filter.negative_exponent > most) s.filter.negative_exponent = most;
    if (s.map.transform == MapTransform::Eye) {
        notes.push_back(
            "map.transform eye: the code computes map coordinates from world space; they differ by rounding");
        s.map.transform = MapTransform::World;
    }
    return s;
}

std::string disk_list(std::span<const glm::vec2> places) {
    std::string out;
    for (const glm::vec2& p : places) out += fmt::format("{}vec2({:.9g}, {:.9g})", out.empty() ? "" : ", ", p.x, p.y);
    return "vec2[](" + out + ")";
}

/// Returns the macros under which the shader files become the code of one look-up.
std::vector<gl::Define> lookup_defines(const Settings& s, const LookupFacts& facts) {
    std::vector<gl::Define> out;
    const auto add = [&](std::string name, auto value) { out.push_back({std::move(name), fmt::format("{}", value)}); };
    for_each_shader_setting([&](const Param& p) {
        const Value value = get_value(s, {&p, 0, {}});
        const std::string name = name_of_key(p.key);
        if (p.choices) {
            const auto rows = p.choices();
            for (std::size_t i = 0; i < rows.size(); ++i) add(name + "_" + name_of_key(rows[i].key), i);
        }
        if (p.choices || p.cost == Cost::Program) add(name, int(numeric_value(value)));
    });
    const Filter& filter = filter_of(s);
    const Bias& bias = bias_of(s);
    add("map_resolution", facts.size.longest());
    if (facts.size.is_square()) {
        add("MAP_SIDES", fmt::format("ivec2({})", facts.size.width));
        add("MAP_SIZE", fmt::format("vec2({}.0)", facts.size.width));
        add("MAP_SHAPE", "vec2(1.0)");
    } else {
        add("MAP_SIDES", fmt::format("ivec2({}, {})", facts.size.width, facts.size.height));
        add("MAP_SIZE", fmt::format("vec2({}.0, {}.0)", facts.size.width, facts.size.height));
        add("MAP_SHAPE",
            fmt::format("(vec2({0}.0, {1}.0) / {2}.0)", facts.size.width, facts.size.height, facts.size.longest()));
    }
    add("KERNEL_SIZE", taps_across(filter, s));
    add("SUBPIXEL_BITS", facts.subpixel_bits);
    add("FILTER_SAMPLER", int(uses_sampler(s)));
    add("SAMPLER_BILINEAR", int(is_bilinear(filter, s)));
    add("MOMENTS_SUMMED", int(filter.moments.summed));
    add("MOMENTS_QUANTISED", int(filter.moments.quantised && s.filter.moment_format == MomentFormat::Bits16));
    add("MAP_LAYERS", facts.views);
    add("MAP_IS_COLOUR", int(is_colour(s.map.format)));
    add("MAP_HOLDS_DISTANCES", int(holds_distances(s.map.format)));
    add("VIEWS_BLEND", int(facts.blends));
    add("BIAS_PER_TEXEL", int(compares_per_texel(s)));
    add("BIAS_HAS_REMAINDER", int(compares_per_texel(s) && bias.remainder));
    add("BIAS_READS_PLANE", int(bias.gives_needed_bias));
    add("BIAS_BY_DERIVATIVES", int(bias.by_derivatives));
    add("BIAS_NORMAL_OFFSET", int(s.bias.normal != 0));
    add("BIAS_SLOPED", int(s.bias.slope != 0));
    add("SKIPS_SEARCH", 1);
    add("SKIPS_UNLIT", 1);
    for (const char* off : {"MAP_PAGED", "COMPARE_BY_HAND", "SEAM_TRIALS", "MAP_BOUNDS", "KEEPS_LOOPS",
                            "DISK_FROM_IMAGE", "BLOCKS_AS_IMAGES"})
        add(off, 0);
    add("DISK_CONSTANTS", kDiskTable);
    const std::pair<const char*, std::vector<glm::vec2>> lists[] = {
        {"TAP", disk_points(filter, s, s.filter.taps)},
        {"BLOCKER", disk_points(filter, s, s.filter.blocker_taps)},
        {"RAY", spiral_places(s.filter.rays)}};
    for (const auto& [name, places] : lists) {
        add(fmt::format("{}_COUNT", name), places.size());
        add(fmt::format("{}_PLACES", name), int(places.size()) <= kDiskTable ? disk_list(places) : "0");
    }
    return out;
}

/// Returns the numbers of the settings as GLSL constants, each with its key and unit.
std::string number_constants(const Settings& s) {
    std::string out;
    for_each_shader_setting([&](const Param& p) {
        if (p.choices || p.cost == Cost::Program) return;
        const SettingRef ref{&p, 0, {}};
        const Value value = get_value(s, ref);
        const std::string name = name_of_key(p.key);
        if (name == "map_resolution") return;  // known as a number of texels everywhere
        const bool real = std::holds_alternative<double>(value);
        const std::string unit(shown_unit(s, ref));
        out += fmt::format("// {}{}{}\nconst {} {} = {};\n", p.key, unit.empty() ? "" : ", ", unit,
                           real ? "float" : "int", name,
                           real ? float_literal(std::get<double>(value)) : std::to_string(int(numeric_value(value))));
    });
    return out;
}

/// Returns the code that takes the place of shaders/lib/frame.glsl: uniforms, and the functions that read them.
std::string frame_code(const LookupFacts& facts) {
    const std::string views = fmt::format("[{}]", facts.views);
    const char* half_unit = facts.perspective ? "tan" : "m";
    std::string out = fmt::format(
        "// World positions (metres) to homogeneous map coordinates and depth, all within 0 and w, by view.\n"
        "uniform mat4 shadow_uvd_from_world{0};\n"
        "// Distances of the near and far plane of a view along its axis, metres.\n"
        "uniform vec2 shadow_near_far_m{0};\n"
        "// Half of the longer side of a view's map: {2}.\n"
        "uniform float shadow_half_width_{1}{0};\n",
        views, half_unit, facts.perspective ? "tangent of half the angle" : "metres");
    out += facts.type == LightType::Directional
               ? "// Unit vector from a surface to the light.\nuniform vec3 shadow_to_light;\n"
               : "// Position of the light, metres.\nuniform vec3 shadow_light_position_m;\n"
                 "// Unit vector against the light's axis.\nuniform vec3 shadow_to_light;\n";
    // Declarations that the look-up does not use are left out later.
    out += fmt::format(
        "// End of a view, and the beginning of its blend into the next: {1}.\n"
        "uniform vec2 shadow_view_ends{0};\n"
        "// Position (metres) and unit viewing direction of the camera.\n"
        "uniform vec3 shadow_camera_position_m;\nuniform vec3 shadow_camera_forward;\n",
        views,
        facts.choice == ViewChoice::Map ? "largest distance from the map's middle, as a share of the map"
                                        : "metres from the camera");
    if (facts.warped)
        out += fmt::format(
            "// Warp of a view: middle, near and far in metres, and the relative rise of w over the map.\n"
            "uniform vec4 shadow_warp{0};\n",
            views);
    if (facts.stretched)
        out += fmt::format(
            "// Shortest side of a texel over its width and over its height.\n"
            "uniform vec2 shadow_texel_shape{0};\n",
            views);
    out +=
        "// Origin of positions in the shader that draws the map, metres; 0 for world positions.\n"
        "uniform vec3 shadow_map_origin_m;\n"
        "// World positions (metres) to clip space of the picture, and the picture's size in pixels.\n"
        "uniform mat4 shadow_clip_from_world;\nuniform vec2 shadow_picture_px;\n\n";
    out +=
        "struct LightBlock {\n    vec4 position;\n    vec4 to_light;\n    vec4 radiance;\n    vec4 kernel;\n};\n\n"
        "struct ViewBlock {\n    mat4 uvd_from_relative;\n    vec4 curve;\n    vec4 warp;\n    vec4 span;\n};\n\n";
    out += fmt::format(
        "/// Returns the light. kernel.x: {}; kernel.y: reach of the kernel in texels.\n"
        "LightBlock light_of(int index) {{\n"
        "    return LightBlock({}, vec4(shadow_to_light, 0.0), vec4(0.0), vec4({}, {}, {}, {}));\n}}\n\n",
        facts.type == LightType::Directional ? "tangent of the light's angular radius"
                                             : "radius of the light in metres",
        facts.type == LightType::Directional ? "vec4(0.0)" : "vec4(shadow_light_position_m, 0.0)",
        float_literal(facts.light_size), float_literal(facts.reach.bias), float_literal(facts.reach.edge),
        float_literal(facts.reach.read));
    const std::string per_texel = float_literal(1.0 / facts.size.longest());
    std::string span = facts.choice == ViewChoice::One    ? fmt::format("vec2({}, 0.0)", per_texel)
                       : facts.choice == ViewChoice::Face ? "vec2(0.0)"
                                                          : "shadow_view_ends[layer]";
    span += facts.stretched     ? ", shadow_texel_shape[layer]"
            : facts.perspective ? ", vec2(1.0)"
                                : ", vec2(2.0 * half_width * " + per_texel + ", 1.0 / (planes.y - planes.x))";
    out += fmt::format(
        "/// Returns a view. curve: near, far, half width, 1 / texels.\n"
        "ViewBlock view_of(int layer) {{\n"
        "    vec2 planes = shadow_near_far_m[layer];\n"
        "    float half_width = shadow_half_width_{}[layer];\n"
        "    return ViewBlock(shadow_uvd_from_world[layer], vec4(planes, half_width, {}), {}, vec4({}));\n}}\n\n",
        half_unit, per_texel, facts.warped ? "shadow_warp[layer]" : "vec4(0.0)", span);
    out += "const int LIGHT_DIRECTIONAL = 0, LIGHT_SPOT = 1, LIGHT_POINT = 2;\n\n";
    return out;
}

/// Returns the part of shaders/lib/frame.glsl from its first function that reads no uniform by itself.
std::string frame_helpers(const gl::ShaderSource& source) {
    std::vector<std::string> files;
    const std::string text = source.expand("lib/frame.glsl", {}, files);
    const std::size_t from = text.find("/// Returns true when the view's rays");
    if (from == text.npos) throw Error("shaders/lib/frame.glsl: is_perspective() is missing");
    return text.substr(from);
}

/// Replaces the frame block's members and facts about lights by uniforms and numbers.
std::string with_facts(std::string text, const LookupFacts& facts) {
    const std::pair<const char*, std::string> lights[] = {{"TYPE", std::to_string(index_of(facts.type))},
                                                          {"CASTS", "1"},
                                                          {"FIRST_VIEW", "0"},
                                                          {"VIEWS", std::to_string(facts.views)},
                                                          {"CLOSED", std::to_string(int(facts.closed))},
                                                          {"CHOICE", std::to_string(int(facts.choice))},
                                                          {"WARPED", std::to_string(int(facts.warped))},
                                                          {"STRETCHED", std::to_string(int(facts.stretched))},
                                                          {"PERSPECTIVE", std::to_string(int(facts.perspective))}};
    for (const auto& [name, value] : lights)
        text = std::regex_replace(text, std::regex(fmt::format("LIGHT_{}\\[[^\\]]*\\]", name)), value);
    const std::pair<const char*, const char*> members[] = {{"frame\\.map_origin\\.xyz", "shadow_map_origin_m"},
                                                           {"frame\\.divided_eye\\.xyz", "shadow_camera_position_m"},
                                                           {"frame\\.divided_forward\\.xyz", "shadow_camera_forward"},
                                                           {"frame\\.clip_from_relative", "shadow_clip_from_world"},
                                                           {"frame\\.picture\\.xy", "shadow_picture_px"}};
    for (const auto& [member, uniform] : members) text = std::regex_replace(text, std::regex(member), uniform);
    return text;
}

/// Returns the end of the statement that begins at `at`: after its ';' or its block.
std::size_t statement_end(std::string_view text, std::size_t at) {
    int depth = 0;
    for (; at < text.size(); ++at) {
        const char c = text[at];
        depth += c == '(' || c == '{';
        depth -= c == ')' || c == '}';
        if (depth == 0 && (c == ';' || c == '}')) return at + 1;
    }
    return text.size();
}

/// Decides comparisons of numbers with numbers, and leaves out statements that never run.
std::string with_decided_branches(std::string text) {
    const std::pair<const char*, int> names[] = {
        {"LIGHT_DIRECTIONAL", 0}, {"LIGHT_SPOT", 1},      {"LIGHT_POINT", 2}, {"CHOICE_ONE", 0},
        {"CHOICE_FACE", 1},       {"CHOICE_INTERVAL", 2}, {"CHOICE_MAP", 3},  {"CHOICE_DISTANCE", 4}};
    for (const auto& [name, number] : names)
        text = std::regex_replace(text, std::regex(fmt::format("(\\b[0-9]+ [=!]=) {}\\b", name)),
                                  fmt::format("$1 {}", number));
    for (int a = 0; a < 7; ++a)
        for (int b = 0; b < 5; ++b)
            for (const bool equal : {true, false})
                text = std::regex_replace(
                    text,
                    std::regex(fmt::format(
                        "(\\(|\\? |: |&& |\\|\\| |= |return ){} {} {}(?![.0-9])(?= *(\\)|\\?|:|&&|\\|\\||;))", a,
                        equal ? "==" : "!=", b)),
                    (a == b) == equal ? "$1true" : "$1false");
    text = std::regex_replace(text, std::regex("\\(false && [^()|]*(\\([^()]*\\)[^()|]*)*\\)"), "(false)");
    constexpr std::string_view kNever = "if (false) ";
    for (std::size_t at; (at = text.find(kNever)) != text.npos;) {
        const std::size_t end = statement_end(text, at + kNever.size());
        text.erase(at, end - at);
        // A branch for the other case becomes the statement.
        std::size_t next = at;
        while (next < text.size() && std::isspace(static_cast<unsigned char>(text[next]))) ++next;
        if (text.compare(next, 5, "else ") == 0) text.erase(at, next + 5 - at);
    }
    return std::regex_replace(text, std::regex("\n *\n(?= *(\\}|[a-z]))"), "\n");
}

/// Returns the function that another program calls.
std::string entry_code(const Settings& s) {
    const bool derivatives = bias_of(s).by_derivatives;
    const std::string in_map = s.caster.cull == Cull::None    ? "true"
                               : s.caster.cull == Cull::Front ? "!gl_FrontFacing"
                                                              : "gl_FrontFacing";
    std::string out =
        "/// Returns the visibility of the light: 1 lit, 0 in shadow.\n"
        "/// @param position_m world position of the surface, metres\n"
        "/// @param face_normal unit normal of the triangle, on the side that the camera sees\n"
        "/// @param vertex_normal unit interpolated normal, on the same side\n"
        "/// @param mapped_normal unit normal with the normal map\n"
        "/// @param pixel centre of the pixel in the picture, pixels: gl_FragCoord.xy\n"
        "float shadow_visibility(vec3 position_m, vec3 face_normal, vec3 vertex_normal, vec3 mapped_normal, vec2 "
        "pixel) {\n"
        "    Surface s;\n"
        "    s.position = position_m;\n    s.geometric = face_normal;\n    s.vertex = vertex_normal;\n"
        "    s.shading = mapped_normal;\n    s.to_eye = vec3(0.0);\n    s.pixel = pixel;\n    s.receives = true;\n";
    out += fmt::format("    s.in_map = {};\n", in_map);
    if (derivatives) out += "    s.step_x = dFdx(position_m);\n    s.step_y = dFdy(position_m);\n";
    return out + "    return light_visibility(s, 0);\n}\n";
}

std::string sampler_words(const Settings& s) {
    const MapSettings& m = s.map;
    const bool lit = m.outside == Outside::Lit;
    const double border = lit != m.reversed_z ? 1 : 0;
    return m.wrap == MapWrap::Border   ? fmt::format("clamp to border, border depth {}", border)
           : m.wrap == MapWrap::Repeat ? "repeat"
                                       : "clamp to edge";
}

/// Returns the lines that say how to draw the map and bind it.
std::string use_text(const Settings& s, const LookupFacts& facts, std::string_view code) {
    const auto line = [](const std::string& text) { return "// " + text + "\n"; };
    const Filter& filter = filter_of(s);
    const char* kind = facts.views > 1 ? "a texture array, a layer by view" : "a texture";
    std::string out = line("How to use it, in a fragment shader of GLSL 4.50:");
    out += line("    float visibility = shadow_visibility(position, face_normal, normal, normal, gl_FragCoord.xy);");
    out += line(fmt::format("The map is {} of {}x{} texels, format {}, depth 0 to 1{}.", kind, facts.size.width,
                            facts.size.height,
                            value_text(*find_setting("map.format")->param, get_value(s, *find_setting("map.format"))),
                            s.map.reversed_z ? ", 1 at the near plane (reversed)" : ""));
    if (holds_distances(s.map.format))
        out += line("It stores (distance along the axis - near) / (far - near), 1 minus that if reversed.");
    if (names_in_code(code, "shadow_map"))
        out += line(fmt::format("shadow_map: nearest texel, {}, no comparison.", sampler_words(s)));
    if (names_in_code(code, "shadow_map_compare"))
        out += line(fmt::format("shadow_map_compare: {}, {}, comparison {}.",
                                is_bilinear(filter, s) ? "linear" : "nearest texel", sampler_words(s),
                                s.map.reversed_z ? (s.map.compare == Compare::Less ? "GREATER" : "GEQUAL")
                                                 : (s.map.compare == Compare::Less ? "LESS" : "LEQUAL")));
    if (names_in_code(code, "moments_map"))
        out += line(fmt::format(
            "moments_map: the mean of quantised(moments_of(share)) over {} texels to each side of a "
            "texel ({}), linear, {}{}.",
            s.filter.blur, s.filter.blur_shape == BlurShape::Box ? "box" : "Gaussian",
            s.map.wrap == MapWrap::Repeat ? "repeat" : "clamp to edge", s.filter.mips ? ", with mip levels" : ""));
    if (names_in_code(code, "sums_map"))
        out +=
            line(s.filter.sums == TableSums::Integer
                     ? "sums_map: texel (x, y) holds the sum of round(SUMS_ONE * moments_of(share).xy) over all texels "
                       "(i, j) with i <= x and j <= y, as 32-bit integers that wrap; SUMS_ONE is 3715370."
                     : "sums_map: texel (x, y) holds the sum of moments_of(share).xy over all texels (i, j) with "
                       "i <= x and j <= y.");
    if (offsets_polygons(s))
        out += line(fmt::format("While the map is drawn: glPolygonOffsetClamp({}, {}, {}).",
                                float_literal(s.bias.raster_slope * (s.map.reversed_z ? -1 : 1)),
                                float_literal(s.bias.raster_units * (s.map.reversed_z ? -1 : 1)),
                                float_literal(s.bias.raster_clamp * (s.map.reversed_z ? -1 : 1))));
    if (s.caster.cull != Cull::None)
        out += line(fmt::format("While the map is drawn, {} faces are culled.",
                                s.caster.cull == Cull::Front ? "front" : "back"));
    if (facts.views > 1)
        out += line(fmt::format("The light has {} views, in the order of the map's layers.", facts.views));
    return out;
}

}  // namespace

LookupFacts lookup_facts(const Settings& settings) {
    const LightSettings& light = settings.lights[std::size_t(settings.view.light)];
    LookupFacts out{.type = light.type, .size = MapSize(settings.map.resolution)};
    const bool parallel = light.type == LightType::Directional;
    out.perspective =
        parallel ? light.projection == LightProjection::Perspective : light.projection != LightProjection::Orthographic;
    out.warped = parallel && fit_row(light.fit).warps;
    if (light.type == LightType::Point) {
        out.views = 6;
        out.choice = ViewChoice::Face;
    } else if (parallel && light.cascades > 1) {
        out.views = light.cascades;
        out.choice = light.cascade_choice == CascadeChoice::Map ? ViewChoice::Map : ViewChoice::Interval;
        out.blends = light.cascade_blend > 0;
    }
    out.light_size = parallel ? std::tan(std::min(light.size, 89.0) * 3.14159265358979323846 / 180) : light.size;
    out.reach = reach_of(settings);
    return out;
}

LookupFacts lookup_facts(const Settings& settings, const FittedLight& light, MapSize size, int subpixel_bits) {
    LookupFacts out{.type = light.type,
                    .choice = light.chooser.choice,
                    .views = int(light.views.size()),
                    .perspective = light.is_perspective(),
                    .warped = light.derives_texels(size),
                    .stretched = light.is_perspective() && light.is_stretched(size),
                    .closed = light.closed,
                    .size = size,
                    .light_size = light.size,
                    .reach = kernel_reach_in_light(settings, light, size),
                    .subpixel_bits = subpixel_bits};
    for (const ViewSpan& span : light.chooser.spans) out.blends |= span.blends_from < span.ends;
    return out;
}

std::string lookup_export_refusal(const Settings& settings) {
    const Source& source = source_of(settings, settings.view.light);
    if (!source.needs.map)
        return fmt::format("light.source {}: no shadow map is read, so there is no look-up; set light.source to map",
                           source.key);
    if (draws_pages(settings))
        return "map.virtual: a look-up in pages needs the page table of the program that draws them; set map.virtual "
               "to "
               "false";
    if (!settings.lights[std::size_t(settings.view.light)].cast)
        return "light.cast: the light casts no shadow; set light.cast to true";
    return {};
}

ExportedCode lookup_glsl(const Settings& given, const LookupFacts& facts) {
    ExportedCode out;
    const Settings s = settings_for_export(given, out.notes);
    if (const std::string refusal = lookup_export_refusal(s); !refusal.empty()) throw Error(refusal);
    const gl::ShaderSource source;
    const gl::IncludeNames names{{"FILTER_FILE", std::string(filter_of(s).file)},
                                 {"BIAS_FILE", std::string(bias_of(s).file)}};
    // Files that this code replaces count as included already.
    std::vector<std::string> files{"lib/frame.glsl", "shared/frame.h", "lib/pages.glsl"};
    std::string text = frame_code(facts) + number_constants(s) + frame_helpers(source);
    if (facts.choice == ViewChoice::One) {
        files.push_back("lib/view_choice.glsl");
        text +=
            "struct ViewPick {\n    int view, other;\n    float share;\n};\n\n"
            "ViewPick choose_view(int light, vec3 position) { return ViewPick(0, 0, 0.0); }\n\n";
    }
    text += source.expand("lib/visibility.glsl", names, files) + entry_code(s);
    text = with_decided_branches(with_facts(preprocess_glsl(text, lookup_defines(s, facts)), facts));
    std::vector<std::string> roots{"shadow_visibility"};
    if (filter_of(s).samples() == Samples::Moments) roots.insert(roots.end(), {"moments_of", "quantised"});
    const std::string code = used_glsl(text, roots);
    out.text = use_text(s, facts, code) + "\n" + code;
    if (s.lights[std::size_t(s.view.light)].contact > 0)
        out.notes.push_back("light.contact: contact shadows are a pass of their own, which the code leaves out");
    if (s.map.blur_texels > 0)
        out.notes.push_back("map.blur_texels: the code reads a map whose depths are blurred already");
    return out;
}

std::string settings_cpp(const Settings& given, const LookupFacts& facts) {
    std::vector<std::string> notes;
    const Settings s = settings_for_export(given, notes);
    std::string out =
        "#pragma once\n\nnamespace shadow {\n\n"
        "/// Settings of the shadow map, its look-up and its light. Constants that these settings leave without effect "
        "are absent.\n";
    for (const Param& p : params()) {
        const std::string_view group = p.key.substr(0, p.key.find('.'));
        const bool shown =
            group == "map" || group == "bias" || group == "filter" || group == "caster" || group == "light";
        if (!shown || is_text(p) || p.scope == Scope::Object || p.key == "light.count") continue;
        const SettingRef ref{&p, p.scope == Scope::Light ? s.view.light : 0, {}};
        if (!idle_reason(s, ref).empty()) continue;
        const Value value = get_value(s, ref);
        const std::string unit(shown_unit(s, ref));
        std::string type = "const char*", number;
        if (p.choices) {
            number = fmt::format("\"{}\"", value_text(p, value));
        } else if (std::holds_alternative<bool>(value)) {
            type = "bool";
            number = std::get<bool>(value) ? "true" : "false";
        } else if (std::holds_alternative<int>(value)) {
            type = "int";
            number = std::to_string(std::get<int>(value));
        } else {
            type = "double";
            number = fmt::format("{}", std::get<double>(value));
            if (number.find_first_of(".en") == number.npos) number += ".0";
        }
        out += fmt::format("inline constexpr {} {} = {};{}{}\n", type, name_of_key(p.key), number,
                           unit.empty() ? "" : "  // ", unit);
    }
    out += fmt::format(
        "\n/// Number of views (cascades or cube faces) of the light.\ninline constexpr int views = {};\n\n"
        "/// Numbers of one view, for the uniforms of the GLSL text. Matrices are stored by columns.\n"
        "struct View {{\n"
        "    float uvd_from_world[16];  ///< world metres to homogeneous map coordinates and depth\n"
        "    float near_m, far_m;       ///< along the view's axis\n"
        "    float half_width{};        ///< of the longer side of the map\n"
        "    /// Returns the width of a texel{}.\n"
        "    constexpr float texel_m() const {{ return 2 * half_width{} / {}; }}\n"
        "}};\n\n"
        "/// Numbers of the light, for the uniforms of the GLSL text.\n"
        "struct Light {{\n    float to_light[3];\n    float position_m[3];\n    View view[views];\n}};\n\n"
        "}}  // namespace shadow\n",
        facts.views, facts.perspective ? "_tan" : "_m",
        facts.perspective ? " at a distance of 1 m, metres" : ", metres", facts.perspective ? "_tan" : "_m",
        facts.size.longest());
    return out;
}

}  // namespace si
