// Kinds of files that the editor exports.
#pragma once

#include <string>

namespace si {

/// Kind of file that the menu command Export writes.
enum class ExportKind {
    Bundle,   ///< scene, camera, maps and matrices of the frame
    Picture,  ///< scene picture with its overlay
    Map,      ///< shown depth map
    Code,     ///< settings as code of an engine, which the dialog Convert writes
};

/// Request to write the shown frame into a file: a bundle (scene, camera and maps as files), a picture, a map or code.
struct ExportRequest {
    ExportKind kind = ExportKind::Bundle;
    std::string path;
    bool operator==(const ExportRequest&) const = default;
};

}  // namespace si
