#include "renderer/reference/light_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "renderer/reference/truth_rays.h"

namespace si {
namespace {

constexpr int kTile = 8;             ///< texels a side
constexpr double kFarthest = 24;     ///< texels that a footprint is stretched at most
constexpr double kTolerance = 1e-5;  ///< of the scene's radius: surfaces nearer to each other count as one

struct TexelRay {
    glm::dvec3 origin{0}, direction{0};  ///< metres, unit
};

/// The light's ray through a point of a map, given in texels.
TexelRay texel_ray(const LightView& view, const glm::dvec2& texel, int resolution) {
    const glm::dvec2 at = (2.0 * texel / double(resolution) - 1.0) * view.half_width;
    if (view.curve.perspective) return {view.eye, glm::normalize(view.axes * glm::dvec3(at, -1))};
    return {view.eye + view.axes * glm::dvec3(at, 0), -view.axes[2]};
}

/// Metres of all surfaces along the rays through the centres of a tile's texels.
struct Tile {
    std::vector<std::uint32_t> first;  ///< per texel, and the end
    std::vector<float> metres;         ///< from `start`
    std::vector<double> start;         ///< per texel: metres from the ray's origin to where the scene begins
};

using TileKey = std::uint64_t;
TileKey tile_key(int view, int x, int y) {
    const auto half = [](int v) { return std::uint64_t(std::uint32_t(v)) & 0x0fffffffu; };
    return std::uint64_t(view) << 56 | half(y) << 28 | half(x);
}
int tile_of(int texel) {
    return int(std::floor(double(texel) / kTile));
}

class LightSpace {
public:
    LightSpace(const TruthScene& scene, const FittedLight& light, int resolution)
        : scene_(scene.impl()), light_(light), resolution_(resolution),
          radius_m_(scene_.radius / scene_.scale) {}

    void want(int view, int x, int y) { tiles_.try_emplace(tile_key(view, x, y), Wanted{view, x, y, {}}); }

    void trace(const Workers& workers) {
        std::vector<Wanted*> all;
        for (auto& [key, wanted] : tiles_) all.push_back(&wanted);
        for_blocks(all.size(), workers, [&](std::size_t i) { all[i]->tile = traced(*all[i]); });
    }

    /// Whether the surface that stands for the receiver at a texel's centre is lit.
    bool lit(int view, int x, int y, const Receiver& receiver) const {
        const LightView& v = light_.views[std::size_t(view)];
        const TexelRay ray = texel_ray(v, glm::dvec2(x + 0.5, y + 0.5), resolution_);
        const Tile& tile = tiles_.at(tile_key(view, tile_of(x), tile_of(y))).tile;
        const auto texel = std::size_t((y - tile_of(y) * kTile) * kTile + (x - tile_of(x) * kTile));
        const std::uint32_t begin = tile.first[texel], end = tile.first[texel + 1];
        const double plane = glm::dot(receiver.position_ws - ray.origin, receiver.normal_ws) /
                                 glm::dot(ray.direction, receiver.normal_ws) -
                             tile.start[texel];
        double first = std::numeric_limits<double>::infinity(), own = first, least = first;
        // What does not cast is not met; its plane stands for it.
        if (!scene_.geometry->objects[receiver.object].casts) own = plane, least = 0;
        for (std::uint32_t i = begin; i < end; ++i) {
            const double t = tile.metres[i], off = std::abs(t - plane);
            first = std::min(first, t);
            if (off < least) least = off, own = t;
        }
        return own <= first + kTolerance * radius_m_;  // nothing met: nothing darkens
    }

private:
    struct Wanted {
        int view, x, y;
        Tile tile;
    };
    const TruthScene::Impl& scene_;
    const FittedLight& light_;
    int resolution_;
    double radius_m_;
    std::unordered_map<TileKey, Wanted> tiles_;

