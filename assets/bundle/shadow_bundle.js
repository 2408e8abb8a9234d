// Shadow Inspector. No licence has been chosen yet; all rights are the owner's until then.
//
// Writer of bundles for three.js: one frame with its scene, camera, lights and shadow maps, as a zip file for Shadow
// Inspector. docs/bundle.md describes the format. It needs WebGL 2, three.js r182 or newer, and no other file.
//
//     import { downloadShadowBundle } from './shadow_bundle.js';
//     addEventListener('keydown', (event) => {
//         if (event.key === 'b') downloadShadowBundle({ renderer, scene, camera });
//     });
//
// - The frame is drawn once more, so that its maps, matrices and picture belong together.
// - Anything that cannot be read is left out, with a note. A missing member is unknown to the inspector, and never 0.

/** Revision of three.js whose shadow maps are depth textures. */
const oldestRevision = 182;

/**
 * Draws a frame and returns it as the bytes of a zip file.
 *
 * @param {object} frame
 * @param {object} frame.renderer a WebGLRenderer
 * @param {object} frame.scene
 * @param {object} frame.camera
 * @param {object[]} [frame.lights] lights to write; all visible ones that cast shadows by default
 * @param {number} [frame.metresPerUnit] length of a unit of the scene
 * @param {string} [frame.madeBy] name of the program
 * @return {Uint8Array}
 * @throws {Error} where the frame cannot be written, with the reason
 */
export function shadowBundle({ renderer, scene, camera, lights, metresPerUnit = 1, madeBy = 'three.js' }) {
    if (!renderer.isWebGLRenderer) throw new Error('shadow_bundle: the renderer is no WebGLRenderer');
    const revision = parseInt(globalThis.__THREE__, 10);
    if (revision < oldestRevision)
        throw new Error(`shadow_bundle: three.js r${revision} keeps no depth textures; use r${oldestRevision} or newer`);
    if (!renderer.shadowMap.enabled) throw new Error('shadow_bundle: renderer.shadowMap.enabled is false');

    const target = renderer.getRenderTarget();
    renderer.setRenderTarget(null);
    renderer.render(scene, camera);
    const gl = renderer.getContext();
    const picture = readPicture(gl);
    const notes = [];
    const model = new Model(notes, renderer.shadowMap.type === vsmShadowMap);
    model.addScene(scene);
    const files = new Map();
    const reader = new DepthReader(renderer);
    const chosen = lights ?? visibleLights(scene);
    const size = (light) => `${light.shadow.map.width}x${light.shadow.map.height}`;
    const written = [];
    for (const light of chosen) {
        if (!light.shadow?.map) {
            notes.push(`The light '${light.name}' has no shadow map.`);
        } else if (written.length > 0 && size(light) !== size(written[0])) {
            notes.push(`The light '${light.name}' is left out: its map has ${size(light)} texels, others ` +
                       `${size(written[0])}.`);
        } else if (written.length === 16) {
            notes.push(`The light '${light.name}' is left out: a bundle has at most 16 lights.`);
        } else {
            written.push(light);
        }
    }
    if (written.length === 0) throw new Error('shadow_bundle: no light has a shadow map; set light.castShadow');
    const lightMembers = written.map((light, index) =>
        writeLight(renderer, reader, model, light, index, camera, metresPerUnit, files, notes));
    reader.dispose();
    renderer.setRenderTarget(target);

    const frame = {
        bundle: 1,
        made_by: `${madeBy}, three.js r${revision}`,
        scene: 'scene.glb',
        world: { up: 'y', hand: 'right', metres_per_unit: metresPerUnit, origin: [0, 0, 0] },
        camera: {
            clip_from_world: product(camera.projectionMatrix.elements, camera.matrixWorldInverse.elements),
            width: picture.width,
            height: picture.height,
            depth: conventionOf(camera),
        },
        picture: 'picture.png',
        lights: lightMembers,
    };
    if (notes.length > 0) frame.notes = notes;
    files.set('scene.glb', model.glb());
    files.set('picture.png', png(picture.width, picture.height, flipped(picture)));
    files.set('frame.json', utf8(JSON.stringify(frame, null, 1)));
    return zip(files);
}

