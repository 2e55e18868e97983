// The live pictures in a real browser: node tests/web/live.mjs [--firefox] [--timed] [--pictures FOLDER] [NAME...]:
// all tests, or those whose names contain a NAME; --timed: those that measure. To be run at the top of
// the repository, after "make web demos".
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build, findings, firefox, newPage, run } from './browser.mjs';

const words = process.argv.slice(2).filter(word => word !== '--firefox');
const timed = words[0] === '--timed' && words.shift() !== '';
const pictures = words[0] === '--pictures' ? words.splice(0, 2)[1] : undefined;
const pages = resolve(`${build}/web/pages`);
const chapters = ['01', '02', '03', '04', '05', '06', '07', '08', '09', '10', '11', '12', '13', '14', '15', '16', '17'].map(n => `demo${n}`);

// ---- a live picture ---------------------------------------------------------------------------

// Small, for speed, but for the tests that say otherwise.
async function open(demo, options = {}) {
    const page = await newPage(options), [w, h] = options.size ?? [240, 180];
    await page.goto(`${pathToFileURL(`${pages}/${demo}.html`)}?workers=${options.workers ?? 2}&size=${w}x${h}`);
    if (!options.dead)
        await page.waitForFunction(() => document.querySelector('.live')?.live, { timeout: 60000 });
    return page;
}

// Until all samples are there, of a picture that was begun after this.
const done = (page, finished) => page.waitForFunction(finished => {
    const live = document.querySelector('.live').live;
    return live.done > 0 && (!finished || /finished: at most/.test(document.querySelector('.status').textContent));
}, { timeout: 60000, polling: 20 }, finished);
async function anew(page, act) {
    await page.evaluate(() => { document.querySelector('.live').live.done = 0; });
    await act();
    await done(page);
    await page.evaluate(() => new Promise(requestAnimationFrame));
}

// The bytes of the picture, or of the other one, as one number.
const hash = (page, which = 0) => page.evaluate(which => {
    let h = 2166136261;
    for (const [i, byte] of document.querySelector('.live').live.images[which].data.entries())
        h = i % 4 < 3 ? Math.imul(h ^ byte, 16777619) : h;
    return h >>> 0;
}, which);

// Until it is this number: where no event tells that all is drawn.
async function become(page, expected, what) {
    const end = performance.now() + 60000;
    while (await hash(page) !== expected && performance.now() < end)
        await new Promise(later => setTimeout(later, 50));
    assert.equal(await hash(page), expected, what);
}

// The same number of what a demo writes on this machine, of the same size.
const native = {};
async function nativeHash(page, demo, ...options) {
    const size = await page.$eval('.picture', canvas => [canvas.width, canvas.height]);
    const key = [demo, ...size, ...options].join(' ');
    if (native[key] === undefined) {
        const file = `${build}/web/native.png`;
        execFileSync(`${build}/${demo}`, [...size, '--quiet', '--no-window', '--out', file, ...options]);
        native[key] = await page.evaluate(async url => {
            const image = new Image();
            image.src = url;
            await image.decode();
            const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext('2d');
            context.drawImage(image, 0, 0);
            let h = 2166136261;
            for (const [i, byte] of context.getImageData(0, 0, image.width, image.height).data.entries())
                h = i % 4 < 3 ? Math.imul(h ^ byte, 16777619) : h;
            return h >>> 0;
        }, `data:image/png;base64,${readFileSync(file).toString('base64')}`);
    }
    return native[key];
}

// A point of the picture, as if it had 480 x 360 pixels, on the screen.
async function place(page, x, y) {
    const box = await page.$eval('.picture', canvas => { canvas.scrollIntoView({ block: 'center' }); const { left, top, width } = canvas.getBoundingClientRect(); return { left, top, width }; });
    return [box.left + x * box.width / 480, box.top + y * box.width / 480];
}
async function drag(page, from, by, steps = 10, pause = 0) {
    const [x, y] = await place(page, ...from), [X, Y] = await place(page, from[0] + by[0], from[1] + by[1]);
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let i = 1; i <= steps; i++) {
        await page.mouse.move(x + (X - x) * i / steps, y + (Y - y) * i / steps);
        if (pause > 0)
            await new Promise(later => setTimeout(later, pause));
    }
    await page.mouse.up();
}
async function press(page, ...keys) {
    await page.focus('.picture');
    for (const key of keys)
        await page.keyboard.press(key);
}
const status = page => page.$eval('.status', element => element.textContent);
const text = (page, selector) => page.$eval(selector, element => element.textContent);
const slide = (page, name, value) => page.evaluate((name, value) => {
    const label = [...document.querySelectorAll('label')].find(l => l.textContent.trim().startsWith(name));
    const input = label.querySelector('input');
    if (input.type === 'checkbox')
        input.click();
    else
        input.value = value, input.dispatchEvent(new Event('input'));
}, name, value);
const button = (page, name) => page.evaluate(name => [...document.querySelectorAll('.live button')].find(b => b.textContent === name).click(), name);
const tests = {}, speeds = {};
const BALL = [155, 225]; // of the picture at first

