#include "renderer/bundle/given_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "renderer/base/error.h"
#include "renderer/base/key.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/bundle/map_image.h"
#include "renderer/projection/camera_of_matrix.h"
#include "renderer/projection/view_of_matrix.h"
#include "renderer/scene/axes.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxImageBytes = std::size_t{2} << 30;
constexpr std::size_t kMaxTexels = std::size_t{1} << 29;  // of all maps of a bundle

/// Largest relative difference between a stated number and the one that follows from the matrix.
constexpr double kAgreement = 1e-6;

/// Settings of the bias of a look-up that have amounts.
constexpr std::string_view kBiasKeys[] = {"bias.kind", "bias.unit", "bias.constant", "bias.slope", "bias.normal"};

bool agrees(double stated, double derived, double scale) {
    return std::abs(stated - derived) <= kAgreement * scale;
}

/// Takes axes, place and projection as they were written, without rounding by the product of matrices, where they are
/// those of `view` and in its normal form.
void take_exact_parts(const BundleMap& map, LightView& view) {
    if (!map.clip.world_from_view || !map.clip.projection) return;
    const glm::dmat4 &pose = *map.clip.world_from_view, &projection = *map.clip.projection;
    const glm::dmat3 axes(pose);
    const glm::dvec3 eye(pose[3]);
    if (glm::transpose(pose)[3] != glm::dvec4(0, 0, 0, 1)) return;
    if (view.curve.perspective ? projection[2][3] != -1 : projection[3][3] != 1) return;
    // Across parallel rays any axes do: the projection counts along them.
    if (glm::length(axes[2] - view.axes[2]) > kAgreement || !(glm::determinant(axes) > 0)) return;
    const glm::dmat3 product = glm::transpose(axes) * axes;
    for (int i = 0; i < 3; ++i) {
        if (glm::length(product[i] - glm::dmat3(1)[i]) > kAgreement) return;
        if (view.curve.perspective && glm::length(axes[i] - view.axes[i]) > kAgreement) return;
    }
    const double range = view.curve.far - view.curve.near;
    // The eye of parallel rays is any point: the projection counts from it.
    if (view.curve.perspective && glm::distance(eye, view.eye) > kAgreement * (range + glm::length(eye))) return;
    const double along = glm::dot(eye - view.eye, view.axes[2]);
    const double moved = view.curve.perspective ? 0 : along;
    view.eye = eye;
    view.axes = axes;
    view.projection = projection;
    view.curve.near += moved;
    view.curve.far += moved;
    if (const auto& planes = map.depth.planes_m)
        if (agrees((*planes)[0], view.curve.near, range) && agrees((*planes)[1], view.curve.far, range)) {
            view.curve.near = (*planes)[0];
            view.curve.far = (*planes)[1];
        }
    if (!view.curve.warp) return;
    view.curve.warp->middle_m += moved;
    const DepthWarp& own = *view.curve.warp;
    if (const auto& given = map.depth.warp)
        if (agrees(given->middle_m + given->near_m, own.middle_m + own.near_m, range) &&
            agrees(given->middle_m + given->far_m, own.middle_m + own.far_m, range) && agrees(given->rise, own.rise, 1))
            view.curve.warp = given;
}

/// Returns the part of an image that is the map, one channel, top row first.
FloatImage cut(const BundleMap& map, const FloatImage& image) {
    const BundleRegion region = map.region.value_or(BundleRegion{0, 0, image.width, image.height});
    if (region.x > image.width - region.width || region.y > image.height - region.height)
        throw Error(fmt::format("the region {}, {}, {}, {} exceeds the image of {} × {} texels; correct the region",
                                region.x, region.y, region.width, region.height, image.width, image.height));
    if (map.image.channel >= image.channels)
        throw Error(
            fmt::format("channel {} is read, and the image has {}; count from 0", map.image.channel, image.channels));
    const bool bottom_first = first_row_of(map.image) == FirstRow::Bottom;
    FloatImage out{region.width, region.height, 1, {}};
    out.data.resize(std::size_t(region.width) * std::size_t(region.height));
    for (int y = 0; y < region.height; ++y) {
        const int row = region.y + (bottom_first ? region.height - 1 - y : y);
        for (int x = 0; x < region.width; ++x)
            out.data[std::size_t(y) * std::size_t(region.width) + std::size_t(x)] =
                image.at(region.x + x, row, map.image.channel);
    }
    return out;
}

