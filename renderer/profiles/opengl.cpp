// Profile of OpenGL.
#include "renderer/profiles/api_bias.h"

namespace si {
namespace {

constexpr std::string_view kOpenglSource = "docs.gl: glPolygonOffset; OpenGL 4.6 core, 14.6.5";

constexpr EngineParameter kOpenglParameters[] = {
    {.key = "factor",
     .unit = "x depth slope",
     .standard = 0,
     .min = -100,
     .max = 100,
     .meaning = "Offset by the slope of the triangle while the map is drawn. Negative under reversed depth.",
     .source = kOpenglSource,
     .setting = "bias.raster_slope",
     .is_bias = true},
    {.key = "units",
     .unit = "depth steps",
     .standard = 0,
     .min = -1e7,
     .max = 1e7,
     .meaning = "Offset by steps of the depth format while the map is drawn. Negative under reversed depth.",
     .source = kOpenglSource,
     .setting = "bias.raster_units",
     .is_bias = true},
    {.key = "clamp",
     .unit = "depth",
     .standard = 0,
     .min = -1,
     .max = 1,
     .meaning = "Largest offset; 0 is no limit. Negative under reversed depth.",
     .source = kOpenglSource,
     .setting = "bias.raster_clamp",
     .is_bias = true},
    {.key = "shader.depthBias",
     .unit = "normalised depth",
     .standard = 0,
     .min = 0,
     .max = 1,
     .meaning = "Number of your own shader: subtracted from the receiver's depth, added under reversed depth.",
     .source = kOpenglSource,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "shader.normalOffset",
     .unit = "m",
     .standard = 0,
     .min = 0,
     .max = 1e3,
     .meaning = "Number of your own shader: shift of the look-up along the geometric normal.",
     .source = kOpenglSource,
     .setting = "bias.normal",
     .is_bias = true},
};

constexpr ApiNames kOpenglNames{"factor", "units", "clamp", false};

BiasNumbers read_opengl(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    return read_api_bias(kOpenglNames, profile, values, facts);
}

void write_opengl(const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
    write_api_bias(kOpenglNames, bias, facts, to);
}

}  // namespace

const EngineProfile& opengl_profile() {
    static const EngineProfile row{.name = "opengl",
                                   .title = "OpenGL",
                                   .version = "4.6",
                                   .unverified = "the size of a unit, which each driver chooses",
                                   .parameters = kOpenglParameters,
                                   .read_bias = read_opengl,
                                   .write_bias = write_opengl};
    return row;
}

}  // namespace si