// ---- the same bits ------------------------------------------------------------------------------

for (const demo of chapters)
    tests[`${demo} has the bytes of the program`] = async () => {
        const page = await open(demo);
        await done(page, demo >= 'demo10'); // from there on it is finished, too
        assert.equal(await hash(page), await nativeHash(page, demo));
    };

tests['a chapter sends less than 200 kB'] = async () => {
    const packed = name => gzipSync(readFileSync(`${pages}/live/${name}`)).length;
    const most = Math.max(...chapters.map(demo => packed(`${demo}.js`))) + packed('live.js') + packed('live.css');
    console.log(`  the largest: ${Math.round(most / 1000)} kB`);
    assert.ok(most < 200000);
};

tests['one worker, three, and none make the same picture'] = async () => {
    for (const options of [{ workers: 1 }, { workers: 3 }, { before: () => { delete window.Worker; } }])
        for (const demo of ['demo04', 'demo10']) {
            const page = await open(demo, options);
            await done(page, demo === 'demo10');
            assert.equal(await hash(page), await nativeHash(page, demo), `${demo} ${JSON.stringify(options)}`);
        }
};

// ---- what moves -----------------------------------------------------------------------------------

tests['a drag moves the ball, and reset moves it back'] = async () => {
    for (const demo of ['demo01', 'demo07']) {
        const page = await open(demo);
        await done(page);
        const first = await hash(page);
        await page.evaluate(() => { document.querySelector('.live').live.drafts.length = 0; });
        await anew(page, () => drag(page, BALL, [60, -20], 20, 15));
        assert.ok(await page.evaluate(() => document.querySelector('.live').live.drafts.length) > 3, 'drafts on the way');
        assert.notEqual(await hash(page), first);
        await anew(page, () => button(page, 'reset everything'));
        assert.equal(await hash(page), first);
    }
};

tests['cube, mirror, lamp and camera move, too'] = async () => {
    const page = await open('demo06');
    await done(page);
    const seen = new Set([await hash(page)]);
    for (const [from, by] of [[[340, 245], [20, 0]], [[262, 215], [10, 0]], [[20, 60], [30, 0]]]) {
        await anew(page, () => drag(page, from, by));
        const now = await hash(page);
        assert.ok(!seen.has(now), `drag from ${from}`);
        seen.add(now);
    }
    for (const thing of [1, 2, 3, 4]) { // without a pointer
        await page.select('.live select', await page.$eval(`.live option:nth-child(${thing + 1})`, o => o.value));
        await anew(page, () => button(page, '→'));
        const now = await hash(page);
        assert.ok(!seen.has(now), `arrow for thing ${thing}`);
        seen.add(now);
    }
};

tests['keys say the same as in the window'] = async () => {
    const page = await open('demo07');
    await done(page);
    const first = await hash(page);
    for (const [key, demo] of [['1', 'demo01'], ['4', 'demo04'], ['6', 'demo06']]) {
        await anew(page, () => press(page, key));
        const options = ['--bounces', '5'];
        assert.equal(await hash(page), await nativeHash(page, demo, ...(demo === 'demo06' ? options : [])), `key ${key}`);
    }
    await anew(page, () => press(page, '7'));
    assert.equal(await hash(page), first, 'key 7');
    for (const key of ['ArrowLeft', 'ArrowUp', 'PageUp', ']', 'l']) {
        const before = await hash(page);
        await anew(page, () => press(page, key));
        assert.notEqual(await hash(page), before, `key ${key}`);
    }
    await anew(page, () => press(page, 'r'));
    assert.equal(await hash(page), first, 'key r');
    await press(page, '-'); // what there is, stays
    assert.equal(await text(page, '.live output'), '8');
    await press(page, '+', '+');
    await page.waitForFunction(() => /^32 samples/.test(document.querySelector('.status').textContent), { timeout: 60000 });
    assert.equal(await hash(page), await nativeHash(page, 'demo07', '--samples', '32'));
};

