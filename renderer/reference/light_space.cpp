#include "renderer/reference/light_space.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "renderer/key.h"
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

/// Metres of all surfaces along the rays through the centres of a tile's texels, where they were asked for.
struct Tile {
    int view = 0, x = 0, y = 0;
    std::uint64_t wanted = 0, traced = 0;      ///< a bit per texel
    std::uint32_t first[kTile * kTile] = {};   ///< into `metres`, where traced
    std::uint16_t count[kTile * kTile] = {};
    std::vector<float> metres;                 ///< from where each ray enters the scene
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
    LightSpace(const TruthScene& scene, FittedLight light, int resolution)
        : scene_(scene.impl()), light_(std::move(light)), resolution_(resolution),
          radius_m_(scene_.radius / scene_.scale) {}

    std::size_t views() const { return light_.views.size(); }
    std::uint64_t rays() const { return rays_; }

    /// What was traced is dropped when it takes too much memory.
    void begin() {
        if (tiles_.size() > kMostTiles) tiles_.clear();
    }

    void want(int view, int x, int y) {
        const int tx = tile_of(x), ty = tile_of(y);
        Tile& tile = tiles_.try_emplace(tile_key(view, tx, ty)).first->second;
        tile.view = view, tile.x = tx, tile.y = ty;
        const std::uint64_t bit = std::uint64_t{1} << within(tile, x, y);
        if (tile.wanted == tile.traced && !(tile.traced & bit)) waiting_.push_back(&tile);
        tile.wanted |= bit;
    }

    void trace(const Workers& workers) {
        const std::vector<Tile*> all = std::exchange(waiting_, {});
        try {
            for_blocks(all.size(), workers, [&](std::size_t i) { trace(*all[i]); });
        } catch (...) {
            for (Tile* tile : all) tile->wanted = tile->traced;
            throw;
        }
    }

