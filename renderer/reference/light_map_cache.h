// Cache of light maps in memory and on disk, shared by the whole process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>

#include "renderer/reference/light_map.h"

namespace si {

/// Cache of baked light maps by content, in memory and on disk. Usable from any thread.
class LightMapCache {
public:
    /// Limits in bytes of the files on disk and of the maps in memory; the least recently used are removed.
    static constexpr std::uint64_t kMaxDiskBytes = 512ull << 20, kMaxMemoryBytes = 256ull << 20;

    /// Returns the light map of a task: from memory, from disk, or baked now and stored in both. A file that is
    /// damaged, or written by another version of the program, is baked again. LightMap::remark reports that, and failed
    /// writes.
    /// @throws Cancelled, without storing anything; Error as light_map_layout() and ReferenceScene do
    std::shared_ptr<const LightMap> get(const LightMapTask& task, const Workers& workers = {});
    /// Sets the folder of light maps on disk, created by the first write. Empty: none are stored on disk.
    /// @param max_bytes limit of all its files
    void set_disk_folder(std::filesystem::path folder, std::uint64_t max_bytes = kMaxDiskBytes);
    /// Removes all light maps from memory; files stay.
    void clear();

    /// Numbers of light maps that get() baked, read from disk, and found in memory.
    struct Counts {
        std::size_t baked = 0, read = 0, known = 0;  ///< number of maps baked, read from disk, found in memory
    };
    /// Returns how often get() baked, read and found a light map so far.
    Counts counts() const;

private:
    /// Baked light map in memory, with the content key that finds it.
    struct Known {
        std::uint64_t content = 0;
        std::shared_ptr<const LightMap> map;
    };
    mutable std::mutex mutex_;
    std::list<Known> known_;  ///< the newest first
    std::filesystem::path folder_;
    std::uint64_t max_bytes_ = kMaxDiskBytes;
    Counts counts_;

    /// Finds a light map in memory by its content key, and sets LightMap::key to the `key` that the requesting frame
    /// expects. Null: not in memory.
    std::shared_ptr<const LightMap> find(std::uint64_t content, std::uint64_t key);
    /// Returns the light map's layout for the task's geometry and size, cached from the last call where both are the
    /// same. Thread-safe.
    std::shared_ptr<const LightMapLayout> layout_of(const LightMapTask& task, const Workers& workers);
    /// Stores a light map in memory and removes the least recently used ones above the limit.
    std::shared_ptr<const LightMap> keep(std::uint64_t content, LightMap map);

    std::shared_ptr<const LightMapLayout> layout_;  ///< layout of the last task; all lights of a scene share one
    std::uint64_t layout_geometry_ = 0;             ///< ReferenceGeometry::key of the layout
};

/// Returns the light map cache that all renderers of the process share.
LightMapCache& light_maps();

}  // namespace si
