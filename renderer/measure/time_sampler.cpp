#include "renderer/measure/time_sampler.h"

#include <algorithm>

#include "renderer/techniques.h"

namespace si {

void TimeSampler::add(const FrameResult& frame) {
    clock_ = frame.clock;
    if (!warm_) {
        warm_ = true;
        return;
    }
    double total = 0;
    for (const PassInfo& pass : frame.passes) {
        if (pass.state != PassState::Ran) continue;
        if (!passes_.contains(pass.name)) order_.push_back(pass.name);
        Samples& samples = passes_[pass.name];
        samples.gpu.push_back(pass.gpu_ms);
        samples.cpu.push_back(pass.cpu_ms);
        total += pass.gpu_ms;
    }
    totals_.push_back(total);
}

bool TimeSampler::settled() const {
    return frames() >= limits_.least && spread_of(totals_).relative() < limits_.spread;
}

TimeMeasurement TimeSampler::result() const {
    TimeMeasurement m;
    m.total_ms = spread_of(totals_);
    for (const std::string& name : order_) {
        const Samples& samples = passes_.at(name);
        m.passes.push_back({name, spread_of(samples.gpu), spread_of(samples.cpu)});
    }
    m.settled = settled();
    m.clock = clock_;
    return m;
}

WorkCost work_cost(const Settings& settings, const FrameResult& frame) {
    WorkCost cost;
    const auto kernels = filters();
    const Filter& kernel = kernels[std::size_t(std::clamp(settings.filter.kernel, 0, int(kernels.size()) - 1))];
    const bool gathers = kernel.gathers > 0 && settings.filter.method != int(FilterMethod::Sampler);
    cost.taps_per_pixel = gathers ? 4.0 * kernel.gathers : kernel.sampler_taps;
    const std::uint64_t texels = std::uint64_t(frame.map_resolution) * std::uint64_t(frame.map_resolution);
    for (const FittedLight& light : frame.lights)
        if (light.casts) cost.map_texels += texels * light.views.size();
    // Drivers store 24-bit depth in 32 bits; a colour map has a depth buffer beside it.
    const std::uint64_t bytes = settings.map.format == int(MapFormat::D16)      ? 2
                                : settings.map.format == int(MapFormat::Colour) ? 8
                                                                                : 4;
    cost.map_bytes = cost.map_texels * bytes;
    for (const PassInfo& pass : frame.passes) {
        if (pass.state != PassState::Ran) continue;
        cost.draws += pass.draws;
        cost.triangles += pass.triangles;
    }
    return cost;
}

}  // namespace si