/** Draws a frame and lets the browser save it. Takes what shadowBundle() takes. */
export function downloadShadowBundle(frame, fileName = 'frame.zip') {
    const url = URL.createObjectURL(new Blob([shadowBundle(frame)], { type: 'application/zip' }));
    const link = document.createElement('a');
    link.href = url;
    link.download = fileName;
    link.click();
    URL.revokeObjectURL(url);
}

// Constants of three.js, which this file does not import.
const basicShadowMap = 0, vsmShadowMap = 3;
const frontSide = 0, backSide = 1, doubleSide = 2;
const repeatWrapping = 1000, mirroredRepeatWrapping = 1002;

function visibleLights(scene) {
    const lights = [];
    scene.traverseVisible((object) => {
        if (object.isLight && object.castShadow) lights.push(object);
    });
    return lights;
}

/** Returns the product of two matrices by columns, in double precision. */
function product(a, b) {
    const out = [];
    for (let column = 0; column < 4; ++column) {
        for (let row = 0; row < 4; ++row) {
            let sum = 0;
            for (let i = 0; i < 4; ++i) sum += a[4 * i + row] * b[4 * column + i];
            out.push(sum);
        }
    }
    return out;
}

/** Returns the depth convention of a camera. A reversed depth buffer of three.js has the range 0 to 1. */
function conventionOf(camera) {
    const reversed = camera.reversedDepth === true;
    return { range: reversed ? '0..1' : '-1..1', reversed };
}

function placeOf(object) {
    return Array.from(object.matrixWorld.elements.slice(12, 15));
}

// ---- Lights and maps ------------------------------------------------------------------------------------------------

/** Returns the culling of all casters, as OpenGL has it; undefined where casters differ. */
function cullingOf(casters, type) {
    const found = new Set();
    for (const { object, material } of casters) {
        if (object.customDepthMaterial || object.customDistanceMaterial) return undefined;
        const turned = { [frontSide]: backSide, [backSide]: frontSide, [doubleSide]: doubleSide };
        const own = type === vsmShadowMap ? material.side : turned[material.side];
        found.add(material.shadowSide ?? own);
    }
    if (found.size !== 1) return undefined;
    return { [frontSide]: 'back', [backSide]: 'front', [doubleSide]: 'none' }[[...found][0]];
}

/** Returns the cameras of a light's maps with their parts of the image. */
function viewsOf(light) {
    const shadow = light.shadow;
    if (!light.isPointLight) {
        const views = [];
        for (let i = 0; i < shadow.getViewportCount(); ++i) {
            const part = shadow.getViewport(i);
            const region = [part.x * shadow.mapSize.x, part.y * shadow.mapSize.y, part.z * shadow.mapSize.x,
                            part.w * shadow.mapSize.y].map(Math.round);
            views.push({ camera: shadow.getCamera(i), region, cascade: shadow._cascadeData?.[i] });
        }
        return views;
    }
    // WebGLShadowMap turns one camera to each face and forgets the earlier ones.
    const directions = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    const ups = [[0, -1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1], [0, -1, 0], [0, -1, 0]];
    const eye = placeOf(light);
    return directions.map((direction, face) => {
        const camera = shadow.camera.clone();
        camera.projectionMatrix.copy(shadow.camera.projectionMatrix);
        camera._reversedDepth = shadow.camera._reversedDepth;
        camera.position.fromArray(eye);
        camera.up.fromArray(ups[face]);
        camera.lookAt(eye[0] + direction[0], eye[1] + direction[1], eye[2] + direction[2]);
        camera.updateMatrixWorld();
        return { camera, face };
    });
}

