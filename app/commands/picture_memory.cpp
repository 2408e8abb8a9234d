// Memory that a large picture takes, reported before it is drawn.
#include <fmt/format.h>

#include "app/base/notes.h"
#include "app/commands/commands.h"
#include "renderer/base/error.h"
#include "renderer/base/held_memory.h"

namespace si {

std::string picture_memory_note(const PictureSize& size, std::uint64_t bytes_per_pixel, std::uint64_t available) {
    constexpr std::uint64_t kNotedBytes = std::uint64_t{1} << 30;
    const std::uint64_t bytes = std::uint64_t(size.width) * std::uint64_t(size.height) * bytes_per_pixel;
    if (bytes < kNotedBytes) return {};
    const std::string text =
        fmt::format("{} x {} pixels take about {} of memory", size.width, size.height, bytes_text(bytes));
    if (available == 0) return text;
    if (bytes > available)
        throw Error(fmt::format("--size {}x{}: {}, and {} are free; choose a smaller picture", size.width, size.height,
                                text, bytes_text(available)));
    return fmt::format("{}; {} are free", text, bytes_text(available));
}

void require_picture_memory(const PictureSize& size, std::uint64_t bytes_per_pixel) {
    if (const std::string note = picture_memory_note(size, bytes_per_pixel, available_memory()); !note.empty())
        print_notes({note});
}

}  // namespace si
