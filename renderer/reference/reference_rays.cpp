#include "renderer/reference/reference_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace si {
namespace {

struct Query {
    RTCIntersectContext context;  ///< first: Embree hands its address to the filter
    const RayHierarchy* scene = nullptr;
    HitRules rules;
    std::vector<Hit>* hits = nullptr;  ///< collects instead of stopping

    Query(const RayHierarchy& s, const HitRules& r) : scene(&s), rules(r) { rtcInitIntersectContext(&context); }
};

/// Candidate hit of an Embree filter call.
struct HitCandidate {
    const Caster* caster = nullptr;
    bool instanced = false;
    unsigned primitive = 0, ray = 0;
    glm::vec3 normal{0}, direction{0};  ///< triangle normal by winding, and ray direction, in one space
    float t = 0;
};

bool culled(const HitCandidate& c, const HitRules& rules) {
    const Cull cull = rules.culls[c.caster->object].cull;
    if (cull == Cull::None) return false;
    // Rays run towards the light, so a front face points along them. In an instance's space winding is that of the
    // mesh.
    float facing = glm::dot(c.normal, c.direction);
    if (c.caster->mirrored) facing = -facing;
    return cull == Cull::Back ? facing < 0 : facing > 0;
}

/// Tests a candidate hit again in double precision, without the receiver's own triangle.
bool hits_exactly(const HitCandidate& c, const ExactRay& ray, const RayHierarchy& scene) {
    if (c.caster->object == ray.object && c.primitive == ray.primitive) return false;
    const TriangleWs t = scene.geometry->triangle(c.caster->object, c.primitive);
    const glm::dvec3 a = scene.to_unit(t[0]), e1 = scene.to_unit(t[1]) - a, e2 = scene.to_unit(t[2]) - a;
    const glm::dvec3 p = glm::cross(ray.direction, e2);
    const double det = glm::dot(e1, p);
    const double size = std::max(glm::dot(e1, e1), glm::dot(e2, e2));
    // Parallel up to rounding: the ray lies in the triangle's plane or next to it.
    if (std::abs(det) <= 1e-14 * size) return false;
    const glm::dvec3 s = ray.origin - a, q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / det, v = glm::dot(ray.direction, q) / det, along = glm::dot(e2, q) / det;
    constexpr double kSlack = 1e-12;
    return u >= -kSlack && v >= -kSlack && u + v <= 1 + kSlack && along > 0 && along < ray.length;
}

void filter(const RTCFilterFunctionNArguments* args) {
    Query& query = *reinterpret_cast<Query*>(args->context);
    const unsigned n = args->N;
    for (unsigned i = 0; i < n; ++i) {
        if (args->valid[i] == 0) continue;
        HitCandidate c;
        const unsigned instance = RTCHitN_instID(args->hit, n, i, 0);
        c.instanced = instance != RTC_INVALID_GEOMETRY_ID;
        c.caster = &query.scene->casters[c.instanced ? instance : RTCHitN_geomID(args->hit, n, i)];
        c.primitive = RTCHitN_primID(args->hit, n, i);
        c.ray = RTCRayN_id(args->ray, n, i);
        c.normal = {RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i), RTCHitN_Ng_z(args->hit, n, i)};
        c.direction = {RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i), RTCRayN_dir_z(args->ray, n, i)};
        c.t = RTCRayN_tfar(args->ray, n, i);
        const HitRules& rules = query.rules;
        const bool left_out = !rules.culls.empty() && culled(c, rules);
        const bool met =
            (query.hits || !left_out) && (rules.exact.empty() || hits_exactly(c, rules.exact[c.ray], *query.scene));
        if (met && query.hits) query.hits->push_back({c.t, left_out, c.caster->object, c.primitive});
        if (!met || query.hits) args->valid[i] = 0;
    }
}

}  // namespace

const CasterTree* RayHierarchy::caster_tree(const std::stop_token& stop) const {
    if (instances > 0) return nullptr;
    const std::lock_guard guard(tree_lock_);
    if (tree_) return tree_.get();
    std::vector<std::size_t> counts;
    for (const Caster& c : casters) counts.push_back(geometry->objects[c.object].mesh->triangles());
    tree_ = std::make_unique<const CasterTree>(device.get(), scene.get(), counts, stop);
    return tree_.get();
}

void mark_occluded(const RayHierarchy& scene, std::span<RTCRay> rays, const HitRules& rules) {
    if (rays.empty()) return;
    Query query(scene, rules);
    // Rays are coherent (neighbouring pixels, or samples of one light): packets are faster than streams.
    query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    if (!rules.culls.empty() || !rules.exact.empty()) query.context.filter = filter;
    rtcOccluded1M(scene.scene.get(), &query.context, rays.data(), unsigned(rays.size()), sizeof(RTCRay));
}

void collect_hits(const RayHierarchy& scene, const RTCRay& ray, const HitRules& rules, std::vector<Hit>& out) {
    out.clear();
    Query query(scene, rules);
    query.context.filter = filter;
    query.hits = &out;
    RTCRayHit hit;
    hit.ray = ray;
    hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene.scene.get(), &query.context, &hit);
}

}  // namespace si
