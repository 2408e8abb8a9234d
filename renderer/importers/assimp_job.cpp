#include "renderer/importers/assimp_job.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>

#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/base/printable.h"
#include "renderer/importers/assimp_files.h"
#include "renderer/importers/assimp_scene.h"

namespace si {
namespace {

/// Forwards Assimp's progress.
class ForwardedProgress final : public Assimp::ProgressHandler {
public:
    explicit ForwardedProgress(const std::function<void(double)>& progress) : progress_(progress) {}
    bool Update(float fraction) override {
        if (fraction >= 0) progress_(0.8 * double(std::min(fraction, 1.0f)));
        return true;
    }

private:
    const std::function<void(double)>& progress_;
};

constexpr unsigned kSteps = aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_SortByPType |
                            aiProcess_JoinIdenticalVertices | aiProcess_TransformUVCoords;

/// Returns Assimp's words on a failure as part of a sentence.
std::string reason_of(const char* library_text) {
    std::string text = printable(library_text, 200);
    while (!text.empty() && std::string_view(" .:;\n").find(text.back()) != std::string_view::npos) text.pop_back();
    return text.empty() ? std::string("no reason is given") : text;
}

}  // namespace

std::vector<std::uint8_t> assimp_request_bytes(const AssimpRequest& request) {
    std::vector<std::uint8_t> out(request.label.begin(), request.label.end());
    out.push_back(0);
    out.insert(out.end(), request.file.begin(), request.file.end());
    return out;
}

std::vector<std::uint8_t> assimp_work(std::span<const std::uint8_t> request,
                                      const std::function<void(double)>& progress, int folder) {
    const std::string text(request.begin(), request.end());
    const std::size_t end = std::min(text.find('\0'), text.size() - 1);
    assimp::ModelFolder model_folder(folder);
    assimp::Source source{.label = text.substr(0, end), .extension = {}, .folder = model_folder, .notes = {}};
    const std::string file = text.substr(end + 1);
    source.extension = lower_extension(file);

    Assimp::Importer importer;
    auto* const files = new assimp::FolderFiles(model_folder);  // the importer owns it
    importer.SetIOHandler(files);
    importer.SetProgressHandler(new ForwardedProgress(progress));
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    const aiScene* const scene = importer.ReadFile(file, kSteps);
    if (!scene) {
        const std::string why = reason_of(importer.GetErrorString());
        if (why.find("bad_alloc") != why.npos) throw Error("it needs more memory than its reader may take");
        throw Error(fmt::format("it cannot be read as {} ({})", source.label, why));
    }
    for (const std::string& missing : files->missing())
        source.notes.push_back(fmt::format("the file \"{}\" beside it cannot be read", missing));
    progress(0.8);
    return assimp::to_glb(*scene, source);
}

}  // namespace si
