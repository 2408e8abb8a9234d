// GLSL sources of the minimal programs (bare.h).
#pragma once

#include <string>

#include "tests/bench/bare.h"

namespace si {

/// Material variant of a fragment shader.
enum class BareLook { Colour, Textured, Masked };
/// Pass of a fragment shader: forward shading, visibility alone, or shading that reads a visibility texture.
enum class BarePass { Forward, Visibility, ReadsVisibility };

/// Returns the vertex shader of a camera pass.
std::string bare_camera_vertex(const BareOptions& options, BarePass pass);
/// Returns the fragment shader of a camera pass. @param map_resolution texels a side of the shadow map
std::string bare_camera_fragment(const BareOptions& options, BarePass pass, BareLook look, int map_resolution);
/// Returns the fragment shader for one axis (0: x, 1: y) of the moments' blur. Axis 0 reads depths, axis 1 moments.
std::string bare_blur_fragment(int axis);

/// Vertex shader of the shadow map's pass for opaque triangles.
inline constexpr const char* kBareDepthVertex =
    "layout(location=0) in vec3 p; uniform mat4 clip; void main(){gl_Position=clip*vec4(p,1);}";
/// Vertex shader of the shadow map's pass for masked triangles.
inline constexpr const char* kBareMaskedDepthVertex = R"(
layout(location=0) in vec3 p; layout(location=3) in vec2 t; uniform mat4 clip; out vec2 uv;
void main(){ uv=t; gl_Position=clip*vec4(p,1); })";
/// Fragment shader that discards texels of a mask below its cutoff.
inline constexpr const char* kBareMaskedDepthFragment = R"(
in vec2 uv; uniform float cutoff; layout(binding=1) uniform sampler2D base;
void main(){ if(texture(base,uv).a<cutoff) discard; })";
/// Vertex shader that draws one triangle over the whole target.
inline constexpr const char* kBareFullscreenVertex =
    "void main(){ gl_Position=vec4(vec2((gl_VertexID&1)*4-1,(gl_VertexID&2)*2-1),0,1); }";

}  // namespace si
