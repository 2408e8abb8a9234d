#include "renderer/bundle/imported_maps.h"

#include <fmt/format.h>

#include <utility>

#include "renderer/base/error.h"
#include "renderer/base/key.h"
#include "renderer/projection/view_of_matrix.h"

namespace si {
namespace {

void add_view(Key& key, const LightView& view) {
    key.add(view.eye).add(view.axes[0]).add(view.axes[1]).add(view.axes[2]);
    for (int column = 0; column < 4; ++column) key.add(view.projection[column]);
    key.add(view.curve.perspective).add(view.curve.near).add(view.curve.far);
    key.add(view.curve.convention.reversed).add(view.curve.convention.zero_to_one).add(view.clamps_near);
    key.add(view.caster_shift.all_m).add(view.caster_shift.grazing_m);
    const DepthWarp warp = view.curve.warp.value_or(DepthWarp{});
    key.add(warp.middle_m).add(warp.near_m).add(warp.far_m).add(warp.rise);
}

void add_views(Key& key, const ImportedViews& views) {
    for (const LightView& view : views.views) add_view(key, view);
    key.add(views.chooser.choice).add(views.chooser.from_ws).add(views.chooser.forward).add(views.closed);
    for (const ViewSpan& span : views.chooser.spans) key.add(span.ends).add(span.blends_from);
}

/// Adds raster states to a key. @throws Error where their number is not that of the maps
void add_raster(Key& key, const std::vector<CasterRaster>& raster, std::size_t maps) {
    if (raster.empty()) return;
    if (raster.size() != maps)
        throw Error(fmt::format("{} imported maps have {} raster states; each map needs one", maps, raster.size()));
    for (const CasterRaster& r : raster)
        key.add(r.offset_factor).add(r.offset_units).add(r.offset_clamp).add(r.cull ? int(*r.cull) : -1);
}

}  // namespace

std::shared_ptr<const ImportedMaps> imported_maps(std::vector<FloatImage> images, std::optional<ImportedViews> views,
                                                  std::vector<CasterRaster> raster, bool bias_known) {
    if (images.empty()) throw Error("the imported light has no map; give an image a view");
    Key key;
    const int width = images.front().width, height = images.front().height;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const FloatImage& image = images[i];
        if (image.channels != 1 || image.width < 1 || image.height < 1 ||
            image.data.size() != std::size_t(image.width) * std::size_t(image.height))
            throw Error(fmt::format("imported map {}: one depth a texel is needed", i));
        if (image.width != width || image.height != height)
            throw Error(fmt::format("imported map {} is {}×{} and map 0 is {}×{}; all maps need one size", i,
                                    image.width, image.height, width, height));
        key.add(width).add(height).bytes(image.data.data(), image.data.size() * sizeof(float));
    }
    if (views) {
        if (views->views.size() != images.size())
            throw Error(fmt::format("{} imported maps have {} views; each map needs one view", images.size(),
                                    views->views.size()));
        add_views(key, *views);
    }
    add_raster(key, raster, images.size());
    auto maps = std::make_shared<ImportedMaps>();
    maps->images = std::move(images);
    maps->views = std::move(views);
    maps->raster = std::move(raster);
    maps->bias_known = bias_known;
    maps->key = key.value();
    return maps;
}

std::shared_ptr<const ImportedMaps> drawn_maps(ImportedViews views, MapSize size, std::vector<CasterRaster> raster) {
    if (views.views.empty()) throw Error("the light's maps have no view; give a matrix a map");
    if (size.shortest() < 1)
        throw Error(fmt::format("maps of {}×{} texels cannot be drawn; give sizes from 1", size.width, size.height));
    Key key;
    key.add("drawn").add(size.sides());
    add_views(key, views);
    add_raster(key, raster, views.views.size());
    auto maps = std::make_shared<ImportedMaps>();
    maps->views = std::move(views);
    maps->raster = std::move(raster);
    maps->drawn_size = size;
    maps->key = key.value();
    return maps;
}

Cull culled_faces(Cull culled, bool front_is_clockwise, const LightView& view) {
    if (culled == Cull::None || front_is_clockwise == is_mirrored(view)) return culled;
    return culled == Cull::Front ? Cull::Back : Cull::Front;
}

}  // namespace si
