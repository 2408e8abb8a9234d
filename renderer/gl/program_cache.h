// Programs by what they are made of: two source files, included techniques and defines.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "renderer/gl/handle.h"
#include "renderer/gl/shader_source.h"

namespace si::gl {

struct Define {
    std::string name, value;
};

struct ProgramRequest {
    std::string_view vertex, fragment;  ///< below shaders/
    IncludeNames includes;
    std::vector<Define> defines;  ///< only those that the sources mention enter the program
    std::string preamble;         ///< text after the defines, e.g. a uniform block made from the settings table
};

class ProgramCache {
public:
    /// Programs kept from frame to frame unless told otherwise. A frame takes 5 to 40. On llvmpipe each takes some 4
    /// MB, machine code included (resident memory, measured over 55 programs of a random trial); a program that was
    /// dropped is found in the driver's cache of shaders.
    static constexpr std::size_t kMostPrograms = 64;
    explicit ProgramCache(ShaderSource source = ShaderSource(), std::size_t most = kMostPrograms)
        : source_(std::move(source)), most_(most) {}
    /// The linked program. A miss compiles; after a hot reload that does not compile, the last good program.
    /// @throws Error with the compile log and the file names when there is no good program.
    GLuint get(const ProgramRequest& request);
    ShaderSource& source() { return source_; }
    const std::string& log() const { return log_; }
    std::size_t size() const { return programs_.size(); }
    /// A frame ends: of what it did not use, the longest unused gives way until `most` programs are left; 0: as many as
    /// the constructor was told.
    void end_frame(std::size_t most = 0);

private:
    struct Kept {
        Program program;
        std::uint64_t used = 0;  ///< the last frame that did
    };
    ShaderSource source_;
    std::size_t most_;
    std::unordered_map<std::uint64_t, Kept*> by_request_;  // request and generation
    std::unordered_map<std::uint64_t, Kept*> last_good_;   // request alone
    std::unordered_map<std::uint64_t, Kept> programs_;     // final text
    std::uint64_t frame_ = 1;
    std::string log_;
    GLuint use(Kept& kept) const;
    Program build(const std::string& vertex, const std::string& fragment, std::string_view label,
                  const std::vector<std::string>& files) const;
};

}  // namespace si::gl
