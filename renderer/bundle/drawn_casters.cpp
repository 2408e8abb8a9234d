#include "renderer/bundle/drawn_casters.h"

namespace si {

DrawnCasters drawn_casters(const Scene& scene, const std::set<std::string>& drawn) {
    std::set<std::string> paths;
    for (const Object& object : scene.objects) paths.insert(scene.nodes[std::size_t(object.node)].path);
    DrawnCasters out;
    for (const std::string& path : paths)
        if (!drawn.contains(path)) out.left_out.insert(path);
    for (const std::string& path : drawn) out.unknown += !paths.contains(path);
    return out;
}

}  // namespace si
