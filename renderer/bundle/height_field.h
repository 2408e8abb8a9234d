// Surface of a shadow map as a triangle mesh, for maps that come without their scene.
#pragma once

#include <cstddef>

#include "renderer/base/float_image.h"
#include "renderer/projection/light_view.h"
#include "renderer/scene/scene.h"

namespace si {

/// Limits for height_field(), which makes a mesh from the depths of a shadow map.
struct HeightFieldOptions {
    std::size_t max_triangles = 500'000;
    double depth_step = 0;  ///< depth step of the map's format, depth-buffer units; the mesh ignores finer detail
};

/// Mesh of the surface that a shadow map shows, for maps that come without a scene. Front faces face the light.
struct HeightField {
    glm::dvec3 origin_ws{0};  ///< world position to which the mesh is relative
    Mesh mesh;                ///< metres, relative to `origin_ws`, without normals
    int stride = 1;           ///< texels between two rows of the finest triangles
    double error_texels = 0;  ///< largest distance between mesh and texels along the light's axis, in texels
    std::size_t cut = 0;      ///< pairs of neighbouring texels between which the surface is cut
};

/// Makes a triangle mesh of the surface that a shadow map shows. The mesh has at most one vertex per texel, at its
/// centre, and fewer on flat parts (right-triangulated irregular network: Evans, Kirkpatrick and Townsend,
/// Right-Triangulated Irregular Networks, Algorithmica 30, 2001). It is cut where depth jumps. Texels at the far plane
/// are left out.
/// @param depths depth-buffer values of view.curve, top row first @throws Error if no triangle remains
HeightField height_field(const LightView& view, const FloatImage& depths, const HeightFieldOptions& options = {});

/// Returns a scene whose only object is the two-sided mesh of the surface that a shadow map shows (height_field()).
/// The scene is ready to draw: finalise() has run.
/// @throws Error as height_field()
Scene height_field_scene(const LightView& view, const FloatImage& depths, const HeightFieldOptions& options = {});

}  // namespace si
