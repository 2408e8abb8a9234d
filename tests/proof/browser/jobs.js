// Fetches jobs, has an engine draw them, and posts masks and facts.

/** Returns a job with its buffers: positions, normals and indices. */
async function fetchJob(index) {
    const get = async (name) => {
        const response = await fetch(`/job/${index}/${name}`);
        if (!response.ok) throw new Error(`job ${index}: ${name}: ${response.status}`);
        return response;
    };
    const job = await (await get('job.json')).json();
    const buffer = async (name) => (await get(name)).arrayBuffer();
    job.positions = new Float32Array(await buffer(job.positions));
    job.normals = new Float32Array(await buffer(job.normals));
    job.indices = new Uint32Array(await buffer(job.indices));
    return job;
}

/** Returns the geometry of each object with indices of its own. */
export function objectsOf(job) {
    return job.objects.map((object) => {
        const used = job.indices.subarray(object.first_index, object.first_index + object.index_count);
        let first = Infinity, last = -1;
        for (const index of used) {
            first = Math.min(first, index);
            last = Math.max(last, index);
        }
        return { ...object, positions: job.positions.slice(3 * first, 3 * (last + 1)),
            normals: job.normals.slice(3 * first, 3 * (last + 1)), indices: used.map((index) => index - first) };
    });
}

/** Returns the product of two matrices, column by column. */
export function multiply(a, b) {
    const out = new Array(16).fill(0);
    for (let column = 0; column < 4; ++column)
        for (let row = 0; row < 4; ++row)
            for (let k = 0; k < 4; ++k) out[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return out;
}

/** Returns the inverse of a rotation and translation, column by column. */
export function inverseOfPose(m) {
    const out = new Array(16).fill(0);
    for (let column = 0; column < 3; ++column)
        for (let row = 0; row < 3; ++row) out[4 * column + row] = m[4 * row + column];
    for (let row = 0; row < 3; ++row)
        out[12 + row] = -(out[row] * m[12] + out[4 + row] * m[13] + out[8 + row] * m[14]);
    out[15] = 1;
    return out;
}

/**
 * Returns the mask as a PGM file: the red channel of the picture with shadows over that of the one without.
 * Both are linear floats in rows from the bottom. Pixels without light are white.
 */
function maskOf(width, height, shadowed, lit) {
    const head = new TextEncoder().encode(`P5\n${width} ${height}\n255\n`);
    const out = new Uint8Array(head.length + width * height);
    out.set(head);
    const kDark = 1e-5;
    for (let y = 0; y < height; ++y)
        for (let x = 0; x < width; ++x) {
            const from = 4 * ((height - 1 - y) * width + x);
            const share = lit[from] > kDark ? shadowed[from] / lit[from] : 1;
            out[head.length + y * width + x] = Math.round(255 * Math.min(1, Math.max(0, share)));
        }
    return out;
}

/** Returns the name of the driver that WebGL draws by. */
function driverName() {
    const gl = document.createElement('canvas').getContext('webgl2');
    const names = gl?.getExtension('WEBGL_debug_renderer_info');
    return gl ? String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER)) : 'none';
}

/**
 * Draws all jobs and posts what comes out.
 * draw(job) returns {shadowed, lit, facts}, pictures as RGBA floats in rows from the bottom.
 */
export async function drawJobs(draw) {
    const post = (what, body) => fetch(what, { method: 'POST', body });
    try {
        const driver = driverName();
        const count = Number(await (await fetch('/jobs')).text());
        for (let index = 0; index < count; ++index) {
            const job = await fetchJob(index);
            const { shadowed, lit, facts } = await draw(job);
            await post(`/mask/${index}`, maskOf(job.camera.width, job.camera.height, shadowed, lit));
            await post(`/facts/${index}`, JSON.stringify({ ...facts, driver }, null, 1));
        }
        await post('/done', '');
    } catch (error) {
        await post('/done', `${error.stack ?? error}`);
    }
}
