// Code template of OpenGL.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string opengl_code(const CodeInput& in) {
    return fmt::format(
        "/* while the map is drawn; the clamp needs OpenGL 4.6 */\n"
        "glEnable(GL_POLYGON_OFFSET_FILL);\n"
        "glPolygonOffsetClamp({}, {}, {}); /* factor, units, clamp */\n"
        "/* in the shader that reads the map */\n"
        "static const float shader_depth_bias = {};      /* normalised depth, towards the light */\n"
        "static const float shader_normal_offset_m = {}; /* along the geometric normal */\n",
        in.c_text("factor"), in.c_text("units"), in.c_text("clamp"), in.c_text("shader.depthBias"),
        in.c_text("shader.normalOffset"));
}

}  // namespace si
