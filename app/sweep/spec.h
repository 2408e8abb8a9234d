// Specification of a sweep: scene, settings, axes and picture size. Equal specifications give equal errors and costs,
// so that a sweep can be continued, split into shards and merged.
#pragma once

#include <string>
#include <string_view>

#include "app/base/json_text.h"
#include "app/session/session.h"
#include "renderer/measure/axes.h"
#include "renderer/measure/frame_costs.h"
#include "renderer/measure/shadow_time.h"
#include "renderer/settings/earlier.h"

namespace si {

/// Part of a sweep that one of several machines measures: part `index` of `count`. Case n, counted from 0, belongs to
/// part n mod count + 1.
struct Shard {
    int index = 1, count = 1;  ///< index from 1
    /// Returns true if the case belongs to this shard of the sweep.
    bool contains(std::size_t case_number) const { return int(case_number % std::size_t(count)) == index - 1; }
    bool operator==(const Shard&) const = default;
};

/// Parses the value of the option --shard, which selects a part of a sweep: "2/8" is the second part of eight.
/// @throws UsageError
Shard parse_shard(std::string_view text);

/// Options for timing the frames of a sweep. Rounds over all cases continue until the time of every case is precise
/// enough (time_sampler.h), up to a largest number of rounds.
struct SweepTiming {
    bool on = true;
    CostCase cost = kFrontierCost;  ///< kind of frames to time
    int rounds = 10;                ///< largest number of rounds
    int frames = 3;                 ///< timed frames per case and round, after one warm-up frame
    int min_frames = 5;             ///< smallest number of frames of a case before its time can count as settled
};

/// Specification of a sweep: scene, common settings, varied settings (axes) and picture size. Equal specifications give
/// equal errors and costs (counts of work, not times).
struct SweepSpec {
    std::string scene;                ///< name or path as given
    std::uint64_t scene_content = 0;  ///< scene_content_key()
    std::uint64_t maps_content = 0;   ///< hash of the imported shadow maps of map.bundle; 0: none
    std::size_t triangles = 0;
    Settings base;  ///< measured_settings()
    std::vector<SweepAxis> axes;
    int width = 640, height = 360;  ///< size of the picture
    bool area = false;              ///< truth.area, which all cases share
    Shard shard;
};

/// Computes a hash of everything that is drawn of a scene, in any pose and from any of its cameras. A file read twice,
/// or from another place, gives the same hash. Used to notice that a sweep's scene has changed.
std::uint64_t scene_content_key(const Scene& scene);

/// Makes the specification of a sweep for a loaded scene.
/// @param settings settings that all cases share @param axes varied settings with their values
/// @param width, height size of each picture, pixels @throws Error for a bundle (map.bundle) that cannot be read
SweepSpec sweep_spec(const std::string& scene_name, const Scene& scene, const Settings& settings,
                     std::vector<SweepAxis> axes, int width, int height);

/// Converts the specification of a sweep (scene, settings, axes, picture size) to JSON, for the sweep's journal.
nlohmann::ordered_json spec_json(const SweepSpec& spec);
/// Reads the specification of a sweep from the JSON that spec_json() makes. @param settings_version version of the
/// settings in the file (earlier.h) @throws Error
SweepSpec spec_from_json(const nlohmann::ordered_json& json, int settings_version = kSettingsVersion);

/// Computes a hash of a sweep's cases and their order. Two programs whose hashes differ would number the cases
/// differently.
std::string plan_key(const SweepPlan& plan);

/// Describes the first difference between the specifications of two sweeps ("map.format: d16 there, d24 here"); empty
/// if they are equal. Used to refuse a folder that holds another sweep.
/// @param there, here JSON of spec_json() @param with_shard true: also compares the shards
std::string spec_difference(const nlohmann::ordered_json& there, const nlohmann::ordered_json& here,
                            bool with_shard = true);

}  // namespace si
