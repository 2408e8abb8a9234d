#include "renderer/reference/reference_picture.h"

#include <atomic>

namespace si {
namespace {

std::uint64_t next_version() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace

std::shared_ptr<const ReferencePicture> reference_picture(const ReferenceTask& task, const TracedReference& traced,
                                                          const std::optional<ReferenceOptions>& options) {
    auto picture = std::make_shared<ReferencePicture>();
    picture->key = task.key;
    picture->version = next_version();
    picture->step = task.raster.step;
    picture->traced = traced;
    picture->options = options;
    return picture;
}

}  // namespace si
