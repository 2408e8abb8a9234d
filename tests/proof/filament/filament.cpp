// Draws jobs in Filament 1.9: filament JOB... The mask is a lit white material under one directional light, divided by
// the same picture with receiving off: colour, N·L and exposure cancel. Both are drawn into a target of linear floats
// without post-processing. Filament fits the map by itself; the light's matrix is that of the view's light camera.
// clang-format off
// Filament's macros have names that the JSON library uses, so that library comes first.
#include "native/job.h"
// clang-format on

#include <filamat/MaterialBuilder.h>
#include <filament/Camera.h>
#include <filament/DebugRegistry.h>
#include <filament/Engine.h>
#include <filament/IndexBuffer.h>
#include <filament/LightManager.h>
#include <filament/Material.h>
#include <filament/MaterialInstance.h>
#include <filament/RenderTarget.h>
#include <filament/RenderableManager.h>
#include <filament/Renderer.h>
#include <filament/Scene.h>
#include <filament/SwapChain.h>
#include <filament/Texture.h>
#include <filament/VertexBuffer.h>
#include <filament/View.h>
#include <filament/Viewport.h>
#include <geometry/SurfaceOrientation.h>
#include <utils/EntityManager.h>

#include <cstdio>
#include <limits>
#include <memory>

namespace {

using namespace filament;
using filamat::MaterialBuilder;
using math::float3;
using proof::Job;
using proof::Matrix;

math::mat4 filament_matrix(const Matrix& m) {
    math::mat4 out;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) out[column][row] = m[4 * column + row];
    return out;
}

Matrix matrix_of(const math::mat4& m) {
    Matrix out{};
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) out[4 * column + row] = m[column][row];
    return out;
}

Material* white_material(Engine& engine, bool double_sided) {
    MaterialBuilder builder;
    builder.name(double_sided ? "two_sided" : "one_sided")
        .shading(MaterialBuilder::Shading::LIT)
        .platform(MaterialBuilder::Platform::DESKTOP)
        .targetApi(MaterialBuilder::TargetApi::OPENGL)
        .optimization(MaterialBuilder::Optimization::NONE)
        .material(
            "void material(inout MaterialInputs m) { prepareMaterial(m); m.baseColor = vec4(1.0); m.roughness = 1.0; "
            "}");
    if (double_sided) builder.doubleSided(true).culling(MaterialBuilder::CullingMode::NONE);
    const filamat::Package package = builder.build(engine.getJobSystem());
    if (!package.isValid()) throw std::runtime_error("Filament does not compile the material");
    return Material::Builder().package(package.getData(), package.getSize()).build(engine);
}

LightManager::ShadowOptions shadow_options(const Job& job) {
    LightManager::ShadowOptions out;
    out.mapSize = std::uint32_t(job.map_resolution);
    out.constantBias = job.parameter("constantBias", out.constantBias);
    out.normalBias = job.parameter("normalBias", out.normalBias);
    out.polygonOffsetConstant = job.parameter("polygonOffsetConstant", out.polygonOffsetConstant);
    out.polygonOffsetSlope = job.parameter("polygonOffsetSlope", out.polygonOffsetSlope);
    out.stable = job.choice("stable", "true") == "true";
    return out;
}

class Drawing {
public:
    Drawing() {
        engine_ = Engine::create(Engine::Backend::OPENGL);
        if (!engine_) throw std::runtime_error("Filament does not start");
        swap_chain_ = engine_->createSwapChain(64, 64, SwapChain::CONFIG_READABLE);
        renderer_ = engine_->createRenderer();
        MaterialBuilder::init();
        for (const bool double_sided : {false, true}) materials_[double_sided] = white_material(*engine_, double_sided);
    }

    ~Drawing() {
        for (Material* material : materials_) engine_->destroy(material);
        engine_->destroy(renderer_);
        engine_->destroy(swap_chain_);
        MaterialBuilder::shutdown();
        Engine::destroy(&engine_);
    }

