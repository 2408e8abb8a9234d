#include "renderer/bundle/bundle_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include "renderer/base/atomic_file.h"
#include "renderer/base/descriptor.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/base/printable.h"
#include "renderer/base/temporary_folder.h"
#include "renderer/bundle/builtin_bundles.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/bundle/bundle_path.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxEntries = 4096;
constexpr std::uint64_t kMaxTotalBytes = std::uint64_t{4} << 30;
constexpr std::uint64_t kMaxRatio = 1000;
constexpr std::string_view kOpenFix = "open a folder or zip file with a frame.json";
constexpr std::string_view kZipFix = "write the zip file again from the bundle's files alone";

[[noreturn]] void refuse_bundle(const fs::path& path, std::string_view what, std::string_view fix) {
    throw Error(fmt::format("{}: {}; {}", printable(path.string(), 300), what, fix));
}

/// Opened zip file.
struct Zip {
    zip_t* zip = nullptr;
    explicit Zip(zip_t* opened) : zip(opened) {}
    Zip(const Zip&) = delete;
    Zip& operator=(const Zip&) = delete;
    ~Zip() {
        if (zip) zip_discard(zip);
    }
};

/// Entry of a zip file.
struct ZipEntry {
    std::uint64_t index = 0, bytes = 0;
};

/// Returns the reason why an entry's kind is not read; empty for a regular file or folder.
std::string_view kind_fault(zip_t* zip, std::uint64_t index) {
    std::uint8_t system = 0;
    std::uint32_t attributes = 0;
    if (zip_file_get_external_attributes(zip, index, 0, &system, &attributes) != 0) return "has no readable attributes";
    if (system != ZIP_OPSYS_UNIX && system != ZIP_OPSYS_OS_X) return {};
    const std::uint32_t kind = attributes >> 16 & S_IFMT;
    if (kind == 0 || kind == S_IFREG || kind == S_IFDIR) return {};
    return kind == S_IFLNK ? "is a link" : "is neither file nor folder";
}

/// Reads the directory of a zip file and checks each entry. @param size bytes of the zip file
std::map<std::string, ZipEntry> zip_entries(zip_t* zip, const fs::path& path, std::uint64_t size) {
    const zip_int64_t count = zip_get_num_entries(zip, 0);
    if (count < 0 || std::uint64_t(count) > kMaxEntries)
        refuse_bundle(path, fmt::format("the zip file has {} entries", count),
                      fmt::format("use at most {}", kMaxEntries));
    std::map<std::string, ZipEntry> out;
    std::uint64_t total = 0;
    for (zip_uint64_t i = 0; i < zip_uint64_t(count); ++i) {
        zip_stat_t stat;
        zip_stat_init(&stat);
        constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_METHOD;
        if (zip_stat_index(zip, i, ZIP_FL_ENC_RAW, &stat) != 0 || (stat.valid & kNeeded) != kNeeded)
            refuse_bundle(path, fmt::format("entry {} cannot be read", i), kZipFix);
        std::string name = stat.name;
        const auto refuse = [&](std::string_view what) {
            refuse_bundle(path, fmt::format("the entry \"{}\" {}", printable(name, 100), what), kZipFix);
        };
        const bool is_folder = name.ends_with('/');
        const std::string_view plain(name.data(), name.size() - is_folder);
        if (const std::string_view fault = bundle_path_fault(plain); !fault.empty()) refuse(fault);
        if (const std::string_view fault = kind_fault(zip, i); !fault.empty()) refuse(fault);
        if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) && stat.encryption_method != ZIP_EM_NONE) refuse("is encrypted");
        if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE)
            refuse("is compressed by another method than deflate");
        if (stat.size > kMaxTotalBytes || (total += stat.size) > kMaxTotalBytes)
            refuse(fmt::format("takes the zip file above {} bytes", kMaxTotalBytes));
        if (is_folder && stat.size > 0) refuse("is a folder with content");
        if (!out.emplace(std::string(plain), ZipEntry{i, stat.size}).second) refuse("stands twice in the zip file");
        if (is_folder) out.find(std::string(plain))->second.index = ZIP_UINT64_MAX;
    }
    if (total > kMaxRatio * size)
        refuse_bundle(path, fmt::format("the zip file of {} bytes holds {} bytes", size, total),
                      fmt::format("compress files at most {} to one", kMaxRatio));
    return out;
}

