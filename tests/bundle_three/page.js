// Draws scenes with shadows in three.js and posts the bundle of each to the server of capture.mjs.
import * as THREE from 'three';
import { SunLight } from 'three/addons/lights/SunLight.js';
import { shadowBundle } from '/bundle/shadow_bundle.js';

/** Returns a texture whose alpha is a lattice. */
function lattice() {
    const size = 32, data = new Uint8Array(size * size * 4).fill(255);
    for (let y = 0; y < size; ++y)
        for (let x = 0; x < size; ++x)
            if ((x + 2) % 8 >= 4 && (y + 3) % 16 >= 6) data[4 * (y * size + x) + 3] = 0;
    const texture = new THREE.DataTexture(data, size, size);
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.repeat.set(2, 1);
    texture.offset.set(0.125, 0);
    texture.needsUpdate = true;
    return texture;
}

function makeScene() {
    const scene = new THREE.Scene();
    const add = (name, geometry, material, place, casts = true) => {
        const mesh = new THREE.Mesh(geometry, material);
        mesh.name = name;
        mesh.position.fromArray(place);
        mesh.castShadow = casts;
        mesh.receiveShadow = true;
        scene.add(mesh);
        return mesh;
    };
    const paint = (color) => new THREE.MeshLambertMaterial({ color });
    const ground = add('Ground', new THREE.PlaneGeometry(16, 16), paint(0x99958a), [0, 0, 0], false);
    ground.rotation.x = -Math.PI / 2;
    add('Box', new THREE.BoxGeometry(1, 1, 1), paint(0xb04a30), [-1.5, 0.5, 0.3]);
    add('Box', new THREE.BoxGeometry(1.2, 2, 1.2), paint(0x3070b0), [1.6, 1, -1.2]).rotation.y = 0.6;
    add('Ball', new THREE.SphereGeometry(0.6, 24, 12), paint(0xd0c090), [0.4, 0.8, 1.4]);
    const fence = new THREE.MeshLambertMaterial({ color: 0x604020, map: lattice(), alphaTest: 0.5 });
    add('Fence/front', new THREE.BoxGeometry(3, 1, 0.1), fence, [-0.6, 0.5, 2.4]).rotation.y = 0.2;
    const posts = new THREE.InstancedMesh(new THREE.BoxGeometry(0.2, 1.4, 0.2), paint(0x806050), 3);
    posts.name = 'Post';
    posts.castShadow = true;
    for (let i = 0; i < 3; ++i)
        posts.setMatrixAt(i, new THREE.Matrix4().makeRotationY(0.3 * i).setPosition(2.6, 0.7, 0.6 * i));
    scene.add(posts);
    scene.add(new THREE.AmbientLight(0xffffff, 0.6));
    return scene;
}

function makeLight(type) {
    const light = type === 'directional' ? new THREE.DirectionalLight(0xffffff, 2)
        : type === 'sun' ? new SunLight(0xffffff, 2)
        : type === 'spot' ? new THREE.SpotLight(0xffffff, 120, 0, 0.6, 0.2) : new THREE.PointLight(0xffffff, 60);
    light.name = type;
    // A point light among the casters, which then lie in most faces.
    if (type === 'point') light.position.set(0.1, 1.1, 0.3);
    else light.position.set(3.5, 5, 2.5);
    light.castShadow = true;
    light.shadow.mapSize.set(512, 512);
    light.shadow.bias = -0.0005;
    light.shadow.normalBias = 0.02;
    light.shadow.camera.near = 0.2;
    light.shadow.camera.far = 20;
    return light;
}

const cases = [
    { name: 'directional', light: 'directional', type: THREE.PCFShadowMap, reversed: false },
    { name: 'spot', light: 'spot', type: THREE.BasicShadowMap, reversed: false },
    { name: 'reversed', light: 'spot', type: THREE.PCFShadowMap, reversed: true },
    { name: 'point', light: 'point', type: THREE.BasicShadowMap, reversed: false },
    { name: 'cascades', light: 'sun', type: THREE.PCFShadowMap, reversed: false },
    { name: 'variance', light: 'directional', type: THREE.VSMShadowMap, reversed: false },
];

async function main() {
    for (const { name, light, type, reversed } of cases) {
        const canvas = document.createElement('canvas');
        canvas.width = 480;
        canvas.height = 270;
        const renderer = new THREE.WebGLRenderer({ canvas, reversedDepthBuffer: reversed });
        if (reversed && !renderer.state.buffers.depth.getReversed()) {
            await fetch(`/skip/${name}`, { method: 'POST', body: 'EXT_clip_control' });
            continue;
        }
        renderer.shadowMap.enabled = true;
        renderer.shadowMap.type = type;
        const scene = makeScene();
        scene.add(makeLight(light));
        const camera = new THREE.PerspectiveCamera(45, 480 / 270, 0.1, 50);
        camera.position.set(1, 4, 8);
        camera.lookAt(0, 0.5, 0);
        renderer.render(scene, camera);
        const before = new Uint8Array(480 * 270 * 4), after = new Uint8Array(before.length);
        const gl = renderer.getContext();
        const read = (out) => gl.readPixels(0, 0, 480, 270, gl.RGBA, gl.UNSIGNED_BYTE, out);
        read(before);
        const bytes = shadowBundle({ renderer, scene, camera, madeBy: `test "${name}"` });
        // The bundle leaves the renderer as it was.
        renderer.render(scene, camera);
        read(after);
        if (before.some((value, i) => value !== after[i])) throw new Error(`${name}: the next frame differs`);
        await fetch(`/bundle/${name}`, { method: 'POST', body: bytes });
        renderer.dispose();
    }
}

main().then(() => fetch('/done', { method: 'POST', body: '' }),
            (error) => fetch('/done', { method: 'POST', body: `${error.stack ?? error}` }));