/// Returns the image of a map with its columns as rows, top row first. @param image decoded image of BundleMap::image
FloatImage turned_image(const BundleMap& map, const FloatImage& image) {
    const FloatImage from = cut(map, image);
    FloatImage out{from.height, from.width, 1, {}};
    out.data.reserve(from.data.size());
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) out.data.push_back(from.at(from.width - 1 - y, from.height - 1 - x));
    return out;
}

/// Returns the map of turned_image(), in which a w that changes by column changes by row.
BundleMap turned_map(const BundleMap& map) {
    BundleMap out = map;
    out.image = {.file = map.image.file, .first_row = FirstRow::Top};
    out.region.reset();
    out.depth.warp.reset();
    const glm::dmat4 m = map.clip.matrix();
    out.clip = {};
    out.clip.clip_from_world = m;
    for (int column = 0; column < 4; ++column)
        std::swap((*out.clip.clip_from_world)[column].x, (*out.clip.clip_from_world)[column].y);
    return out;
}

/// Converter of stored values of one row of a map to depth-buffer values.
class StoredDepth {
public:
    StoredDepth(const BundleDepth& depth, const DepthCurve& curve) : depth_(depth), curve_(curve) {}

    /// @param ray length of the ray to the texel for one metre along the axis
    double value(double stored, double ray) const {
        switch (depth_.stored) {
            case BundleStored::Depth:
                return stored;
            case BundleStored::Linear:
            case BundleStored::Moments:
                return at_share(stored);
            case BundleStored::Exponential:
                return at_share(std::log(stored) / *depth_.exponent);
            case BundleStored::AxisMetres:
                return at_metres(stored);
            case BundleStored::DistanceMetres:
                return at_metres(stored / ray);
            case BundleStored::DistanceShare:
                return at_metres(stored * *depth_.range_m / ray);
        }
        return stored;
    }

private:
    double at_share(double share) const { return at_metres(curve_.near + share * (curve_.far - curve_.near)); }
    double at_metres(double z) const {
        // Behind the eye depth has no meaning.
        if (curve_.perspective && z <= 0) return curve_.convention.reversed ? 2 : -1;
        return z == INFINITY ? curve_.convention.reversed ? -1 : 2 : curve_.depth(z);
    }
    const BundleDepth& depth_;
    const DepthCurve& curve_;
};

/// Returns the raster state of a light's maps; empty where nothing of it is known. @param turned see turned_map()
std::vector<CasterRaster> raster_of(const BundleLight& light, const std::vector<LightView>& views, bool turned) {
    std::vector<CasterRaster> out;
    bool any = false;
    for (std::size_t i = 0; i < light.maps.size(); ++i) {
        const BundleRaster& state = light.maps[i].raster;
        any |= !(state == BundleRaster{});
        CasterRaster& raster = out.emplace_back();
        raster.offset_factor = state.offset_factor.value_or(0);
        raster.offset_units = state.offset_units.value_or(0);
        raster.offset_clamp = state.offset_clamp.value_or(0);
        if (state.cull) raster.cull = culled_faces(*state.cull, (state.front == BundleFront::Cw) != turned, views[i]);
    }
    return any ? out : std::vector<CasterRaster>();
}

/// Checks that a directional light shines along the rays of its map: reversed depth turns parallel rays around.
void check_direction(const BundleWorld& world, const BundleLight& light, const LightView& view) {
    if (!light.direction || light.type != LightType::Directional) return;
    if (glm::dot(glm::dmat3(world_from_engine(world)) * *light.direction, view.axes[2]) > 0)
        throw Error("the map looks against the light's direction; correct depth.reversed, the matrix or the direction");
}

}  // namespace

glm::dmat4 world_from_engine(const BundleWorld& world) {
    glm::dmat3 turn = y_up_from(world.up);
    // A mirror that keeps y up.
    if (world.left_handed) turn = glm::dmat3({1, 0, 0}, {0, 1, 0}, {0, 0, -1}) * turn;
    const glm::dmat3 linear = world.metres_per_unit * turn;
    glm::dmat4 out(linear);
    out[3] = glm::dvec4(linear * world.origin, 1);
    return out;
}

LightView view_of_map(const BundleWorld& world, const BundleMap& map) {
    const glm::dmat4 change = world_from_engine(world);
    const bool is_ours = change == glm::dmat4(1);
    const glm::dmat4 clip = is_ours ? map.clip.matrix() : map.clip.matrix() * glm::inverse(change);
    LightView view = view_of_matrix(clip, map.depth.convention);
    if (is_ours) take_exact_parts(map, view);
    view.clamps_near = map.raster.depth_clamp.value_or(false);
    view.caster_shift = {map.raster.shift_m.value_or(0), map.raster.grazing_shift_m.value_or(0)};
    return view;
}