    void draw(const Job& job) {
        const LightManager::ShadowOptions options = shadow_options(job);
        // The warp of a map along the view is no setting of this version's options, but a switch for debugging.
        engine_->getDebugRegistry().setProperty("d.shadowmap.lispsm", job.choice("lispsm", "false") == "true");
        scene_ = engine_->createScene();
        for (const proof::Object& object : job.objects) add(object);
        const nlohmann::json& direction = job.json["light"]["to_light_ws"];
        const float3 to_light{direction[0].get<float>(), direction[1].get<float>(), direction[2].get<float>()};
        const utils::Entity light = utils::EntityManager::get().create();
        LightManager::Builder(LightManager::Type::DIRECTIONAL)
            .direction(-to_light)
            .intensity(1)
            .castShadows(true)
            .shadowOptions(options)
            .build(*engine_, light);
        scene_->addEntity(light);

        const utils::Entity eye = utils::EntityManager::get().create();
        Camera* camera = engine_->createCamera(eye);
        camera->setCustomProjection(filament_matrix(proof::matrix_of(job.json["camera"]["clip_from_view"])),
                                    job.camera("near_m"), job.camera("far_m"));
        camera->setModelMatrix(math::mat4f(
            filament_matrix(proof::inverse_of_pose(proof::matrix_of(job.json["camera"]["view_from_world"])))));
        camera->setExposure(1);

        const auto texture = [&](Texture::InternalFormat format, Texture::Usage usage) {
            return Texture::Builder()
                .width(std::uint32_t(job.width_px))
                .height(std::uint32_t(job.height_px))
                .levels(1)
                .format(format)
                .usage(usage)
                .build(*engine_);
        };
        Texture* colour = texture(Texture::InternalFormat::RGBA32F, Texture::Usage::COLOR_ATTACHMENT);
        Texture* depth = texture(Texture::InternalFormat::DEPTH32F, Texture::Usage::DEPTH_ATTACHMENT);
        RenderTarget* target = RenderTarget::Builder()
                                   .texture(RenderTarget::AttachmentPoint::COLOR, colour)
                                   .texture(RenderTarget::AttachmentPoint::DEPTH, depth)
                                   .build(*engine_);
        View* view = engine_->createView();
        view->setScene(scene_);
        view->setCamera(camera);
        view->setViewport({0, 0, std::uint32_t(job.width_px), std::uint32_t(job.height_px)});
        view->setRenderTarget(target);
        view->setPostProcessingEnabled(false);
        view->setShadowingEnabled(true);

        const auto picture = [&](bool shadows) {
            RenderableManager& renderables = engine_->getRenderableManager();
            for (const Made& made : made_)
                renderables.setReceiveShadows(renderables.getInstance(made.entity), shadows && made.receives);
            std::vector<float> out(std::size_t(4) * job.width_px * job.height_px);
            // The first frame of a swap chain may be skipped.
            while (!renderer_->beginFrame(swap_chain_)) engine_->flushAndWait();
            renderer_->render(view);
            renderer_->readPixels(
                target, 0, 0, std::uint32_t(job.width_px), std::uint32_t(job.height_px),
                backend::PixelBufferDescriptor(out.data(), out.size() * sizeof(float), backend::PixelDataFormat::RGBA,
                                               backend::PixelDataType::FLOAT));
            renderer_->endFrame();
            engine_->flushAndWait();
            return out;
        };
        const std::vector<float> shadowed = picture(true);
        const Camera* box = view->getDirectionalLightCamera();
        // The constant bias is a shift of this camera, and no part of the light's box.
        const Matrix clip_from_world =
            matrix_of(box->getCullingProjectionMatrix() * math::mat4(box->getViewMatrix()) *
                      math::mat4::translation(math::double3(to_light) * double(options.constantBias)));
        const std::vector<float> lit = picture(false);
        proof::write_mask(job, shadowed, lit);
        // One texel on each side is not used.
        proof::write_facts(job,
                           {{"engine", "Filament"},
                            {"version", "1.9.25"},
                            {"map_resolution", options.mapSize - 2},
                            {"map_rim_texels", 1},
                            {"map_format", "depth16"}},
                           clip_from_world, -1, 1);

        engine_->destroy(view);
        engine_->destroy(target);
        engine_->destroy(colour);
        engine_->destroy(depth);
        engine_->destroyCameraComponent(eye);
        for (const utils::Entity entity : {light, eye}) destroy(entity);
        for (const Made& made : made_) {
            destroy(made.entity);
            engine_->destroy(made.vertices);
            engine_->destroy(made.indices);
        }
        made_.clear();
        engine_->destroy(scene_);
        engine_->flushAndWait();
    }

private:
    struct Made {
        utils::Entity entity;
        VertexBuffer* vertices;
        IndexBuffer* indices;
        bool receives;
    };