function writeLight(renderer, reader, model, light, index, viewer, metresPerUnit, files, notes) {
    const shadow = light.shadow, type = renderer.shadowMap.type;
    const isVsm = type === vsmShadowMap;
    const { width, height } = shadow.map;
    const out = {
        name: light.name,
        type: light.isPointLight ? 'point' : light.isSpotLight ? 'spot' : 'directional',
    };
    const place = placeOf(light);
    if (light.isSunLight) {
        out.direction = place.map((value) => -value);
    } else if (light.target) {
        const target = placeOf(light.target);
        out.direction = target.map((value, i) => value - place[i]);
    }
    if (light.isSpotLight || light.isPointLight) out.position = place;
    if (light.isSpotLight) out.cone_deg = light.angle * 360 / Math.PI;

    const views = viewsOf(light);
    const cull = cullingOf(model.casters, type);
    if (cull === undefined) notes.push('Casters differ in the faces that they draw, so culling is unknown.');
    const twoDimensional = light.isPointLight ? null : reader.read(shadow.map, isVsm);
    if (twoDimensional) files.set(`map${index}.pfm`, pfm(width, height, twoDimensional.depths));
    out.maps = views.map((view) => {
        let file = `map${index}.pfm`;
        let texels = twoDimensional;
        if (view.face !== undefined) {
            file = `map${index}_${view.face}.pfm`;
            texels = reader.readFace(shadow.map, view.face);
            files.set(file, pfm(width, height, texels.depths));
        }
        const isLinear = isVsm && view.camera.isOrthographicCamera;
        const map = {
            image: { file, first_row: 'bottom' },
            clip_from_world: product(view.camera.projectionMatrix.elements, view.camera.matrixWorldInverse.elements),
            depth: { ...conventionOf(view.camera), stored: isLinear ? 'moments' : 'depth', format: texels.format },
            // The depth materials of three.js have no polygon offset.
            raster: { offset_factor: 0, offset_units: 0, offset_clamp: 0, front: 'ccw', depth_clamp: false },
            drawn: model.drawn,
        };
        map.depth.clear = map.depth.reversed ? 0 : 1;
        if (cull !== undefined) map.raster.cull = cull;
        if (model.casters.some(({ object }) => object.customDepthMaterial || object.customDistanceMaterial))
            delete map.raster;
        if (views.length > 1 && view.region) map.region = view.region;
        if (view.cascade)
            map.interval = [Math.max(view.cascade.x, viewer.near), view.cascade.y].map((v) => v * metresPerUnit);
        return map;
    });
    if (views.length === 1 && twoDimensional && (views[0].region[2] !== width || views[0].region[3] !== height))
        out.maps[0].region = views[0].region;

    // three.js adds shadow.bias to its own depth, so a shift towards the light is negative there.
    out.lookup = {
        bias: {
            constant: shadow.bias === 0 ? 0 : -shadow.bias,
            slope: 0,
            normal: shadow.normalBias * metresPerUnit,
            units: 'depth, depth, metres',
        },
        kernel: isVsm ? 'vsm' : type === basicShadowMap ? 'hard' : 'vogel',
        filter: type === basicShadowMap ? 'nearest' : 'linear',
        wrap: 'clamp',
    };
    if (!isVsm) out.lookup.compare = conventionOf(shadow.camera).reversed ? 'greater-equal' : 'less-equal';
    if (isVsm) notes.push(`The map of '${light.name}' holds mean and deviation, blurred over ${shadow.radius} texels.`);
    if (shadow.intensity !== 1) notes.push(`The shadow of '${light.name}' has an intensity of ${shadow.intensity}.`);
    return out;
}

/** Reader of depth textures, which WebGL cannot read itself: a shader copies the bits of each texel to integers. */
class DepthReader {
    constructor(renderer) {
        this.renderer = renderer;
        this.gl = renderer.getContext();
        this.programs = new Map();
    }

    dispose() {
        for (const program of this.programs.values()) this.gl.deleteProgram(program);
    }

