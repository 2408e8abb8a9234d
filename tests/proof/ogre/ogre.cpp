// Draws jobs in OGRE 1.12: ogre JOB... The shadows are those of the RTShader system (IntegratedPSSM3 with one map) with
// its depth texture. The mask is per-pixel lighting by one light, divided by the same picture with receiving off:
// colour, N·L and units cancel. Both are drawn into a target of linear floats.
#include <Ogre.h>
#include <OgreGpuProgramManager.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <OgreManualObject.h>
#include <OgreShadowCameraSetup.h>
#include <RTShaderSystem/OgreRTShaderSystem.h>

#include <cstdio>
#include <memory>

#include "native/job.h"

namespace {

using proof::Job;
using proof::Matrix;

constexpr const char* kPluginFolder = "/usr/lib/x86_64-linux-gnu/OGRE";
constexpr const char* kShaderFolders[] = {"/usr/share/OGRE/Media/RTShaderLib/GLSL",
                                          "/usr/share/OGRE/Media/ShadowVolume"};
const Ogre::String kScheme = Ogre::RTShader::ShaderGenerator::DEFAULT_SCHEME_NAME;
const Ogre::String kGroup = Ogre::RGN_DEFAULT;

Ogre::Matrix4 ogre_matrix(const Matrix& m) {
    Ogre::Matrix4 out;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) out[row][column] = Ogre::Real(m[4 * column + row]);
    return out;
}

Matrix matrix_of(const Ogre::Matrix4& m) {
    Matrix out{};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) out[4 * column + row] = m[row][column];
    return out;
}

/// Places the camera of the shadow map at the box that the job gives, and keeps the matrix that OGRE draws with.
class GivenBox : public Ogre::ShadowCameraSetup {
public:
    explicit GivenBox(const Job& job) : job_(job) {}

    void getShadowCamera(const Ogre::SceneManager*, const Ogre::Camera*, const Ogre::Viewport*, const Ogre::Light*,
                         Ogre::Camera* shadow_camera, std::size_t) const override {
        const Matrix pose = proof::inverse_of_pose(proof::matrix_of(job_.json["light"]["view_from_world"]));
        const double centre[] = {(job_.light("left_m") + job_.light("right_m")) / 2,
                                 (job_.light("bottom_m") + job_.light("top_m")) / 2};
        // OGRE takes no near distance of 0 or less, so the camera stands back as far as it needs.
        const double back = std::max(0.0, 1 - job_.light("near_m"));
        Ogre::Vector3 at;
        Ogre::Matrix3 axes;
        for (int row = 0; row < 3; ++row) {
            at[row] =
                Ogre::Real(pose[12 + row] + pose[row] * centre[0] + pose[4 + row] * centre[1] + pose[8 + row] * back);
            for (int column = 0; column < 3; ++column) axes[row][column] = Ogre::Real(pose[4 * column + row]);
        }
        shadow_camera->setProjectionType(Ogre::PT_ORTHOGRAPHIC);
        shadow_camera->setOrthoWindow(Ogre::Real(job_.light("right_m") - job_.light("left_m")),
                                      Ogre::Real(job_.light("top_m") - job_.light("bottom_m")));
        shadow_camera->setNearClipDistance(Ogre::Real(job_.light("near_m") + back));
        shadow_camera->setFarClipDistance(Ogre::Real(job_.light("far_m") + back));
        shadow_camera->getParentSceneNode()->setPosition(at);
        shadow_camera->getParentSceneNode()->setOrientation(Ogre::Quaternion(axes));
        clip_from_world = matrix_of(shadow_camera->getProjectionMatrix() * shadow_camera->getViewMatrix());
    }

    mutable Matrix clip_from_world{};

private:
    const Job& job_;
};

