// Makes receivers, lights and queries for tests of the ray-traced reference, without a GPU.
#pragma once

#include <memory>
#include <vector>

#include "renderer/reference/reference.h"

namespace si::test {

/// Returns the receiver at barycentric coordinates of a triangle: the point (1-u-v) a + u b + v c.
/// @param turned reverses the normal, which otherwise follows the winding
Receiver receiver_on(const ReferenceGeometry& geometry, std::uint32_t object, std::uint32_t primitive, double u,
                     double v, bool turned = false);

/// Returns the receiver at a point of object 0, a floor that faces up.
/// @param edge_m length of the floor's triangles, metres
Receiver floor_receiver(const glm::dvec3& position_ws, double edge_m);

/// Returns receivers as a picture of one row, one pixel per receiver.
Receivers row_of(const std::vector<Receiver>& pixels);

/// Returns the surface ids that the GPU would draw, by testing each pixel's ray against each triangle. The cost suits
/// small scenes only.
/// @param width, height pixels
SurfaceIds ids_by_rays(const Scene& scene, const Camera& camera, int width, int height);

/// Returns a directional light.
/// @param to_light unit direction towards the light, world
/// @param angular_radius_deg angular radius of the light's disc, degrees; 0: a point
Emitter sun(const glm::dvec3& to_light, double angular_radius_deg = 0);

/// Returns a reference query for all objects of a scene under default settings.
ReferenceQuery query_for(const Scene& scene, const Emitter& emitter, const ReferenceOptions& options = {});

/// Builds the reference's ray-tracing geometry of a scene.
std::shared_ptr<const ReferenceGeometry> geometry_of(const Scene& scene, const Settings& settings = {});

}  // namespace si::test
