// What glPolygonOffset adds to the stored depth of a plane, as the driver was measured to make it
// (renderer/render/polygon_offset.h). Drawing the map applies it; this tells what it is worth.
// @param per_texel depth of the plane per texel, along u and v, without sign
float raster_offset(vec2 per_texel, float quantum) {
    float slope = frame.offset.z * (frame.offset.w != 0.0 ? length(per_texel) : max(per_texel.x, per_texel.y));
    float raster = bias_raster_slope * slope + bias_raster_units * (frame.offset.x + frame.offset.y * quantum);
    return bias_raster_clamp > 0.0 ? min(raster, bias_raster_clamp) : raster;
}