MapDepths depths_of_map(const BundleMap& map, const LightView& view, const FloatImage& image) {
    MapDepths out{cut(map, image)};
    FloatImage& depths = out.depths;
    const float far = float(view.curve.convention.far_depth());
    const std::optional<float> clear = map.depth.clear ? std::optional(float(*map.depth.clear)) : std::nullopt;
    const BundleStored stored = map.depth.stored;
    const bool needs_rays =
        view.curve.perspective && (stored == BundleStored::DistanceMetres || stored == BundleStored::DistanceShare);
    constexpr double kRounding = 1e-6;
    for (int y = 0; y < depths.height; ++y) {
        const double v = 1 - (y + 0.5) / depths.height;
        const DepthCurve curve = view.curve.curve_at_row(v);
        const StoredDepth depth_of(map.depth, curve);
        for (int x = 0; x < depths.width; ++x) {
            float& texel = depths.data[std::size_t(y) * std::size_t(depths.width) + std::size_t(x)];
            if (clear && texel == *clear) {
                texel = far;
                continue;
            }
            if (std::isnan(texel)) {
                ++out.not_a_number;
                texel = far;
                continue;
            }
            if (stored == BundleStored::Depth && texel >= 0 && texel <= 1) continue;
            const double ray =
                needs_rays ? glm::distance(view.position_ws({(x + 0.5) / depths.width, v}, 1), view.eye) : 1;
            const double depth = depth_of.value(texel, ray);
            // The far plane itself is no fault: it is where no caster is.
            const double beyond_near = curve.convention.reversed ? depth - 1 : -depth;
            const double beyond_far = curve.convention.reversed ? -depth : depth - 1;
            if (std::isnan(depth) || beyond_near > kRounding ||
                (stored == BundleStored::Depth && beyond_far > kRounding))
                ++out.outside_range;
            texel = std::isnan(depth) ? far : float(std::clamp(depth, 0.0, 1.0));
        }
    }
    return out;
}

ViewChooser chooser_of(const Bundle& bundle, const BundleLight& light, const std::vector<LightView>& views) {
    ViewChooser out;
    out.choice = choice_of(light);
    if (out.choice == ViewChoice::Face) out.from_ws = views.front().eye;
    if (bundle.camera && (out.choice == ViewChoice::Interval || out.choice == ViewChoice::Map)) {
        const BundleMatrix& clip = bundle.camera->clip;
        const glm::dmat4 change = world_from_engine(bundle.world);
        const MatrixCamera camera = camera_of_matrix(clip.matrix() * glm::inverse(change), bundle.camera->depth);
        out.from_ws = camera.eye;
        out.forward = -camera.axes[2];
        // A product of matrices rounds.
        if (clip.world_from_view && change == glm::dmat4(1)) {
            const glm::dmat4& pose = *clip.world_from_view;
            if (glm::distance(glm::dvec3(pose[3]), camera.eye) <= kAgreement * (1 + glm::length(camera.eye)) &&
                glm::distance(glm::dvec3(pose[2]), camera.axes[2]) <= kAgreement) {
                out.from_ws = glm::dvec3(pose[3]);
                out.forward = -glm::dvec3(pose[2]);
            }
        }
    }
    const std::size_t count = light.maps.size();
    for (std::size_t i = 0; i < count; ++i) {
        const BundleMap& map = light.maps[i];
        if (out.choice == ViewChoice::Map) {
            const std::array<double, 2> edge = map.edge.value_or(std::array{0.5, 0.5});
            out.spans.push_back({edge[1], edge[0]});
        }
        if (out.choice != ViewChoice::Interval) continue;
        const double ends = (*map.interval)[1];
        const double next = i + 1 < count ? (*light.maps[i + 1].interval)[0] : ends;
        out.spans.push_back({ends, std::clamp(next, (*map.interval)[0], ends)});
    }
    return out;
}

std::vector<std::pair<std::string_view, std::string>> normal_offset_settings(const BundleBias& bias) {
    if (!bias.normal) return {};
    if (*bias.normal == 0) return {{"bias.normal", "0"}};
    if (bias.units[2] == BiasUnit::Depth) return {};
    return {{"bias.normal_unit", bias.units[2] == BiasUnit::Texels ? "texels" : "metres"},
            {"bias.normal_by", value_text(*find_setting("bias.normal_by")->param, int(bias.normal_by))},
            {"bias.normal", fmt::format("{}", *bias.normal)}};
}

