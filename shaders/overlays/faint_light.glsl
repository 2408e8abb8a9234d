// Visibility in full shadow, where the reference has no edge within the reach of the kernel and of the depth blur.
#include "lib/truth.glsl"
vec4 overlay(Receiver r) {
    vec4 reference = reference_here(), more = more_reference_here();
    float v = classified_visibility(classified_here());
    float reach = light_of(r.light).kernel.z + float(DEPTH_BLUR_TEXELS);
    bool faint = counts(reference) && true_visibility(reference) == 0.0 && v > VISIBLE_ERROR;
    return vec4(faint && more.z > reach * r.texel_m ? v : NOTHING);
}
