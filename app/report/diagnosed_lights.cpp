#include "app/report/diagnosed_lights.h"

#include "renderer/reference/reference.h"

namespace si {

std::vector<PixelDiagnosis> diagnose_lights(const Probe& probe, const Scene& scene, const Settings& settings,
                                            const DriverInfo& driver, const ReferenceScene& casters) {
    std::vector<PixelDiagnosis> out;
    const auto traits = object_traits(scene, settings);
    for (const Probe::PerLight& light : probe.lights)
        out.push_back(diagnose_pixel(probe, light, trace_fragment_reference(casters, probe, light, settings, traits),
                                     settings, driver));
    return out;
}

}  // namespace si