/// Returns the one folder of a zip file that holds frame.json, with its slash; empty for the top. Nothing if frame.json
/// is missing.
std::optional<std::string> folder_in_zip(const std::map<std::string, ZipEntry>& entries) {
    const auto is_file = [&](const std::string& name) {
        const auto found = entries.find(name);
        return found != entries.end() && found->second.index != ZIP_UINT64_MAX;
    };
    if (is_file(std::string(kFrameJson))) return "";
    std::optional<std::string> out;
    for (const auto& [name, entry] : entries) {
        const std::size_t slash = name.find('/');
        const std::string folder = name.substr(0, slash == name.npos ? name.size() : slash) + "/";
        if (out == folder || !is_file(folder + std::string(kFrameJson))) continue;
        if (out) return std::nullopt;
        out = folder;
    }
    return out;
}

/// Opens a file below a folder, one part of its path after the other, so that no link is followed. Holds -1 with errno
/// on failure.
Descriptor open_part(int folder, std::string_view name) {
    Descriptor at(-1);
    for (std::size_t start = 0; start <= name.size();) {
        const std::size_t end = std::min(name.find('/', start), name.size());
        const bool last = end == name.size();
        const int flags = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (last ? 0 : O_DIRECTORY);
        at = Descriptor(
            ::openat(at.fd < 0 ? folder : at.fd, std::string(name.substr(start, end - start)).c_str(), flags));
        if (at.fd < 0) return at;
        start = end + 1;
    }
    return at;
}

std::string_view open_fault(int error) {
    return error == ENOENT    ? "does not exist"
           : error == ELOOP   ? "is a link"
           : error == ENOTDIR ? "has a link or a file in its path"
           : error == ENXIO   ? "is neither file nor folder"
                              : "cannot be opened";
}

bool read_fully(int fd, std::byte* out, std::size_t size) {
    for (std::size_t done = 0; done < size;) {
        const ssize_t got = ::read(fd, out + done, size - done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        done += std::size_t(got);
    }
    return true;
}

}  // namespace

bool is_bundle_path(const fs::path& path) {
    if (path.filename() == kFrameJson) return true;
    // A path that ends in '/' names a folder.
    const std::string extension = lower_extension(path.has_filename() ? path : path.parent_path());
    return extension == ".bundle" || extension == ".zip";
}

/// Opened folder or zip file.
struct BundleFiles::Opened {
    fs::path path;      ///< for messages: the folder or the zip file
    Descriptor folder;  ///< -1 for a zip file
    std::optional<Zip> zip;
    std::map<std::string, ZipEntry> entries;
    std::string prefix;  ///< folder in the zip file that holds the bundle, with its slash
    std::uint64_t bytes_left = kMaxTotalBytes;
    std::vector<StampedFile> read;
    std::optional<BundleContents> made;  ///< files of a built-in bundle

    [[noreturn]] void refuse(std::string_view name, std::string_view what, std::string_view fix) const {
        refuse_bundle(path / fs::path(name), what, fix);
    }
    void check_size(std::string_view name, std::uint64_t size, std::size_t max_bytes) {
        if (size > max_bytes)
            refuse(name, fmt::format("has {} bytes, more than the limit of {}", size, max_bytes), "make it smaller");
        if (size > bytes_left)
            refuse(name, fmt::format("takes the bundle above {} bytes", kMaxTotalBytes), "make the bundle smaller");
        bytes_left -= size;
    }
    std::vector<std::byte> read_entry(std::string_view name, std::size_t max_bytes);
    std::vector<std::byte> read_file(std::string_view name, std::size_t max_bytes);
};

