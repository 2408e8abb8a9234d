#include "renderer/scenes/foreign_jobs.h"

#include "renderer/gltf/draco.h"
#include "renderer/gltf/webp.h"

namespace si {

std::span<const ForeignJob> foreign_jobs() {
    static const ForeignJob jobs[] = {gltf::kDracoJob, gltf::kWebpJob};
    return jobs;
}

}  // namespace si
