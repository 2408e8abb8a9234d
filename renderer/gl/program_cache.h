// Cache of linked OpenGL programs, by source files, included techniques and defines.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "renderer/gl/handle.h"
#include "renderer/gl/shader_source.h"

namespace si::gl {

/// A preprocessor definition for GLSL: "#define name value".
struct Define {
    std::string name, value;
};

/// Description of an OpenGL program to compile: source files, includes and defines. Used as key of the ProgramCache.
struct ProgramRequest {
    std::string_view vertex, fragment;  ///< paths below shaders/
    IncludeNames includes;
    std::vector<Define> defines;  ///< names that the sources do not mention are ignored
    std::string preamble;         ///< text after the defines, e.g. a uniform block made from the settings table
};

/// Cache of linked OpenGL programs of one context. Compiles a program on the first request, and again after a shader
/// file changed.
class ProgramCache {
public:
    /// Limit of cached programs. A frame uses 5 to 40. On llvmpipe each takes some 4 MB of machine code and
    /// intermediate data (measured over 55 programs); a program that is linked again comes from the driver's shader
    /// cache.
    static constexpr std::size_t kMaxPrograms = 64;
    /// @param source shader files to compile from
    explicit ProgramCache(ShaderSource source = ShaderSource()) : source_(std::move(source)) {}
    /// Returns the OpenGL name of the linked program for a request; compiles the program if the cache lacks it. When a
    /// changed shader file does not compile, the last good program is returned.
    /// @throws Error with the compile log and the file names when there is no good program.
    GLuint get(const ProgramRequest& request);
    /// Returns the GLSL sources that programs are compiled from.
    ShaderSource& source() { return source_; }
    /// Returns the error text of the last compilation; empty if it succeeded.
    const std::string& log() const { return log_; }
    /// Returns the number of programs in the cache.
    std::size_t size() const { return programs_.size(); }
    /// Marks the end of a frame for the program cache: deletes the least recently used programs until `most` are left.
    /// Programs that the frame used stay.
    /// @param most largest number of programs to keep; 0: kMaxPrograms
    void end_frame(std::size_t most = 0);

private:
    /// Linked shader program in the program cache, and the last frame that used it.
    struct Kept {
        Program program;
        std::uint64_t used = 0;  ///< last frame that used the program
    };
    ShaderSource source_;
    std::unordered_map<std::uint64_t, Kept*> by_request_;  // request and generation
    std::unordered_map<std::uint64_t, Kept*> last_good_;   // request alone
    std::unordered_map<std::uint64_t, Kept> programs_;     // final text
    std::uint64_t frame_ = 1;
    std::string log_;
    /// Marks a cached program as used in this frame and returns its OpenGL name.
    GLuint use(Kept& kept) const;
    /// Compiles and links a program from the complete GLSL texts of its two shaders.
    /// @param label name of the program in frame debuggers
    /// @param files source files, for the error message
    /// @throws Error with the compile log
    Program build(const std::string& vertex, const std::string& fragment, std::string_view label,
                  const std::vector<std::string>& files) const;
};

}  // namespace si::gl
