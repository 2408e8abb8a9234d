#include "renderer/reference/light_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/base/directions.h"
#include "renderer/reference/ray_scenes.h"

namespace si {
namespace {

constexpr int kStrip = 64;        ///< rows traced at once
constexpr double kInset = 0.25;   ///< least distance of a sample from its chart's borders, texels
constexpr double kNoise = 0.005;  ///< target standard error for area lights, about one step of 8 bits
constexpr double kOutsideChartPenalty =
    1e6;  ///< added to distances of texels outside their chart, so that any inside are nearer
constexpr std::uint64_t kMethod = 1;  ///< version of the algorithm: increase when the same task gives another map

int samples_of(const Emitter& emitter, const Settings& settings) {
    return emitter.size > 0 ? std::max(settings.light_map.samples, 1) : 1;
}

void add_emitter(Key& key, const Emitter& e, int samples) {
    // Cone and range limit the lit region, not the occluders.
    key.add(e.type).add(e.casts).add(samples);
    if (e.type != LightType::Directional) key.add(e.position_ws);
    if (e.type == LightType::Directional || (e.type == LightType::Spot && samples > 1)) key.add(e.to_light);
    if (samples > 1) key.add(e.size);
}

/// Returns the barycentric coordinates of the point of a triangle that is nearest to `at`.
glm::dvec3 nearest_shares(const std::array<glm::dvec2, 3>& t, const glm::dvec2& at) {
    glm::dvec3 best(1, 0, 0);
    double least = std::numeric_limits<double>::infinity();
    const glm::dvec2 e1 = t[1] - t[0], e2 = t[2] - t[0], s = at - t[0];
    const double area = e1.x * e2.y - e1.y * e2.x;
    if (area != 0) {
        const double b = (s.x * e2.y - s.y * e2.x) / area, c = (e1.x * s.y - e1.y * s.x) / area;
        if (b >= 0 && c >= 0 && b + c <= 1) return {1 - b - c, b, c};
    }
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const glm::dvec2 along = t[std::size_t(next)] - t[std::size_t(k)], to = at - t[std::size_t(k)];
        const double length2 = glm::dot(along, along);
        const double share = length2 > 0 ? std::clamp(glm::dot(to, along) / length2, 0.0, 1.0) : 0;
        const glm::dvec2 off = to - share * along;
        if (!(glm::dot(off, off) < least)) continue;
        least = glm::dot(off, off);
        best = glm::dvec3(0);
        best[k] = 1 - share;
        best[next] = share;
    }
    return best;
}

/// Triangle of a chart in the atlas, which maps texels to surface points.
class PlacedTriangle {
public:
    PlacedTriangle(const LightMapLayout& layout, const LightMapChart& chart, const TriangleWs& corners,
                   std::uint8_t borders)
        : corners_(corners), normal_(unit_normal(corners[0], corners[1], corners[2])) {
        for (std::size_t k = 0; k < 3; ++k) at_[k] = layout.atlas_position(chart, corners_[k]);
        std::array<double, 3> lengths;  // sides opposite to the corners, in the atlas
        for (std::size_t k = 0; k < 3; ++k) lengths[k] = glm::length(at_[(k + 2) % 3] - at_[(k + 1) % 3]);
        const glm::dvec2 e1 = at_[1] - at_[0], e2 = at_[2] - at_[0];
        const double area2 = std::abs(e1.x * e2.y - e1.y * e2.x);
        const double in_radius = area2 / std::max(lengths[0] + lengths[1] + lengths[2], 1e-300);
        const double inset = std::min(kInset, 0.5 * in_radius);
        for (std::size_t k = 0; k < 3; ++k) {
            const double height = area2 / std::max(lengths[k], 1e-300);
            const double share = height > 0 ? inset / height : 0;
            const bool border = (borders >> ((k + 1) % 3) & 1) != 0;
            all_in_[int(k)] = share;
            borders_in_[int(k)] = border ? share : 0;
        }
        for (std::size_t k = 0; k < 3; ++k)
            edge_m_ = std::max(edge_m_, float(glm::distance(corners_[k], corners_[(k + 1) % 3])));
    }

    glm::dvec2 lo() const { return glm::min(at_[0], glm::min(at_[1], at_[2])); }
    glm::dvec2 hi() const { return glm::max(at_[0], glm::max(at_[1], at_[2])); }
    const glm::dvec3& normal() const { return normal_; }
    float edge_m() const { return edge_m_; }

