// What a sweep is of: its scene, settings, axes and picture. Equal specs give equal errors and costs, so that a sweep
// may be continued, split into shards and merged again.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "app/session/session.h"
#include "renderer/measure/axes.h"
#include "renderer/settings/earlier.h"

namespace si {

/// One of `count` equal parts of a sweep: cases are dealt out in turn.
struct Shard {
    int index = 1, count = 1;  ///< index from 1
    bool holds(std::size_t case_number) const { return int(case_number % std::size_t(count)) == index - 1; }
    bool operator==(const Shard&) const = default;
};

/// "2/8": the second of eight. @throws UsageError
Shard parse_shard(std::string_view text);

struct SweepSpec {
    std::string scene;                ///< as it was named
    std::uint64_t scene_content = 0;  ///< scene_content_key()
    std::size_t triangles = 0;
    Settings base;  ///< measured_settings()
    std::vector<SweepAxis> axes;
    int width = 640, height = 360;  ///< of the picture
    bool area = false;              ///< truth.area of what all cases share
    Shard shard;
};

/// Of what is drawn of a scene: equal for the same file read twice, wherever it lies.
std::uint64_t scene_content_key(const Scene& scene);

SweepSpec sweep_spec(const std::string& scene_name, const Scene& scene, const Settings& settings,
                     std::vector<SweepAxis> axes, int width, int height);

nlohmann::ordered_json spec_json(const SweepSpec& spec);
/// @param settings_version of the file that it is from (earlier.h)
/// @throws Error when it is not what spec_json() writes
SweepSpec spec_from_json(const nlohmann::ordered_json& json, int settings_version = kSettingsVersion);

/// Of the cases and their order, which follow from the spec and from what the program knows of its settings.
std::string plan_key(const SweepPlan& plan);

/// How two specs differ, as a phrase that names the first difference and both values ("map.format: d16 there, d24
/// here"); empty when they are the same. `there` and `here` are of spec_json().
std::string spec_difference(const nlohmann::ordered_json& there, const nlohmann::ordered_json& here,
                            bool with_shard = true);

}  // namespace si