bool settings_state_bias(const Bundle& bundle) {
    return std::ranges::all_of(kBiasKeys,
                               [&](std::string_view key) { return bundle.settings.contains(std::string(key)); });
}

std::optional<BiasSettings> stated_bias(const Bundle& bundle, const BundleLight& light) {
    Settings settings;
    try {
        if (!settings_state_bias(bundle)) {
            const BundleBias& bias = light.lookup.bias;
            if (!bias.constant || !bias.slope || !bias.normal || bias.units[0] != bias.units[1]) return std::nullopt;
            const auto normal = normal_offset_settings(bias);
            if (normal.empty()) return std::nullopt;
            set_setting(settings, "bias.kind", "slope");
            settings.bias.unit = bias.units[0];
            set_setting(settings, "bias.constant", fmt::format("{}", *bias.constant));
            set_setting(settings, "bias.slope", fmt::format("{}", *bias.slope));
            for (const auto& [key, value] : normal) set_setting(settings, key, value);
        }
        for (const auto& [key, value] : bundle.settings)
            if (key.starts_with("bias.") && !key.starts_with("bias.raster_")) set_setting(settings, key, value);
    } catch (const UsageError&) {
        return std::nullopt;  // amounts beyond the limits of bias.*
    }
    return settings.bias;
}

Bundle read_bundle(BundleFiles& files) {
    const std::vector<std::byte> text = files.read(kFrameJson, kMaxFrameJsonBytes);
    return parse_bundle({reinterpret_cast<const char*>(text.data()), text.size()}, files.label(kFrameJson));
}

GivenMaps read_given_maps(BundleFiles& files) {
    GivenMaps out;
    out.bundle = read_bundle(files);
    const std::string file = files.label(kFrameJson);
    // An atlas is decoded once while consecutive maps read it.
    std::pair<BundleImage, FloatImage> last;
    const auto image_of = [&](const BundleImage& image) -> const FloatImage& {
        BundleImage same = image;  // whichever channel and row order is read
        same.channel = 0;
        same.first_row.reset();
        if (last.first == same) return last.second;
        last = {};
        const std::vector<std::byte> bytes = files.read(image.file, kMaxImageBytes);
        last.second =
            decode_map_image(files.label(image.file), bytes, {image.width, image.height, image.channels, image.format});
        last.first = same;
        if ((image.width && image.width != last.second.width) || (image.height && image.height != last.second.height))
            throw Error(fmt::format("{}: the image has {} × {} texels and frame.json states {} × {}; correct one",
                                    files.label(image.file), last.second.width, last.second.height, image.width,
                                    image.height));
        return last.second;
    };
    std::optional<MapSize> size;
    std::size_t texels = 0;
    for (std::size_t l = 0; l < out.bundle.lights.size(); ++l) {
        const BundleLight& light = out.bundle.lights[l];
        if (light.maps.empty()) {
            out.lights.push_back(nullptr);
            continue;
        }
        std::vector<FloatImage> images;
        ImportedViews views;
        const bool turned = std::ranges::all_of(
            light.maps, [](const BundleMap& map) { return is_warped_by_column(map.clip.matrix()); });
        if (turned)
            out.notes.push_back(fmt::format(
                "{}: lights[{}]: w changes from column to column of its maps; their rows and columns are exchanged",
                file, l));
        for (std::size_t m = 0; m < light.maps.size(); ++m) {
            const std::string place = fmt::format("{}: lights[{}].maps[{}]", file, l, m);
            const FloatImage& image = image_of(light.maps[m].image);
            try {
                const BundleMap map = turned ? turned_map(light.maps[m]) : light.maps[m];
                views.views.push_back(view_of_map(out.bundle.world, map));
                check_direction(out.bundle.world, light, views.views.back());
                MapDepths depths = turned ? depths_of_map(map, views.views.back(), turned_image(light.maps[m], image))
                                          : depths_of_map(map, views.views.back(), image);
                const MapSize own(depths.depths.width, depths.depths.height);
                if (size && !(*size == own))
                    throw Error(
                        fmt::format("the map has {} × {} texels and the first one {} × {}; give maps of one "
                                    "size, or lights of other sizes in bundles of their own",
                                    own.width, own.height, size->width, size->height));
                size = own;
                texels += depths.depths.data.size();
                if (texels > kMaxTexels)
                    throw Error(fmt::format("the maps have more than {} texels; leave some out", kMaxTexels));
                if (depths.not_a_number)
                    out.notes.push_back(fmt::format("{}: {} texels are no numbers; they are read as the far plane",
                                                    place, depths.not_a_number));
                if (depths.outside_range)
                    out.notes.push_back(
                        fmt::format("{}: {} texels lie outside the depth range; check depth.stored and depth.range",
                                    place, depths.outside_range));
                images.push_back(std::move(depths.depths));
            } catch (const Error& error) {
                throw Error(fmt::format("{}: {}", place, error.what()));
            }
            if (views.views.back().curve.perspective != views.views.front().curve.perspective)
                throw Error(fmt::format("{}: its rays {} parallel and those of the first map {}; split the light",
                                        place, views.views.back().curve.perspective ? "are not" : "are",
                                        views.views.front().curve.perspective ? "are not" : "are"));
        }
        views.closed = light.closed;
        try {
            views.chooser = chooser_of(out.bundle, light, views.views);
        } catch (const Error& error) {
            throw Error(fmt::format("{}: camera: {}", file, error.what()));
        }
        std::vector<CasterRaster> raster = raster_of(light, views.views, turned);
        const std::optional<BiasSettings> bias = stated_bias(out.bundle, light);
        ImportedMaps maps = *imported_maps(std::move(images), std::move(views), std::move(raster), bias.has_value());
        maps.bias = bias;
        for (const BundleMap& map : light.maps) maps.drawn.push_back(map.drawn);
        out.lights.push_back(std::make_shared<const ImportedMaps>(std::move(maps)));
    }
    out.files = files.files_read();
    return out;
}

