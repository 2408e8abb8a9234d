#include "renderer/scenes/foreign_jobs.h"

#include "renderer/bundle/map_image_exr.h"
#include "renderer/gltf/draco.h"
#include "renderer/gltf/webp.h"
#include "renderer/importers/assimp_job.h"

namespace si {

std::span<const ForeignJob> foreign_jobs() {
    static const ForeignJob jobs[] = {gltf::kDracoJob, gltf::kWebpJob, kAssimpJob, kExrJob};
    return jobs;
}

}  // namespace si
