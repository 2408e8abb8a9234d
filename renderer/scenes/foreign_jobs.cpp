#include "renderer/scenes/foreign_jobs.h"

#include "renderer/gltf/draco.h"
#include "renderer/gltf/webp.h"
#include "renderer/importers/assimp_job.h"

namespace si {

std::span<const ForeignJob> foreign_jobs() {
    static const ForeignJob jobs[] = {gltf::kDracoJob, gltf::kWebpJob, kAssimpJob};
    return jobs;
}

}  // namespace si
