// Draws jobs in three.js. The mask is a Lambert material under one light, divided by the same picture with
// receiveShadow off: albedo, N·L and units cancel. Both are drawn into a target of linear floats.
import * as THREE from 'three';
import { drawJobs, objectsOf } from '/browser/jobs.js';

const renderer = new THREE.WebGLRenderer();
renderer.shadowMap.enabled = true;

const kTypes = { BasicShadowMap: THREE.BasicShadowMap, PCFShadowMap: THREE.PCFShadowMap, VSMShadowMap: THREE.VSMShadowMap };
const kSides = { FrontSide: THREE.FrontSide, BackSide: THREE.BackSide, DoubleSide: THREE.DoubleSide };

function lightOf(job, parameters) {
    const box = job.light, light = new THREE.DirectionalLight(0xffffff, 1);
    const pose = new THREE.Matrix4().fromArray(box.view_from_world).invert();
    light.position.setFromMatrixPosition(pose);
    light.target.position.copy(light.position).sub(new THREE.Vector3(...box.to_light_ws));
    light.castShadow = true;
    Object.assign(light.shadow.camera, { left: box.left_m, right: box.right_m, bottom: box.bottom_m, top: box.top_m,
        near: box.near_m, far: box.far_m });
    light.shadow.camera.updateProjectionMatrix();
    light.shadow.mapSize.set(job.map_resolution, job.map_resolution);
    light.shadow.bias = parameters.bias ?? 0;
    light.shadow.normalBias = parameters.normalBias ?? 0;
    light.shadow.radius = parameters.radius ?? 1;
    return light;
}

drawJobs(async (job) => {
    const parameters = job.parameters, { width, height } = job.camera;
    renderer.shadowMap.type = kTypes[parameters['shadowMap.type'] ?? 'PCFShadowMap'];
    const scene = new THREE.Scene(), meshes = [];
    for (const object of objectsOf(job)) {
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute('position', new THREE.BufferAttribute(object.positions, 3));
        geometry.setAttribute('normal', new THREE.BufferAttribute(object.normals, 3));
        geometry.setIndex(new THREE.BufferAttribute(object.indices, 1));
        // Double-sided materials cast as three.js does by default.
        const side = parameters.shadowSide;
        const material = new THREE.MeshLambertMaterial({ color: 0xffffff,
            side: object.double_sided ? THREE.DoubleSide : THREE.FrontSide,
            shadowSide: object.double_sided || !side ? null : kSides[side] });
        const mesh = new THREE.Mesh(geometry, material);
        mesh.castShadow = object.casts;
        mesh.receiveShadow = object.receives;
        meshes.push(mesh);
        scene.add(mesh);
    }
    const light = lightOf(job, parameters);
    scene.add(light, light.target);
    const camera = new THREE.PerspectiveCamera();
    camera.matrixAutoUpdate = false;
    camera.matrix.fromArray(job.camera.view_from_world).invert();
    camera.updateMatrixWorld(true);
    camera.projectionMatrix.fromArray(job.camera.clip_from_view);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType });
    const picture = () => {
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        const out = new Float32Array(4 * width * height);
        renderer.readRenderTargetPixels(target, 0, 0, width, height, out);
        return out;
    };
    const shadowed = picture();
    for (const mesh of meshes) mesh.receiveShadow = false;
    const lit = picture();
    const box = light.shadow.camera;
    const clip = new THREE.Matrix4().multiplyMatrices(box.projectionMatrix, box.matrixWorldInverse);
    const facts = { engine: 'three.js', version: THREE.REVISION, map_resolution: light.shadow.mapSize.x,
        width_m: box.right - box.left, height_m: box.top - box.bottom, depth_m: box.far - box.near,
        clip_from_world: clip.toArray() };
    target.dispose();
    light.dispose();
    for (const mesh of meshes) {
        mesh.geometry.dispose();
        mesh.material.dispose();
    }
    return { shadowed, lit, facts };
});
