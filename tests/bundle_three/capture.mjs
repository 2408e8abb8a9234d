// Serves page.html to a headless Chromium and keeps the bundles that it posts.
// node capture.mjs OUT_FOLDER NODE_MODULES BUNDLE_FOLDER
import { spawn } from 'node:child_process';
import { createServer } from 'node:http';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';

const [out, modules, bundle] = process.argv.slice(2);
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const roots = { three: path.join(modules, 'three'), bundle };
const types = { '.html': 'text/html', '.js': 'text/javascript' };

function fileOf(url) {
    const [first, ...rest] = url.slice(1).split('/');
    const root = roots[first] ?? here, name = roots[first] ? rest.join('/') : url.slice(1);
    const file = path.normalize(path.join(root, name));
    return file.startsWith(root + path.sep) ? file : null;
}

let browser, console_text = '';
function finish(code, text) {
    if (text) process.stderr.write(text + '\n');
    browser?.kill('SIGKILL');
    server.close();
    process.exit(code);
}

const server = createServer((request, response) => {
    if (request.method === 'POST') {
        const parts = [];
        request.on('data', (part) => parts.push(part));
        request.on('end', () => {
            const body = Buffer.concat(parts), [, what, name] = request.url.split('/');
            response.end();
            if (what === 'bundle' && /^[a-z]+$/.test(name)) writeFileSync(path.join(out, `${name}.zip`), body);
            if (what === 'skip' && /^[a-z]+$/.test(name)) writeFileSync(path.join(out, `${name}.lacks`), body);
            if (what === 'done') finish(body.length > 0 ? 1 : 0, body.toString());
        });
        return;
    }
    try {
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
    browser = spawn('chromium', ['--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking',
        '--disable-component-update', '--disable-sync', '--enable-logging=stderr', '--v=0',
        `--user-data-dir=${path.join(out, 'profile')}`, url], { stdio: ['ignore', 'ignore', 'pipe'] });
    browser.stderr.on('data', (text) => { console_text += text; });
    browser.on('error', (error) => finish(1, `chromium: ${error.message}`));
    browser.on('exit', () => finish(1, `chromium ended\n${console_text}`));
});
setTimeout(() => finish(1, `no bundle within 5 minutes\n${console_text}`), 300000);
