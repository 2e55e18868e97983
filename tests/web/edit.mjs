// "Write it yourself" in the pages, in a real browser: node tests/web/edit.mjs [--firefox]
// [--all] [--pictures FOLDER] [NAME...]: the tests, or those whose names contain a NAME; --all: the
// long form, with all submissions and mistakes. To be run at the top of the repository, after "make web".
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { browser, build, complaints, findings, firefox, kept, newPage, run, serve } from './browser.mjs';

const words = process.argv.slice(2).filter(word => word !== '--firefox' && word !== '--all');
const everything = process.argv.includes('--all');
const pictures = words[0] === '--pictures' ? words.splice(0, 2)[1] : undefined;
const pages = `${build}/web/pages`;

// ---- a page with nothing but an editor --------------------------------------------------

const html = routines => `<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width"><title>Test</title>
<link rel="icon" href="data:,"><link rel="stylesheet" href="site.css">
<script defer src="edit/edit.js"></script></head>
<body><main><h1>A sphere</h1><div id="live-demo01"></div>
<div class="edit" data-routines="${routines}" data-live="live-demo01"></div></main></body></html>`;
let missing = /^$/; // what the server does not have
const server = await serve(pages, (url, response) => {
    if (url.pathname === '/') {
        response.setHeader('content-type', 'text/html');
        response.end(html(url.searchParams.get('routines')));
    } else if (missing.test(url.pathname)) {
        response.statusCode = 404;
        response.end();
    } else {
        return false;
    }
    return true;
});
const { fetched } = server;

async function open(routines = 'rt_hit_sphere rt_camera_ray', width = 1100, context = browser) {
    const page = await newPage({ width, context });
    await page.goto(`${server.top}?routines=${encodeURIComponent(routines)}`);
    await page.evaluate(() => {
        window.events = [];
        document.getElementById('live-demo01').addEventListener('mine', event =>
            window.events.push([event.detail.routine, event.detail.bytes.length,
                WebAssembly.validate(event.detail.bytes)]));
    });
    return page;
}

const text = (page, selector) => page.$eval(selector, element => element.textContent);
const finished = page => page.waitForFunction(() =>
    /^(?!.*\.\.\.$)./.test(document.querySelector('.edit-status')?.textContent ?? ''),
{ timeout: 60000, polling: 20 }).catch(async error => {
    throw new Error(`${error.message}; it says: ${await text(page, '.edit')}`);
});

async function press(page, label) {
    const buttons = await page.$$('.edit button');
    for (const button of buttons)
        if ((await button.evaluate(element => element.textContent)).startsWith(label))
            return button.click();
    throw new Error(`no button ${label}`);
}

async function begin(page) {
    await press(page, 'Write it yourself');
    await page.waitForSelector('.cm-content');
    await finished(page);
}