tests['digits of a French keyboard need no Shift'] = async () => {
    const page = await open('demo07');
    await done(page);
    await anew(page, () => page.$eval('.picture', canvas =>
        canvas.dispatchEvent(new KeyboardEvent('keydown', { key: '\'', code: 'Digit4', bubbles: true }))));
    assert.equal(await hash(page), await nativeHash(page, 'demo04'));
};

tests['a finger moves things and scrolls elsewhere'] = async () => {
    const page = await open('demo04', { width: 375, height: 400, touch: true });
    await done(page);
    const first = await hash(page), swipe = async from => {
        const [x, y] = await place(page, ...from), before = await page.evaluate(() => scrollY);
        await page.touchscreen.touchStart(x, y);
        for (let i = 1; i <= 8; i++)
            await page.touchscreen.touchMove(x, y - 10 * i);
        await page.touchscreen.touchEnd();
        return await page.evaluate(() => scrollY) - before;
    };
    await anew(page, async () => assert.equal(await swipe(BALL), 0, 'the page stays'));
    assert.notEqual(await hash(page), first);
};

// ---- controls ----------------------------------------------------------------------------------------

tests['sliders change what they say'] = async () => {
    const five = await open('demo05');
    await done(five);
    const gamma = await hash(five);
    await slide(five, 'gamma', 1);
    assert.equal(await text(five, '.live output'), '1.0');
    await become(five, await nativeHash(five, 'demo04'), 'gamma 1 is chapter 4');
    await slide(five, 'gamma', 2.2);
    await become(five, gamma, 'and back');
    const six = await open('demo06');
    await anew(six, () => slide(six, 'bounces', 0));
    assert.equal(await hash(six), await nativeHash(six, 'demo06', '--bounces', '0'));
    const seven = await open('demo07');
    await done(seven);
    await anew(seven, () => slide(seven, 'samples', 5)); // what there is, stays
    assert.equal(await hash(seven), await nativeHash(seven, 'demo07', '--samples', '32'));
    await anew(seven, () => slide(seven, 'samples', 1));
    assert.equal(await hash(seven), await nativeHash(seven, 'demo07', '--samples', '2'));
    assert.ok(await seven.$$eval('.chart circle', list => list.length) >= 1, 'the chart has grown');
    await anew(seven, () => seven.click('.stages label:nth-of-type(3)'));
    assert.equal(await seven.evaluate(() => document.querySelector('.live').live.ex.page_stage()), 3);
};

tests['chapter 8: the same picture by one ray at a time and by other workers, and its speeds'] = async () => {
    const page = await open('demo08');
    await done(page);
    const first = await hash(page);
    await anew(page, () => slide(page, '4 rays'));
    assert.equal(await hash(page), first);
    await anew(page, () => slide(page, 'workers', 1));
    assert.equal(await hash(page), first);
    assert.equal(await page.$$eval('.speed', list => list.length), 3);
};

tests['chapter 9: the error of both kinds of numbers'] = async () => {
    const page = await open('demo09');
    await done(page);
    await page.waitForFunction(() => document.querySelector('.live').live.other_done, { timeout: 60000 });
    assert.equal(await hash(page, 1), await nativeHash(page, 'demo09', '--sampler', 'random'));
    const [sobol, random] = await page.evaluate(() => ['0', '1'].map(i => document.querySelectorAll(`.chart circle.curve-${i}`).length));
    assert.ok(sobol > 3 && random > 3, `${sobol} and ${random} points`);
    assert.match(await status(page), /64 samples, error/);
};

tests['the divider shows the other picture'] = async () => {
    const five = await open('demo05');
    await done(five);
    await slide(five, 'on the left', 40);
    await five.waitForFunction(() => document.querySelector('.live').live.other_done);
    assert.equal(await hash(five, 1), await nativeHash(five, 'demo04'));
    assert.equal(await five.$eval('.other', canvas => getComputedStyle(canvas).visibility), 'visible');
    const ten = await open('demo10');
    await done(ten, true);
    assert.equal(await hash(ten, 1), await nativeHash(ten, 'demo09', '--samples', '16'), 'its noise');
};

