#include "renderer/measure/time_sampler.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "renderer/gl/pass_clock.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"

namespace si {

namespace {

TimeSamples::Pass& pass_of(TimeSamples& samples, const std::string& name) {
    for (TimeSamples::Pass& pass : samples.passes)
        if (pass.name == name) return pass;
    return samples.passes.emplace_back(TimeSamples::Pass{name, {}, {}});
}

void append(std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

/// Returns true for the upload of imported maps, which stands for no work of the engine that has drawn them.
bool uploads_given_maps(const PassInfo& pass) {
    return pass.makes == Result::DrawnMaps && pass.category == PassCategory::Tool;
}

}  // namespace

double drawn_ms(const FrameResult& frame, std::optional<PassCategory> of, double PassInfo::*time) {
    double ms = 0;
    for (const PassInfo& pass : frame.passes)
        if (pass.state == PassState::Drawn && pass.category == of.value_or(pass.category) && !uploads_given_maps(pass))
            ms += pass.*time;
    return ms;
}

void TimeSamples::add(const FrameResult& frame) {
    clock = frame.clock;
    for (const PassInfo& info : frame.passes) {
        if (info.state != PassState::Drawn || uploads_given_maps(info)) continue;
        Pass& pass = pass_of(*this, info.name);
        pass.gpu_ms.push_back(info.gpu_ms);
        pass.cpu_ms.push_back(info.cpu_ms);
    }
    if (burst_ended) bursts.push_back(total_ms.size());
    burst_ended = false;
    total_ms.push_back(drawn_ms(frame));
    wall_ms.push_back(drawn_ms(frame, {}, &PassInfo::wall_ms));
    maps_ms.push_back(drawn_ms(frame, PassCategory::Maps));
}

void TimeSamples::add(const TimeSamples& more) {
    clock = more.clock;
    const std::size_t before = total_ms.size();
    if (more.bursts.empty() && !more.total_ms.empty()) bursts.push_back(before);
    for (const std::size_t first : more.bursts) bursts.push_back(before + first);
    burst_ended = true;
    append(total_ms, more.total_ms);
    append(maps_ms, more.maps_ms);
    append(wall_ms, more.wall_ms);
    for (const Pass& from : more.passes) {
        Pass& to = pass_of(*this, from.name);
        append(to.gpu_ms, from.gpu_ms);
        append(to.cpu_ms, from.cpu_ms);
    }
}

std::string_view time_unit(const std::string& clock) {
    return clock == gl::name(gl::ClockKind::Processor) ? "ms of processor" : "ms";
}

TimeMeasurement summarise_times(const TimeSamples& samples, double settled_below) {
    TimeMeasurement m;
    const auto spread = [&](std::vector<double> times) {
        // The burst of a time is unknown for passes that did not run in every frame.
        const bool every = times.size() == samples.total_ms.size();
        return spread_of(std::move(times),
                         every ? std::span<const std::size_t>(samples.bursts) : std::span<const std::size_t>());
    };
    m.total_ms = spread(samples.total_ms);
    m.maps_ms = spread(samples.maps_ms);
    if (std::ranges::any_of(samples.wall_ms, [](double ms) { return ms > 0; })) m.wall_ms = spread(samples.wall_ms);
    std::vector<double> rest = samples.total_ms;
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= samples.maps_ms[i];
    m.picture_ms = spread(std::move(rest));
    for (const auto& pass : samples.passes) m.passes.push_back({pass.name, spread(pass.gpu_ms), spread(pass.cpu_ms)});
    m.settled = m.total_ms.bursts >= kMinBursts && m.total_ms.relative() < settled_below;
    m.clock = samples.clock;
    return m;
}

void TimeSampler::add(const FrameResult& frame, double now_s) {
    pause_s_ = 0;
    if (!warm_) {
        if (!begun_) start_s_ = now_s;
        begun_ = warm_ = true;
        burst_s_ = last_s_ = now_s;
        return;
    }
    samples_.add(frame);
    last_s_ = now_s;
    const double slot_s = limits_.over_s / std::max(limits_.bursts, 1);
    if (++in_burst_ < kBurstFrames && now_s - burst_s_ < slot_s) return;
    samples_.burst_ended = true;
    in_burst_ = 0;
    burst_s_ = now_s;
    pause_s_ = std::max(0.0, start_s_ + ++ended_ * slot_s - now_s);
    warm_ = pause_s_ == 0;
}

bool TimeSampler::settled() const {
    return frames() >= limits_.least && ended_ >= limits_.bursts && summarise_times(samples_, limits_.spread).settled;
}

TimeMeasurement TimeSampler::result() const {
    TimeMeasurement m = summarise_times(samples_, limits_.spread);
    m.settled = settled();
    m.seconds = last_s_ - start_s_;
    return m;
}

BurstClock BurstClock::steady() {
    using Clock = std::chrono::steady_clock;
    return {[] { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); },
            [](double s) { std::this_thread::sleep_for(std::chrono::duration<double>(s)); }};
}

TimeMeasurement sample_times(const TimeSampler::Limits& limits, const std::function<FrameResult()>& draw,
                             const BurstClock& clock) {
    TimeSampler sampler(limits);
    while (!sampler.done()) {
        if (sampler.pause_s() > 0) clock.wait_s(sampler.pause_s());
        const FrameResult frame = draw();
        sampler.add(frame, clock.now_s());
    }
    return sampler.result();
}

WorkCost work_cost(const Settings& settings, const FrameResult& frame) {
    WorkCost cost;
    cost.taps_per_pixel = kernel_cost(settings).texels;
    const std::uint64_t texels = std::uint64_t(frame.map_size.width) * std::uint64_t(frame.map_size.height);
    std::uint64_t casting = 0;
    for (const FittedLight& light : frame.lights) {
        if (!light.casts) continue;
        ++casting;
        cost.map_texels += texels * light.views.size();
    }
    // Virtual maps count the pages that are read, drawn in this frame or before.
    if (frame.pages) cost.map_texels = frame.pages->read_texels();
    if (casting == 0) cost.taps_per_pixel = 0;
    // Drivers store 24-bit depth in 32 bits. A colour map needs a depth buffer, too.
    const auto bytes = std::uint64_t(drawn_texel_bytes(settings.map.format));
    const auto fetched = std::uint64_t(texel_bytes(settings.map.format));
    cost.map_bytes = cost.map_texels * bytes;
    if (casting > 0) {
        const PrefilterBytes prefilter = prefilter_bytes(settings);
        cost.map_bytes += std::uint64_t(prefilter.kept * double(cost.map_texels) + prefilter.scratch * double(texels));
    }
    // The blurred copy has no depth buffer. One map blurred along x only is stored as 32-bit floats.
    if (settings.map.blur_texels > 0 && casting > 0) cost.map_bytes += cost.map_texels * fetched + 4 * texels;
    const std::uint64_t pixels = std::uint64_t(frame.colour.width) * std::uint64_t(frame.colour.height);
    std::uint64_t light_maps = 0;
    for (const LightMapNeed& n : frame.light_maps) {
        light_maps += n.met;
        cost.map_bytes += n.bytes;
    }
    cost.bytes_touched = cost.map_bytes + casting * pixels * std::uint64_t(std::llround(cost.taps_per_pixel)) * fetched;
    cost.bytes_touched += light_maps * pixels * 4;  // four texels of a byte
    for (const PassInfo& pass : frame.passes) {
        if (pass.state != PassState::Drawn) continue;
        cost.draws += pass.draws;
        cost.triangles += pass.triangles;
    }
    return cost;
}

}  // namespace si