const rt = readFileSync('rt.h', 'utf8');
const routines = [...rt.matchAll(/^#ifndef (rt_[a-z_]+)$/gm)].map(match => match[1]);

// A page with all routines, at this one: the same for all tests that need no new one, which would
// take some seconds to prepare the compiler.
async function warm(routine) {
    if (kept.length === 0) {
        kept.push(await open(routines.join(' ')));
        await begin(kept[0]);
    }
    await kept[0].bringToFront();
    await kept[0].select('.edit select', routine);
    await finished(kept[0]);
    return kept[0];
}

// As a reader would paste it.
async function paste(page, code) {
    await page.focus('.cm-content');
    await page.keyboard.down('Control');
    await page.keyboard.press('a');
    await page.keyboard.up('Control');
    await page.$eval('.cm-content', (element, code) => {
        const clipboardData = new DataTransfer();
        clipboardData.setData('text/plain', code);
        const event = new Event('paste', { bubbles: true, cancelable: true });
        element.dispatchEvent(Object.defineProperty(event, 'clipboardData', { value: clipboardData }));
    }, code);
}

// What the page says of a text: { status, verdict, list, printed }.
async function attempt(page, code) {
    if (code !== '')
        await paste(page, code);
    else
        await page.focus('.cm-content'), await page.keyboard.down('Control'), await page.keyboard.press('a'),
        await page.keyboard.up('Control'), await page.keyboard.press('Backspace');
    await press(page, 'compile and try');
    await finished(page);
    return {
        status: await text(page, '.edit-status'), verdict: await text(page, '.edit-verdict'),
        list: await page.$$eval('.edit-list li', list => list.map(item => item.textContent)),
        printed: await page.$eval('.edit-printed', element =>
            element.parentElement.hidden ? '' : element.textContent),
    };
}

// What "save" would put into a file of this name.
async function saved(page, name) {
    await page.evaluate(() => {
        URL.createObjectURL = blob => { window.saved = blob.text(); return 'data:,'; };
        HTMLAnchorElement.prototype.click = function () { window.savedAs = this.download; };
    });
    await press(page, `save ${name}`);
    assert.equal(await page.evaluate(() => window.savedAs), name);
    return page.evaluate(() => window.saved);
}

// ---- texts to try ---------------------------------------------------------------------

const submission = name => readFileSync(`tests/classroom/submissions/${name}`, 'utf8');
const demo = readFileSync('demos/demo01_sphere.c', 'utf8');
const copied = `#define rt_hit_sphere my_hit_sphere\n#include "rt.h"\n` +
    /static bool hit_sphere[^]*?\n}\n/.exec(demo)[0].replace('hit_sphere', 'my_hit_sphere');
const right = copied.replace('discriminant < 0.0', '!(discriminant >= 0.0)')
    .replace('t <= 0.0 || (float)t >= t_max', '!(t > 0.0 && (float)t < t_max)');
const reflect = (body, before = '') => `#define rt_reflect my_reflect
#include "rt.h"
${before}
static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    ${body}
    return rt_sub(incident, rt_scale(normal, 2 * rt_dot(normal, incident)));
}
`;

// ---- the tests ------------------------------------------------------------------------

const tests = {};
const test = (name, act) => { tests[name] = act; };

test('file: a server is needed', async () => {
    const page = await newPage();
    await page.goto(pathToFileURL(resolve(`${pages}/demo01.html`)).href);
    assert.match(await text(page, '.edit'), /you need a web server: python3 -m http\.server/);
});

test('first: what is fetched, and when', async () => {
    fetched.length = 0;
    const page = await open();
    assert.deepEqual(fetched.map(([path]) => path), ['/site.css', '/edit/edit.js', '/edit/edit.css']);
    assert.match(await text(page, '.edit'), /fetches a C compiler once, 23 MB/);
    const from = performance.now();
    await begin(page);
    const sum = fetched.reduce((sum, [, size]) => sum + size, 0);
    console.log(`  ${(sum / 1e6).toFixed(1)} MB, first compile and verdict after ` +
        `${((performance.now() - from) / 1000).toFixed(1)} s: ${await text(page, '.edit-status')}`);
    assert.match(await text(page, '.edit-verdict'), /WRONG {2}hits from outside/); // the starter
    await page.waitForFunction(async () => (await Promise.all((await caches.keys())
        .map(async key => (await (await caches.open(key)).keys()).length))).join() === '5');
    await page.close();
});

test('the server ends meanwhile', async () => {
    const context = await browser.createBrowserContext(); // where nothing is kept
    const page = await open(undefined, undefined, context);
    missing = /editor\.js/;
    await press(page, 'Write it yourself');
    await page.waitForFunction(() => /The editor could not be loaded/.test(document.body.textContent));
    missing = /clang\.bin/;
    await begin(page);
    assert.match(await text(page, '.edit-status'), /The compiler could not be loaded: clang\.bin: .* 404/);
    missing = /^$/;
    await press(page, 'compile and try');
    await finished(page);
    assert.match(await text(page, '.edit-status'), /0 of 9 right/);
    assert.ok(complaints.splice(0).every(words => /404/.test(words)));
    await context.close();
});

test('right and wrong answers', async () => {
    const page = await warm('rt_hit_sphere');
    let said = await attempt(page, copied);
    assert.match(said.verdict, /8 of 9 kinds of input right/);
    assert.match(said.verdict, /WRONG {2}no direction, NaN, infinity\n +input \d+ of 200: center .*\n +yours: hit .*\n +right: hit 0/);
    assert.match(said.status, /8 of 9 right/);
    said = await attempt(page, right);
    assert.match(said.verdict, /all right: 9 of 9/);
    const events = await page.evaluate(() => window.events);
    assert.deepEqual(events.at(-1)[0], 'rt_hit_sphere');
    assert.ok(events.at(-1)[1] > 1000 && events.at(-1)[2]);
    const times = [];
    for (let i = 0; i < (words.includes('soak') ? 100 : everything ? 5 : 1); i++) {
        const from = performance.now();
        await attempt(page, `${right}/* ${i} */\n`);
        times.push(performance.now() - from);
    }
    times.sort((a, b) => a - b);
    console.log(`  later, from paste to verdict: ${times[0].toFixed(0)} to ${times.at(-1).toFixed(0)} ms, ` +
        `mostly ${times[times.length >> 1].toFixed(0)}; ${await text(page, '.edit-status')}`);
});

test('a mistake is marked in its line', async () => {
    const page = await warm('rt_hit_sphere');
    let said = await attempt(page, right.replace('return true;', 'return true'));
    const line = right.split('\n').findIndex(line => /return true;/.test(line)) + 1;
    assert.match(said.status, /my_hit_sphere\.c: does not compile/);
    assert.match(said.list[0], new RegExp(`line ${line} expected ';' after return statement`));
    await page.waitForSelector('.cm-lint-marker-error');
    await page.waitForSelector('.cm-lintRange-error');
    assert.equal(said.verdict, '');
    said = await attempt(page, right.replace('#include "rt.h"', '#include "rt.h"\n#include "mine.h"'));
    assert.deepEqual(said.list, ["line 3 'mine.h' file not found"]);
    said = await attempt(page, right.replace('return true;', 'return far_away(t);')
        .replace('#include "rt.h"', '#include "rt.h"\nbool far_away(double t);'));
    assert.match(said.list[0], /undefined symbol: far_away/);
    said = await attempt(page, '');
    assert.match(said.status, /my_hit_sphere\.c: empty/);
    said = await attempt(page, 'int x;\n');
    assert.match(said.status, /replaces nothing: there is no line like #define/);
    said = await attempt(page, '#include "rt.h"\n#define rt_hit_sphere my_hit_sphere\n' +
        right.split('\n').slice(2).join('\n'));
    assert.match(said.status, /#define rt_\.\.\. must come before #include "rt\.h"/);
    said = await attempt(page, `${right}int main(void) { return 0; }\n`);
    assert.match(said.list.join('\n'), /^tests\/classroom\/show\.c, line \d+: conflicting types for 'main'/m);
    said = await attempt(page, right.replace('return true;', 'int unused; return true;'));
    assert.match(said.list[0], /warning: unused variable/); // and a verdict
    assert.match(said.verdict, /all right/);
    said = await attempt(page, `${right}/* ${'x'.repeat(1 << 20)} */`);
    assert.match(said.status, /larger than a megabyte/);
});

test('what goes wrong while it runs', async () => {
    const page = await warm('rt_reflect');
    const from = performance.now();
    let said = await attempt(page, submission('eva.c'));
    assert.match(said.verdict, /WRONG {2}unit vectors: no end within 3 seconds\n0 of 2/);
    assert.ok(performance.now() - from < 15000);
    const events = await page.evaluate(() => window.events.length);
    said = await attempt(page, reflect('return my_reflect(my_reflect(normal, incident), normal);',
        'static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal);'));
    assert.match(said.verdict, /it crashed: the stack is full/);
    assert.match(said.verdict, /no picture: it would crash, or never end/);
    assert.equal(await page.evaluate(() => window.events.length), events); // no picture
    said = await attempt(page, submission('jon.c'));
    assert.match(said.verdict, /all right: 2 of 2/);
    assert.match(said.printed, /^0: I am reflecting [^]*and \d{8} bytes more$/);
    assert.ok(said.printed.length < 4200);
    said = await attempt(page, reflect('char *volatile much = malloc(3000000000u); memset(much, 1, 3000000000u);',
        '#include <stdlib.h>'));
    assert.match(said.verdict, /0 of 2/);
    said = await attempt(page, reflect('').replace('2 *', '2.0f *'));
    assert.match(said.verdict, /all right: 2 of 2/); // it still lives
});

if (everything) test('what else goes wrong while it runs', async () => {
    const page = await warm('rt_reflect');
    let said = await attempt(page, submission('finn.c'));
    assert.match(said.verdict, /WRONG {2}unit vectors: it crashed: it read or wrote outside/);
    said = await attempt(page, submission('kim.c'));
    assert.match(said.verdict, /yours: reflected nan nan nan/);
    said = await attempt(page, reflect('for (;;) puts("again");', '#include <stdio.h>'));
    assert.match(said.verdict, /no end within 3 seconds/);
    assert.match(said.printed, /^again\nagain/);
    said = await attempt(page, reflect('for (int i = 0; i < 1000; i++) { char *volatile some = malloc(1 << 20); memset(some, i, 1 << 20); }',
        '#include <stdlib.h>'));
    assert.match(said.verdict, /0 of 2/);
    said = await attempt(page, reflect('static volatile char much[2000000000]; much[(int)normal.x] = 1;'));
    assert.match(said.status, /does not compile: no end within 30 seconds/);
    said = await attempt(page, reflect('abort();', '#include <stdlib.h>'));
    assert.match(said.verdict, /it crashed: it reached a place that it must not reach/);
    said = await attempt(page, reflect('float *volatile p = 0; *p = 1;'));
    assert.match(said.verdict, /it crashed/);
});

test('each routine, as rt.h has it, is all right', async () => {
    const page = await warm(routines[0]);
    const own = name => (name === 'rt_hit_sphere' ? right // rt.h's are in pieces
        : name === 'rt_hit_triangle' ? readFileSync('tests/classroom/submissions/tara.c', 'utf8')
        : new RegExp(`^static inline [^;{}]*[ *]${name}\\([^;{}]*\\{$[^]*?^\\}`, 'm').exec(rt)[0]
            .replace(`${name}(`, `my_${name.slice(3)}(`)).replace(/^#(define|include).*$/gm, '');
    const file = some => `${some.map(name => `#define ${name} my_${name.slice(3)}\n`).join('')}#include "rt.h"\n\n` +
        some.map(own).join('\n\n');
    const slow = [];
    for (const some of everything ? routines.map(name => [name]) : [routines]) { // one by one, or all in one file
        await page.select('.edit select', some[0]);
        await finished(page);
        const from = performance.now();
        const said = await attempt(page, file(some));
        assert.equal([...said.verdict.matchAll(/^all right: (\d+) of \1 kinds/gm)].length, some.length, JSON.stringify(said));
        slow.push([performance.now() - from, some.length === 1 ? some[0] : 'all of them']);
    }
    await page.evaluate(() => localStorage.clear());
    slow.sort(([a], [b]) => b - a);
    console.log(`  ${routines.length} routines; from paste to verdict, ms: ` +
        `${slow.map(([ms, name]) => `${name} ${ms.toFixed(0)}`).join(', ')}`);
});

test('the text is kept, saved and given back', async () => {
    let page = await open();
    await begin(page);
    await press(page, 'start over');
    const starter = await saved(page, 'my_hit_sphere.c');
    assert.match(starter, /My own rt_hit_sphere[^]*#define rt_hit_sphere my_hit_sphere/);
    await attempt(page, right);
    await page.close();
    fetched.length = 0;
    page = await open();
    await begin(page);
    assert.deepEqual(fetched.filter(([path]) => /\.bin/.test(path)), [], 'the compiler, too');
    assert.equal(await saved(page, 'my_hit_sphere.c'), right);
    await page.select('.edit select', 'rt_camera_ray');
    await finished(page);
    assert.match(await saved(page, 'my_camera_ray.c'), /My own rt_camera_ray/);
    assert.match(await text(page, '.edit-verdict'), /rt_camera_ray, chapter 1/);
    await page.select('.edit select', 'rt_hit_sphere');
    assert.equal(await saved(page, 'my_hit_sphere.c'), right);
    await press(page, 'start over');
    assert.equal(await saved(page, 'my_hit_sphere.c'), starter);
    await page.close();
});

test('by the keys alone', async () => {
    const page = await open();
    await page.keyboard.press('Tab');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.cm-content');
    await finished(page);
    const inside = () => page.evaluate(() => document.activeElement.matches('.cm-content'));
    assert.ok(await inside());
    await page.keyboard.press('Tab');
    assert.ok(await inside()); // an indent
    await page.keyboard.press('Escape');
    await page.keyboard.press('Tab');
    assert.ok(!await inside());
    await paste(page, copied);
    await page.keyboard.down('Control');
    await page.keyboard.press('Enter');
    await page.keyboard.up('Control');
    assert.match(await text(page, '.edit-status'), /compiling/);
    await finished(page);
    assert.match(await text(page, '.edit-status'), /8 of 9/);
    await page.keyboard.type('// by itself');
    await page.waitForFunction(() => /compiling/.test(document.querySelector('.edit-status').textContent));
    await finished(page);
    await press(page, 'start over');
    await finished(page);
    await page.close();
});

test('the marks of make grade', async () => {
    const all = 'tests/classroom/submissions';
    // By another compiler than grade.wasm's: the inputs of a seed are the same.
    const native = spawnSync('tests/classroom/run', ['grade', all], {
        env: { ...process.env, SEED: '0', OUT: `${build}/web/marks.csv`, BUILD: `${build}/web` },
        encoding: 'utf8',
    });
    assert.equal(native.status, 0, native.stdout + native.stderr);
    const [head, ...rows] = readFileSync(`${build}/web/marks.csv`, 'utf8').trim().split('\n');
    const table = rows.map(line => line.split(',')).filter((_, i) => everything || i % 9 === 0);
    const chapters = [...head.matchAll(/chapter (\d+)/g)].map(([, chapter]) => chapter);
    const work = mkdtempSync(join(tmpdir(), 'rt-edit-'));
    const page = await warm('rt_reflect');
    for (const [quoted, ...rest] of table) {
        const numbers = rest.slice(0, 2 * chapters.length); // then comes what it uses
        const name = JSON.parse(quoted), path = join(all, name);
        const files = statSync(path).isDirectory() ? readdirSync(path).sort().map(file => join(name, file)) : [name];
        const good = Array(numbers.length / 2).fill(0), count = good.slice();
        let compiles = true;
        for (const file of files) {
            const said = await attempt(page, submission(file));
            const part = /^(rt_\w+), chapter (\d+)\n(?:  [^]*?)^(?:all right: )?(\d+) of (\d+) kinds/gm;
            compiles &&= said.verdict !== '';
            for (const [, , chapter, marks, of] of said.verdict.matchAll(part)) {
                good[chapters.indexOf(chapter)] += +marks;
                count[chapters.indexOf(chapter)] += +of;
            }
            // line by line what "make try" says, but for why it came to no end
            const tried = spawnSync(`${build}/web/classroom/grade`,
                ['--folder', work, '--try', join(all, file)],
                { encoding: 'utf8', maxBuffer: 1 << 27 });
            const lines = text => text.split('\n').filter(line => /^ {2}/.test(line))
                .map(line => line.replace(/: (it crashed|ended by the system|it ended by itself).*/, ': $1'));
            if (said.verdict !== '' && !/does not compile/.test(tried.stdout))
                assert.deepEqual(lines(said.verdict), lines(tried.stdout), file);
            console.log(`  ${file}: ${said.status}`);
        }
        assert.deepEqual(good, numbers.filter((_, i) => i % 2 === 0).map(Number), name);
        if (compiles)
            assert.deepEqual(count, numbers.filter((_, i) => i % 2 === 1).map(Number), name);
    }
    // What the page saves is what "make try" takes.
    await page.select('.edit select', 'rt_hit_sphere');
    await finished(page);
    await attempt(page, right);
    writeFileSync(join(work, 'my_hit_sphere.c'), await saved(page, 'my_hit_sphere.c'));
    const tried = spawnSync(`${build}/web/classroom/grade`,
        ['--folder', work, '--try', join(work, 'my_hit_sphere.c')], { encoding: 'utf8' });
    assert.match(tried.stdout, /\nall right\n$/);
    await press(page, 'start over');
    rmSync(work, { recursive: true });
});

test('the picture by it, beside the right one', async () => {
    const page = await newPage({ width: 900 });
    await page.goto(`${server.top}demo04.html?size=120x90`);
    await begin(page);
    const hashes = async () => {
        await page.waitForFunction(() => document.querySelector('.live').live.other_done &&
            document.querySelector('.live').live.done > 0, { timeout: 60000 });
        return page.evaluate(() => document.querySelector('.live').live.images.map(image => image.data.reduce((h, byte) => Math.imul(h ^ byte, 16777619) >>> 0, 2166136261)));
    };
    const draw = async code => {
        await page.evaluate(() => { document.querySelector('.live').live.done = 0; });
        await attempt(page, code);
        return hashes();
    };
    const leave = 'static inline rt_vec3 my_leave(rt_vec3 point, rt_vec3 normal, rt_vec3 direction)\n';
    const [wrong, expected] = await draw(readFileSync('docs/mistakes/4-acne.c', 'utf8'));
    assert.notEqual(wrong, expected);
    assert.ok(await page.$eval('.live', live => live.classList.contains('mine') && live.nextElementSibling.matches('.edit')));
    const told = []; // a click tells of the picture by the reader's routine, and not of the right one
    const box = await page.$eval('.picture', canvas => { const { left, top, width, height } = canvas.getBoundingClientRect(); return { left, top, width, height }; });
    for (let part = 0.2; part < 0.85; part += 0.05) {
        await page.mouse.click(box.left + part * box.width, box.top + 0.93 * box.height);
        await page.waitForFunction(before => document.querySelector('.live').live.say_path() !== before, { timeout: 60000 }, told.at(-1) ?? '');
        told.push(await page.evaluate(() => document.querySelector('.live').live.say_path()));
    }
    assert.ok(told.some(words => /meets the floor[^]*hidden by the floor/.test(words)), told.join('\n'));
    const body = /^static inline rt_vec3 rt_leave\([^{;]*\n(\{[^]*?\n\})/m.exec(rt)[1];
    const [good, again] = await draw(`#define rt_leave my_leave\n#include "rt.h"\n${leave}${body}\n`);
    assert.equal(again, expected);
    assert.equal(good, expected, 'the same bytes');
    await attempt(page, 'this is no C');
    assert.ok(await page.$eval('.live', live => live.classList.contains('old')), 'of what was typed before');
    // right in all that is asked, but endless in the picture: the page goes on without it
    await attempt(page, `#define rt_leave my_leave\n#include "rt.h"\n${leave.replace('my_', 'other_')}${body}\n` +
        `${leave}{\n    static int calls;\n    if (++calls > 5000)\n        for (volatile int on = 1; on;) { }\n    return other_leave(point, normal, direction);\n}\n`);
    assert.match(await text(page, '.edit-verdict'), /^all right/m);
    await page.waitForFunction(() => !document.querySelector('.live').classList.contains('mine'), { timeout: 60000 });
    assert.match(await text(page, '.edit-status'), /The picture stopped: it did not end within 3 s/);
    await page.waitForFunction(() => document.querySelector('.live').live.done > 0, { timeout: 60000 });
    await press(page, 'start over');
    await finished(page);
});

test('for everybody: axe-core, light and dark, narrow and wide', async () => {
    if (firefox)
        return console.log('note: not tried in Firefox, which cannot be told: colours');
    let page = await open(undefined, 360);
    const look = async what => {
        for (const [scheme, width] of [['light', 360], ['dark', 1100]]) {
            await page.setViewport({ width, height: 900 });
            await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
            await new Promise(ready => setTimeout(ready, 200));
            if (pictures)
                await page.screenshot({ path: join(pictures, `${what}-${scheme}-${width}.png`), fullPage: true });
            assert.deepEqual(await findings(page), [], `${what} ${scheme} ${width}`);
            const wide = await page.evaluate(() => document.documentElement.scrollWidth);
            assert.ok(wide <= width, `${what}: ${wide} wide`);
        }
    };
    await look('begin');
    page = await warm('rt_hit_sphere');
    await attempt(page, copied);
    await look('verdict');
    await attempt(page, copied.replace(/;\n}\n$/, '\n    int unused = ;\n}\n'));
    await look('error');
    await attempt(page, reflect('printf("%g\\n", (double)normal.x);', '#include <stdio.h>'));
    await look('prints');
});

if (pictures)
    mkdirSync(pictures, { recursive: true });
await run(tests, words);