// The pixel of a canvas, of 240 x 180.
const shown = (page, selector, x, y) => page.$eval(selector, (canvas, x, y) =>
    [...canvas.getContext('2d').getImageData(x, y, 1, 1).data], x, y);

tests['what is compared is really drawn, and never an older view'] = async () => {
    const ten = await open('demo10');
    await done(ten, true);
    await slide(ten, 'on the left', 50);
    await ten.waitForFunction(() => {
        const data = document.querySelector('.other').getContext('2d').getImageData(0, 0, 240, 180).data;
        return document.querySelector('.live').live.images[1].data.every((byte, i) => byte === data[i]);
    }, { timeout: 60000 });
    const five = await open('demo05');
    await slide(five, 'on the left', 50);
    await five.waitForFunction(() => document.querySelector('.live').live.other_done, { timeout: 60000 });
    const before = await shown(five, '.other', 20, 90);
    await slide(five, 'gamma', 3); // changes both
    await five.waitForFunction(before => document.querySelector('.other').getContext('2d').getImageData(20, 90, 1, 1).data[1] > before, { timeout: 60000 }, before[1]);
    await drag(five, BALL, [10, 0], 3);
    assert.equal(await five.$eval('.other', canvas => getComputedStyle(canvas).visibility), 'hidden');
    await five.waitForFunction(() => getComputedStyle(document.querySelector('.other')).visibility === 'visible', { timeout: 60000 });
};

tests['more samples: of both pictures, also while it moves'] = async () => {
    const nine = await open('demo09');
    await done(nine);
    await slide(nine, 'samples', 7);
    await nine.waitForFunction(() => document.querySelector('.live').live.other_done, { timeout: 60000 });
    assert.equal(await hash(nine), await nativeHash(nine, 'demo09', '--samples', '128'));
    assert.equal(await hash(nine, 1), await nativeHash(nine, 'demo09', '--samples', '128', '--sampler', 'random'));
    const four = await open('demo04');
    await done(four);
    await anew(four, () => press(four, 'ArrowLeft', '+', 'ArrowLeft', '+'));
    const [mixed, one] = [await hash(four), await open('demo04')];
    await done(one);
    await anew(one, () => press(one, '+', '+'));
    await anew(one, () => press(one, 'ArrowLeft', 'ArrowLeft'));
    assert.equal(mixed, await hash(one), 'no two views in one');
};

tests['a hidden tab rests and goes on'] = async () => {
    const page = await open('demo07');
    await done(page);
    const hide = hidden => page.evaluate(hidden => {
        Object.defineProperty(document, 'hidden', { value: hidden, configurable: true });
        document.dispatchEvent(new Event('visibilitychange'));
    }, hidden);
    await slide(page, 'samples', 7);
    await page.waitForFunction(() => /^(1[7-9]|[2-9]\d) samples/.test(document.querySelector('.status').textContent), { timeout: 60000 });
    await hide(true);
    let rested = '', now = await status(page); // what was on its way still comes
    for (const end = performance.now() + 20000; rested !== now && performance.now() < end; now = await status(page)) {
        rested = now;
        await new Promise(later => setTimeout(later, 700));
    }
    assert.equal(now, rested);
    assert.doesNotMatch(now, /^128/);
    await hide(false);
    await page.waitForFunction(() => /^128 samples/.test(document.querySelector('.status').textContent), { timeout: 60000 });
    assert.equal(await hash(page), await nativeHash(page, 'demo07', '--samples', '128'));
};

tests['chapter 10: d and g change the finished picture, and back'] = async () => {
    const page = await open('demo10');
    await done(page, true);
    const first = await hash(page), until = words => page.waitForFunction(words => new RegExp(words).test(document.querySelector('.status').textContent), { timeout: 60000 }, words);
    await press(page, 'd');
    await until('^16 samples, error [\\d.]+ %, [\\d.]+ Mrays');
    await become(page, await nativeHash(page, 'demo09', '--samples', '16'), 'd');
    await press(page, 'd');
    await become(page, first, 'd twice');
    const pixel = () => document.querySelector('.live').live.images[0].data[4 * 9000], clean = await page.evaluate(pixel);
    await press(page, 'g');
    await page.waitForFunction(clean => document.querySelector('.live').live.images[0].data[4 * 9000] !== clean, { timeout: 60000 }, clean);
    await press(page, 'g');
    await become(page, first, 'g twice');
};

