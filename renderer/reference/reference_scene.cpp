#include "renderer/reference/reference_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "renderer/reference/reference_rays.h"

namespace si {
namespace {

void check(const embree::Device& device, const std::stop_token& stop) {
    const RTCError error = rtcGetDeviceError(device.get());
    if (stop.stop_requested()) throw Cancelled();
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY)
        throw Error("out of memory for the ray-traced reference; use a smaller scene");
    throw Error(fmt::format("the ray-traced reference cannot be prepared: Embree reports error {}", int(error)));
}

void solid_points(const RTCFilterFunctionNArguments* args) {
    const auto& mask = *static_cast<const AlphaMask*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const bool solid = mask.is_solid(RTCHitN_primID(args->hit, args->N, i), RTCHitN_u(args->hit, args->N, i),
                                         RTCHitN_v(args->hit, args->N, i));
        if (!solid) args->valid[i] = 0;
    }
}

class Builder {
public:
    Builder(RayHierarchy& impl, const Workers& workers) : impl_(impl), stop_(workers.stop) {}

    void add(std::uint32_t object, bool shared) {
        const ReferenceObject& o = impl_.geometry->objects[object];
        glm::dmat4 unit_from_mesh = o.world;
        unit_from_mesh[3] -= glm::dvec4(impl_.centre, 0);
        for (int c = 0; c < 4; ++c) unit_from_mesh[c] = glm::dvec4(glm::dvec3(unit_from_mesh[c]) * impl_.scale, c == 3);
        shared = shared && is_well_conditioned(glm::dmat3(unit_from_mesh));
        const embree::Geometry geometry = shared ? instance(o, unit_from_mesh) : triangles(*o.mesh, unit_from_mesh);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(impl_.scene.get(), geometry.get(), unsigned(impl_.casters.size()));
        impl_.casters.push_back({object, !shared && glm::determinant(glm::dmat3(o.world)) < 0});
        impl_.triangles += o.mesh->triangles();
        impl_.instances += shared;
        check(impl_.device, stop_);
    }

    embree::Scene new_scene() {
        embree::Scene scene(rtcNewScene(impl_.device.get()));
        check(impl_.device, stop_);
        rtcSetSceneFlags(scene.get(), RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
        return scene;
    }

    void commit(const embree::Scene& scene) {
        const auto go_on = [](void* stop, double) { return !static_cast<std::stop_token*>(stop)->stop_requested(); };
        rtcSetSceneProgressMonitorFunction(scene.get(), go_on, &stop_);
        rtcCommitScene(scene.get());
        rtcSetSceneProgressMonitorFunction(scene.get(), nullptr, nullptr);
        check(impl_.device, stop_);
    }

private:
    RayHierarchy& impl_;
    std::stop_token stop_;
    std::map<const ReferenceMesh*, RTCScene> shared_;

    embree::Geometry triangles(const ReferenceMesh& mesh, const glm::dmat4& unit_from_mesh) {
        embree::Geometry geometry(rtcNewGeometry(impl_.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
        check(impl_.device, stop_);
        auto* corners = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
        if (mesh.triangles() > 0 && !corners) check(impl_.device, stop_);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            corners[i] = glm::vec3(unit_from_mesh * glm::dvec4(glm::dvec3(mesh.positions[i]), 1));
        set_indices(geometry, mesh, corners);
        if (mesh.mask) {
            rtcSetGeometryUserData(geometry.get(), const_cast<AlphaMask*>(mesh.mask.get()));
            rtcSetGeometryOccludedFilterFunction(geometry.get(), solid_points);
            rtcSetGeometryIntersectFilterFunction(geometry.get(), solid_points);
        }
        return geometry;
    }

    /// Sets the index buffer: the mesh's own, which outlives the hierarchy, or a copy where triangles have to be
    /// replaced.
    void set_indices(const embree::Geometry& geometry, const ReferenceMesh& mesh, const glm::vec3* corners) {
        constexpr std::size_t kStride = 3 * sizeof(std::uint32_t);
        // A triangle that rounding collapsed to a line can give false hits; one collapsed to a point cannot.
        const auto is_needle = [&](std::size_t i) {
            const glm::dvec3 a(corners[mesh.indices[i]]), b(corners[mesh.indices[i + 1]]),
                c(corners[mesh.indices[i + 2]]);
            const glm::dvec3 cross = glm::cross(b - a, c - a);
            return !(glm::dot(cross, cross) > 0);
        };
        std::vector<std::size_t> needles;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            if (is_needle(i)) needles.push_back(i);
        if (needles.empty()) {
            rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(),
                                       0, kStride, mesh.triangles());
            return;
        }
        auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, kStride, mesh.triangles()));
        if (!indices) check(impl_.device, stop_);
        std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
        for (const std::size_t i : needles) indices[i + 1] = indices[i + 2] = indices[i];
    }

