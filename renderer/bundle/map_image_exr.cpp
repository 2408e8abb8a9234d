#include "renderer/bundle/map_image_exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/bundle/bundle.h"
#include "renderer/bundle/map_image_checks.h"
#include "renderer/foreign/pack.h"

namespace si {
namespace {

constexpr std::size_t kMaxExrNumbers = std::size_t{1} << 28;  // an answer of 1 GiB
constexpr std::string_view kWriteAgain = "write the file again";

/// Bytes of a file in memory, read by the library.
class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(std::span<const std::uint8_t> bytes) : IStream("image"), bytes_(bytes) {}
    bool read(char c[], int n) override {
        if (n < 0 || std::uint64_t(n) > bytes_.size() - at_) throw std::runtime_error("the file is cut");
        std::memcpy(c, bytes_.data() + at_, std::size_t(n));
        at_ += std::uint64_t(n);
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t place) override {
        if (place > bytes_.size()) throw std::runtime_error("the file is cut");
        at_ = place;
    }
    void clear() override {}

private:
    std::span<const std::uint8_t> bytes_;
    std::uint64_t at_ = 0;
};

/// Bytes of a file that the library writes to memory.
class MemoryOutput : public Imf::OStream {
public:
    MemoryOutput() : OStream("image") {}
    void write(const char c[], int n) override {
        if (bytes.size() < at_ + std::uint64_t(n)) bytes.resize(at_ + std::uint64_t(n));
        std::memcpy(bytes.data() + at_, c, std::size_t(n));
        at_ += std::uint64_t(n);
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t place) override { at_ = place; }
    std::string bytes;

private:
    std::uint64_t at_ = 0;
};

/// Returns the names of the channels to read, those of depths first.
std::vector<std::string> channel_names(const Imf::ChannelList& channels) {
    std::vector<std::string> out;
    for (const char* name : {"Z", "Y", "R", "G", "B", "A"})
        if (channels.findChannel(name)) out.emplace_back(name);
    for (auto it = channels.begin(); it != channels.end(); ++it)
        if (std::ranges::find(out, it.name()) == out.end()) out.emplace_back(it.name());
    constexpr std::size_t kMost = 4;
    if (out.size() > kMost) out.resize(kMost);
    return out;
}

FloatImage decode_exr(std::span<const std::uint8_t> bytes) {
    MemoryInput stream(bytes);
    Imf::InputFile file(stream, 0);
    const Imath::Box2i window = file.header().dataWindow();
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
    check_map_image_sides(width, height);
    const Imf::ChannelList& channels = file.header().channels();
    const std::vector<std::string> names = channel_names(channels);
    if (names.empty()) throw Error("the image has no channel; write one of depths");
    const std::size_t texels = std::size_t(width) * std::size_t(height);
    check_map_image_numbers(width, height, int(names.size()), kMaxExrNumbers);
    FloatImage out{int(width), int(height), int(names.size()), {}};
    out.data.resize(texels * names.size());
    Imf::FrameBuffer buffer;
    std::vector<std::vector<std::uint32_t>> whole(names.size());
    const auto add_slice = [&](const std::string& name, Imf::PixelType type, void* first, std::size_t stride) {
        // Addresses count from the origin of the image, which the data window may lie far from.
        const auto origin = reinterpret_cast<std::uintptr_t>(first) -
                            std::uintptr_t(std::int64_t(window.min.x) * std::int64_t(stride)) -
                            std::uintptr_t(std::int64_t(window.min.y) * std::int64_t(stride) * width);
        buffer.insert(name, Imf::Slice(type, reinterpret_cast<char*>(origin), stride, stride * std::size_t(width)));
    };
    for (std::size_t c = 0; c < names.size(); ++c) {
        const Imf::Channel& channel = *channels.findChannel(names[c]);
        if (channel.xSampling != 1 || channel.ySampling != 1)
            throw Error(
                fmt::format("channel {} has fewer samples than texels; write one a texel", printable(names[c], 60)));
        if (channel.type == Imf::UINT) {
            whole[c].resize(texels);
            add_slice(names[c], Imf::UINT, whole[c].data(), sizeof(std::uint32_t));
        } else {
            add_slice(names[c], Imf::FLOAT, out.data.data() + c, sizeof(float) * names.size());
        }
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    for (std::size_t c = 0; c < names.size(); ++c)
        for (std::size_t i = 0; i < whole[c].size(); ++i)
            out.data[i * names.size() + c] = float(whole[c][i] / 4294967295.0);
    return out;
}

std::vector<std::uint8_t> run_exr_job(std::span<const std::uint8_t> request,
                                      const std::function<void(double)>& progress, int) {
    return decode_packed_exr(request, progress);
}

}  // namespace

constinit const ForeignJob kExrJob = {"exr", "the OpenEXR decoder", run_exr_job};

std::vector<std::uint8_t> decode_packed_exr(std::span<const std::uint8_t> bytes,
                                            const std::function<void(double)>& progress) {
    progress(0);
    FloatImage image;
    try {
        image = decode_exr(bytes);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(fmt::format("the OpenEXR image cannot be read ({}); {}", printable(error.what()), kWriteAgain));
    }
    PackWriter out;
    out.number(std::uint64_t(image.width));
    out.number(std::uint64_t(image.height));
    out.number(std::uint64_t(image.channels));
    out.block({reinterpret_cast<const std::uint8_t*>(image.data.data()), image.data.size() * sizeof(float)});
    return std::move(out.bytes());
}

FloatImage decode_exr_map(std::span<const std::byte> bytes) {
    constexpr std::array<std::uint8_t, 4> kMagic = {0x76, 0x2f, 0x31, 0x01};
    const std::span file(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    if (file.size() < kMagic.size() || !std::equal(kMagic.begin(), kMagic.end(), file.begin()))
        throw Error("the file is no OpenEXR image; write one of floats");
    ForeignLimits limits;
    limits.memory_bytes = std::size_t{3} << 30;
    limits.answer_bytes = kMaxExrNumbers * sizeof(float) + 4096;
    const auto answer = run_foreign_job(kExrJob, file, limits);
    PackReader in(answer);
    const std::uint64_t width = in.number(), height = in.number(), channels = in.number();
    const auto data = in.block();
    constexpr std::uint64_t kSide = kMaxBundleImageSide;
    if (width < 1 || height < 1 || width > kSide || height > kSide || channels < 1 || channels > 4 ||
        data.size() != width * height * channels * sizeof(float))
        throw Error("the OpenEXR decoder returns an image of a wrong size");
    FloatImage out{int(width), int(height), int(channels), {}};
    out.data.resize(data.size() / sizeof(float));
    std::memcpy(out.data.data(), data.data(), data.size());
    return out;
}

std::string exr_bytes(const FloatImage& image) {
    std::vector<float> first(std::size_t(image.width) * std::size_t(image.height));
    for (std::size_t i = 0; i < first.size(); ++i) first[i] = image.data[i * std::size_t(image.channels)];
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first.data()), sizeof(float),
                                  sizeof(float) * std::size_t(image.width)));
    MemoryOutput stream;
    {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(image.height);
    }
    return std::move(stream.bytes);
}

}  // namespace si
