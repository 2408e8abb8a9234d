#include "renderer/reference/light_map_cache.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <optional>
#include <utility>

#include "renderer/base/atomic_file.h"
#include "renderer/base/key.h"
#include "renderer/base/regular_file.h"
#include "renderer/reference/ray_scenes.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "shadow-inspector light map\n";
constexpr std::uint32_t kVersion = 2;  ///< version of the file format
constexpr std::string_view kExtension = ".lightmap";

/// Header of a light map file, after kMagic. All numbers have the machine's byte order, which the version reveals.
struct Header {
    std::uint32_t version = kVersion;
    std::int32_t side = 0;
    std::uint64_t content = 0, layout = 0, rays = 0;
    std::uint64_t texels_key = 0;  ///< hash of the texels that follow
};
static_assert(sizeof(Header) == 40);

std::uint64_t key_of(const LightMapLayout& layout) {
    Key key;
    key.add(layout.side).add(layout.texels_per_metre).add(layout.charts.size());
    for (const LightMapChart& c : layout.charts) key.add(c.u).add(c.v).add(c.at).add(c.rect);
    key.bytes(layout.chart_of.data(), layout.chart_of.size() * sizeof(layout.chart_of[0]));
    return key.value();
}

std::uint64_t key_of(const std::vector<std::uint8_t>& texels) {
    return Key().bytes(texels.data(), texels.size()).value();
}

fs::path file_of(const fs::path& folder, std::uint64_t content) {
    return folder / fmt::format("{:016x}{}", content, kExtension);
}

std::string_view bytes_of(const Header& header) {
    return {reinterpret_cast<const char*>(&header), sizeof header};
}

/// Reads a light map file. Returns nothing without a file, or with an unusable one. @param remark receives the reason
std::optional<LightMap> read_map(const fs::path& path, std::uint64_t content, const LightMapLayout& layout,
                                 std::string& remark) {
    std::error_code missing;
    if (!fs::exists(fs::symlink_status(path, missing))) return {};
    const auto unusable = [&](std::string_view why) {
        remark = fmt::format("{}: {}; the light map is baked again", path.string(), why);
        return std::nullopt;
    };
    const std::size_t texels = std::size_t(layout.side) * std::size_t(layout.side);
    const std::size_t bytes = kMagic.size() + sizeof(Header) + texels;
    const ReadResult file = read_regular_file(path, 2 * bytes);
    if (!file.error.empty()) return unusable(file.error);
    std::string_view rest = file.bytes.text();
    if (!rest.starts_with(kMagic)) return unusable("no light map");
    rest.remove_prefix(kMagic.size());
    Header header;
    if (rest.size() < sizeof header) return unusable("cut short");
    std::memcpy(&header, rest.data(), sizeof header);
    rest.remove_prefix(sizeof header);
    if (header.version != kVersion) return unusable("of another version of the program");
    if (header.content != content || header.side != layout.side || header.layout != key_of(layout))
        return unusable("of another scene, light or version of the program");
    LightMap out;
    if (rest.size() != texels) return unusable("cut short, or too long");
    out.texels.assign(rest.begin(), rest.end());
    if (key_of(out.texels) != header.texels_key) return unusable("damaged");
    out.rays = header.rays;
    out.held = TrackedMemory("light maps", array_bytes(out.texels));
    out.from_disk = true;
    // The time of last use: make_room() removes the oldest first.
    std::error_code ignored;
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
    return out;
}

/// Removes the least recently used files until all take at most `most` bytes, and remains of interrupted writes.
void make_room(const fs::path& folder, std::uint64_t most) {
    struct Entry {
        fs::file_time_type time;
        fs::path path;
        std::uint64_t bytes;
    };
    std::vector<Entry> entries;
    std::uint64_t sum = 0;
    std::error_code error;
    for (const fs::directory_entry& e : fs::directory_iterator(folder, error)) {
        std::error_code gone;
        const auto bytes = e.file_size(gone);
        const auto time = e.last_write_time(gone);
        if (gone) continue;
        if (e.path().extension() == ".tmp" && e.path().filename().string().find(kExtension) != std::string::npos &&
            time < fs::file_time_type::clock::now() - std::chrono::hours(1))
            fs::remove(e.path(), gone);
        if (e.path().extension() != kExtension) continue;
        entries.push_back({time, e.path(), bytes});
        sum += bytes;
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.time < b.time; });
    for (const Entry& e : entries) {
        if (sum <= most) return;
        std::error_code gone;
        if (fs::remove(e.path, gone)) sum -= e.bytes;
    }
}