    embree::Geometry instance(const ReferenceObject& o, const glm::dmat4& unit_from_mesh) {
        RTCScene& mesh_scene = shared_[o.mesh.get()];
        if (!mesh_scene) {
            embree::Scene scene = new_scene();
            const embree::Geometry geometry = triangles(*o.mesh, glm::dmat4(1));
            rtcCommitGeometry(geometry.get());
            rtcAttachGeometry(scene.get(), geometry.get());
            commit(scene);
            mesh_scene = scene.get();
            impl_.meshes.push_back(std::move(scene));
        }
        embree::Geometry geometry(rtcNewGeometry(impl_.device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
        check(impl_.device, stop_);
        rtcSetGeometryInstancedScene(geometry.get(), mesh_scene);
        const glm::mat4x3 transform(unit_from_mesh);
        rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &transform[0][0]);
        return geometry;
    }
};

}  // namespace

ReferenceScene::ReferenceScene(std::shared_ptr<const ReferenceGeometry> geometry, const Workers& workers,
                               Instancing instancing)
    : geometry_(std::move(geometry)), impl_(std::make_unique<RayHierarchy>()) {
    RayHierarchy& i = *impl_;
    i.geometry = geometry_.get();
    static_cast<UnitFrame&>(i) = geometry_->unit_frame();
    const double aside_m = glm::distance(geometry_->bounds.centre(), i.centre);
    i.radius = std::max((geometry_->bounds.radius() + aside_m) * i.scale, 1.0);
    i.device.reset(rtcNewDevice(nullptr));
    if (!i.device) throw Error("the ray-traced reference cannot be prepared: Embree finds no device");
    const auto taken = [](void* held, ssize_t bytes, bool) {
        static_cast<TrackedMemory*>(held)->add(bytes);
        return true;
    };
    rtcSetDeviceMemoryMonitorFunction(i.device.get(), taken, &i.held);

    std::map<const ReferenceMesh*, int> uses;
    std::size_t flattened = 0;
    for (const ReferenceObject& o : geometry_->objects)
        if (o.casts) {
            ++uses[o.mesh.get()];
            flattened += o.mesh->triangles();
        }
    const bool share =
        instancing == Instancing::Always || (instancing == Instancing::Automatic && flattened > kMaxFlattenedTriangles);
    Builder builder(i, workers);
    i.scene = builder.new_scene();
    for (std::uint32_t k = 0; k < geometry_->objects.size(); ++k) {
        const ReferenceObject& o = geometry_->objects[k];
        if (!o.casts || o.mesh->indices.empty()) continue;
        builder.add(k, share && uses[o.mesh.get()] > 1);
    }
    builder.commit(i.scene);
    if (workers.progress) workers.progress(1);
}

ReferenceScene::~ReferenceScene() = default;

std::size_t ReferenceScene::triangle_count() const {
    return impl_->triangles;
}

std::size_t ReferenceScene::instance_count() const {
    return impl_->instances;
}

}  // namespace si
