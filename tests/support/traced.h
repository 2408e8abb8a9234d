// Receivers and lights for tests of the ray-traced truth, made without a GPU.
#pragma once

#include <memory>
#include <vector>

#include "renderer/reference/truth.h"

namespace si::test {

/// The point (1-u-v) a + u b + v c of a triangle, its normal by winding, or turned over.
Receiver receiver_on(const ReferenceGeometry& geometry, std::uint32_t object, std::uint32_t primitive, double u,
                     double v, bool turned = false);

/// A picture of one row.
Receivers row_of(const std::vector<Receiver>& pixels);

/// What the GPU would draw, by a ray for each pixel against each triangle. Small scenes only.
SurfaceIds ids_by_rays(const Scene& scene, const Camera& camera, int width, int height);

Emitter sun(const glm::dvec3& to_light, double angular_radius_deg = 0);

/// A query over all objects of a scene under default settings.
ReferenceQuery query_for(const Scene& scene, const Emitter& emitter, const ReferenceOptions& options = {});

std::shared_ptr<const ReferenceGeometry> geometry_of(const Scene& scene, const Settings& settings = {});

}  // namespace si::test