    /// Returns the surface point for a texel with centre `at`.
    /// @param distance receives its distance in texels, plus kOutsideChartPenalty where the centre lies outside the
    /// triangle
    glm::dvec3 point(const glm::dvec2& at, double& distance) const {
        const glm::dvec3 own = nearest_shares(at_, at);
        const bool within = glm::distance(mixed(at_, own), at) < 1e-9;
        const glm::dvec3& in = within ? borders_in_ : all_in_;
        std::array<glm::dvec2, 3> inner;
        std::array<glm::dvec3, 3> shares;
        for (int k = 0; k < 3; ++k) {
            shares[std::size_t(k)] = in;
            shares[std::size_t(k)][k] = 1 - (in[0] + in[1] + in[2] - in[k]);
            inner[std::size_t(k)] = mixed(at_, shares[std::size_t(k)]);
        }
        const glm::dvec3 of_inner = nearest_shares(inner, at);
        const glm::dvec3 share = of_inner[0] * shares[0] + of_inner[1] * shares[1] + of_inner[2] * shares[2];
        distance = glm::distance(mixed(at_, share), at) + (within ? 0 : kOutsideChartPenalty);
        return share[0] * corners_[0] + share[1] * corners_[1] + share[2] * corners_[2];
    }

private:
    TriangleWs corners_;
    std::array<glm::dvec2, 3> at_;  ///< texels
    glm::dvec3 normal_;
    glm::dvec3 all_in_, borders_in_;  ///< least barycentric coordinates: inset from all sides, and from borders only
    float edge_m_ = 0;

    static glm::dvec2 mixed(const std::array<glm::dvec2, 3>& t, const glm::dvec3& share) {
        return share[0] * t[0] + share[1] * t[1] + share[2] * t[2];
    }
};

class Baker {
public:
    Baker(const LightMapTask& task, const LightMapLayout& layout, const ReferenceScene& scene)
        : task_(task), layout_(layout), scene_(scene) {
        query_.emitter = task.emitter;
        query_.traits.resize(task.geometry->objects.size());
        query_.options = {.area = task.samples > 1, .samples = task.samples, .noise = kNoise, .nearest = false};
        for (std::uint32_t c = 0; c < layout.charts.size(); ++c) {
            const glm::ivec4 r = layout.charts[c].rect;
            by_strip_.resize(std::max(by_strip_.size(), std::size_t((r.y + r.w - 1) / kStrip) + 1));
            for (int s = r.y / kStrip; s <= (r.y + r.w - 1) / kStrip; ++s) by_strip_[std::size_t(s)].push_back(c);
        }
    }

    void bake(LightMap& out, const Workers& workers) {
        out.texels.assign(std::size_t(layout_.side) * std::size_t(layout_.side), 255);
        for (std::size_t s = 0; s < by_strip_.size(); ++s) {
            const Workers part = workers.with_progress_range(double(s) / double(by_strip_.size()),
                                                             double(s + 1) / double(by_strip_.size()));
            const int y0 = int(s) * kStrip, rows = std::min(kStrip, layout_.side - y0);
            place(y0, rows, by_strip_[s], workers);
            const Reference reference = trace_visibility(scene_, receivers_, query_, part.with_progress_range(0.1, 1));
            out.rays += reference.rays;
            std::uint8_t* to = out.texels.data() + std::size_t(y0) * std::size_t(layout_.side);
            for (std::size_t i = 0; i < receivers_.pixels.size(); ++i)
                if (receivers_.pixels[i].hit()) to[i] = std::uint8_t(std::lround(reference.visibility.data[i] * 255));
        }
    }

private:
    const LightMapTask& task_;
    const LightMapLayout& layout_;
    const ReferenceScene& scene_;
    ReferenceQuery query_;
    std::vector<std::vector<std::uint32_t>> by_strip_;  ///< charts by strip of rows
    Receivers receivers_;
    std::vector<double> distances_;  ///< distance of each texel's best point so far, texels

