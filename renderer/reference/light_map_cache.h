// Light maps that are known, in memory and on disk, for all who draw.
#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>

#include "renderer/reference/light_map.h"

namespace si {

/// Light maps by what they are made of. Any thread.
class LightMaps {
public:
    /// What the folder on disk may take in all, and what is kept in memory; the longest unused goes first.
    static constexpr std::uint64_t kMostOnDisk = 512ull << 20, kMostInMemory = 256ull << 20;

    /// The map of that task: known, read from disk, or else baked and kept in both. A file that is damaged, or of
    /// another version of the program, is baked again, which the map's remark says; so it does where the disk takes
    /// none.
    /// @throws Cancelled, after which nothing is kept; Error as light_map_layout() and ReferenceScene do
    std::shared_ptr<const LightMap> get(const LightMapTask& task, const Workers& workers = {});
    /// Where maps are kept on disk from now on; made when first written to. Empty: nowhere.
    void keep_in(std::filesystem::path folder, std::uint64_t most_bytes = kMostOnDisk);
    /// Keeps none in memory.
    void forget();

    /// What get() did so far.
    struct Counts {
        std::size_t baked = 0, read = 0, known = 0;
    };
    Counts counts() const;

private:
    struct Known {
        std::uint64_t content = 0;
        std::shared_ptr<const LightMap> map;
    };
    mutable std::mutex mutex_;
    std::list<Known> known_;  ///< the newest first
    std::filesystem::path folder_;
    std::uint64_t most_bytes_ = kMostOnDisk;
    Counts counts_;

    std::shared_ptr<const LightMap> find(std::uint64_t content, std::uint64_t key);
    std::shared_ptr<const LightMapLayout> layout_of(const LightMapTask& task, const Workers& workers);
    std::shared_ptr<const LightMap> keep(std::uint64_t content, LightMap map);

    std::shared_ptr<const LightMapLayout> layout_;  ///< the last one: lights of a scene share it
    std::uint64_t layout_geometry_ = 0;             ///< its ReferenceGeometry::key
};

/// The process's own.
LightMaps& light_maps();

}  // namespace si
