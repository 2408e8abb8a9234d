#include "renderer/gltf/tinygltf_model.h"

#include <fmt/format.h>

#include <limits>

namespace si::gltf {
namespace {

tinygltf::FsCallbacks closed_file_system() {
    tinygltf::FsCallbacks callbacks{};
    callbacks.FileExists = [](const std::string&, void*) { return false; };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) {
        return false;
    };
    callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
        return false;
    };
    return callbacks;
}

bool skip_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
    return true;
}

}  // namespace

tinygltf::Model read_model(const Context& context, const Json& root) {
    const std::string text = core_text(root);
    if (text.size() > std::size_t(std::numeric_limits<int>::max())) {
        context.fail("the JSON is too large", "split the scene");
    }
    tinygltf::Model model;
    tinygltf::TinyGLTF reader;
    reader.SetFsCallbacks(closed_file_system());
    reader.SetImageLoader(skip_image, nullptr);
    std::string errors, warnings;
    bool ok = false;
    try {
        ok = reader.LoadASCIIFromString(&model, &errors, &warnings, text.data(), static_cast<unsigned>(text.size()), "",
                                        tinygltf::REQUIRE_VERSION);
    } catch (const std::exception& error) {
        errors = error.what();
    }
    if (!ok) {
        while (!errors.empty() && errors.back() == '\n') errors.pop_back();
        context.fail(errors.empty() ? "tinygltf cannot read it" : errors, "repair the file or export it again");
    }
    return model;
}

}  // namespace si::gltf