    void place(int y0, int rows, const std::vector<std::uint32_t>& charts, const Workers& workers) {
        const std::size_t count = std::size_t(layout_.side) * std::size_t(rows);
        receivers_.width = layout_.side;
        receivers_.height = rows;
        receivers_.pixels.assign(count, {});
        receivers_.starts.assign(count, {});
        distances_.assign(count, std::numeric_limits<double>::infinity());
        // Charts share no texel.
        parallel_for_blocks(charts.size(), {.threads = workers.threads, .stop = workers.stop},
                            [&](std::size_t c) { place_chart(layout_.charts[charts[c]], y0, rows); });
        const UnitFrame frame = task_.geometry->unit_frame();
        parallel_for_blocks(std::size_t(rows), {.threads = workers.threads, .stop = workers.stop}, [&](std::size_t y) {
            for (std::size_t i = y * std::size_t(layout_.side); i < (y + 1) * std::size_t(layout_.side); ++i)
                if (const Receiver& r = receivers_.pixels[i]; r.hit())
                    receivers_.starts[i] = {ray_origin(frame, r), glm::vec3(r.normal_ws), r.object};
        });
    }

    void place_chart(const LightMapChart& chart, int y0, int rows) {
        const std::uint32_t first = layout_.objects[chart.object].first;
        const glm::ivec2 least(chart.rect.x, std::max(chart.rect.y, y0));
        const glm::ivec2 end(chart.rect.x + chart.rect.z, std::min(chart.rect.y + chart.rect.w, y0 + rows));
        for (std::uint32_t i = 0; i < chart.count; ++i) {
            const std::uint32_t t = layout_.triangles[chart.first + i];
            const PlacedTriangle triangle(layout_, chart, task_.geometry->triangle(chart.object, t),
                                          layout_.borders[first + t]);
            // Bilinear look-ups reach texels whose centres are less than one texel away.
            const glm::ivec2 from = glm::max(glm::ivec2(glm::floor(triangle.lo() - 1.5)), least);
            const glm::ivec2 to = glm::min(glm::ivec2(glm::ceil(triangle.hi() + 1.5)), end);
            for (int y = from.y; y < to.y; ++y)
                for (int x = from.x; x < to.x; ++x) {
                    const std::size_t at = std::size_t(y - y0) * std::size_t(layout_.side) + std::size_t(x);
                    double distance = 0;
                    const glm::dvec3 point = triangle.point({x + 0.5, y + 0.5}, distance);
                    if (!(distance < distances_[at])) continue;
                    distances_[at] = distance;
                    double unused = 0;
                    const glm::dvec3 to_light = task_.emitter.direction_from(point, unused);
                    Receiver& r = receivers_.pixels[at];
                    r.position_ws = point;
                    r.normal_ws = glm::dot(triangle.normal(), to_light) < 0 ? -triangle.normal() : triangle.normal();
                    r.edge_m = triangle.edge_m();
                    r.object = chart.object;
                    r.primitive = t;
                }
        }
    }
};

}  // namespace

std::uint64_t light_map_key(const Scene& scene, const Settings& settings, const std::vector<FittedLight>& lights,
                            int light) {
    if (light < 0 || std::size_t(light) >= lights.size()) return 0;
    const Emitter emitter = emitter_of(lights[std::size_t(light)], settings.lights[std::size_t(light)]);
    Key key = reference_geometry_key(scene, settings);
    add_emitter(key, emitter, samples_of(emitter, settings));
    return key.add(settings.light_map.resolution).value();
}

LightMapTask light_map_task(const Scene& scene, const Settings& settings, const FrameResult& frame, int light) {
    const auto i = std::size_t(std::max(light, 0));
    if (i >= frame.light_maps.size() || frame.light_maps[i].key == 0)
        throw Error(fmt::format("light {} has no light map: its light.source is another", light));
    const Emitter emitter = emitter_of(frame.lights[i], settings.lights[i]);
    return {ray_scenes().geometry(scene, settings), emitter, frame.light_maps[i].resolution,
            samples_of(emitter, settings), frame.light_maps[i].key};
}

std::uint64_t light_map_content_key(const LightMapTask& task) {
    Key key;
    key.add(kMethod).add(task.side);
    add_emitter(key, task.emitter, task.samples);
    task.geometry->add_content(key);
    return key.value();
}

LightMap bake_light_map(const LightMapTask& task, std::shared_ptr<const LightMapLayout> layout,
                        const ReferenceScene& scene, const Workers& workers) {
    LightMap out;
    out.key = task.key;
    out.version = next_version();
    out.layout = std::move(layout);
    Baker(task, *out.layout, scene).bake(out, workers);
    out.held = TrackedMemory("light maps", array_bytes(out.texels));
    return out;
}

}  // namespace si
