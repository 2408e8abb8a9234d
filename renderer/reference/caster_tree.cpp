#include "renderer/reference/caster_tree.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "renderer/base/error.h"
#include "renderer/base/workers.h"

namespace si {
namespace {

constexpr unsigned kLeafTriangles = 4;

/// Box along the axes of a shaft, of which only the largest height matters.
struct ShaftBox {
    glm::vec2 low, high;
    float top;
};

/// Axes of a shaft by coordinate, with their absolute values: the sum of the latter is the reach of a box.
struct ShaftAxes {
    glm::mat3 by_coordinate, reach;
    explicit ShaftAxes(const glm::mat3& axes) : by_coordinate(glm::transpose(axes)), reach(by_coordinate) {
        for (int c = 0; c < 3; ++c) reach[c] = glm::abs(reach[c]);
    }
};

ShaftBox box_along(const ShaftAxes& axes, const RTCBounds& b) {
    const glm::vec3 low(b.lower_x, b.lower_y, b.lower_z), high(b.upper_x, b.upper_y, b.upper_z);
    const glm::vec3 centre = axes.by_coordinate * (0.5f * (low + high)), reach = axes.reach * (0.5f * (high - low));
    return {glm::vec2(centre - reach), glm::vec2(centre + reach), centre.z + reach.z};
}

ShaftBox box_along(const ShaftAxes& axes, const std::array<glm::vec3, 3>& corners) {
    const glm::vec3 a = axes.by_coordinate * corners[0], b = axes.by_coordinate * corners[1],
                    c = axes.by_coordinate * corners[2];
    const glm::vec3 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
    return {glm::vec2(low), glm::vec2(high), high.z};
}

bool meets(const LightShaft& shaft, const ShaftBox& box) {
    const float height = std::min(box.top, shaft.top) - shaft.bottom;
    if (!(height > 0)) return false;
    const glm::vec2 reach = height * shaft.slope;
    return box.low.x <= shaft.high.x + reach.x && box.high.x >= shaft.low.x - reach.x &&
           box.low.y <= shaft.high.y + reach.y && box.high.y >= shaft.low.y - reach.y;
}

}  // namespace

struct CasterTree::Node {
    struct Children {
        Node* nodes[2];
        RTCBounds bounds[2];
    };
    /// Triangle by its ids in Embree.
    struct Triangle {
        unsigned caster, primitive;
    };
    unsigned triangles = 0;  ///< of a leaf; 0: an inner node
    union {
        Children children;
        Triangle leaf[kLeafTriangles];
    };
};

CasterTree::CasterTree(RTCDevice device, RTCScene scene, std::span<const std::size_t> triangles,
                       const std::stop_token& stop) {
    std::vector<RTCBuildPrimitive> primitives;
    for (unsigned c = 0; c < triangles.size(); ++c) {
        const RTCGeometry geometry = rtcGetGeometry(scene, c);
        buffers_.push_back(
            {static_cast<const glm::vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0)),
             static_cast<const std::uint32_t*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_INDEX, 0))});
        const std::size_t count = triangles[c];
        for (unsigned p = 0; p < count; ++p) {
            const auto [i, j, k] = corners(c, p);
            const glm::vec3 low = glm::min(glm::min(i, j), k), high = glm::max(glm::max(i, j), k);
            const float size = glm::dot(high, high) + glm::dot(low, low);
            // Rounding may have collapsed a triangle to a point, which hides nothing.
            if (!std::isfinite(size) || low == high) continue;
            primitives.push_back({low.x, low.y, low.z, c, high.x, high.y, high.z, p});
        }
    }
    if (primitives.empty()) return;
    nodes_.reset(rtcNewBVH(device));
    RTCBuildArguments build = rtcDefaultBuildArguments();
    build.maxDepth = 48;
    build.maxLeafSize = kLeafTriangles;
    build.bvh = nodes_.get();
    build.primitives = primitives.data();
    build.primitiveCount = build.primitiveArrayCapacity = primitives.size();
    build.createNode = [](RTCThreadLocalAllocator allocator, unsigned, void*) -> void* {
        return new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node;
    };
    build.setNodeChildren = [](void* node, void** children, unsigned count, void*) {
        for (unsigned i = 0; i < count; ++i)
            static_cast<Node*>(node)->children.nodes[i] = static_cast<Node*>(children[i]);
    };
    build.setNodeBounds = [](void* node, const RTCBounds** bounds, unsigned count, void*) {
        for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->children.bounds[i] = *bounds[i];
    };
    build.createLeaf = [](RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* first, std::size_t count,
                          void*) -> void* {
        auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node;
        node->triangles = unsigned(count);
        for (std::size_t i = 0; i < count; ++i) node->leaf[i] = {first[i].geomID, first[i].primID};
        return node;
    };
    build.buildProgress = [](void* stop_token, double) {
        return !static_cast<const std::stop_token*>(stop_token)->stop_requested();
    };
    build.userPtr = const_cast<std::stop_token*>(&stop);
    root_ = static_cast<const Node*>(rtcBuildBVH(&build));
    if (stop.stop_requested()) throw Cancelled();
    if (!root_) throw Error("out of memory for the ray-traced reference; use a smaller scene");
}

void ShaftTriangles::clear() {
    caster.clear();
    primitive.clear();
    for (std::vector<float>* bounds : {&low_x, &low_y, &high_x, &high_y, &top}) bounds->clear();
}

bool CasterTree::collect(const LightShaft& shaft, std::size_t most, ShaftTriangles& out) const {
    out.clear();
    if (!root_) return true;
    const ShaftAxes axes(shaft.axes);
    thread_local std::vector<const Node*> left;
    left.assign(1, root_);
    while (!left.empty()) {
        const Node& node = *left.back();
        left.pop_back();
        if (node.triangles == 0) {
            for (int i = 0; i < 2; ++i)
                if (meets(shaft, box_along(axes, node.children.bounds[i]))) left.push_back(node.children.nodes[i]);
            continue;
        }
        for (unsigned i = 0; i < node.triangles; ++i) {
            const auto [caster, primitive] = node.leaf[i];
            const ShaftBox box = box_along(axes, corners(caster, primitive));
            if (!meets(shaft, box)) continue;
            if (out.size() == most) return false;
            out.caster.push_back(caster);
            out.primitive.push_back(primitive);
            out.low_x.push_back(box.low.x);
            out.low_y.push_back(box.low.y);
            out.high_x.push_back(box.high.x);
            out.high_y.push_back(box.high.y);
            out.top.push_back(box.top);
        }
    }
    return true;
}

}  // namespace si