    /** Keeps the state that reading changes. Returns a function that sets it again, since three.js remembers it. */
    #keepState() {
        const gl = this.gl;
        const flags = [gl.BLEND, gl.CULL_FACE, gl.DEPTH_TEST, gl.SCISSOR_TEST, gl.STENCIL_TEST];
        const enabled = flags.map((flag) => gl.isEnabled(flag));
        const unit = gl.getParameter(gl.ACTIVE_TEXTURE);
        gl.activeTexture(gl.TEXTURE0);
        const [vertices, program, draw, read, flat, cube, mask, viewport] =
            [gl.VERTEX_ARRAY_BINDING, gl.CURRENT_PROGRAM, gl.DRAW_FRAMEBUFFER_BINDING, gl.READ_FRAMEBUFFER_BINDING,
             gl.TEXTURE_BINDING_2D, gl.TEXTURE_BINDING_CUBE_MAP, gl.COLOR_WRITEMASK, gl.VIEWPORT]
                .map((name) => gl.getParameter(name));
        return () => {
            flags.forEach((flag, i) => enabled[i] ? gl.enable(flag) : gl.disable(flag));
            gl.bindVertexArray(vertices);
            gl.useProgram(program);
            gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, draw);
            gl.bindFramebuffer(gl.READ_FRAMEBUFFER, read);
            gl.bindTexture(gl.TEXTURE_2D, flat);
            gl.bindTexture(gl.TEXTURE_CUBE_MAP, cube);
            gl.activeTexture(unit);
            gl.colorMask(...mask);
            gl.viewport(...viewport);
        };
    }

    /** Reads a flat map: its depth texture, or the moments of a variance map. */
    read(map, isVsm) {
        const texture = isVsm ? map.texture : map.depthTexture;
        return this.#read(this.gl.TEXTURE_2D, texture, map.width, map.height, 0, isVsm ? 'r16f' : undefined);
    }

    /** Reads a face of a cube map, in the order +x -x +y -y +z -z. */
    readFace(map, face) {
        return this.#read(this.gl.TEXTURE_CUBE_MAP, map.depthTexture, map.width, map.height, face);
    }

    #program(target) {
        const gl = this.gl, isCube = target === gl.TEXTURE_CUBE_MAP;
        if (this.programs.has(target)) return this.programs.get(target);
        const compile = (type, source) => {
            const shader = gl.createShader(type);
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            return shader;
        };
        const program = gl.createProgram();
        gl.attachShader(program, compile(gl.VERTEX_SHADER, `#version 300 es
            void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }`));
        gl.attachShader(program, compile(gl.FRAGMENT_SHADER, `#version 300 es
            precision highp float;
            precision highp int;
            uniform highp ${isCube ? 'samplerCube' : 'sampler2D'} map;
            uniform vec2 size;
            uniform int firstRow;
            uniform mat3 face;
            out highp uvec4 bits;
            void main() {
                ivec2 texel = ivec2(gl_FragCoord.xy) + ivec2(0, firstRow);
                ${isCube ? `vec2 at = 2. * (vec2(texel) + .5) / size - 1.;
                            float depth = textureLod(map, face * vec3(at, 1), 0.).r;`
                         : 'float depth = texelFetch(map, texel, 0).r;'}
                bits = uvec4(floatBitsToUint(depth), 0, 0, 0);
            }`));
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS))
            throw new Error('shadow_bundle: a shader does not link: ' + gl.getProgramInfoLog(program));
        this.programs.set(target, program);
        return program;
    }

    #read(target, texture, width, height, face, knownFormat) {
        const gl = this.gl, own = this.renderer.properties.get(texture).__webglTexture;
        if (!own) throw new Error('shadow_bundle: three.js has not drawn a shadow map');
        const program = this.#program(target), rows = Math.min(height, 256);
        const restore = this.#keepState();
        const format = knownFormat ?? this.#format(target, own);
        const vertices = gl.createVertexArray(), frame = gl.createFramebuffer(), integers = gl.createTexture();
        gl.bindVertexArray(vertices);
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, integers);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32UI, width, rows);
        gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, integers, 0);
        gl.bindTexture(target, own);
        // A sampler that compares or filters gives no depths.
        const settings = [[gl.TEXTURE_COMPARE_MODE, gl.NONE], [gl.TEXTURE_MIN_FILTER, gl.NEAREST],
                          [gl.TEXTURE_MAG_FILTER, gl.NEAREST]];
        const before = settings.map(([name]) => gl.getTexParameter(target, name));
        for (const [name, value] of settings) gl.texParameteri(target, name, value);
        for (const state of [gl.BLEND, gl.CULL_FACE, gl.DEPTH_TEST, gl.SCISSOR_TEST, gl.STENCIL_TEST]) gl.disable(state);
        gl.colorMask(true, true, true, true);
        gl.useProgram(program);
        gl.uniform1i(gl.getUniformLocation(program, 'map'), 0);
        gl.uniform2f(gl.getUniformLocation(program, 'size'), width, height);
        // Columns: direction of the columns of a face, of its rows, and its middle.
        const faces = [[0, 0, -1, 0, -1, 0, 1, 0, 0], [0, 0, 1, 0, -1, 0, -1, 0, 0], [1, 0, 0, 0, 0, 1, 0, 1, 0],
                       [1, 0, 0, 0, 0, -1, 0, -1, 0], [1, 0, 0, 0, -1, 0, 0, 0, 1], [-1, 0, 0, 0, -1, 0, 0, 0, -1]];
        gl.uniformMatrix3fv(gl.getUniformLocation(program, 'face'), false, faces[face]);
        const depths = new Float32Array(width * height);
        const part = new Uint32Array(width * rows * 4);
        for (let row = 0; row < height; row += rows) {
            const count = Math.min(rows, height - row);
            gl.viewport(0, 0, width, count);
            gl.uniform1i(gl.getUniformLocation(program, 'firstRow'), row);
            gl.drawArrays(gl.TRIANGLES, 0, 3);
            gl.readPixels(0, 0, width, count, gl.RGBA_INTEGER, gl.UNSIGNED_INT, part);
            const bits = new Uint32Array(depths.buffer, row * width * 4, count * width);
            for (let i = 0; i < bits.length; ++i) bits[i] = part[4 * i];
        }
        settings.forEach(([name], i) => gl.texParameteri(target, name, before[i]));
        gl.deleteFramebuffer(frame);
        gl.deleteTexture(integers);
        gl.deleteVertexArray(vertices);
        restore();
        return { depths, format };
    }

    /** Returns the storage of a depth texture, as the driver has it. */
    #format(target, own) {
        const gl = this.gl, frame = gl.createFramebuffer();
        const face = target === gl.TEXTURE_CUBE_MAP ? gl.TEXTURE_CUBE_MAP_POSITIVE_X : target;
        gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, face, own, 0);
        const value = (name) => gl.getFramebufferAttachmentParameter(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, name);
        const isFloat = value(gl.FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) === gl.FLOAT;
        const bits = value(gl.FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
        gl.deleteFramebuffer(frame);
        return isFloat ? 'd32f' : bits === 16 ? 'd16' : bits === 24 ? 'd24' : 'd32f';
    }
}

