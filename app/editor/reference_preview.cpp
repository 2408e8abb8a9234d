#include "app/editor/reference_preview.h"

#include <utility>

#include "app/editor/upload_picture.h"

namespace si {
namespace {

constexpr std::chrono::milliseconds kLeastPause(200);

}  // namespace

bool PreviewOfReference::update(const TracedSoFar* so_far) {
    if (!so_far) {
        const bool had = size_.x > 0;
        *this = {};
        return had;
    }
    const std::size_t tiles = so_far->tiles();
    if (of_ == so_far && tiles_ == tiles) return false;
    const auto now = std::chrono::steady_clock::now();
    if (of_ == so_far && now - uploaded_ < kLeastPause) return false;
    const ByteImage picture = so_far->picture();
    if (picture.data.empty()) return false;
    before_ = std::exchange(texture_, {});
    texture_ = upload_picture(picture);
    size_ = {picture.width, picture.height};
    of_ = so_far;
    tiles_ = tiles;
    uploaded_ = now;
    return true;
}

}  // namespace si
