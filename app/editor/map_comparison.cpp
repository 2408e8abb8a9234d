#include "app/editor/map_comparison.h"

#include <algorithm>

#include "app/editor/upload_picture.h"
#include "ui/state/panels.h"

namespace si {

void EditorMapComparison::clear() {
    facts_ = {};
    renderer_.reset();
    texture_.reset();
    compared_.clear();
    painted_.reset();
    light_ = -1;
}

bool EditorMapComparison::compare(const Scene& scene, const Settings& settings,
                                  const std::vector<std::shared_ptr<const ImportedMaps>>& maps, int light,
                                  ImportedLeftOut left_out) {
    Settings relevant = settings;
    relevant.camera = {};
    relevant.view = {};
    const std::uint64_t key = maps[std::size_t(light)]->key;
    if (light_ == light && left_out_ == left_out && scene_ == scene.id && maps_ == key && settings_ == relevant)
        return false;
    facts_ = {};
    compared_.clear();
    painted_.reset();
    light_ = light;
    left_out_ = left_out;
    scene_ = scene.id;
    maps_ = key;
    settings_ = relevant;
    if (!renderer_) renderer_ = std::make_unique<Renderer>();
    try {
        for (ComparedMap& map : compare_imported_maps(
                 *renderer_, scene, settings, maps, light,
                 {.border_texels = left_out.border ? 1 : 0, .leaves_out_masked = left_out.masked, .limits = {}}))
            compared_.push_back(std::make_shared<const ComparedMap>(std::move(map)));
    } catch (const std::exception& e) {
        compared_.clear();
        facts_.problem = e.what();
    }
    return true;
}

bool EditorMapComparison::paint(std::size_t view, ImportedPicture picture) {
    if (painted_ == picture && painted_view_ == view) return false;
    const ComparedMap& map = *compared_[view];
    facts_.map = compared_[view];
    facts_.scale_m = difference_scale_m(map.numbers);
    const ByteImage image = picture == ImportedPicture::Imported ? linear_picture(map, map.imported)
                            : picture == ImportedPicture::Drawn  ? linear_picture(map, map.drawn)
                                                                 : difference_picture(map.numbers, facts_.scale_m);
    texture_ = upload_picture(image);
    facts_.picture = {texture_.id(), image.width, image.height};
    painted_ = picture;
    painted_view_ = view;
    return true;
}

bool EditorMapComparison::update(const Scene& scene, const PictureState& state, const EditorRequests& requests,
                                 const FrameResult& frame) {
    const int light = shown_light(state.settings);
    const auto& maps = frame.imported;
    const bool wanted = requests.want_map_comparison && light >= 0 && std::size_t(light) < maps.size() &&
                        maps[std::size_t(light)] && maps[std::size_t(light)]->views;
    if (!wanted) {
        const bool had = facts_.map || !facts_.problem.empty();
        clear();
        return had;
    }
    bool changed = compare(scene, state.settings, maps, light, state.imported_left_out);
    if (!compared_.empty()) {
        const std::size_t view = std::min(std::size_t(shown_face(state.settings, frame)), compared_.size() - 1);
        changed |= paint(view, state.imported_picture);
    }
    return changed;
}

}  // namespace si
