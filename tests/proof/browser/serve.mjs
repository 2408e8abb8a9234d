// Serves an engine's page and its jobs to a headless Chromium, and keeps what the page posts.
// node serve.mjs ENGINE_FOLDER NODE_MODULES PROFILE_FOLDER JOB...
import { spawn } from 'node:child_process';
import { createServer } from 'node:http';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';

const [engine, modules, profile, ...jobs] = process.argv.slice(2);
const here = path.dirname(new URL(import.meta.url).pathname);
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript' };
const kSilence_ms = 180000;

/** Returns the file of a request: of the engine's folder, of a package, of this folder or of a job. */
function fileOf(url) {
    const [first, second, ...rest] = url.slice(1).split('/');
    let root = engine, name = url.slice(1);
    if (first === 'modules') [root, name] = [modules, [second, ...rest].join('/')];
    if (first === 'browser') [root, name] = [here, [second, ...rest].join('/')];
    if (first === 'job') [root, name] = [jobs[Number(second)], rest.join('/')];
    root = path.resolve(root);
    const file = path.normalize(path.join(root, name));
    return file.startsWith(root + path.sep) ? file : null;
}

let browser, consoleText = '', timer;
function finish(code, text) {
    if (text) process.stderr.write(text + '\n');
    browser?.kill('SIGKILL');
    server.close();
    process.exit(code);
}
function expectMore() {
    clearTimeout(timer);
    timer = setTimeout(() => finish(1, `nothing came for ${kSilence_ms / 1000} s\n${consoleText}`), kSilence_ms);
}

const server = createServer((request, response) => {
    if (request.method === 'POST') {
        const parts = [];
        request.on('data', (part) => parts.push(part));
        request.on('end', () => {
            const body = Buffer.concat(parts), [, kind, index] = request.url.split('/');
            response.end();
            expectMore();
            const files = { mask: 'mask.pgm', facts: 'facts.json' };
            if (kind in files) writeFileSync(path.join(jobs[Number(index)], files[kind]), body);
            if (kind === 'done') finish(body.length > 0 ? 1 : 0, body.toString());
        });
        return;
    }
    try {
        if (request.url === '/jobs') {
            response.end(String(jobs.length));
            return;
        }
        const file = fileOf(request.url);
        response.setHeader('Content-Type', types[path.extname(file)] ?? 'application/octet-stream');
        response.end(readFileSync(file));
    } catch {
        response.statusCode = 404;
        response.end();
    }
});

server.listen(0, '127.0.0.1', () => {
    const url = `http://127.0.0.1:${server.address().port}/page.html`;
    // gl-egl is Mesa's OpenGL ES; gl is its desktop OpenGL, which needs an X display. The browser's own rasteriser,
    // SwiftShader, is switched off: its grid of vertices is 1/16 of a pixel, that of Mesa 1/256.
    const angle = process.env.SI_PROOF_ANGLE ?? 'gl-egl';
    const platform = angle === 'gl' ? ['--ozone-platform=x11'] : [];
    browser = spawn('chromium', ['--headless', '--no-sandbox', '--use-gl=angle', `--use-angle=${angle}`,
        ...platform, '--disable-software-rasterizer', '--ignore-gpu-blocklist', '--disable-quic', '--no-first-run',
        '--disable-background-networking', '--disable-component-update', '--disable-sync', '--enable-logging=stderr', '--v=0',
        `--user-data-dir=${profile}`, url], { stdio: ['ignore', 'ignore', 'pipe'] });
    browser.stderr.on('data', (text) => { consoleText += text; });
    browser.on('error', (error) => finish(1, `chromium: ${error.message}`));
    browser.on('exit', () => finish(1, `chromium ended\n${consoleText}`));
    expectMore();
});
