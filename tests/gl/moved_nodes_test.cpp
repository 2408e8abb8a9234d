// Tests that meshes stay uploaded where only node transforms have changed.
#include <epoxy/gl.h>

#include "renderer/scenes/builtin.h"
#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

/// Counts uploads into buffers during its lifetime. An upload must come first: epoxy loads a function of the driver at
/// its first call and would overwrite the replacement.
class UploadCount {
public:
    UploadCount() {
        current = this;
        put_ = epoxy_glNamedBufferSubData;
        epoxy_glNamedBufferSubData = [](GLuint buffer, GLintptr at, GLsizeiptr size, const void* data) {
            current->bytes_ += std::size_t(size);
            current->put_(buffer, at, size, data);
        };
    }
    ~UploadCount() { epoxy_glNamedBufferSubData = put_; }
    UploadCount(const UploadCount&) = delete;
    UploadCount& operator=(const UploadCount&) = delete;
    std::size_t bytes() const { return bytes_; }

private:
    inline static UploadCount* current = nullptr;
    PFNGLNAMEDBUFFERSUBDATAPROC put_ = nullptr;
    std::size_t bytes_ = 0;
};

class MovedNodes : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        renderer.render(load_scene("boxes"), settings_, {.width = 16, .height = 9});
    }
    std::size_t uploads(const Scene& scene) {
        const UploadCount count;
        FrameRequest request{.width = 160, .height = 90, .outputs = {.visibility = true}};
        picture_ = renderer.read_colour(renderer.render(scene, settings_, request).colour);
        return count.bytes();
    }
    /// Compares the last picture with one by a new renderer.
    void expect_as_fresh(const Scene& scene) {
        Renderer fresh;
        FrameRequest request{.width = 160, .height = 90, .outputs = {.visibility = true}};
        EXPECT_EQ(picture_.data, fresh.read_colour(fresh.render(scene, settings_, request).colour).data);
    }
    Settings settings_;
    ByteImage picture_;
};

TEST_F(MovedNodes, MeshesAreNotUploadedWhereOnlyTransformsChange) {
    Scene scene = load_scene("teapot");
    const std::size_t all = uploads(scene);
    for (Node& node : scene.nodes) node.local[3].x += 0.25;
    refresh(scene);
    EXPECT_LT(uploads(scene), all / 10);
    expect_as_fresh(scene);
    const ByteImage before = picture_;
    hide_objects(scene, {scene.nodes[std::size_t(scene.objects[0].node)].path});
    EXPECT_LT(uploads(scene), all / 10);
    EXPECT_NE(picture_.data, before.data);
    expect_as_fresh(scene);
}

TEST_F(MovedNodes, ChangedMeshesAndMaterialsAreUploadedAgain) {
    Scene scene = load_scene("teapot");
    const std::size_t all = uploads(scene);
    for (glm::vec3& p : scene.meshes[0].positions.edit()) p *= 1.5f;
    refresh(scene);
    EXPECT_GT(uploads(scene), all / 2);
    expect_as_fresh(scene);
    for (Material& m : scene.materials) {
        m.alpha = AlphaMode::Mask;
        m.alpha_cutoff = 2;
    }
    refresh(scene);
    EXPECT_GT(uploads(scene), all / 2);
    expect_as_fresh(scene);
    // Equal numbers at another address are another mesh.
    for (Mesh& m : scene.meshes) m.positions = std::vector<glm::vec3>(m.positions.all());
    refresh(scene);
    EXPECT_GT(uploads(scene), all / 2);
}

}  // namespace
}  // namespace si
