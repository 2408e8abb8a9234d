// Offset that glPolygonOffset adds to the stored depth of a plane, by the driver's measured behaviour
// (renderer/render/polygon_offset.h). Drawing the map applies the offset. This function only computes its amount.
// @param per_texel depth of the plane per texel, along u and v, without sign
float raster_offset(vec2 per_texel, float quantum) {
    float slope = frame.offset.z * (frame.offset.w != 0.0 ? length(per_texel) : max(per_texel.x, per_texel.y));
    float raster = bias_raster_slope * slope + bias_raster_units * (frame.offset.x + frame.offset.y * quantum);
    return bias_raster_clamp > 0.0 ? min(raster, bias_raster_clamp) : raster;
}