    void destroy(utils::Entity entity) {
        engine_->destroy(entity);
        utils::EntityManager::get().destroy(entity);
    }

    void add(const proof::Object& object) {
        const std::size_t count = object.positions.size() / 3;
        // Filament takes normals as rotations.
        std::unique_ptr<geometry::SurfaceOrientation> frames(
            geometry::SurfaceOrientation::Builder()
                .vertexCount(count)
                .normals(reinterpret_cast<const float3*>(object.normals.data()))
                .build());
        rotations_.emplace_back(count);
        frames->getQuats(rotations_.back().data(), count);
        positions_.push_back(object.positions);
        indices_.push_back(object.indices);
        Made made{};
        made.vertices = VertexBuffer::Builder()
                            .vertexCount(std::uint32_t(count))
                            .bufferCount(2)
                            .attribute(VertexAttribute::POSITION, 0, VertexBuffer::AttributeType::FLOAT3)
                            .attribute(VertexAttribute::TANGENTS, 1, VertexBuffer::AttributeType::FLOAT4)
                            .build(*engine_);
        const auto buffer = [](const auto& values) {
            return VertexBuffer::BufferDescriptor(values.data(), values.size() * sizeof(values[0]));
        };
        made.vertices->setBufferAt(*engine_, 0, buffer(positions_.back()));
        made.vertices->setBufferAt(*engine_, 1, buffer(rotations_.back()));
        made.indices = IndexBuffer::Builder()
                           .indexCount(std::uint32_t(object.indices.size()))
                           .bufferType(IndexBuffer::IndexType::UINT)
                           .build(*engine_);
        made.indices->setBuffer(*engine_, buffer(indices_.back()));
        made.entity = utils::EntityManager::get().create();
        made.receives = object.receives;
        float3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
        for (std::size_t i = 0; i < object.positions.size(); i += 3) {
            const float3 at{object.positions[i], object.positions[i + 1], object.positions[i + 2]};
            low = min(low, at);
            high = max(high, at);
        }
        RenderableManager::Builder(1)
            .boundingBox(Box().set(low, high))
            .material(0, materials_[object.double_sided]->getDefaultInstance())
            .geometry(0, RenderableManager::PrimitiveType::TRIANGLES, made.vertices, made.indices)
            .castShadows(object.casts)
            .receiveShadows(object.receives)
            .build(*engine_, made.entity);
        scene_->addEntity(made.entity);
        made_.push_back(made);
    }

    Engine* engine_ = nullptr;
    SwapChain* swap_chain_ = nullptr;
    Renderer* renderer_ = nullptr;
    Scene* scene_ = nullptr;
    std::array<Material*, 2> materials_{};
    std::vector<Made> made_;
    // Filament reads these later on a thread of its own.
    std::vector<std::vector<math::quatf>> rotations_;
    std::vector<std::vector<float>> positions_;
    std::vector<std::vector<std::uint32_t>> indices_;
};

}  // namespace

int main(int count, char** arguments) {
    try {
        Drawing drawing;
        for (int i = 1; i < count; ++i) drawing.draw(proof::read_job(arguments[i]));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