tests['part two: its pictures, on keys and to choose'] = async () => {
    const page = await open('demo15', { size: [120, 90] });
    await done(page, true);
    for (const [stage, demo] of [[8, 'demo11'], [9, 'demo12'], [10, 'demo13'], [13, 'demo16'], [14, 'demo17'], [11, 'demo14']]) {
        await page.click(`.stages label:nth-of-type(${stage})`);
        await become(page, await nativeHash(page, demo, '--samples', '64'), demo);
    }
    await press(page, '.');
    await become(page, await nativeHash(page, 'demo15'), 'a point goes on');
    await press(page, '9');
    await page.waitForFunction(() => document.querySelector('.stages label:nth-of-type(9) input').checked);
    assert.match(await text(page, '.stages label:nth-of-type(9)'), /12 lamps/);
};

tests['part two: what a thing is, by the wheel and by buttons'] = async () => {
    const page = await open('demo12');
    await done(page, true);
    const first = await hash(page), [x, y] = await place(page, 218, 65); // the lamp
    await page.focus('.picture');
    await page.mouse.move(x, y);
    await anew(page, () => page.mouse.wheel({ deltaY: -200 }));
    const larger = await hash(page);
    assert.notEqual(larger, first);
    await page.select('.live select', '4');
    await page.waitForFunction(() => document.querySelector('.tuned').textContent === 'radius 7.26');
    await anew(page, () => page.click('.pad [aria-label="less"]'));
    await anew(page, () => page.click('.pad [aria-label="less"]'));
    assert.match(await text(page, '.tuned'), /radius 6$/);
    await page.select('.live select', '0');
    await page.waitForFunction(() => document.querySelector('.tuned').textContent === '');
};

tests['part two: exposure makes other bytes of the same light'] = async () => {
    const page = await open('demo14');
    await done(page, true);
    const first = await hash(page);
    await slide(page, 'exposure', 2);
    await become(page, await nativeHash(page, 'demo14', '--exposure', '2'), 'slider');
    await press(page, 'w', 'w', 'w', 'w');
    await become(page, first, 'keys');
};

tests['part two: the path tells of glass, gloss and lamps'] = async () => {
    const page = await open('demo13');
    await done(page, true);
    const [x, y] = await place(page, 255, 277);
    await page.mouse.click(x, y);
    await page.waitForFunction(() => /refracted, in/.test(document.querySelector('.live .words').textContent));
    assert.equal(await page.$$eval('.legend span', list => list.filter(span => !span.hidden).length), 8);
};

tests['a teapot is taken with all its triangles, and they are told'] = async () => {
    const page = await open('demo17');
    await done(page, true);
    const first = await hash(page), [x, y] = await place(page, 380, 240);
    await page.mouse.click(x, y);
    await page.waitForFunction(() => /the teapot\s*triangle \d+, u 0\.\d+, v 0\.\d+/.test(document.querySelector('.live .words').textContent));
    await page.evaluate(() => { document.querySelector('.live').live.drafts.length = 0; });
    await anew(page, () => drag(page, [380, 290], [-20, 10], 20, 60)); // the pedestal
    assert.ok(await page.evaluate(() => document.querySelector('.live').live.drafts.length) > 0, 'drafts on the way');
    assert.notEqual(await hash(page), first);
    await button(page, 'reset everything');
    await become(page, first, 'reset');
};

tests['what the keys can move is what the stage has'] = async () => {
    for (const [demo, things] of [['demo01', 2], ['demo02', 3], ['demo03', 4], ['demo06', 5], ['demo11', 6], ['demo16', 6], ['demo17', 7]]) {
        const page = await open(demo);
        assert.equal(await page.$$eval('.live option', list => list.length), things, demo);
    }
};

tests['in French for who reads French'] = async () => {
    const page = await open('demo07', { before: () => { Object.defineProperty(navigator, 'language', { value: 'fr-CA' }); } });
    await done(page);
    assert.match(await status(page), /16 échantillons, erreur/);
    assert.match(await text(page, '.live'), /à gauche: le chapitre précédent/);
};

// ---- the path of a pixel -------------------------------------------------------------------------------