/** Returns the picture that was drawn last, the bottom row first. */
function readPicture(gl) {
    const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
    const rgba = new Uint8Array(width * height * 4);
    const before = gl.getParameter(gl.READ_FRAMEBUFFER_BINDING);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, before);
    return { width, height, rgba };
}

/** Returns a picture's pixels with the top row first, and opaque. */
function flipped({ width, height, rgba }) {
    const out = new Uint8Array(rgba.length);
    for (let y = 0; y < height; ++y) {
        const from = (height - 1 - y) * width * 4;
        out.set(rgba.subarray(from, from + width * 4), y * width * 4);
    }
    for (let i = 3; i < out.length; i += 4) out[i] = 255;
    return out;
}

// ---- The scene ------------------------------------------------------------------------------------------------------

/** Scene as glTF: one node a drawn mesh, in world space. Skins and morphs are baked into their vertices. */
class Model {
    constructor(notes, receiversAreDrawn) {
        this.notes = notes;
        this.receiversAreDrawn = receiversAreDrawn;
        this.json = { asset: { version: '2.0', generator: 'shadow_bundle.js' }, scene: 0, scenes: [{ nodes: [] }] };
        this.chunks = [];
        this.size = 0;
        this.names = new Set();
        this.casters = [];  // objects that are drawn into maps, with a material each
        this.drawn = [];    // their names
        this.suggested = {};
        this.primitives = new Map();
        this.materials = new Map();
    }

    addScene(scene) {
        scene.traverseVisible((object) => {
            if (!object.isMesh) {
                if (object.isLine || object.isPoints) this.#note('Lines and points are left out of the scene.');
            } else if (object.isBatchedMesh) {
                this.#note('Batched meshes are left out of the scene.');
            } else {
                this.#addObject(object);
            }
        });
    }

