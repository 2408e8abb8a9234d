// Tests that changes which act while maps are drawn are not tried on an imported map.
#include "renderer/inspect/given_map_changes.h"

#include <gtest/gtest.h>

#include "renderer/advise/trial.h"
#include "tests/support/sets.h"

namespace si {
namespace {

/// Returns measured settings whose only light has maps of an origin.
MeasuredSettings measured(MapProvider provider) {
    MeasuredError frame;
    frame.lights.resize(1);
    frame.lights[0].provider = provider;
    return {.error = 1, .noise = 0, .work = {}, .camera = {}, .frame = std::make_shared<const MeasuredError>(frame)};
}

TEST(GivenMapChanges, OnlyChangesOfTheLookUpAreTried) {
    int drawn = 0;
    TrialMeter meter;
    meter.measure = [&](const Settings&, int) {
        ++drawn;
        return MeasuredSettings{.error = 0, .noise = 0, .work = {}, .camera = {}};
    };
    const Settings base;
    const auto tried = [&](MapProvider provider, const char* change) {
        const Settings s = settings_with(base, {change});
        return try_candidate(base, measured(provider), {.name = change, .settings = s}, meter);
    };
    for (const char* change : {"map.resolution=64", "light.0.fit=view", "caster.cull=front", "bias.raster_slope=2",
                               "object.Tree.cast=false", "map.format=d16", "light.0.azimuth=3"}) {
        const int before = drawn;
        EXPECT_EQ(tried(MapProvider::Imported, change).candidate.untried, kNeedsAnotherMap) << change;
        EXPECT_EQ(drawn, before) << change;
        EXPECT_TRUE(tried(MapProvider::Drawn, change).is_drawn()) << change;
    }
    for (const char* change : {"bias.constant=2", "filter.kernel=hard", "map.compare=less", "map.blur_texels=1",
                               "light.0.size=2", "light.0.contact=0.3", "object.Tree.receive=false"})
        EXPECT_TRUE(tried(MapProvider::Imported, change).is_drawn()) << change;
}

}  // namespace
}  // namespace si
