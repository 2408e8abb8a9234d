// Draws jobs in Babylon.js. The mask is a white StandardMaterial under one light, divided by the same picture with
// receiveShadows off: albedo, N·L and units cancel. Both are drawn into a texture of linear floats.
import { drawJobs, inverseOfPose, objectsOf } from '/browser/jobs.js';

const { Color3, Color4, Constants, DirectionalLight, Engine, FreeCamera, Material, Matrix, Mesh, RenderTargetTexture, Scene,
    ShadowGenerator, StandardMaterial, Vector3, VertexData } = globalThis.BABYLON;

const engine = new Engine(document.getElementById('canvas'), false);
// Shaders compile before a draw returns.
engine.getCaps().parallelShaderCompile = undefined;

const kFilters = { NONE: ShadowGenerator.FILTER_NONE, POISSON: ShadowGenerator.FILTER_POISSONSAMPLING,
    PCF: ShadowGenerator.FILTER_PCF, PCSS: ShadowGenerator.FILTER_PCSS,
    ESM: ShadowGenerator.FILTER_EXPONENTIALSHADOWMAP };

function lightOf(job, scene) {
    const box = job.light, pose = inverseOfPose(box.view_from_world);
    const light = new DirectionalLight('sun', new Vector3(...box.to_light_ws).scale(-1), scene);
    light.position = new Vector3(pose[12], pose[13], pose[14]);
    light.specular = Color3.Black();
    light.shadowFrustumSize = box.right_m - box.left_m;
    light.shadowMinZ = box.near_m;
    light.shadowMaxZ = box.far_m;
    return light;
}

function cameraOf(job, scene) {
    const view = job.camera.view_from_world, pose = inverseOfPose(view);
    const camera = new FreeCamera('camera', new Vector3(pose[12], pose[13], pose[14]), scene);
    camera.upVector = new Vector3(pose[4], pose[5], pose[6]);
    camera.setTarget(camera.position.subtract(new Vector3(pose[8], pose[9], pose[10])));
    camera.minZ = job.camera.near_m;
    camera.maxZ = job.camera.far_m;
    camera.freezeProjectionMatrix(Matrix.FromArray(job.camera.clip_from_view));
    return camera;
}

drawJobs(async (job) => {
    const parameters = job.parameters, { width, height } = job.camera;
    const scene = new Scene(engine);
    scene.useRightHandedSystem = true;
    scene.ambientColor = Color3.Black();
    scene.clearColor = new Color4(1, 1, 1, 1);
    const camera = cameraOf(job, scene), light = lightOf(job, scene);
    // With true the map holds 32-bit floats. The default, 16-bit floats, adds steps of 2^-11 of the depth range.
    const generator = new ShadowGenerator(job.map_resolution, light, true);
    generator.filter = kFilters[parameters.filter ?? 'NONE'];
    generator.bias = parameters.bias ?? generator.bias;
    generator.normalBias = parameters.normalBias ?? 0;
    generator.forceBackFacesOnly = parameters.forceBackFacesOnly === 'true';
    const meshes = objectsOf(job).map((object) => {
        const mesh = new Mesh(object.name, scene), data = new VertexData();
        data.positions = object.positions;
        data.normals = object.normals;
        data.indices = object.indices;
        data.applyToMesh(mesh);
        const material = new StandardMaterial(object.name, scene);
        material.diffuseColor = Color3.White();
        material.specularColor = Color3.Black();
        // Triangles are counterclockwise, as in glTF.
        material.sideOrientation = Material.CounterClockWiseSideOrientation;
        material.backFaceCulling = !object.double_sided;
        material.twoSidedLighting = object.double_sided;
        mesh.material = material;
        mesh.receiveShadows = object.receives;
        if (object.casts) generator.addShadowCaster(mesh, false);
        return mesh;
    });
    const target = new RenderTargetTexture('mask', { width, height }, scene, false, true, Constants.TEXTURETYPE_FLOAT);
    target.renderList = meshes;
    target.activeCamera = camera;
    target.clearColor = new Color4(1, 1, 1, 1);
    scene.customRenderTargets.push(target);
    const picture = async () => {
        await scene.whenReadyAsync();
        // The first frame compiles what the map and the mask need.
        scene.render();
        scene.render();
        return new Float32Array(await target.readPixels());
    };
    const shadowed = await picture();
    const clip = Array.from(generator.getTransformMatrix().m);
    for (const mesh of meshes) mesh.receiveShadows = false;
    const lit = await picture();
    const facts = { engine: 'Babylon.js', version: Engine.Version, map_resolution: generator.getShadowMap().getSize().width,
        width_m: light.shadowFrustumSize, height_m: light.shadowFrustumSize,
        depth_m: light.shadowMaxZ - light.shadowMinZ, clip_from_world: clip };
    scene.dispose();
    return { shadowed, lit, facts };
});