std::shared_ptr<const GivenMaps> given_maps(const fs::path& path) {
    constexpr std::size_t kKept = 4;
    static std::mutex mutex;
    static std::vector<std::pair<fs::path, std::shared_ptr<const GivenMaps>>> kept;  // the last used comes last
    const std::lock_guard lock(mutex);
    std::error_code ignored;
    const fs::path place = fs::absolute(path, ignored).lexically_normal();
    const auto found = std::ranges::find(kept, place, [](const auto& entry) { return entry.first; });
    if (found != kept.end()) {
        const auto is_current = [](const StampedFile& file) {
            return file.stamp && file.stamp == file_stamp(file.path);
        };
        const auto maps = found->second;
        kept.erase(found);
        if (std::ranges::all_of(maps->files, is_current)) {
            kept.emplace_back(place, maps);
            return maps;
        }
    }
    BundleFiles files(path);
    auto maps = std::make_shared<const GivenMaps>(read_given_maps(files));
    if (kept.size() >= kKept) kept.erase(kept.begin());
    kept.emplace_back(place, maps);
    return maps;
}

EngineBias engine_bias_of_light(const Settings& settings, int light) {
    if (settings.map.bundle.empty() || settings.map.bundle_maps == BundleMaps::Drawn) return EngineBias::Own;
    const auto maps = given_maps(settings.map.bundle);
    const auto i = std::size_t(std::max(light, 0));
    return i < maps->lights.size() ? engine_bias(maps->lights[i].get(), settings) : EngineBias::Own;
}

std::shared_ptr<const ImportedMaps> placed_maps(const std::shared_ptr<const ImportedMaps>& maps,
                                                const glm::dmat4& placement) {
    if (!maps || !maps->views || placement == glm::dmat4(1)) return maps;
    auto out = std::make_shared<ImportedMaps>(*maps);
    const double scale = glm::length(glm::dvec3(placement[0]));
    for (LightView& view : out->views->views) {
        if (scale == 1) {
            view.eye = glm::dvec3(placement * glm::dvec4(view.eye, 1));
            view.axes = glm::dmat3(placement) * view.axes;
            continue;
        }
        const bool clamps = view.clamps_near;
        const CasterShift shift = view.caster_shift;
        view = view_of_matrix(view.clip_from_relative(glm::dvec3(0)) * glm::inverse(placement), view.curve.convention);
        view.clamps_near = clamps;
        view.caster_shift = {scale * shift.all_m, scale * shift.grazing_m};
    }
    ViewChooser& chooser = out->views->chooser;
    chooser.from_ws = glm::dvec3(placement * glm::dvec4(chooser.from_ws, 1));
    chooser.forward = glm::dmat3(placement) * chooser.forward / scale;
    if (chooser.choice == ViewChoice::Interval)
        for (ViewSpan& span : chooser.spans) span = {span.ends * scale, span.blends_from * scale};
    Key key;
    key.add(maps->key).add(placement);
    out->key = key.value();
    return out;
}

}  // namespace si
