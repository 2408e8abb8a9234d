// Load of the measurement that compares clocks.
layout(location = 0) out vec4 colour_out;

void main() {
    float v = gl_FragCoord.x;
    for (int i = 0; i < 64; ++i) v = sin(v + gl_FragCoord.y);
    colour_out = vec4(v);
}