    /// Whether the surface that stands for the receiver at a texel's centre is lit.
    bool lit(int view, int x, int y, const Receiver& receiver) const {
        const TexelRay ray = texel_ray(light_.views[std::size_t(view)], glm::dvec2(x + 0.5, y + 0.5), resolution_);
        const Tile& tile = tiles_.at(tile_key(view, tile_of(x), tile_of(y)));
        const std::size_t texel = within(tile, x, y);
        const std::uint32_t begin = tile.first[texel], end = begin + tile.count[texel];
        const double plane = glm::dot(receiver.position_ws - ray.origin, receiver.normal_ws) /
                                 glm::dot(ray.direction, receiver.normal_ws) -
                             start_of(ray, view);
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
    static constexpr std::size_t kMostTiles = 400'000;  ///< kept from one search to the next; about 1 kB each
    const TruthScene::Impl& scene_;
    FittedLight light_;
    int resolution_;
    double radius_m_;
    std::unordered_map<TileKey, Tile> tiles_;
    std::vector<Tile*> waiting_;
    std::atomic<std::uint64_t> rays_{0};

    static std::size_t within(const Tile& tile, int x, int y) {
        return std::size_t((y - tile.y * kTile) * kTile + (x - tile.x * kTile));
    }

    /// Metres along a texel's ray to where it enters the sphere around the scene, so that no digits are lost on the way.
    double start_of(const TexelRay& ray, int view) const {
        const double start = glm::dot(scene_.centre - ray.origin, ray.direction) - 1.01 * radius_m_;
        return light_.views[std::size_t(view)].curve.perspective ? std::max(start, 0.0) : start;
    }

    void trace(Tile& tile) {
        thread_local std::vector<float> hits;
        for (std::size_t texel = 0; texel < kTile * kTile; ++texel) {
            const std::uint64_t bit = std::uint64_t{1} << texel;
            if (!(tile.wanted & bit) || (tile.traced & bit)) continue;
            const glm::dvec2 centre(tile.x * kTile + int(texel % kTile) + 0.5, tile.y * kTile + int(texel / kTile) + 0.5);
            const TexelRay ray = texel_ray(light_.views[std::size_t(tile.view)], centre, resolution_);
            const glm::vec3 origin(scene_.to_unit(ray.origin + start_of(ray, tile.view) * ray.direction));
            all_hits(scene_, make_ray(origin, glm::vec3(ray.direction), std::numeric_limits<float>::infinity(), 0), {},
                     hits);
            hits.resize(std::min<std::size_t>(hits.size(), 0xffff));
            tile.first[texel] = std::uint32_t(tile.metres.size());
            tile.count[texel] = std::uint16_t(hits.size());
            for (const float t : hits) tile.metres.push_back(float(t / scene_.scale));
            tile.traced |= bit;
            ++rays_;
        }
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
    // Rounded up, so that a distance within the reach stays so.
    const double distance = std::max(off.x, off.y);
    const float rounded = float(distance);
    return rounded < distance ? std::nextafter(rounded, std::numeric_limits<float>::infinity()) : rounded;
}

}  // namespace

std::uint64_t texel_rays_key(const FittedLight& light, int map_resolution) {
    Key key;
    key.add(map_resolution);
    for (const LightView& v : light.views) key.add(v.eye).add(v.axes).add(v.half_width).add(v.curve.perspective);
    return key.value();
}

struct EdgeFinder::Impl {
    LightSpace space;
    Impl(const TruthScene& scene, const FittedLight& light, int resolution) : space(scene, light, resolution) {}
};

EdgeFinder::EdgeFinder(const TruthScene& scene, const FittedLight& light, int map_resolution)
    : impl_(std::make_unique<Impl>(scene, light, map_resolution)) {}
EdgeFinder::~EdgeFinder() = default;

std::uint64_t EdgeFinder::rays() const {
    return impl_->space.rays();
}

void EdgeFinder::find(const Receivers& receivers, const Truth& truth, double reach_texels,
                      std::span<const Footprint> footprints, EdgeImage& facts, const Workers& workers) {
    const double reach = reach_texels + 1;
    LightSpace& space = impl_->space;
    space.begin();
    std::vector<std::uint32_t> asked;
    for (std::size_t i = 0; i < footprints.size(); ++i) {
        const Footprint& f = footprints[i];
        if (f.view < 0 || std::size_t(f.view) >= space.views() || !std::isfinite(f.centre.x + f.centre.y)) continue;
        if (double(facts[i].searched) >= reach) continue;
        asked.push_back(std::uint32_t(i));
        const TexelRange r = texels_of(f, reach);
        for (int y = r.y0; y <= r.y1; ++y)
            for (int x = r.x0; x <= r.x1; ++x) space.want(f.view, x, y);
    }
    space.trace(workers.part(0, 0.8));
    constexpr std::size_t kBlock = 256;
    for_blocks((asked.size() + kBlock - 1) / kBlock, workers.part(0.8, 1), [&](std::size_t block) {
        for (std::size_t k = block * kBlock; k < std::min(asked.size(), (block + 1) * kBlock); ++k) {
            const std::uint32_t i = asked[k];
            const Footprint& f = footprints[i];
            const bool own = truth.hard().data[i] >= 0.5f;
            const TexelRange r = texels_of(f, reach);
            EdgeFact fact{std::numeric_limits<float>::infinity(), float(reach)};
            for (int y = r.y0; y <= r.y1; ++y)
                for (int x = r.x0; x <= r.x1; ++x) {
                    const float distance = distance_from(f, x, y);
                    if (distance < fact.texels && space.lit(f.view, x, y, receivers.pixels[i]) != own)
                        fact.texels = distance;
                }
            facts[i] = fact;
        }
    });
}

std::vector<float> edge_distances(const TruthScene& scene, const Receivers& receivers, const Truth& truth,
                                  const FittedLight& light, int map_resolution, double reach_texels,
                                  const std::vector<Footprint>& footprints, const Workers& workers) {
    EdgeFinder finder(scene, light, map_resolution);
    EdgeImage facts(footprints.size(), kUnknownEdge);
    finder.find(receivers, truth, reach_texels, footprints, facts, workers);
    std::vector<float> out(facts.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = facts[i].texels;
    return out;
}

}  // namespace si
