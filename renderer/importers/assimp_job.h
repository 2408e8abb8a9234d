// Job of a child process: reads a model with Assimp and returns it as a GLB.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "renderer/foreign/child.h"

namespace si {

/// Request to the child process that reads a model with Assimp: the name of the model's file in its folder.
struct AssimpRequest {
    std::string file;   ///< name without folder
    std::string label;  ///< name of the format, for messages: "OBJ"
};

/// Encodes a request to read a model with Assimp as bytes for run_foreign_job(), which runs it in a child process.
std::vector<std::uint8_t> assimp_request_bytes(const AssimpRequest& request);

/// Reads a model with Assimp and returns it as the bytes of a GLB, with notes in the extras of its asset. Runs in a
/// child process.
/// @param request bytes from assimp_request_bytes()
/// @param progress is called with 0..1
/// @param folder descriptor of the model's folder
/// @throws Error one sentence without the file's name
std::vector<std::uint8_t> assimp_work(std::span<const std::uint8_t> request,
                                      const std::function<void(double)>& progress, int folder);

/// Job that reads a model with Assimp in a child process; row of foreign_jobs().
inline constexpr ForeignJob kAssimpJob{"assimp", "the model reader (Assimp)", assimp_work};

}  // namespace si