std::vector<std::byte> BundleFiles::Opened::read_entry(std::string_view name, std::size_t max_bytes) {
    const auto found = entries.find(prefix + std::string(name));
    if (found == entries.end()) refuse(name, "does not exist", "add it to the zip file, or correct its name");
    if (found->second.index == ZIP_UINT64_MAX) refuse(name, "is a folder", "name a file");
    check_size(name, found->second.bytes, max_bytes);
    std::vector<std::byte> out(found->second.bytes);
    zip_file_t* const file = zip_fopen_index(zip->zip, found->second.index, 0);
    if (!file) refuse(name, fmt::format("cannot be read ({})", zip_strerror(zip->zip)), kZipFix);
    std::size_t done = 0;
    zip_int64_t got = 0;
    while (done < out.size() && (got = zip_fread(file, out.data() + done, out.size() - done)) > 0)
        done += std::size_t(got);
    std::byte more{};
    // The checksum is compared at the end of the data.
    if (done == out.size()) got = zip_fread(file, &more, 1);
    const std::string why = got < 0 ? zip_file_strerror(file) : "its size differs from that of the directory";
    zip_fclose(file);
    if (done != out.size() || got != 0) refuse(name, fmt::format("cannot be read ({})", why), kZipFix);
    return out;
}

std::vector<std::byte> BundleFiles::Opened::read_file(std::string_view name, std::size_t max_bytes) {
    const Descriptor file = open_part(folder.fd, name);
    if (file.fd < 0) refuse(name, open_fault(errno), "put a regular file of this name into the bundle");
    struct stat status {};
    if (::fstat(file.fd, &status) != 0 || !S_ISREG(status.st_mode))
        refuse(name, S_ISDIR(status.st_mode) ? "is a folder" : "is no regular file", "put a regular file there");
    read.push_back(stamped(path / fs::path(name)));
    check_size(name, std::uint64_t(status.st_size), max_bytes);
    std::vector<std::byte> out(std::size_t(status.st_size));
    if (!read_fully(file.fd, out.data(), out.size())) refuse(name, "cannot be read to its end", "write it again");
    return out;
}

