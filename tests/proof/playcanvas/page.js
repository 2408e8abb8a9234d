// Draws jobs in PlayCanvas. The mask is a white StandardMaterial under one light, divided by the same picture with
// castShadows off: albedo, N·L and units cancel. Both are drawn into a texture of linear floats.
import * as pc from 'playcanvas';
import { drawJobs, inverseOfPose, multiply, objectsOf } from '/browser/jobs.js';

const app = new pc.Application(document.getElementById('canvas'), { graphicsDeviceOptions: { antialias: false } });
app.autoRender = false;
app.scene.ambientLight = new pc.Color(0, 0, 0);
app.scene.clusteredLightingEnabled = false;
app.start();

/** Draws one frame. */
function drawFrame() {
    return new Promise((resolve) => {
        app.once('frameend', resolve);
        app.renderNextFrame = true;
    });
}

function cameraOf(job, target) {
    const { near_m, far_m, fov_y_deg, width, height } = job.camera;
    const entity = new pc.Entity('camera');
    entity.addComponent('camera', { nearClip: near_m, farClip: far_m, fov: fov_y_deg, renderTarget: target,
        aspectRatioMode: pc.ASPECT_MANUAL, aspectRatio: width / height, clearColor: new pc.Color(1, 1, 1, 1),
        toneMapping: pc.TONEMAP_NONE, gammaCorrection: pc.GAMMA_NONE });
    const pose = new pc.Mat4();
    pose.data.set(inverseOfPose(job.camera.view_from_world));
    entity.setPosition(pose.getTranslation());
    entity.setRotation(new pc.Quat().setFromMat4(pose));
    return entity;
}

function lightOf(job) {
    const [x, y, z] = job.light.to_light_ws, parameters = job.parameters, degrees = 180 / Math.PI;
    const entity = new pc.Entity('sun');
    entity.addComponent('light', { type: 'directional', castShadows: true, intensity: 1,
        shadowDistance: job.camera.far_m, shadowResolution: job.map_resolution,
        shadowType: pc[parameters.shadowType ?? 'SHADOW_PCF3_32F'], shadowBias: parameters.shadowBias ?? 0.05,
        normalOffsetBias: parameters.normalOffsetBias ?? 0, numCascades: 1 });
    // The light shines along its -y.
    entity.setEulerAngles(90 - Math.asin(y) * degrees, Math.atan2(x, z) * degrees, 0);
    return entity;
}

function entityOf(object) {
    const mesh = new pc.Mesh(app.graphicsDevice);
    mesh.setPositions(object.positions);
    mesh.setNormals(object.normals);
    mesh.setIndices(object.indices);
    mesh.update();
    const material = new pc.StandardMaterial();
    material.diffuse = new pc.Color(1, 1, 1);
    material.specular = new pc.Color(0, 0, 0);
    material.useGammaTonemap = false;
    material.cull = object.double_sided ? pc.CULLFACE_NONE : pc.CULLFACE_BACK;
    material.twoSidedLighting = object.double_sided;
    material.update();
    const entity = new pc.Entity(object.name);
    entity.addComponent('render', { meshInstances: [new pc.MeshInstance(mesh, material)], castShadows: object.casts,
        receiveShadows: object.receives });
    return entity;
}

drawJobs(async (job) => {
    const { width, height } = job.camera;
    const colour = new pc.Texture(app.graphicsDevice, { width, height, format: pc.PIXELFORMAT_RGBA32F, mipmaps: false,
        minFilter: pc.FILTER_NEAREST, magFilter: pc.FILTER_NEAREST });
    const target = new pc.RenderTarget({ colorBuffer: colour, depth: true, samples: 1 });
    const camera = cameraOf(job, target), sun = lightOf(job);
    const entities = [camera, sun, ...objectsOf(job).map(entityOf)];
    for (const entity of entities) app.root.addChild(entity);
    const picture = async () => {
        await drawFrame();
        await drawFrame();
        return new Float32Array(await colour.read(0, 0, width, height, { renderTarget: target, immediate: true }));
    };
    const shadowed = await picture();
    const fit = sun.light.light.getRenderData(camera.camera.camera, 0).shadowCamera;
    const pose = Array.from(fit._node.getWorldTransform().data);
    const clip = multiply(Array.from(fit.projectionMatrix.data), inverseOfPose(pose));
    const facts = { engine: 'PlayCanvas', version: pc.version, map_resolution: sun.light.shadowResolution,
        width_m: 2 * fit.orthoHeight, height_m: 2 * fit.orthoHeight, depth_m: fit.farClip - fit.nearClip,
        clip_from_world: clip };
    sun.light.castShadows = false;
    const lit = await picture();
    for (const entity of entities) entity.destroy();
    target.destroy();
    colour.destroy();
    return { shadowed, lit, facts };
});