    #note(text) {
        if (!this.notes.includes(text)) this.notes.push(text);
    }

    #push(list, element) {
        this.json[list] ??= [];
        this.json[list].push(element);
        return this.json[list].length - 1;
    }

    #view(bytes, target) {
        while (this.size % 4 !== 0) {
            this.chunks.push(new Uint8Array(1));
            ++this.size;
        }
        const view = { buffer: 0, byteOffset: this.size, byteLength: bytes.byteLength };
        if (target) view.target = target;
        this.chunks.push(bytes);
        this.size += bytes.byteLength;
        return this.#push('bufferViews', view);
    }

    #accessor(values, type, bounds) {
        const width = { SCALAR: 1, VEC2: 2, VEC3: 3 }[type];
        const isIndex = type === 'SCALAR';
        const accessor = {
            bufferView: this.#view(new Uint8Array(values.buffer, values.byteOffset, values.byteLength),
                                   isIndex ? 34963 : 34962),
            componentType: isIndex ? 5125 : 5126,
            count: values.length / width,
            type,
        };
        if (bounds) {
            accessor.min = new Array(width).fill(Infinity);
            accessor.max = new Array(width).fill(-Infinity);
            values.forEach((value, i) => {
                accessor.min[i % width] = Math.min(accessor.min[i % width], value);
                accessor.max[i % width] = Math.max(accessor.max[i % width], value);
            });
        }
        return this.#push('accessors', accessor);
    }

    /** Returns positions, deformed as they are drawn. */
    #positions(object) {
        const source = object.geometry.attributes.position, out = new Float32Array(source.count * 3);
        const at = object.position.clone();
        const deformed = object.isSkinnedMesh || (object.morphTargetInfluences ?? []).length > 0;
        for (let i = 0; i < source.count; ++i) {
            if (deformed) object.getVertexPosition(i, at);
            else at.fromBufferAttribute(source, i);
            at.toArray(out, 3 * i);
        }
        return out;
    }

    #attributes(object, texture) {
        const geometry = object.geometry;
        const key = `${geometry.uuid} ${object.isSkinnedMesh || object.morphTargetInfluences ? object.uuid : ''}`;
        const shared = this.primitives.get(key) ?? { POSITION: this.#accessor(this.#positions(object), 'VEC3', true) };
        this.primitives.set(key, shared);
        if (!texture) return { POSITION: shared.POSITION };
        // The transform of a texture is baked into its coordinates.
        const source = geometry.attributes[texture.channel > 0 ? `uv${texture.channel}` : 'uv'];
        if (!source) return { POSITION: shared.POSITION };
        if (texture.matrixAutoUpdate) texture.updateMatrix();
        const m = texture.matrix.elements, uv = new Float32Array(source.count * 2);
        for (let i = 0; i < source.count; ++i) {
            const u = source.getX(i), v = source.getY(i);
            uv[2 * i] = m[0] * u + m[3] * v + m[6];
            uv[2 * i + 1] = m[1] * u + m[4] * v + m[7];
        }
        return { POSITION: shared.POSITION, TEXCOORD_0: this.#accessor(uv, 'VEC2') };
    }

    #indices(geometry, start, count) {
        const index = geometry.index, out = new Uint32Array(Math.floor(count / 3) * 3);
        for (let i = 0; i < out.length; ++i) out[i] = index ? index.getX(start + i) : start + i;
        return this.#accessor(out, 'SCALAR');
    }

    #addObject(object) {
        const geometry = object.geometry;
        if (!geometry.attributes.position) return;
        const all = geometry.index ? geometry.index.count : geometry.attributes.position.count;
        const first = geometry.drawRange.start, last = Math.min(all, first + geometry.drawRange.count);
        const materials = Array.isArray(object.material) ? object.material : null;
        const parts = materials ? geometry.groups.map((g) => ({ ...g, material: materials[g.materialIndex] }))
                                : [{ start: 0, count: all, material: object.material }];
        const primitives = [];
        const drawnInMaps = object.castShadow || (this.receiversAreDrawn && object.receiveShadow);
        for (const part of parts) {
            const from = Math.max(first, part.start), to = Math.min(last, part.start + part.count);
            if (!part.material?.visible || to - from < 3) continue;
            const mask = this.#mask(part.material);
            primitives.push({
                attributes: this.#attributes(object, mask),
                indices: this.#indices(geometry, from, to - from),
                material: this.#material(part.material, mask),
            });
            if (drawnInMaps) this.casters.push({ object, material: part.material });
        }
        if (primitives.length === 0) return;
        const mesh = this.#push('meshes', { primitives });
        const world = Array.from(object.matrixWorld.elements);
        const count = object.isInstancedMesh ? object.count : 1;
        for (let i = 0; i < count; ++i) {
            const own = object.isInstancedMesh
                ? product(world, object.instanceMatrix.array.slice(16 * i, 16 * i + 16)) : world;
            const name = this.#name(object.name);
            this.json.scenes[0].nodes.push(this.#push('nodes', { name, mesh, matrix: own }));
            if (drawnInMaps) this.drawn.push(name);
            else this.suggested[`object.${name}.cast`] = 'false';
            if (!object.receiveShadow) this.suggested[`object.${name}.receive`] = 'false';
        }
    }

    /** Returns a name without slash and control characters, each once, as the inspector spells paths. */
    #name(text) {
        const clean = Array.from(text.toWellFormed?.() ?? text).slice(0, 60).join('')
            .replace(/[\u0000-\u001f\u007f/]/g, '_') || `node ${this.names.size}`;
        let name = clean;
        for (let number = 2; this.names.has(name); ++number) name = `${clean} #${number}`;
        this.names.add(name);
        return name;
    }

    /** Returns the texture whose alpha decides where a surface is; null where there is none. */
    #mask(material) {
        if (!(material.alphaTest > 0)) return null;
        if (material.map && material.alphaMap) this.#note('A mask of two textures is written with the first alone.');
        return material.map ?? material.alphaMap ?? null;
    }

    #material(material, mask) {
        if (this.materials.has(material.uuid)) return this.materials.get(material.uuid);
        const colour = material.color ? material.color.toArray() : [0.8, 0.8, 0.8];
        const out = {
            pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 0.8,
                                    baseColorFactor: [...colour.map((c) => Math.min(1, Math.max(0, c))), 1] },
        };
        if (material.side !== frontSide) out.doubleSided = true;
        const texture = mask ? this.#texture(mask, mask !== material.map) : undefined;
        if (texture !== undefined) {
            out.pbrMetallicRoughness.baseColorTexture = { index: texture };
            out.alphaMode = 'MASK';
            out.alphaCutoff = material.alphaTest;
        }
        const index = this.#push('materials', out);
        this.materials.set(material.uuid, index);
        return index;
    }

    /** Adds the image of a mask. @param {boolean} fromGreen alpha is the green channel, as in an alphaMap */
    #texture(texture, fromGreen) {
        const image = texture.image;
        let rgba;
        if (image?.data && image.data.length === image.width * image.height * 4) {
            rgba = new Uint8Array(image.data);
        } else if (image && !image.data) {
            const canvas = document.createElement('canvas');
            canvas.width = image.width;
            canvas.height = image.height;
            const context = canvas.getContext('2d');
            context.drawImage(image, 0, 0);
            rgba = new Uint8Array(context.getImageData(0, 0, image.width, image.height).data);
        } else {
            this.#note('A mask cannot be read, so its surface is written without holes.');
            return undefined;
        }
        if (fromGreen) for (let i = 0; i < rgba.length; i += 4) rgba[i + 3] = rgba[i + 1];
        // glTF has the first row of an image at v = 0, and so has three.js without flipY.
        if (texture.flipY) rgba = flippedRows(rgba, image.width, image.height);
        const wrap = (value) => value === repeatWrapping ? 10497 : value === mirroredRepeatWrapping ? 33648 : 33071;
        const view = this.#view(png(image.width, image.height, rgba));
        const source = this.#push('images', { mimeType: 'image/png', bufferView: view });
        const sampler = this.#push('samplers', { magFilter: 9729, minFilter: 9729, wrapS: wrap(texture.wrapS),
                                                 wrapT: wrap(texture.wrapT) });
        return this.#push('textures', { source, sampler });
    }

    glb() {
        while (this.size % 4 !== 0) {
            this.chunks.push(new Uint8Array(1));
            ++this.size;
        }
        if (this.size > 0) this.json.buffers = [{ byteLength: this.size }];
        if (Object.keys(this.suggested).length > 0)
            this.json.scenes[0].extras = { shadow_inspector: { suggested: this.suggested } };
        let text = utf8(JSON.stringify(this.json));
        const padded = new Uint8Array(Math.ceil(text.length / 4) * 4).fill(32);
        padded.set(text);
        text = padded;
        return joined([integers(0x46546c67, 2, 28 + text.length + this.size, text.length, 0x4e4f534a), text,
                       integers(this.size, 0x004e4942), ...this.chunks]);
    }
}