/// Makes the material of casters, whose polygon offset is the bias.
Ogre::MaterialPtr caster_material(const Job& job) {
    const auto program = [](const char* name, Ogre::GpuProgramType type, const char* text) {
        auto made = Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(name, kGroup, "glsl", type);
        made->setSource(text);
        return made;
    };
    if (!Ogre::HighLevelGpuProgramManager::getSingleton().getByName("caster_vertex", kGroup)) {
        program("caster_vertex", Ogre::GPT_VERTEX_PROGRAM,
                "#version 150\nuniform mat4 clip;\nin vec4 vertex;\nvoid main() { gl_Position = clip * vertex; }\n");
        program("caster_fragment", Ogre::GPT_FRAGMENT_PROGRAM,
                "#version 150\nout vec4 colour;\nvoid main() { colour = vec4(1); }\n");
    }
    auto material = Ogre::MaterialManager::getSingleton().create("caster", kGroup);
    Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
    pass->setVertexProgram("caster_vertex");
    pass->setFragmentProgram("caster_fragment");
    pass->getVertexProgramParameters()->setNamedAutoConstant("clip",
                                                             Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
    pass->setDepthBias(job.parameter("depth_bias.constant", 0.F), job.parameter("depth_bias.slope", 0.F));
    return material;
}

Ogre::MaterialPtr surface_material(const std::string& name, bool receives, bool double_sided) {
    auto material = Ogre::MaterialManager::getSingleton().create(name, kGroup);
    material->setReceiveShadows(receives);
    Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
    pass->setAmbient(0, 0, 0);
    pass->setDiffuse(1, 1, 1, 1);
    pass->setSpecular(0, 0, 0, 0);
    if (double_sided) pass->setCullingMode(Ogre::CULL_NONE);
    return material;
}

Ogre::PixelFormat map_format(const std::string& name) {
    if (name == "PF_DEPTH16") return Ogre::PF_DEPTH16;
    if (name == "PF_DEPTH32F") return Ogre::PF_DEPTH32F;
    throw std::runtime_error("ShadowTexturePixelFormat: " + name + " is none of PF_DEPTH16 PF_DEPTH32F");
}

class Drawing {
public:
    Drawing() : root_("", "", "") {
        root_.loadPlugin(std::string(kPluginFolder) + "/RenderSystem_GL3Plus");
        root_.setRenderSystem(root_.getAvailableRenderers().at(0));
        root_.initialise(false);
        Ogre::NameValuePairList options{{"hidden", "true"}};
        root_.createRenderWindow("proof", 64, 64, false, &options);
        for (const char* folder : kShaderFolders)
            Ogre::ResourceGroupManager::getSingleton().addResourceLocation(folder, "FileSystem", Ogre::RGN_INTERNAL);
        Ogre::ResourceGroupManager::getSingleton().initialiseAllResourceGroups();
        if (!Ogre::RTShader::ShaderGenerator::initialize())
            throw std::runtime_error("the RTShader system does not start");
        generator_ = Ogre::RTShader::ShaderGenerator::getSingletonPtr();
        generator_->setTargetLanguage("glsl");
        Ogre::RTShader::RenderState* state = generator_->getRenderState(kScheme);
        state->addTemplateSubRenderState(generator_->createSubRenderState(Ogre::RTShader::PerPixelLighting::Type));
        state->addTemplateSubRenderState(generator_->createSubRenderState(Ogre::RTShader::IntegratedPSSM3::Type));
    }
    ~Drawing() { Ogre::RTShader::ShaderGenerator::destroy(); }

    void draw(const Job& job) {
        scene_ = root_.createSceneManager();
        generator_->addSceneManager(scene_);
        scene_->setAmbientLight(Ogre::ColourValue::Black);
        scene_->setShadowTechnique(Ogre::SHADOWTYPE_TEXTURE_ADDITIVE_INTEGRATED);
        scene_->setShadowTextureSettings(Ogre::uint16(job.map_resolution), 1,
                                         map_format(job.choice("ShadowTexturePixelFormat", "PF_DEPTH16")));
        scene_->setShadowTextureSelfShadow(true);
        scene_->setShadowFarDistance(Ogre::Real(job.camera("far_m")));
        scene_->setShadowCasterRenderBackFaces(job.choice("ShadowCasterRenderBackFaces", "true") == "true");
        caster_material(job);
        scene_->setShadowTextureCasterMaterial(Ogre::MaterialManager::getSingleton().getByName("caster", kGroup));
        const auto box = std::make_shared<GivenBox>(job);
        scene_->setShadowCameraSetup(box);
        add_light(job);
        add_objects(job);

        auto texture = Ogre::TextureManager::getSingleton().createManual(
            "picture", kGroup, Ogre::TEX_TYPE_2D, Ogre::uint(job.width_px), Ogre::uint(job.height_px), 0,
            Ogre::PF_FLOAT32_RGBA, Ogre::TU_RENDERTARGET);
        Ogre::RenderTexture* target = texture->getBuffer()->getRenderTarget();
        target->setAutoUpdated(false);
        Ogre::Camera* camera = scene_->createCamera("camera");
        scene_->getRootSceneNode()->createChildSceneNode()->attachObject(camera);
        camera->setNearClipDistance(Ogre::Real(job.camera("near_m")));
        camera->setFarClipDistance(Ogre::Real(job.camera("far_m")));
        camera->setCustomViewMatrix(
            true, Ogre::Affine3(ogre_matrix(proof::matrix_of(job.json["camera"]["view_from_world"]))));
        camera->setCustomProjectionMatrix(true, ogre_matrix(proof::matrix_of(job.json["camera"]["clip_from_view"])));
        Ogre::Viewport* viewport = target->addViewport(camera);
        viewport->setBackgroundColour(Ogre::ColourValue::ZERO);
        viewport->setOverlaysEnabled(false);
        viewport->setMaterialScheme(kScheme);

        const auto picture = [&](bool shadows) {
            for (auto& [object, materials] : objects_) object->setMaterialName(0, materials[shadows], kGroup);
            std::vector<float> out(std::size_t(4) * job.width_px * job.height_px);
            target->update();
            texture->getBuffer()->blitToMemory(Ogre::PixelBox(Ogre::uint32(job.width_px), Ogre::uint32(job.height_px),
                                                              1, Ogre::PF_FLOAT32_RGBA, out.data()));
            return out;
        };
        const std::vector<float> shadowed = picture(true), lit = picture(false);
        proof::write_mask(job, shadowed, lit);
        const std::string version = std::to_string(OGRE_VERSION_MAJOR) + "." + std::to_string(OGRE_VERSION_MINOR) +
                                    "." + std::to_string(OGRE_VERSION_PATCH);
        proof::write_facts(job,
                           {{"engine", "OGRE"},
                            {"version", version},
                            {"map_resolution", scene_->getShadowTexture(0)->getWidth()},
                            {"kernel", "pcf2"},
                            {"map_format", Ogre::PixelUtil::getFormatName(scene_->getShadowTexture(0)->getFormat())}},
                           box->clip_from_world, -1, 1);

        objects_.clear();
        target->removeAllViewports();
        Ogre::TextureManager::getSingleton().remove(texture);
        generator_->removeAllShaderBasedTechniques();
        generator_->removeSceneManager(scene_);
        root_.destroySceneManager(scene_);
        Ogre::MaterialManager::getSingleton().remove("caster", kGroup);
        for (const std::string& name : materials_) Ogre::MaterialManager::getSingleton().remove(name, kGroup);
        materials_.clear();
    }

private:
    void add_light(const Job& job) {
        Ogre::Light* light = scene_->createLight("light");
        light->setType(Ogre::Light::LT_DIRECTIONAL);
        light->setDiffuseColour(1, 1, 1);
        light->setSpecularColour(0, 0, 0);
        light->setCastShadows(true);
        const nlohmann::json& to_light = job.json["light"]["to_light_ws"];
        Ogre::SceneNode* node = scene_->getRootSceneNode()->createChildSceneNode();
        node->setDirection(-Ogre::Vector3(to_light[0].get<float>(), to_light[1].get<float>(), to_light[2].get<float>()),
                           Ogre::Node::TS_WORLD);
        node->attachObject(light);
    }

    void add_objects(const Job& job) {
        for (const char* side : {"one", "two"})
            for (const char* what : {"lit", "shadowed"}) {
                const std::string name = std::string(what) + "_" + side;
                surface_material(name, what == std::string("shadowed"), side == std::string("two"));
                materials_.push_back(name);
            }
        for (const proof::Object& object : job.objects) {
            Ogre::ManualObject* made = scene_->createManualObject();
            const std::string side = object.double_sided ? "two" : "one";
            made->begin("lit_" + side, Ogre::RenderOperation::OT_TRIANGLE_LIST, kGroup);
            for (std::size_t i = 0; i < object.positions.size(); i += 3) {
                made->position(object.positions[i], object.positions[i + 1], object.positions[i + 2]);
                made->normal(object.normals[i], object.normals[i + 1], object.normals[i + 2]);
            }
            for (const std::uint32_t index : object.indices) made->index(index);
            made->end();
            made->setCastShadows(object.casts);
            scene_->getRootSceneNode()->createChildSceneNode()->attachObject(made);
            objects_.push_back({made, {"lit_" + side, (object.receives ? "shadowed_" : "lit_") + side}});
        }
        for (const std::string& name : materials_) {
            auto material = Ogre::MaterialManager::getSingleton().getByName(name, kGroup);
            if (!generator_->createShaderBasedTechnique(*material, Ogre::MaterialManager::DEFAULT_SCHEME_NAME, kScheme))
                throw std::runtime_error("the RTShader system makes no shader for " + name);
            generator_->validateMaterial(kScheme, name, kGroup);
        }
    }

    Ogre::Root root_;
    Ogre::RTShader::ShaderGenerator* generator_ = nullptr;
    Ogre::SceneManager* scene_ = nullptr;
    std::vector<std::pair<Ogre::ManualObject*, std::array<std::string, 2>>> objects_;
    std::vector<std::string> materials_;
};

}  // namespace

int main(int count, char** arguments) {
    try {
        Ogre::LogManager log;
        log.createLog("ogre.log", true, false, true);
        Drawing drawing;
        for (int i = 1; i < count; ++i) drawing.draw(proof::read_job(arguments[i]));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
