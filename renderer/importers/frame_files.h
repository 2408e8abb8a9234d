// Table of files of other engines that become a bundle before they are opened: captures, and images of maps.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace si {

/// Kind of a file that holds a frame of another engine, or a part of one.
enum class FrameFileKind { Capture, MapImage };

/// Row of the table of files that become a bundle: name for people, extensions, and the command that makes the bundle.
struct FrameFile {
    std::string_view label;                        ///< "RenderDoc capture"
    std::span<const std::string_view> extensions;  ///< lower case, with the dot: ".rdc"
    FrameFileKind kind = FrameFileKind::Capture;
    std::string_view command;  ///< command line that makes the bundle, with FILE for the file
};

/// Returns the table of files that become a bundle.
std::span<const FrameFile> frame_files();

/// Returns the row of a file by its extension, in either case; null: the file becomes no bundle.
const FrameFile* find_frame_file(const std::filesystem::path& path);

}  // namespace si