tests['a click tells what --explain tells'] = async () => {
    const page = await open('demo07');
    await done(page);
    for (const [x, y] of [[100, 250], [262, 215], [430, 100], [350, 240]]) {
        const [X, Y] = await place(page, x + 0.5, y + 0.5);
        await page.mouse.click(X, Y);
        const said = await page.evaluate(() => document.querySelector('.live').live.say_path());
        const [, px, py] = (await text(page, '.inspector .bar span')).match(/pixel (\d+),(\d+), sample 0/);
        const told = execFileSync(`${build}/demo07`, ['240', '180', '--explain', `${px},${py}`, '--samples', '1', '--quiet'], { encoding: 'utf8' });
        assert.equal(said.trim(), told.replace(/mean: .*\n/, '').trim());
        assert.ok(Math.abs(2 * px - x) <= 2 && Math.abs(2 * py - y) <= 2);
    }
    const above = await text(page, '.words');
    assert.match(above, /throughput/);
    const sizes = await page.$$eval('.words tr', list => list.map(row => row.children.length));
    assert.ok(sizes.length > 1 && sizes.every(size => size === sizes[0] && size > 4), `${sizes}`);
    await button(page, '+');
    assert.match(await text(page, '.inspector .bar span'), /sample 1/);
    assert.notEqual(await text(page, '.words'), above);
    const [from_above, from_the_side] = await page.$$eval('.plan', list => list.map(canvas => canvas.toDataURL()));
    assert.notEqual(from_above, from_the_side);
    await press(page, 'Escape');
    assert.equal(await page.$eval('.inspector', element => getComputedStyle(element).display), 'none');
    await press(page, 'Enter');
    assert.match(await text(page, '.inspector .bar span'), /pixel 120,90/);
};

// ---- for everybody ----------------------------------------------------------------------------------------

tests['axe-core finds nothing, light and dark, on a phone and a desk'] = async () => {
    for (const demo of ['demo01', 'demo07', 'demo08', 'demo10', 'demo14', 'demo15']) {
        const page = await open(demo, { width: 360 });
        await done(page);
        await press(page, 'Enter');
        for (const [scheme, width] of [['light', 360], ['dark', 1100]]) {
            await page.setViewport({ width, height: 900 });
            await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
            await new Promise(later => setTimeout(later, 200));
            assert.deepEqual(await findings(page), [], `${demo} ${scheme} ${width}`);
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no scrolling sideways');
        }
        await page.close();
    }
};

// How often the picture was painted, but for drafts, and how often with holes.
const watched = () => {
    const paint = CanvasRenderingContext2D.prototype.putImageData;
    window.painted = window.holes = 0;
    CanvasRenderingContext2D.prototype.putImageData = function (image, ...place) {
        window.painted += this.canvas.isConnected ? 1 : 0;
        window.holes += image.data.some((byte, i) => i % 4 === 3 && byte < 255) ? 1 : 0;
        return paint.call(this, image, ...place);
    };
};

tests['a draft comes first, and no picture has holes'] = async () => {
    for (const demo of ['demo07', 'demo10']) {
        const page = await open(demo, { before: watched });
        await done(page);
        const live = await page.evaluate(() => { const { first, whole } = document.querySelector('.live').live; return { first, whole }; });
        assert.ok(live.first > 0 && live.first < live.whole, `${demo}: ${live.first}, ${live.whole}`);
        assert.equal(await page.evaluate(() => window.holes), 0);
    }
};

tests['with reduced motion it shows few steps'] = async () => {
    const page = await open('demo07', { before: watched, features: [{ name: 'prefers-reduced-motion', value: 'reduce' }] });
    await done(page);
    const samples = await page.evaluate(() => document.querySelector('.live').live.ex.page_samples());
    assert.ok(await page.evaluate(() => window.painted) <= 1 + Math.ceil(Math.log2(samples)));
    assert.equal(await hash(page), await nativeHash(page, 'demo07'));
};

tests['without WebAssembly or its SIMD a sentence and the still picture'] = async () => {
    const without = [() => { delete window.WebAssembly; }, () => { WebAssembly.compile = async () => { throw new Error('no SIMD'); }; }];
    for (const before of without) {
        const page = await open('demo03', { before, dead: true });
        await page.waitForSelector('.live .status');
        assert.match(await text(page, '.live'), /cannot move here/);
        assert.ok(await page.$eval('.live img', image => image.offsetWidth > 100));
    }
};

tests['without a script there is the still picture'] = async () => {
    const page = await newPage();
    await page.setJavaScriptEnabled(false);
    await page.goto(`${pathToFileURL(`${pages}/demo07.html`)}`);
    assert.equal(await page.$$eval('.live > *', list => list.length), 1);
};

