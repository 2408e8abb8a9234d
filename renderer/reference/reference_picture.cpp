#include "renderer/reference/reference_picture.h"

namespace si {
std::shared_ptr<const ReferencePicture> reference_picture(const ReferenceTask& task, const TracedReference& traced,
                                                          const std::optional<ReferenceOptions>& options) {
    return std::make_shared<const ReferencePicture>(
        ReferencePicture{task.key, traced.version, task.raster.step, traced, options});
}

}  // namespace si
