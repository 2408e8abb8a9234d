#include "renderer/measure/time_sampler.h"

#include <algorithm>
#include <cmath>

#include "renderer/techniques.h"

namespace si {

namespace {

TimeSamples::Pass& pass_of(TimeSamples& samples, const std::string& name) {
    for (TimeSamples::Pass& pass : samples.passes)
        if (pass.name == name) return pass;
    return samples.passes.emplace_back(TimeSamples::Pass{name, {}, {}});
}

void append(std::vector<double>& to, const std::vector<double>& from) { to.insert(to.end(), from.begin(), from.end()); }

}  // namespace

void TimeSamples::add(const FrameResult& frame) {
    clock = frame.clock;
    double total = 0, maps = 0;
    for (const PassInfo& info : frame.passes) {
        if (info.state != PassState::Ran) continue;
        Pass& pass = pass_of(*this, info.name);
        pass.gpu_ms.push_back(info.gpu_ms);
        pass.cpu_ms.push_back(info.cpu_ms);
        total += info.gpu_ms;
        if (info.name.starts_with("shadow map")) maps += info.gpu_ms;
    }
    total_ms.push_back(total);
    maps_ms.push_back(maps);
}

void TimeSamples::add(const TimeSamples& more) {
    clock = more.clock;
    append(total_ms, more.total_ms);
    append(maps_ms, more.maps_ms);
    for (const Pass& from : more.passes) {
        Pass& to = pass_of(*this, from.name);
        append(to.gpu_ms, from.gpu_ms);
        append(to.cpu_ms, from.cpu_ms);
    }
}

TimeMeasurement summary(const TimeSamples& samples, double settled_below) {
    TimeMeasurement m;
    m.total_ms = spread_of(samples.total_ms);
    m.maps_ms = spread_of(samples.maps_ms);
    std::vector<double> rest = samples.total_ms;
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= samples.maps_ms[i];
    m.picture_ms = spread_of(std::move(rest));
    for (const auto& pass : samples.passes)
        m.passes.push_back({pass.name, spread_of(pass.gpu_ms), spread_of(pass.cpu_ms)});
    m.settled = m.total_ms.relative() < settled_below;
    m.clock = samples.clock;
    return m;
}

void TimeSampler::add(const FrameResult& frame) {
    if (warm_) samples_.add(frame);
    warm_ = true;
}

bool TimeSampler::settled() const {
    return frames() >= limits_.least && spread_of(samples_.total_ms).relative() < limits_.spread;
}

TimeMeasurement TimeSampler::result() const {
    TimeMeasurement m = summary(samples_, limits_.spread);
    m.settled = settled();
    return m;
}

WorkCost work_cost(const Settings& settings, const FrameResult& frame) {
    WorkCost cost;
    const auto kernels = filters();
    const Filter& kernel = kernels[std::size_t(std::clamp(settings.filter.kernel, 0, int(kernels.size()) - 1))];
    cost.taps_per_pixel = kernel.texels(uses_sampler(settings));
    const std::uint64_t texels = std::uint64_t(frame.map_resolution) * std::uint64_t(frame.map_resolution);
    std::uint64_t casting = 0;
    for (const FittedLight& light : frame.lights) {
        if (!light.casts) continue;
        ++casting;
        cost.map_texels += texels * light.views.size();
    }
    // Drivers store 24-bit depth in 32 bits; a colour map has a depth buffer beside it.
    const std::uint64_t bytes = settings.map.format == int(MapFormat::D16)      ? 2
                                : settings.map.format == int(MapFormat::Colour) ? 8
                                                                                : 4;
    cost.map_bytes = cost.map_texels * bytes;
    const std::uint64_t pixels = std::uint64_t(frame.colour.width) * std::uint64_t(frame.colour.height);
    const std::uint64_t fetched = settings.map.format == int(MapFormat::Colour) ? 4 : bytes;
    cost.bytes_touched =
        cost.map_bytes + casting * pixels * std::uint64_t(std::llround(cost.taps_per_pixel)) * fetched;
    for (const PassInfo& pass : frame.passes) {
        if (pass.state != PassState::Ran) continue;
        cost.draws += pass.draws;
        cost.triangles += pass.triangles;
    }
    return cost;
}

}  // namespace si
