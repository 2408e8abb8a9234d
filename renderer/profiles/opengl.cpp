// Profile of OpenGL.
#include "renderer/profiles/api_bias.h"

namespace si {
namespace {

constexpr ApiNames kOpenglNames{.factor = "factor",
                                .units = "units",
                                .clamp = "clamp",
                                .source = "docs.gl: glPolygonOffset; OpenGL 4.6 core, 14.6.5"};

}  // namespace

const EngineProfile& opengl_profile() {
    static const EngineProfile row =
        api_profile<kOpenglNames>({.name = "opengl",
                                   .title = "OpenGL",
                                   .version = "4.6",
                                   .unverified = "the size of a unit, which each driver chooses"});
    return row;
}

}  // namespace si