function flippedRows(rgba, width, height) {
    const out = new Uint8Array(rgba.length);
    for (let y = 0; y < height; ++y)
        out.set(rgba.subarray((height - 1 - y) * width * 4, (height - y) * width * 4), y * width * 4);
    return out;
}

// ---- Files ----------------------------------------------------------------------------------------------------------

function utf8(text) {
    return new TextEncoder().encode(text);
}

/** Returns 32-bit integers, little-endian. */
function integers(...values) {
    const out = new DataView(new ArrayBuffer(4 * values.length));
    values.forEach((value, i) => out.setUint32(4 * i, value, true));
    return new Uint8Array(out.buffer);
}

function joined(parts) {
    const out = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
    let at = 0;
    for (const part of parts) {
        out.set(part, at);
        at += part.length;
    }
    return out;
}

const crcTable = Uint32Array.from({ length: 256 }, (_, i) => {
    for (let bit = 0; bit < 8; ++bit) i = i & 1 ? 0xedb88320 ^ (i >>> 1) : i >>> 1;
    return i >>> 0;
});

function crc32(bytes) {
    let crc = 0xffffffff;
    for (let i = 0; i < bytes.length; ++i) crc = crcTable[(crc ^ bytes[i]) & 255] ^ (crc >>> 8);
    return (crc ^ 0xffffffff) >>> 0;
}

