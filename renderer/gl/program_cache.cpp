#include "renderer/gl/program_cache.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/base/key.h"
#include "renderer/gl/driver_failure.h"

namespace si::gl {
namespace {

constexpr const char* kShaderFix =
    "; where this driver cannot build it, choose another kernel, bias, source or overlay, or a newer driver";

constexpr std::size_t kRequestsAProgram = 64;  ///< that come to the same text and are remembered

std::string info_log(GLuint id, bool program) {
    GLint length = 0;
    program ? glGetProgramiv(id, GL_INFO_LOG_LENGTH, &length) : glGetShaderiv(id, GL_INFO_LOG_LENGTH, &length);
    std::string text(std::size_t(length > 0 ? length : 1), '\0');
    program ? glGetProgramInfoLog(id, length, nullptr, text.data())
            : glGetShaderInfoLog(id, length, nullptr, text.data());
    return text.c_str();
}

std::string numbered(const std::vector<std::string>& files) {
    std::string out;
    for (std::size_t i = 0; i < files.size(); ++i) out += fmt::format("{}{} = shaders/{}", i ? ", " : "", i, files[i]);
    return out;
}

GLuint compile(GLenum stage, const std::string& text, const std::vector<std::string>& files) {
    const GLuint shader = glCreateShader(stage);
    const char* pointer = text.c_str();
    glShaderSource(shader, 1, &pointer, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (is_injected_failure(DriverFailure::Shader,
                            files.empty() ? std::string_view() : std::string_view(files.front())))
        ok = 0;
    if (!ok) {
        const std::string log = info_log(shader, false);
        glDeleteShader(shader);
        throw Error(fmt::format("shader does not compile (files: {}): {}{}", numbered(files), log, kShaderFix));
    }
    return shader;
}

}  // namespace

Program ProgramCache::build(const std::string& vertex, const std::string& fragment, std::string_view label,
                            const std::vector<std::string>& files) const {
    const GLuint vs = compile(GL_VERTEX_SHADER, vertex, files);
    GLuint fs = 0;
    try {
        fs = compile(GL_FRAGMENT_SHADER, fragment, files);
    } catch (...) {
        glDeleteShader(vs);
        throw;
    }
    auto program = Program::create(label);
    glAttachShader(program.id(), vs);
    glAttachShader(program.id(), fs);
    glLinkProgram(program.id());
    glDeleteShader(vs);
    glDeleteShader(fs);
    GLint ok = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
    if (!ok)
        throw Error(fmt::format("shader does not link (files: {}): {}{}", numbered(files), info_log(program.id(), true),
                                kShaderFix));
    return program;
}

GLuint ProgramCache::get(const ProgramRequest& request) {
    Key key;
    key.add(request.vertex).add(request.fragment).add(request.preamble);
    for (const auto& [name, file] : request.includes) key.add(name).add(file);
    for (const auto& d : request.defines) key.add(d.name).add(d.value);
    const std::uint64_t request_key = key.value();
    key.add(source_.generation());
    if (const auto it = by_request_.find(key.value()); it != by_request_.end()) return use(*it->second);
    try {
        std::vector<std::string> files;
        const std::string vertex = source_.expand(request.vertex, request.includes, files);
        const std::size_t vertex_files = files.size();
        std::vector<std::string> fragment_files;
        const std::string fragment = source_.expand(request.fragment, request.includes, fragment_files);
        std::string head = "#version 450 core\n";
        for (const auto& d : request.defines)
            if (mentions(vertex, d.name) || mentions(fragment, d.name))
                head += fmt::format("#define {} {}\n", d.name, d.value);
        head += request.preamble;
        Key text_key;
        text_key.add(head).add(vertex).add(fragment);
        auto it = programs_.find(text_key.value());
        if (it == programs_.end()) {
            // Vertex and fragment shader number their files separately; the log names those of the fragment shader.
            files.resize(vertex_files);
            const auto& named = fragment_files.size() > files.size() ? fragment_files : files;
            Kept kept{build(head + vertex, head + fragment, request.fragment, named)};
            kept.program.track_memory("texts of shader programs", 2 * head.size() + vertex.size() + fragment.size());
            it = programs_.emplace(text_key.value(), std::move(kept)).first;
        }
        log_.clear();
        last_good_[request_key] = by_request_[key.value()] = &it->second;
        return use(it->second);
    } catch (const Error& e) {
        log_ = e.what();
        const auto good = last_good_.find(request_key);
        if (good == last_good_.end()) throw;
        return use(*(by_request_[key.value()] = good->second));
    }
}

GLuint ProgramCache::use(Kept& kept) const {
    kept.used = frame_;
    return kept.program.id();
}

void ProgramCache::end_frame(std::size_t most) {
    const std::uint64_t now = frame_++;
    if (most == 0) most = kMaxPrograms;
    if (std::max(by_request_.size(), last_good_.size()) > kRequestsAProgram * most) {
        by_request_.clear();
        last_good_.clear();
    }
    while (programs_.size() > most) {
        const auto oldest = std::min_element(programs_.begin(), programs_.end(), [](const auto& a, const auto& b) {
            return a.second.used < b.second.used;
        });
        if (oldest->second.used == now) return;
        const auto names_it = [&](const auto& of) { return of.second == &oldest->second; };
        std::erase_if(by_request_, names_it);
        std::erase_if(last_good_, names_it);
        programs_.erase(oldest);
    }
}

}  // namespace si::gl