tests['a window of 300 pixels'] = async () => {
    const page = await open('demo07', { width: 300, height: 500 });
    await done(page);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await anew(page, () => drag(page, BALL, [40, 0]));
};

tests['many moves start no second loop'] = async () => {
    const page = await open('demo07', { workers: 1 });
    await done(page);
    for (let i = 0; i < 5; i++)
        await drag(page, BALL, [i % 2 ? 10 : -10, 0], 6, 10);
    await page.evaluate(() => { document.querySelector('.live').live.moves.length = 0; });
    await anew(page, () => drag(page, BALL, [20, 0], 10, 30));
    const moves = await page.evaluate(() => document.querySelector('.live').live.moves);
    assert.ok(Math.min(...moves.slice(0, -1)) < 200, `${moves}`);
};

if (firefox) {
    const names = Object.keys(tests).filter(name => /axe|reduced motion|without a script/.test(name));
    names.forEach(name => delete tests[name]);
    console.log(`note: not tried in Firefox, which cannot be told: ${names.join('; ')}`);
}

// ---- how fast it is -----------------------------------------------------------------------------------------

// Each has some tries, as other programs may run beside it.
async function tries(count, test) {
    for (let i = 1; ; i++)
        try {
            return await test();
        } catch (error) {
            if (i === count)
                throw error;
        }
}

speeds['the first picture in half a second'] = () => tries(8, async () => {
    for (const demo of ['demo01', 'demo07']) {
        const page = await open(demo, { size: [480, 360] });
        await done(page);
        const { first, whole } = await page.evaluate(() => document.querySelector('.live').live);
        console.log(`${demo}: first picture, a draft, after ${Math.round(first)} ms; a sample in each pixel after ${Math.round(whole)} ms`);
        assert.ok(first <= 500);
        await page.close();
    }
});

speeds['thirty drafts a second'] = () => tries(8, async () => {
    for (const demo of ['demo01', 'demo07']) {
        const page = await open(demo, { size: [480, 360] });
        await done(page);
        await page.evaluate(() => { document.querySelector('.live').live.drafts.length = 0; });
        await drag(page, BALL, [100, -40], 100, 12);
        const drafts = await page.evaluate(() => document.querySelector('.live').live.drafts);
        const rate = 1000 * (drafts.length - 1) / (drafts.at(-1) - drafts[0]);
        console.log(`${demo}: ${rate.toFixed(1)} drafts a second`);
        assert.ok(rate >= 30);
        await page.close();
    }
});

// Chapter 8 by packets, in each worker, against a native program with as many lanes.
speeds['a worker has 60 % of the speed of a native thread'] = () => tries(8, async () => {
    const program = `${build}/web/native08`;
    execFileSync('sh', ['-c', `make -s BUILD=${build}/web/native MACHINE= CC=clang OPENMP= CFLAGS='-O3 -fno-math-errno -DRT_NO_PACKETS' ${build}/web/native/demo08`]);
    const said = execFileSync(`${build}/web/native/demo08`, ['480', '360', '--no-window', '--out', `${program}.png`], { encoding: 'utf8' });
    const native = +said.match(/([\d.]+) million rays/)[1];
    const page = await open('demo08', { workers: 1, size: [480, 360] });
    await done(page);
    await anew(page, () => slide(page, '4 rays'));
    const rate = await page.evaluate(() => document.querySelector('.live').live.rate);
    console.log(`one ray at a time: page ${rate.toFixed(1)}, native ${native.toFixed(1)} million rays a second: ${Math.round(100 * rate / native)} %`);
    assert.ok(rate >= 0.6 * native);
});

// ---- pictures to look at -----------------------------------------------------------------------------------

if (pictures) {
    for (const demo of chapters)
        for (const [name, width, scheme] of [['desk', 1100, 'light'], ['desk-dark', 1100, 'dark'], ['phone', 360, 'light'], ['phone-dark', 360, 'dark']]) {
            const page = await open(demo, { size: [480, 360], width, features: [{ name: 'prefers-color-scheme', value: scheme }] });
            await done(page);
            await slide(page, 'on the left', 50);
            const [x, y] = await place(page, 350, 240);
            if (scheme === 'dark')
                await page.mouse.click(x, y);
            await new Promise(later => setTimeout(later, 1500));
            await page.screenshot({ path: `${pictures}/${demo}-${name}.png`, fullPage: true });
            await page.close();
        }
}
await run(pictures ? {} : timed ? speeds : tests, words);
