// A real browser for the tests of the pages: Chromium, or with --firefox Firefox, by puppeteer-core, and
// a server of our own. Where one of them is missing, this says so in one line and ends.
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { extname, join, resolve } from 'node:path';

export const build = process.env.BUILD ?? 'build';

function note(words) {
    console.log(`note: ${words}: pages not tested`);
    process.exit(0);
}

export const firefox = process.argv.includes('--firefox');
const names = firefox ? ['firefox', 'firefox-esr'] : ['chromium', 'chromium-browser', 'google-chrome'];
const browserPath = (process.env.PATH ?? '').split(':').flatMap(path => names.map(name => join(path, name)))
    .find(existsSync) ?? note(`${names[0]} is missing (Debian: apt-get install ${names[0].replace('fox', 'fox-esr')})`);
if (!existsSync(`${build}/web/node_modules/puppeteer-core`))
    note('puppeteer-core is missing (make deps-web)');
const packages = createRequire(resolve(`${build}/web/package.json`));
const puppeteer = packages('puppeteer-core');
const axe = readFileSync(packages.resolve('axe-core/axe.min.js'), 'utf8');

// A server for a folder; counts what is fetched: paths, and how many bytes. instead(url, response) may
// answer in its place, and then returns true.
const kinds = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm',
    '.json': 'application/json', '.png': 'image/png', '.svg': 'image/svg+xml' };
export async function serve(folder, instead = () => false) {
    const fetched = [];
    const server = createServer((request, response) => {
        const url = new URL(request.url, 'http://localhost');
        const path = join(folder, decodeURIComponent(url.pathname));
        if (instead(url, response))
            return;
        if (!existsSync(path) || !statSync(path).isFile()) {
            response.statusCode = 404;
            return response.end();
        }
        fetched.push([url.pathname, statSync(path).size]);
        response.setHeader('content-type', kinds[extname(path)] ?? 'application/octet-stream');
        response.end(readFileSync(path));
    });
    await new Promise(ready => server.listen(0, '127.0.0.1', ready));
    return { top: `http://localhost:${server.address().port}/`, fetched, close: () => server.close() };
}

const profile = mkdtempSync(join(tmpdir(), 'rt-pages-'));
export const browser = await puppeteer.launch({
    browser: firefox ? 'firefox' : 'chrome', executablePath: browserPath, headless: true, userDataDir: profile,
    args: process.getuid?.() === 0 && !firefox ? ['--no-sandbox'] : [],
});

// What no page may do: complain, or ask another machine.
export const complaints = [];
export async function newPage({ width = 1100, height = 900, features = [], before, touch = false, context = browser } = {}) {
    const page = await context.newPage();
    await page.setViewport({ width, height, hasTouch: touch });
    if (features.length > 0)
        await page.emulateMediaFeatures(features);
    if (before)
        await page.evaluateOnNewDocument(before);
    page.on('pageerror', error => complaints.push(error.message));
    page.on('console', message => ['error', 'warn'].includes(message.type()) &&
        !/willReadFrequently/.test(message.text()) && complaints.push(message.text())); // that is these tests' reading
    page.on('request', request => /^(data:|blob:|file:|http:\/\/localhost:)/.test(request.url()) ||
        complaints.push(`asked ${request.url()}`));
    return page;
}

// What axe-core finds on a page: a list of rules and elements.
export async function findings(page) {
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => axe.run({ preload: false }));
    return violations.map(v => `${v.id}: ${v.nodes.map(node => node.target).join(' ')}`);
}

// Pages that stay open from test to test.
export const kept = [];

// Run tests, an object of names and functions; one line for each that fails.
export async function run(tests, wanted) {
    let good = 0, bad = 0;
    for (const [name, test] of Object.entries(tests)) {
        if (wanted.length > 0 && !wanted.some(word => name.includes(word)))
            continue;
        complaints.length = 0;
        const from = performance.now();
        try {
            await test();
            if (complaints.length > 0)
                throw new Error(`the page complains: ${complaints.join('; ')}`);
            good++;
            if (process.env.TIMES)
                console.log(`${((performance.now() - from) / 1000).toFixed(1)} s: ${name}`);
        } catch (error) {
            bad++;
            console.log(`${name}: ${error.stack}${complaints.map(words => `\n    the page complains: ${words}`).join('')}`);
        }
        for (const page of (await browser.pages()).slice(1).filter(page => !kept.includes(page)))
            await page.close();
    }
    await browser.close();
    rmSync(profile, { recursive: true, force: true });
    console.log(`pages: ${good} passed, ${bad} failed`);
    process.exit(bad > 0 ? 1 : 0);
}
