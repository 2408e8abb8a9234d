// Cache of light maps in memory and on disk, shared by the whole process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>

#include "renderer/reference/light_map.h"

namespace si {

/// Cache of baked light maps in memory and on disk, found by a hash of their input. Usable from any thread.
class LightMapCache {
public:
    /// Limits in bytes of the files on disk and of the maps in memory; the least recently used are removed.
    static constexpr std::uint64_t kMaxDiskBytes = 512ull << 20, kMaxMemoryBytes = 256ull << 20;

    /// Returns the light map of a task: from memory, from disk, or baked now and stored in both. A damaged file, or one
    /// of another version of the program, is replaced by a newly baked map. LightMap::remark reports such files and
    /// failed writes.
    /// @throws Cancelled, without storing anything; Error as light_map_layout() and ReferenceScene do
    std::shared_ptr<const LightMap> get(const LightMapTask& task, const Workers& workers = {});
    /// Sets the folder in which baked light maps are stored on disk. The first write creates the folder.
    /// @param folder empty: light maps are not stored on disk
    /// @param max_bytes limit of all light map files together; the least recently used are removed
    void set_disk_folder(std::filesystem::path folder, std::uint64_t max_bytes = kMaxDiskBytes);
    /// Removes all light maps from memory. Files on disk stay.
    void clear();

    /// Numbers of light maps that the cache baked, read from disk, and found in memory.
    struct Counts {
        std::size_t baked = 0, read = 0, known = 0;  ///< number of maps baked, read from disk, found in memory
    };
    /// Returns the numbers of light maps that get() has baked, read from disk and found in memory so far.
    Counts counts() const;

private:
    /// Baked light map in memory, with the content key that finds it.
    struct Known {
        std::uint64_t content = 0;
        std::shared_ptr<const LightMap> map;
    };
    mutable std::mutex mutex_;
    std::list<Known> known_;  ///< most recently used first
    std::filesystem::path folder_;
    std::uint64_t max_bytes_ = kMaxDiskBytes;
    Counts counts_;

    /// Finds a baked light map in memory; null: none.
    /// @param content light_map_content_key() of the light map
    /// @param key light_map_key() that the requesting frame expects; the returned map has it as LightMap::key
    std::shared_ptr<const LightMap> find(std::uint64_t content, std::uint64_t key);
    /// Returns the atlas layout of a task's light map. Reuses the layout of the last call if geometry and size are
    /// equal. Thread-safe.
    std::shared_ptr<const LightMapLayout> layout_of(const LightMapTask& task, const Workers& workers);
    /// Stores a light map in memory under its content key, and removes the least recently used ones above the limit.
    /// Returns the stored light map.
    std::shared_ptr<const LightMap> keep(std::uint64_t content, LightMap map);

    std::shared_ptr<const LightMapLayout> layout_;  ///< layout of the last task; all lights of a scene share one
    std::uint64_t layout_geometry_ = 0;             ///< ReferenceGeometry::key of the layout
};

/// Returns the light map cache that all renderers of the process share.
LightMapCache& light_maps();

}  // namespace si