/// Writes a light map file. Returns the error; empty: success.
std::string write_map(const fs::path& folder, std::uint64_t max_bytes, std::uint64_t content, const LightMap& map) {
    try {
        make_folders(folder);
        const Header header{.side = map.layout->side,
                            .content = content,
                            .layout = key_of(*map.layout),
                            .rays = map.rays,
                            .texels_key = key_of(map.texels)};
        const std::uint64_t bytes = kMagic.size() + sizeof header + map.texels.size();
        if (bytes > max_bytes) return {};
        make_room(folder, max_bytes - bytes);
        write_atomically(
            file_of(folder, content),
            {kMagic, bytes_of(header), {reinterpret_cast<const char*>(map.texels.data()), map.texels.size()}});
        return {};
    } catch (const std::exception& e) {
        return fmt::format("the light map is not kept on disk: {}", e.what());
    }
}

}  // namespace

std::shared_ptr<const LightMap> LightMapCache::find(std::uint64_t content, std::uint64_t key) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.content == content; });
    if (found == known_.end()) return nullptr;
    ++counts_.known;
    known_.splice(known_.begin(), known_, found);
    // Equal content for another scene id: the copy gets the key that the requesting frame expects.
    if (found->map->key != key) {
        auto renamed = std::make_shared<LightMap>(*found->map);
        renamed->key = key;
        found->map = std::move(renamed);
    }
    return found->map;
}

std::shared_ptr<const LightMapLayout> LightMapCache::layout_of(const LightMapTask& task, const Workers& workers) {
    {
        const std::lock_guard lock(mutex_);
        if (layout_ && layout_geometry_ == task.geometry->key && layout_->side == task.side) return layout_;
    }
    auto made = std::make_shared<const LightMapLayout>(light_map_layout(*task.geometry, task.side, workers));
    const std::lock_guard lock(mutex_);
    layout_geometry_ = task.geometry->key;
    return layout_ = std::move(made);
}

std::shared_ptr<const LightMap> LightMapCache::keep(std::uint64_t content, LightMap map) {
    auto kept = std::make_shared<const LightMap>(std::move(map));
    const std::lock_guard lock(mutex_);
    std::erase_if(known_, [&](const Known& k) { return k.content == content; });
    known_.push_front({content, kept});
    std::uint64_t bytes = 0;
    for (auto k = known_.begin(); k != known_.end();) {
        bytes += k->map->texels.size();
        k = bytes > kMaxMemoryBytes && k != known_.begin() ? known_.erase(k) : std::next(k);
    }
    return kept;
}

std::shared_ptr<const LightMap> LightMapCache::get(const LightMapTask& task, const Workers& workers) {
    const std::uint64_t content = light_map_content_key(task);
    if (auto known = find(content, task.key)) return known;
    fs::path folder;
    std::uint64_t max_bytes = 0;
    {
        const std::lock_guard lock(mutex_);
        folder = folder_;
        max_bytes = max_bytes_;
    }
    const auto start = std::chrono::steady_clock::now();
    const auto since_ms = [&] {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    };
    const auto layout = layout_of(task, workers);
    std::string remark;
    if (!folder.empty())
        if (auto read = read_map(file_of(folder, content), content, *layout, remark)) {
            read->key = task.key;
            read->version = next_version();
            read->layout = layout;
            read->bake_ms = since_ms();
            const auto kept = keep(content, std::move(*read));
            const std::lock_guard lock(mutex_);
            ++counts_.read;
            return kept;
        }
    const auto scene = ray_scenes().get(task.geometry, workers.with_progress_range(0, 0.1));
    LightMap baked = bake_light_map(task, layout, *scene, workers.with_progress_range(0.1, 1));
    baked.bake_ms = since_ms();
    if (!folder.empty())
        if (const std::string hindered = write_map(folder, max_bytes, content, baked); !hindered.empty())
            remark += (remark.empty() ? "" : "; ") + hindered;
    baked.remark = std::move(remark);
    auto kept = keep(content, std::move(baked));
    const std::lock_guard lock(mutex_);
    ++counts_.baked;
    return kept;
}

void LightMapCache::set_disk_folder(std::filesystem::path folder, std::uint64_t max_bytes) {
    const std::lock_guard lock(mutex_);
    folder_ = std::move(folder);
    max_bytes_ = max_bytes;
}

void LightMapCache::clear() {
    const std::lock_guard lock(mutex_);
    known_.clear();
    layout_.reset();
}

LightMapCache::Counts LightMapCache::counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
}

LightMapCache& light_maps() {
    static LightMapCache maps;
    return maps;
}

}  // namespace si
