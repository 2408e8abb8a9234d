// Job of a child process: reads a model by Assimp and returns it as a GLB.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "renderer/foreign/child.h"

namespace si {

/// Request of the job: the model's file, which lies in the folder of the job.
struct AssimpRequest {
    std::string file;   ///< name without folder
    std::string label;  ///< name of the format, for messages: "OBJ"
};

/// Encodes a request for run_foreign_job().
std::vector<std::uint8_t> assimp_request_bytes(const AssimpRequest& request);

/// Reads the model that a request names and returns it as the bytes of a GLB, with notes in the extras of its asset.
/// @param progress takes 0..1 @param folder descriptor of the model's folder
/// @throws Error one sentence without the file's name
std::vector<std::uint8_t> assimp_work(std::span<const std::uint8_t> request,
                                      const std::function<void(double)>& progress, int folder);

/// Row of the job, for run_foreign_job() and the table of jobs.
inline constexpr ForeignJob kAssimpJob{"assimp", "the model reader (Assimp)", assimp_work};

}  // namespace si