/** Returns a portable float map. Its first row is the bottom of the map. */
function pfm(width, height, depths) {
    const values = new DataView(new ArrayBuffer(depths.length * 4));
    depths.forEach((depth, i) => values.setFloat32(4 * i, depth, true));
    return joined([utf8(`Pf\n${width} ${height}\n-1.0\n`), new Uint8Array(values.buffer)]);
}

/** Returns a PNG of RGBA without compression. */
function png(width, height, rgba) {
    const big = (value) => new Uint8Array([value >>> 24, value >>> 16, value >>> 8, value]);
    const chunk = (type, data) => {
        const body = joined([utf8(type), data]);
        return joined([big(data.length), body, big(crc32(body))]);
    };
    const raw = new Uint8Array(height * (width * 4 + 1));
    for (let y = 0; y < height; ++y) raw.set(rgba.subarray(y * width * 4, (y + 1) * width * 4), y * (width * 4 + 1) + 1);
    const data = [new Uint8Array([0x78, 1])];
    let a = 1, b = 0;
    for (let at = 0; at < raw.length; at += 65535) {
        const part = raw.subarray(at, at + 65535), size = part.length;
        data.push(new Uint8Array([at + size === raw.length ? 1 : 0, size, size >>> 8, ~size, ~size >>> 8]), part);
        for (const byte of part) {
            a = (a + byte) % 65521;
            b = (b + a) % 65521;
        }
    }
    data.push(big((b << 16) | a));
    return joined([new Uint8Array([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10]),
                   chunk('IHDR', joined([big(width), big(height), new Uint8Array([8, 6, 0, 0, 0])])),
                   chunk('IDAT', joined(data)), chunk('IEND', new Uint8Array(0))]);
}

/** Returns a zip file of stored entries. */
function zip(files) {
    const bodies = [], entries = [];
    let at = 0;
    for (const [name, bytes] of files) {
        const path = utf8(name);
        const common = new DataView(new ArrayBuffer(26));
        common.setUint16(0, 20, true);     // version 2.0
        common.setUint16(2, 0x800, true);  // names are UTF-8
        common.setUint16(8, 0x21, true);   // 1 January 1980
        common.setUint32(10, crc32(bytes), true);
        common.setUint32(14, bytes.length, true);
        common.setUint32(18, bytes.length, true);
        common.setUint16(22, path.length, true);
        const fields = new Uint8Array(common.buffer);
        const body = joined([integers(0x04034b50), fields, path, bytes]);
        entries.push(joined([integers(0x02014b50), new Uint8Array([20, 0]), fields, new Uint8Array(10), integers(at), path]));
        bodies.push(body);
        at += body.length;
    }
    const directory = joined(entries);
    const end = new DataView(new ArrayBuffer(22));
    end.setUint32(0, 0x06054b50, true);
    end.setUint16(8, entries.length, true);
    end.setUint16(10, entries.length, true);
    end.setUint32(12, directory.length, true);
    end.setUint32(16, at, true);
    return joined([...bodies, directory, new Uint8Array(end.buffer)]);
}
