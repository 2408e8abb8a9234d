#include "renderer/reference/reference_picture.h"

#include "renderer/base/key.h"

namespace si {
std::shared_ptr<const ReferencePicture> reference_picture(const ReferenceTask& task, const TracedReference& traced,
                                                          const std::optional<ReferenceOptions>& options) {
    return std::make_shared<const ReferencePicture>(
        ReferencePicture{task.key, next_version(), task.raster.step, traced, options});
}

}  // namespace si