BundleFiles::BundleFiles(const fs::path& given) : opened_(std::make_unique<Opened>()) {
    Opened& o = *opened_;
    if (is_builtin_bundle(given)) {
        o.path = given;
        o.made = builtin_bundle(given.string());
        return;
    }
    o.path = given.filename() == kFrameJson ? given.parent_path() : given;
    if (o.path.empty()) o.path = ".";
    const StampedFile stamp = stamped(o.path);
    // O_NONBLOCK: opening a pipe without a writer would wait forever.
    Descriptor at(::open(o.path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (at.fd < 0) refuse_bundle(o.path, fmt::format("cannot be opened ({})", std::strerror(errno)), kOpenFix);
    struct stat status {};
    if (::fstat(at.fd, &status) != 0) refuse_bundle(o.path, "cannot be examined", kOpenFix);
    if (S_ISDIR(status.st_mode)) {
        o.folder = std::move(at);
        if (!has(kFrameJson)) refuse_bundle(o.path, "the folder has no frame.json", kOpenFix);
        return;
    }
    if (!S_ISREG(status.st_mode)) refuse_bundle(o.path, "is neither folder nor zip file", kOpenFix);
    const auto size = std::uint64_t(status.st_size);
    if (size > kMaxTotalBytes) refuse_bundle(o.path, fmt::format("has {} bytes", size), "use at most 4 GiB");
    const int copy = ::fcntl(at.fd, F_DUPFD_CLOEXEC, 0);
    int error = 0;
    o.zip.emplace(copy < 0 ? nullptr : zip_fdopen(copy, ZIP_CHECKCONS, &error));
    if (!o.zip->zip) {
        if (copy >= 0) ::close(copy);
        if (error == ZIP_ER_EXISTS) refuse_bundle(o.path, "an entry stands twice in the zip file", kZipFix);
        zip_error_t text;
        zip_error_init_with_code(&text, error);
        const std::string why = zip_error_strerror(&text);
        zip_error_fini(&text);
        refuse_bundle(o.path, fmt::format("is no zip file that can be read ({})", why), kOpenFix);
    }
    o.read.push_back(stamp);
    o.entries = zip_entries(o.zip->zip, o.path, size);
    const auto prefix = folder_in_zip(o.entries);
    if (!prefix) refuse_bundle(o.path, "the zip file has no frame.json at its top", kOpenFix);
    o.prefix = *prefix;
}

BundleFiles::~BundleFiles() = default;
BundleFiles::BundleFiles(BundleFiles&&) noexcept = default;
BundleFiles& BundleFiles::operator=(BundleFiles&&) noexcept = default;

std::vector<std::byte> BundleFiles::read(std::string_view name, std::size_t max_bytes) {
    if (const std::string_view fault = bundle_path_fault(name); !fault.empty())
        refuse_bundle(opened_->path, fmt::format("the file name \"{}\" {}", printable(name, 100), fault),
                      "name a file of the bundle by a relative path with /");
    if (opened_->made) {
        const auto found = opened_->made->find(std::string(name));
        if (found == opened_->made->end()) opened_->refuse(name, "does not exist", "name a file of the bundle");
        const auto bytes = std::as_bytes(std::span(found->second));
        return {bytes.begin(), bytes.end()};
    }
    return opened_->zip ? opened_->read_entry(name, max_bytes) : opened_->read_file(name, max_bytes);
}

bool BundleFiles::has(std::string_view name) const {
    if (!bundle_path_fault(name).empty()) return false;
    if (opened_->made) return opened_->made->contains(std::string(name));
    if (opened_->zip) {
        const auto found = opened_->entries.find(opened_->prefix + std::string(name));
        return found != opened_->entries.end() && found->second.index != ZIP_UINT64_MAX;
    }
    const Descriptor file = open_part(opened_->folder.fd, name);
    struct stat status {};
    return file.fd >= 0 && ::fstat(file.fd, &status) == 0 && S_ISREG(status.st_mode);
}

std::string BundleFiles::label(std::string_view name) const {
    return (opened_->path / fs::path(name)).string();
}

std::vector<StampedFile> BundleFiles::files_read() const {
    return opened_->read;
}

namespace {

/// Returns the bytes of a zip file. @param method ZIP_CM_DEFLATE or ZIP_CM_STORE
std::string zip_bytes(const BundleContents& contents, zip_int32_t method, const fs::path& path) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* const memory = zip_source_buffer_create(nullptr, 0, 0, &error);
    zip_t* const zip = memory ? zip_open_from_source(memory, ZIP_TRUNCATE, &error) : nullptr;
    if (!zip) refuse_bundle(path, "the zip file cannot be made", "free some memory");
    zip_source_keep(memory);
    bool good = true;
    for (const auto& [name, bytes] : contents) {
        zip_source_t* const source = zip_source_buffer(zip, bytes.data(), bytes.size(), 0);
        const zip_int64_t index = source ? zip_file_add(zip, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
        constexpr zip_uint16_t kFirstDay = 1 << 5 | 1;  // 1980-01-01
        good = good && index >= 0 && zip_set_file_compression(zip, zip_uint64_t(index), method, 1) == 0 &&
               zip_file_set_dostime(zip, zip_uint64_t(index), 0, kFirstDay, 0) == 0;
    }
    good = good && zip_close(zip) == 0;
    if (!good) {
        zip_discard(zip);
        zip_source_free(memory);
        refuse_bundle(path, "the zip file cannot be made", "free some memory");
    }
    std::string out;
    zip_stat_t stat;
    zip_stat_init(&stat);
    good = zip_source_stat(memory, &stat) == 0 && zip_source_open(memory) == 0;
    if (good) {
        out.resize(stat.size);
        good = zip_source_read(memory, out.data(), out.size()) == zip_int64_t(out.size());
        zip_source_close(memory);
    }
    zip_source_free(memory);
    if (!good) refuse_bundle(path, "the zip file cannot be made", "free some memory");
    return out;
}

/// Returns the names of the files of a bundle; frame.json alone where it cannot be read.
std::set<std::string> names_in_bundle(const fs::path& folder) {
    std::set<std::string> out = {std::string(kFrameJson)};
    try {
        BundleFiles files(folder);
        const std::vector<std::byte> text = files.read(kFrameJson, kMaxFrameJsonBytes);
        const Bundle bundle =
            parse_bundle({reinterpret_cast<const char*>(text.data()), text.size()}, files.label(kFrameJson));
        out.insert({bundle.scene, bundle.picture});
        for (const BundleLight& light : bundle.lights) {
            out.insert(light.lookup.shader);
            for (const BundleMap& map : light.maps) out.insert(map.image.file);
        }
    } catch (const Error&) {
        return out;  // no bundle: only what the new one has is replaced
    }
    return out;
}

/// Checks that an existing folder holds nothing but files of the bundle in it and of the new one.
void check_replaceable(const BundleContents& contents, const fs::path& folder) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(folder, error);
    if (!fs::exists(status)) return;
    if (!fs::is_directory(status))
        refuse_bundle(folder, "exists and is no folder", "give another name, or one that ends in .zip");
    const std::set<std::string> old = names_in_bundle(folder);
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (it->is_directory(error) && !it->is_symlink(error)) continue;
        const std::string name = it->path().lexically_relative(folder).generic_string();
        if (!contents.contains(name) && !old.contains(name))
            refuse_bundle(folder,
                          fmt::format("the folder holds {}, which is no part of a bundle", printable(name, 100)),
                          "give another name, or remove the folder");
    }
    if (error) refuse_bundle(folder, fmt::format("cannot be listed ({})", error.message()), "give another name");
}

void write_bundle_folder(const BundleContents& contents, const fs::path& path) {
    const fs::path folder = path.has_filename() ? path : path.parent_path();
    check_replaceable(contents, folder);
    const fs::path parent = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
    TemporaryFolder temporary(parent / fmt::format(".{}.XXXXXX", folder.filename().string()));
    if (temporary.path().empty())
        refuse_bundle(folder, fmt::format("cannot be written ({})", std::strerror(errno)), "give another folder");
    ::chmod(temporary.path().c_str(), 0755);
    for (const auto& [file, bytes] : contents) {
        const fs::path to = temporary.path() / file;
        make_folders(to.parent_path());
        write_atomically(to, {bytes});
    }
    std::error_code error;
    if (fs::exists(fs::symlink_status(folder, error))) {
        // The old folder takes the temporary name, and is removed with it.
        if (::renameat2(AT_FDCWD, temporary.path().c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) != 0)
            refuse_bundle(folder, fmt::format("cannot be replaced ({})", std::strerror(errno)), "give another name");
        return;
    }
    fs::rename(temporary.path(), folder, error);
    if (error) refuse_bundle(folder, fmt::format("cannot be written ({})", error.message()), "give another name");
    temporary.release();
}

}  // namespace

void write_bundle_files(const BundleContents& contents, const fs::path& path) {
    for (const auto& [name, bytes] : contents)
        if (const std::string_view fault = bundle_path_fault(name); !fault.empty())
            refuse_bundle(path, fmt::format("the file name \"{}\" {}", printable(name, 100), fault), "rename it");
    if (lower_extension(path) != ".zip") return write_bundle_folder(contents, path);
    std::uint64_t total = 0;
    for (const auto& [name, bytes] : contents) total += bytes.size();
    std::string zip = zip_bytes(contents, ZIP_CM_DEFLATE, path);
    // Nearly empty maps compress beyond the limit of the reader.
    if (total > kMaxRatio / 2 * zip.size()) zip = zip_bytes(contents, ZIP_CM_STORE, path);
    write_atomically(path, {zip});
}

}  // namespace si
