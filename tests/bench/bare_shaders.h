// What the bare programs run on the GPU.
#pragma once

#include <string>

#include "tests/bench/bare.h"

namespace si {

enum class BareLook { Colour, Textured, Masked };
enum class BarePass { Forward, Visibility, ReadsVisibility };

std::string bare_camera_vertex(const BareOptions& options, BarePass pass);
std::string bare_camera_fragment(const BareOptions& options, BarePass pass, BareLook look, int map_resolution);
/// One axis of the moments' blur; the first reads depths, the second moments.
std::string bare_blur_fragment(int axis);

inline constexpr const char* kBareDepthVertex =
    "layout(location=0) in vec3 p; uniform mat4 clip; void main(){gl_Position=clip*vec4(p,1);}";
inline constexpr const char* kBareMaskedDepthVertex = R"(
layout(location=0) in vec3 p; layout(location=3) in vec2 t; uniform mat4 clip; out vec2 uv;
void main(){ uv=t; gl_Position=clip*vec4(p,1); })";
inline constexpr const char* kBareMaskedDepthFragment = R"(
in vec2 uv; uniform float cutoff; layout(binding=1) uniform sampler2D base;
void main(){ if(texture(base,uv).a<cutoff) discard; })";
inline constexpr const char* kBareFullscreenVertex =
    "void main(){ gl_Position=vec4(vec2((gl_VertexID&1)*4-1,(gl_VertexID&2)*2-1),0,1); }";

}  // namespace si
