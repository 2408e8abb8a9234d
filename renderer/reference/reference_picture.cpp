#include "renderer/reference/reference_picture.h"

#include <atomic>

namespace si {
namespace {

std::uint64_t next_version() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace

std::shared_ptr<const TruthPicture> truth_picture(const TruthTask& task, const TracedTruth& traced,
                                                  const std::optional<TruthOptions>& options) {
    auto picture = std::make_shared<TruthPicture>();
    picture->key = task.key;
    picture->version = next_version();
    picture->step = task.raster.step;
    picture->traced = traced;
    picture->options = options;
    return picture;
}

}  // namespace si
