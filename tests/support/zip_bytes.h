// Zip files of any content, also of such that no program would write.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace si::test {

/// Entry of a zip file in the making. The default is a stored file as Unix programs write it.
struct ZipPart {
    std::string name;
    std::string data;
    std::uint16_t method = 0;            ///< 0 stored, 8 deflated
    std::uint16_t flags = 0;             ///< 1: encrypted
    std::uint32_t mode = 0100644;        ///< Unix mode with kind
    std::uint32_t declared_bytes = ~0u;  ///< size without compression; ~0: that of `data`
    bool wrong_checksum = false;
};

/// Returns the checksum of zip files (CRC-32).
inline std::uint32_t crc32(const std::string& data) {
    std::uint32_t crc = ~0u;
    for (const char c : data) {
        crc ^= (unsigned char)c;
        for (int i = 0; i < 8; ++i) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

/// Returns the bytes of a zip file with these entries, in this order.
inline std::string zip_of(const std::vector<ZipPart>& parts) {
    std::string out, directory;
    const auto put = [](std::string& to, std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) to += char(value >> (8 * i) & 0xff);
    };
    for (const ZipPart& part : parts) {
        const std::uint32_t offset = std::uint32_t(out.size()), packed = std::uint32_t(part.data.size());
        const std::uint32_t bytes = part.declared_bytes == ~0u ? packed : part.declared_bytes;
        std::string common;  // fields of both headers
        put(common, 20, 2);
        put(common, part.flags, 2);
        put(common, part.method, 2);
        put(common, 0, 2);
        put(common, 33, 2);
        put(common, crc32(part.data) + part.wrong_checksum, 4);
        put(common, packed, 4);
        put(common, bytes, 4);
        put(common, std::uint32_t(part.name.size()), 2);
        put(common, 0, 2);
        put(out, 0x04034b50, 4);
        out += common + part.name + part.data;
        put(directory, 0x02014b50, 4);
        put(directory, 3 << 8 | 20, 2);
        directory += common;
        put(directory, 0, 2);
        put(directory, 0, 2);
        put(directory, 0, 2);
        put(directory, part.mode << 16, 4);
        put(directory, offset, 4);
        directory += part.name;
    }
    const std::uint32_t start = std::uint32_t(out.size());
    out += directory;
    put(out, 0x06054b50, 4);
    put(out, 0, 4);
    put(out, std::uint32_t(parts.size()), 2);
    put(out, std::uint32_t(parts.size()), 2);
    put(out, std::uint32_t(directory.size()), 4);
    put(out, start, 4);
    put(out, 0, 2);
    return out;
}

}  // namespace si::test
