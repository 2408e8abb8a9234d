// Weighted copy of a picture, for the mean of several pictures.
#include "shared/units.h"
layout(binding = UNIT_SHADED) uniform sampler2D picture;
uniform float scale;
layout(location = 0) out vec4 colour_out;

void main() { colour_out = vec4(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb * scale, 1.0); }