    Tile traced(const Wanted& wanted) const {
        Tile tile;
        std::vector<float> hits;
        const LightView& view = light_.views[std::size_t(wanted.view)];
        for (int y = 0; y < kTile; ++y)
            for (int x = 0; x < kTile; ++x) {
                const glm::dvec2 centre(wanted.x * kTile + x + 0.5, wanted.y * kTile + y + 0.5);
                const TexelRay ray = texel_ray(view, centre, resolution_);
                // From where the ray enters the sphere around the scene, so that no digits are lost on the way there.
                const double middle = glm::dot(scene_.centre - ray.origin, ray.direction);
                double start = middle - 1.01 * radius_m_;
                if (view.curve.perspective) start = std::max(start, 0.0);
                const glm::vec3 origin(scene_.to_unit(ray.origin + start * ray.direction));
                all_hits(scene_, make_ray(origin, glm::vec3(ray.direction), std::numeric_limits<float>::infinity(), 0),
                         {}, hits);
                tile.first.push_back(std::uint32_t(tile.metres.size()));
                tile.start.push_back(start);
                for (const float t : hits) tile.metres.push_back(float(t / scene_.scale));
            }
        tile.first.push_back(std::uint32_t(tile.metres.size()));
        return tile;
    }
};

/// Texels whose centres lie within `reach` of the footprint.
struct TexelRange {
    int x0, y0, x1, y1;
};

TexelRange texels_of(const Footprint& f, double reach) {
    const glm::dvec2 own = glm::clamp(f.own, f.centre - kFarthest, f.centre + kFarthest);
    const glm::dvec2 lo = glm::min(f.centre, own) - reach, hi = glm::max(f.centre, own) + reach;
    return {int(std::ceil(lo.x - 0.5)), int(std::ceil(lo.y - 0.5)), int(std::floor(hi.x - 0.5)),
            int(std::floor(hi.y - 0.5))};
}

/// How far a texel's centre lies off the footprint's stretched middle, per axis at most.
float distance_from(const Footprint& f, int x, int y) {
    const glm::dvec2 at(x + 0.5, y + 0.5);
    const glm::dvec2 off = glm::max(glm::max(glm::min(f.centre, f.own) - at, at - glm::max(f.centre, f.own)), 0.0);
    return float(std::max(off.x, off.y));
}

}  // namespace

std::vector<float> edge_distances(const TruthScene& scene, const Receivers& receivers, const Truth& truth,
                                  const FittedLight& light, int map_resolution, double reach_texels,
                                  const std::vector<Footprint>& footprints, const Workers& workers) {
    const double reach = reach_texels + 1;
    LightSpace space(scene, light, map_resolution);
    std::vector<std::uint32_t> asked;
    for (std::size_t i = 0; i < footprints.size(); ++i) {
        const Footprint& f = footprints[i];
        if (f.view < 0 || std::size_t(f.view) >= light.views.size() || !std::isfinite(f.centre.x + f.centre.y)) continue;
        asked.push_back(std::uint32_t(i));
        const TexelRange r = texels_of(f, reach);
        for (int y = tile_of(r.y0); y <= tile_of(r.y1); ++y)
            for (int x = tile_of(r.x0); x <= tile_of(r.x1); ++x) space.want(f.view, x, y);
    }
    space.trace(workers.part(0, 0.8));
    std::vector<float> out(footprints.size(), std::numeric_limits<float>::infinity());
    constexpr std::size_t kBlock = 256;
    for_blocks((asked.size() + kBlock - 1) / kBlock, workers.part(0.8, 1), [&](std::size_t block) {
        for (std::size_t k = block * kBlock; k < std::min(asked.size(), (block + 1) * kBlock); ++k) {
            const std::uint32_t i = asked[k];
            const Footprint& f = footprints[i];
            const bool own = truth.hard().data[i] >= 0.5f;
            const TexelRange r = texels_of(f, reach);
            for (int y = r.y0; y <= r.y1; ++y)
                for (int x = r.x0; x <= r.x1; ++x) {
                    const float distance = distance_from(f, x, y);
                    if (distance < out[i] && space.lit(f.view, x, y, receivers.pixels[i]) != own) out[i] = distance;
                }
        }
    });
    return out;
}

}  // namespace si
