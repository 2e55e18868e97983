/* The picture of a chapter, alive: <div class="live" data-demo="demo07">, with the still picture in it.
 * The demo is compiled to WebAssembly and runs on as many workers as there are cores, each with some
 * parts of the picture. demos/viewer.c says what a drag or a key means and what is to be rendered; this
 * script draws it. It needs nothing from the network and works from file://. Without it, and where it
 * cannot run, the still picture stays. See build.sh for how the scripts of this folder become one. */

/* ---- the figure -------------------------------------------------------------------------- */

const DRAFT = 1, REST = 2; /* as viewer_task */
const BEFORE = 0, ONE_SAMPLE = 1, BY_RT_H = 2, OTHER_NUMBERS = 3, NOISY = 4; /* as viewer_comparison */
const KEYS = {ArrowLeft: 256, ArrowRight: 257, ArrowUp: 258, ArrowDown: 259, PageUp: 260, PageDown: 261};
const PART = 4096; /* pixels, as in page.c */
const THINGS = ['the camera', 'the ball', 'the mirror', 'the cube', 'the lamp', 'the glass ball', 'the teapot', 'the pedestal'];
const STAGES = [1, 2, 3, 4, 5, 6, 7], ALL_STAGES = [...STAGES, 8, 9, 10, 11, 12, 13, 14]; /* 8 on: part two, see viewer.h */

/* What each chapter has of its own. */
const chapters = {
    demo01: {compare: ONE_SAMPLE, controls: ['samples']},
    demo02: {compare: BEFORE, controls: []},
    demo03: {compare: BEFORE, controls: []},
    demo04: {compare: BEFORE, controls: []},
    demo05: {compare: BEFORE, controls: ['gamma']},
    demo06: {compare: BEFORE, controls: ['bounces']},
    demo07: {compare: BEFORE, controls: ['stages', 'samples', 'bounces'], chart: 'error'},
    demo08: {compare: ONE_SAMPLE, controls: ['samples', 'lanes', 'workers'], chart: 'speed'},
    demo09: {compare: OTHER_NUMBERS, controls: ['samples', 'sampler'], chart: 'error'},
    demo10: {compare: NOISY, controls: ['samples', 'denoise']},
    demo11: {compare: NOISY, controls: ['samples', 'bounces', 'denoise']},
    demo12: {compare: NOISY, controls: ['samples', 'bounces', 'denoise']},
    demo13: {compare: NOISY, controls: ['samples', 'bounces', 'denoise']},
    demo14: {compare: NOISY, controls: ['samples', 'exposure', 'denoise']},
    demo15: {compare: NOISY, controls: ['all_stages', 'samples', 'exposure', 'denoise']},
    demo16: {compare: NOISY, controls: ['samples', 'bounces', 'denoise']},
    demo17: {compare: NOISY, controls: ['all_stages', 'samples', 'exposure', 'denoise']},
};

async function bring_to_life(root, name, encoded) {
    const asked = new URLSearchParams(location.search); /* ?workers=1&size=240x180 */
    const [W, H] = (asked.get('size') ?? '480x360').split('x').map(Number), chapter = chapters[name];
    const bytes = Uint8Array.from(atob(encoded), c => c.charCodeAt(0));
    const begun = performance.now(), seconds = () => performance.now() / 1000;
    const {ex, text, wish, path} = open(await WebAssembly.compile(bytes), W, H);
    const calm = matchMedia('(prefers-reduced-motion: reduce)');

    /* Its state beside the viewer's. */
    const images = [new ImageData(W, H), new ImageData(W, H)]; /* the picture, and the one to compare with */
    let workers = [], alone = false, mine = null, drawn_by = 'chapter';
    let run = 0, stale = true; /* what came from the workers before is void */
    let asked_for = 0, other_asked = 0, other_begun = false; /* samples */
    let results = [[], []], painted = [0, 0]; /* so many samples of what is to be seen now */
    let started = 0, spent = 0, known_error = Infinity;
    let collected = [], finishing = false, finish_again = false, finished_samples = 0, finished_error = -1;
    let number = 0, latest = 0, dirty = false, moved_at = 0, timer = 0; /* drafts */
    let divide = 0, holding = false, thing = 0, gamma_is = 0, visible = false;
    const report = {first: 0, whole: 0, moves: [], drafts: [], done: 0, workers: 0}; /* for tests and the curious */

    ex.page_set_comparison(chapter.compare);
    const {canvas, other, status, spoken, progress, plans, said, where, controls, chart} = build();
    const context = canvas.getContext('2d'), other_context = other.getContext('2d');
    const at_first = +(asked.get('workers') ?? Math.min(8, navigator.hardwareConcurrency ?? 2));
    hire(at_first);

    /* ---- workers ------------------------------------------------------------------------- */

    /* So many. Where there are none to be had, the page works itself, and answers a little later. */
    function hire(count) {
        workers.forEach(w => { clearTimeout(w.alarm); w.end(); });
        workers = [];
        report.workers = count = Math.max(1, count);
        let url = '';
        alone = false;
        try {
            url = URL.createObjectURL(new Blob([open, '\n', work, '\nonmessage = (receive => e => receive(e.data))(work(postMessage));']));
        } catch { /* then without */ }
        for (let k = 0; k < count; k++) {
            const hear = m => listen(m, w), w = {busy: false};
            try {
                const worker = new Worker(url);
                worker.onmessage = e => hear(e.data);
                worker.onerror = e => { e.preventDefault(); hear({k, failed: e.message ?? 'error'}); };
                w.tell = (m, given) => worker.postMessage(m, given ?? []);
                w.end = () => worker.terminate();
            } catch {
                if (k > 0)
                    break;
                alone = true;
                count = report.workers = 1;
                const receive = work(m => setTimeout(hear, 0, m));
                w.tell = m => setTimeout(receive, 0, m);
                w.end = () => receive({do: 'stop'});
            }
            workers.push(w);
            w.tell({do: 'start', k, n: count, width: W, height: H});
            w.tell({do: 'module', name: 'chapter', bytes});
            if (mine)
                w.tell({do: 'module', name: 'mine', bytes: mine});
        }
        if (url)
            setTimeout(() => URL.revokeObjectURL(url), 10000);
        stale = true;
    }
    const tell_all = m => workers.forEach(w => w.tell(m));

    /* Code of the reader's may run without end: then other workers go on without it. */
    function watch(w) {
        clearTimeout(w.alarm);
        w.owes = drawn_by === 'mine';
        w.only_path = false;
        if (w.owes)
            w.alarm = setTimeout(() => give_up('stopped: it did not end within 3 s'), 3000);
    }
    function heard(w, all) {
        if (w.owes && !all)
            return watch(w);
        clearTimeout(w.alarm);
        w.owes = false;
    }
    function give_up(why) {
        mine = null;
        drawn_by = 'chapter';
        root.classList.remove('mine', 'old');
        hire(workers.length);
        root.dispatchEvent(new CustomEvent('mine-failed', {detail: why}));
        go();
    }

    /* ---- what is to be done ----------------------------------------------------------------- */

    /* Whatever happened: draw a draft, rest, or render what is missing. */
    function go() {
        const now = seconds(), task = ex.page_next(now);
        clearTimeout(timer);
        if (task === DRAFT) {
            ex.page_begin_anew();
            stop();
            run++;
            stale = true;
            painted = [0, 0];
            moved_at ||= performance.now();
            root.classList.add('moving');
            draft();
            timer = setTimeout(go, 155);
        } else if (task === REST) {
            timer = setTimeout(go, 1000 * (ex.page_rests() - now) + 5);
        } else if (visible && !document.hidden) {
            refine();
        }
        show_controls();
        if (ex.page_inspects())
            show_path();
    }
    function stop() {
        tell_all({do: 'stop'});
        asked_for = other_asked = 0;
    }
    /* What is to be seen, for the workers. */
    function wish_now() {
        ex.page_set_comparison(compares());
        return wish();
    }
    function draft() {
        const w = workers.find(worker => !worker.busy);
        dirty = !w;
        if (!w)
            return;
        w.busy = true;
        w.tell({do: 'draft', number: ++number, name: drawn_by, wish: wish_now()});
        watch(w);
    }
    function refine() {
        const samples = ex.page_samples(), anew = stale;
        dirty = false; /* a draft would end the job of its worker */
        if (anew) {
            run++;
            stale = false;
            results = [[], []];
            painted = [0, 0];
            asked_for = spent = 0;
            other_begun = false;
            finishing = finish_again = false;
            finished_samples = 0;
            finished_error = -1;
            chart.begin();
        }
        if (asked_for < samples) {
            asked_for = samples;
            other_asked = 0; /* its job ends */
            report.done = report.other_done = 0;
            not_done(0);
            started = performance.now() - spent;
            tell_all({do: 'refine', run, anew, name: drawn_by, other: 0, to_other: 0, samples, wish: wish_now()});
            workers.forEach(watch);
        } else if (report.done) {
            refine_other();
        }
    }
    function not_done(which) { results[which].filter(Boolean).forEach(r => { r.done = false; }); }
    /* The one to compare with: only when it is looked at, and the picture itself is done. */
    function refine_other() {
        const right = drawn_by === 'mine', looked_at = right || holding || divide > 0 ||
            (chapter.chart === 'error' && compares() === OTHER_NUMBERS);
        const samples = compares() === ONE_SAMPLE ? 1 : ex.page_samples();
        if (is_noisy() || !looked_at || other_asked >= samples)
            return;
        other_asked = samples;
        not_done(1);
        tell_all({do: 'refine', run, anew: !other_begun, name: 'chapter', other: right ? 0 : 1, to_other: 1, samples, wish: wish_now()});
        other_begun = true;
    }
    /* Something else than what is in the room has changed: all again. */
    function again() {
        moved_at = 0;
        stale = true;
        go();
    }
    function compares() {
        return drawn_by === 'mine' ? BY_RT_H : chapter.compare === NOISY && !ex.page_denoises() ? BEFORE : chapter.compare;
    }

    /* ---- what the workers say ---------------------------------------------------------------- */

    function listen(m, w) {
        if (m.failed !== undefined)
            return drawn_by === 'mine' ? give_up('crashed: ' + m.failed) : say(`${t('This picture cannot move here')}: ${m.failed}`);
        if (m.told !== undefined) {
            heard(w, w.only_path);
            return m.told === asked_paths ? show_told(m) : undefined;
        }
        heard(w, m.draft !== undefined || (m.done && m.run === run && m.other === 0));
        if (m.draft !== undefined)
            return show_draft(m, w);
        if (m.run !== run)
            return;
        if (m.collected)
            return finish(m);
        if (m.finished)
            return show_finished(m);
        const put = which => m.parts.forEach((part, i) => images[which].data.set(m.pixels[i], 4 * PART * part));
        put(is_noisy() ? 1 : m.other);
        if (is_noisy() && finished_samples === 0) /* nothing better yet */
            put(0);
        if (m.encoded)
            return paint(is_noisy() ? 1 : m.other);
        results[m.other][m.k] = m;
        show_result(m.other);
    }
    function is_noisy() { return compares() === NOISY; }
    function show_draft(m, w) {
        w.busy = false;
        ex.page_draft_took(m.took / 1000); /* if it came too late, too: the next is smaller */
        if (m.draft > latest && painted[0] === 0) { /* nothing better yet */
            latest = m.draft;
            const small = make('canvas', {width: m.width, height: m.height});
            small.getContext('2d').putImageData(new ImageData(m.pixels, m.width, m.height), 0, 0);
            context.imageSmoothingQuality = 'high';
            context.drawImage(small, 0, 0, W, H);
            root.classList.add('alive');
            report.first ||= performance.now() - begun;
            report.drafts.push(performance.now());
            if (moved_at)
                report.moves.push(performance.now() - moved_at);
            moved_at = 0;
            say_progress();
            if (ex.page_inspects())
                draw_cross();
        }
        if (dirty)
            draft();
    }
    /* Of all workers: samples that every pixel has, rays, and the error (see rt_image_error). */
    function sum_up(which) {
        const list = results[which].filter(Boolean), all = list.length === workers.length;
        const sum = value => list.reduce((a, r) => a + (value(r) ?? 0), 0), count = 3 * W * H;
        const noise = sum(r => r.samples > 1 ? r.squares * (r.samples - (r.samples >> 1)) / (r.samples >> 1) : Infinity);
        return {samples: all ? Math.min(...list.map(r => r.samples)) : 0, rays: sum(r => r.rays), done: all && list.every(r => r.done),
            busy: sum(r => r.busy) / 1000, error: noise > 0 ? Math.sqrt(noise / count) / (sum(r => r.sum) / count) : Infinity};
    }
    function show_result(which) {
        const s = sum_up(which), w = performance.now();
        if (s.samples < 1) /* it has holes, or parts of what was seen before */
            return;
        if (s.error < Infinity && (which === 0 || compares() === OTHER_NUMBERS))
            chart.error(which, s.samples, s.error);
        if (which === 0) {
            known_error = s.error;
            spent = w - started;
            ex.page_progress(s.samples, s.rays, spent / 1000);
            report.whole ||= w - begun;
            report.rate = s.rays / spent / 1000;
            report.per_worker = s.rays / s.busy / 1e6;
            if (moved_at)
                report.moves.push(w - moved_at);
            moved_at = 0;
            progress.value = s.samples / ex.page_samples();
            if (is_noisy() && !finishing && s.samples >= 2 && (s.done ? s.samples > finished_samples : s.samples >= 2 * finished_samples)) {
                finishing = true;
                collected = [];
                tell_all({do: 'collect', run});
            }
            say_progress();
        }
        if (which === 1 || is_noisy())
            root.classList.remove('moving'); /* the other one is of this view, too */
        if (!calm.matches || s.done || s.samples >= 2 * painted[which]) {
            painted[which] = s.samples;
            paint(which);
            if (is_noisy())
                paint(1);
        }
        if (s.done && which === 0) {
            if (!report.done) {
                chart.speed(report.rate);
                if (!is_noisy())
                    spoken.textContent = t('The picture is done.');
            }
            report.done ||= spent;
            refine_other();
        }
        if (s.done && which === 1)
            report.other_done = w;
    }
    /* Chapter 10: all parts to the first worker, which finishes the picture. */
    function finish(m) {
        collected[m.k] = m.collected;
        if (collected.filter(Boolean).length < workers.length)
            return;
        const s = sum_up(0), parts = collected.flat();
        workers[0].tell({do: 'finish', run, parts, samples: s.samples, last: s.done, wish: wish_now()},
            parts.flatMap(p => [p.pixels.buffer, p.half.buffer, p.guides.buffer]));
    }
    function show_finished(m) {
        finishing = false;
        if (m.finished.length === 0) /* it is not wanted any more */
            return;
        finished_samples = finish_again ? 0 : m.samples;
        finish_again = false;
        finished_error = m.error;
        report.finishing = m.took;
        images[0].data.set(m.finished);
        paint(0);
        say_progress();
        if (m.samples >= ex.page_samples() && m.error >= 0)
            spoken.textContent = t('The picture is done.');
        show_result(0);
    }
    const pending = [false, false];
    function paint(which) {
        if (pending[which])
            return;
        pending[which] = true;
        requestAnimationFrame(() => {
            pending[which] = false;
            if (ex.page_next(seconds()) === REST)
                return; /* it moves: the draft is newer */
            (which ? other_context : context).putImageData(images[which], 0, 0);
            root.classList.add('alive');
            if (which === 0 && ex.page_inspects())
                draw_cross();
        });
    }
    function say(words) { status.textContent = in_words(words); }
    function say_progress() {
        say(text(ex.page_say_progress(known_error, is_noisy() ? finished_samples : 0, Math.max(0, finished_error))));
    }

    /* ---- pointer and keys --------------------------------------------------------------------- */

    const spot = e => {
        const box = canvas.getBoundingClientRect();
        return [(e.clientX - box.left) * W / box.width, (e.clientY - box.top) * H / box.height, 4 * W / box.width];
    };
    let held = false;
    canvas.onpointerdown = e => {
        const [x, y, slack] = spot(e);
        if (e.button === 1 || !e.isPrimary)
            return;
        held = true;
        ex.page_press(x, y, e.button === 0 ? 1 : 2, slack);
        canvas.setPointerCapture(e.pointerId);
        go();
    };
    canvas.onpointermove = e => {
        const [x, y] = spot(e);
        if (!e.isPrimary)
            return;
        if (!held) {
            canvas.style.cursor = ex.page_pick(x, y) ? 'grab' : 'crosshair';
            return;
        }
        ex.page_move(x, y, e.shiftKey ? 1 : 0);
        go();
    };
    canvas.onpointerup = () => {
        if (held)
            ex.page_release();
        held = false;
        go();
    };
    canvas.onpointercancel = () => { /* the finger scrolls the page */
        ex.page_let_go();
        held = false;
    };
    canvas.oncontextmenu = e => e.preventDefault();
    canvas.addEventListener('touchstart', e => { /* a finger moves a thing; elsewhere it scrolls the page */
        const [x, y] = spot(e.touches[0]);
        if (ex.page_pick(x, y))
            e.preventDefault();
    }, {passive: false});
    canvas.addEventListener('wheel', e => { /* only when it was chosen: else the page scrolls */
        if (document.activeElement !== canvas)
            return;
        e.preventDefault();
        ex.page_tune(ex.page_pick(...spot(e)), -e.deltaY / 100);
        go();
    }, {passive: false});
    canvas.onkeydown = e => {
        if (e.ctrlKey && !e.getModifierState('AltGraph') || e.metaKey)
            return;
        const arrow = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[e.key];
        let key = e.key.length === 1 ? e.key.toLowerCase() : e.key;
        if (!'0123456789+-=[]'.includes(key) && /^Digit[0-9]$/.test(e.code)) /* a French keyboard */
            key = e.code[5];
        if (key === 'Escape' || key === 'i') {
            if (!ex.page_inspects())
                return;
            close_path();
        } else if (key === 'Enter') {
            look_at(W >> 1, H >> 1);
        } else if (arrow && e.shiftKey && ex.page_inspects()) {
            look_at(at.x + 4 * arrow[0], at.y - 4 * arrow[1]);
        } else if (arrow && thing > 0) {
            nudge(...arrow, e.shiftKey);
        } else if (key === 'b') {
            hold(true);
        } else if (key === 'g') {
            set_gamma(gamma_is === 1 ? 0 : 1);
        } else if (key === 'e' || key === 'w') {
            set_exposure(ex.page_exposure() + (key === 'e' ? 0.5 : -0.5));
        } else if (KEYS[key] || '0123456789,.dlmnpr[]+-='.includes(key)) {
            ex.page_key(KEYS[key] ?? key.charCodeAt(0));
            if (key === 'r')
                reset();
            stale ||= key === 'd' || key === 'p';
            go();
        } else {
            return;
        }
        e.preventDefault();
    };
    canvas.onkeyup = e => { if (e.key.toLowerCase() === 'b') hold(false); };
    canvas.onblur = () => { if (holding) hold(false); };
    function hold(on) {
        holding = on;
        root.style.setProperty('--divide', (on ? 100 : divide) + '%');
        root.classList.toggle('comparing', on || divide > 0);
        go();
    }
    function nudge(right, up, floor) { ex.page_nudge(thing, right, up, floor ? 1 : 0); go(); }
    /* The same picture, other bytes. While the reader's routine draws, it makes them. */
    function set_gamma(gamma) {
        gamma_is = drawn_by === 'mine' ? 0 : gamma;
        ex.page_set_gamma(gamma_is);
        encode_again();
    }
    function set_exposure(stops) {
        ex.page_set_exposure(drawn_by === 'mine' ? 0 : stops);
        encode_again();
    }
    function encode_again() { /* the same light, as other bytes */
        tell_all({do: 'encode', run, name: 'chapter', other: 0, to_other: 0, wish: wish_now()});
        if (other_begun && drawn_by !== 'mine')
            tell_all({do: 'encode', run, name: 'chapter', other: 1, to_other: 1, wish: wish_now()});
        if (is_noisy()) { /* to be finished once more */
            finish_again = finishing;
            finished_samples = 0;
            show_result(0);
        }
        show_controls();
    }
    function reset() {
        gamma_is = thing = 0;
        if (workers.length !== at_first && !alone)
            hire(at_first);
        set_divide(0);
    }
    function set_divide(to) {
        divide = to;
        hold(false);
    }

    /* ---- the path of a pixel ------------------------------------------------------------------- */

    const at = {x: 0, y: 0, sample: 0}, letter = 12;
    let asked_paths = 0, told = {words: ''};
    function look_at(x, y, sample = 0) {
        ex.page_inspect(Math.min(W - 1, Math.max(0, x)), Math.min(H - 1, Math.max(0, y)), sample);
        show_path();
        paint(0);
    }
    function close_path() {
        ex.page_key('i'.charCodeAt(0));
        root.classList.remove('inspecting');
        paint(0);
        canvas.focus();
    }
    function show_path() {
        Object.assign(at, {x: ex.page_x(), y: ex.page_y(), sample: ex.page_sample()});
        root.classList.add('inspecting');
        const boxes = plans.map(plan => plan.getBoundingClientRect());
        const wanted = {...at, letter, sizes: boxes.map(({width, height}) => [width || 150, height || 150])};
        asked_paths++;
        if (drawn_by !== 'mine')
            return show_told(path(wanted));
        const w = workers[0], also_renders = w.owes; /* it has the reader's code, whose path this is */
        w.tell({do: 'path', name: 'mine', number: asked_paths, wish: wish_now(), ...wanted});
        watch(w);
        w.only_path = !also_renders;
    }
    function show_told(answer) {
        told = answer;
        plans.forEach((plan, side) => draw_plan(plan, told.plans[side]));
        const [head, ...rows] = told.table.trim().split('\n');
        where.textContent = `pixel ${at.x},${at.y}, ${t('sample')} ${at.sample} = ${head.match(/= ([^,]*)/)[1]}`;
        said.replaceChildren(table_of(rows.map(row => row.split('\t'))));
        if (ex.page_next(seconds()) !== REST) /* the cross, too */
            paint(0);
    }
    /* Each cell begins with the digit of its kind, see demo.h. Columns that say nothing are left out. */
    function table_of([heads, ...rows]) {
        const says = heads.map((_, k) => rows.some(row => row[k]?.length > 1));
        const line = (row, kind, words) => make('tr', {}, ...row.flatMap((cell, k) => says[k] ? [make(k ? kind : 'td',
            {text: words(cell.slice(1)), class: cell[0] > 0 ? 'of-kind' : false, style: `--c: var(--kind-${cell[0]})`})] : []));
        return make('table', {}, make('thead', {}, line(heads, 'th', t)), make('tbody', {}, ...rows.map(row => line(row, 'td', x => x))));
    }
    function draw_plan(plan, {floats, kinds, labels}) {
        const box = plan.getBoundingClientRect(), density = devicePixelRatio || 1;
        const width = box.width || 150, height = box.height || 150;
        plan.width = width * density;
        plan.height = height * density;
        const c = plan.getContext('2d'), colours = getComputedStyle(root);
        c.scale(density, density);
        for (let i = 0; i < floats.length; i += 6) {
            c.strokeStyle = colours.getPropertyValue('--kind-' + kinds[i + 5]);
            c.lineWidth = floats[i + 4];
            c.setLineDash(kinds[i + 5] === 6 ? [4, 3] : []);
            c.beginPath();
            c.moveTo(floats[i], floats[i + 1]);
            c.lineTo(floats[i + 2], floats[i + 3]);
            c.stroke();
        }
        c.font = `${letter}px sans-serif`;
        c.textAlign = 'center';
        c.textBaseline = 'middle';
        for (const {name: english, x, y} of labels) {
            const name = t(english), half = c.measureText(name).width / 2 + 2;
            c.globalAlpha = 0.75;
            c.fillStyle = colours.getPropertyValue('--soft');
            c.fillRect(x - half, y - letter / 2, 2 * half, letter);
            c.globalAlpha = 1;
            c.fillStyle = colours.getPropertyValue('--text');
            c.fillText(name, x, y);
        }
    }
    function draw_cross() {
        context.strokeStyle = '#fff';
        context.lineWidth = 1;
        context.beginPath();
        for (const [x0, y0, x1, y1] of [[-9, 0, -3, 0], [3, 0, 9, 0], [0, -9, 0, -3], [0, 3, 0, 9]]) {
            context.moveTo(at.x + 0.5 + x0, at.y + 0.5 + y0);
            context.lineTo(at.x + 0.5 + x1, at.y + 0.5 + y1);
        }
        context.stroke();
    }

    /* ---- the elements ------------------------------------------------------------------------------ */

    function build() {
        const still = [...root.querySelectorAll('img')].at(-1), image = still.cloneNode(), alt = still.alt;
        const picture = make('canvas', {class: 'picture', width: W, height: H, tabindex: 0, role: 'application',
            'aria-label': `${alt}. Drag to move things. Enter shows the path of a pixel. Other keys: arrows, page up and down, digits, comma, period, plus, minus, b, r.`});
        const before = make('canvas', {class: 'other', width: W, height: H, 'aria-hidden': 'true'});
        const stage = make('div', {class: 'stage'}, image, picture, before, make('span', {class: 'line', 'aria-hidden': 'true'}),
            make('span', {class: 'whose yours', text: t('yours')}), make('span', {class: 'whose right', text: t('right one')}));
        const views = ['from above', 'from the side'].map(view => make('figure', {},
            make('canvas', {class: 'plan', role: 'img', 'aria-label': `${t('The path')}, ${t(view)}`}), make('figcaption', {text: t(view)})));
        const said = make('div', {class: 'words', tabindex: 0, role: 'region', 'aria-label': t('The path in words')}), where = make('span', {'aria-live': 'polite'});
        const button = (text, label, onclick) => make('button', {type: 'button', text, 'aria-label': label ?? false, onclick});
        const legend = make('p', {class: 'legend'}, ...[1, 2, 3, 4, 5, 6, 7, 8].map(kind =>
            make('span', {style: `--c: var(--kind-${kind})`, text: text_of_kind(kind)})));
        const part_two = () => [...legend.children].forEach((child, i) => { child.hidden = i >= 6 && ex.page_stage() <= 7; });
        const inspector = make('div', {class: 'inspector'}, make('div', {class: 'bar'}, where,
            button('−', t('previous sample'), () => look_at(at.x, at.y, Math.max(0, at.sample - 1))),
            button('+', t('next sample'), () => look_at(at.x, at.y, at.sample + 1)),
            button('×', t('close'), close_path)), make('div', {class: 'plans'}, ...views), legend, said);
        const progress = make('progress', {max: 1, value: 0, 'aria-label': t('samples')}), status = make('div', {class: 'status'});
        const spoken = make('div', {class: 'spoken', 'aria-live': 'polite'});
        const controls = {}, bar = make('div', {class: 'bar'}), chart = chart_of();

        const slider = (key, name, min, max, step, value, show, set) => {
            const input = make('input', {type: 'range', min, max, step}), output = make('output');
            input.oninput = () => set(+input.value);
            controls[key] = () => { input.value = value(); output.textContent = show(); };
            return make('label', {class: 'wide'}, t(name), ' ', input, output);
        };
        const box = (key, name, value, set) => {
            const input = make('input', {type: 'checkbox'});
            input.onchange = () => set(input.checked);
            controls[key] = () => { input.checked = value(); };
            return make('label', {}, input, t(name));
        };
        const known = {
            samples: () => slider('samples', 'samples', 0, 10, 1, () => Math.log2(ex.page_samples()), () => ex.page_samples(), to => {
                stale ||= 2 ** to < ex.page_samples();
                ex.page_set_samples(2 ** to);
                go();
            }),
            bounces: () => slider('bounces', 'bounces', 0, 10, 1, () => Math.min(10, ex.page_bounces()), () => ex.page_bounces(),
                to => { ex.page_set_bounces(to); go(); }),
            gamma: () => slider('gamma', 'gamma', 1, 3, 0.1, () => gamma_is || 2.2, () => (gamma_is || 2.2).toFixed(1), set_gamma),
            lanes: () => box('lanes', `4 ${t('rays at a time')}`, () => ex.page_lanes() > 1, () => { ex.page_key('p'.charCodeAt(0)); again(); }),
            workers: () => slider('workers', 'workers', 1, Math.min(8, navigator.hardwareConcurrency ?? 2), 1, () => workers.length, () => workers.length,
                to => { hire(to); again(); }),
            sampler: () => box('sampler', 'Sobol points', () => ex.page_sobol(), () => { ex.page_key('l'.charCodeAt(0)); go(); }),
            denoise: () => box('denoise', 'without noise', () => ex.page_denoises(), () => { ex.page_key('d'.charCodeAt(0)); again(); }),
            exposure: () => slider('exposure', 'exposure', -4, 4, 0.5, () => ex.page_exposure(), () => ex.page_exposure().toFixed(1), set_exposure),
            stages: () => stages_of(STAGES),
            all_stages: () => stages_of(ALL_STAGES),
        };
        const stages_of = stages => {
            const set = make('fieldset', {class: 'stages'}, make('legend', {class: 'spoken', text: t('as in chapter')}));
            const inputs = stages.map(stage => {
                const input = make('input', {type: 'radio', name: root.id + '-stage', value: stage, onchange: () => { ex.page_set_stage(stage); go(); }});
                set.append(make('label', {}, input, make('span', {}, `${ex.page_chapter(stage)} `, make('small', {text: t(text(ex.page_stage_name(stage)))}))));
                return input;
            });
            controls.stages = () => inputs.forEach((input, i) => { input.checked = stages[i] === ex.page_stage(); });
            return set;
        };
        for (const key of chapter.controls)
            bar.append(known[key]());
        const compare = make('span'), divider = make('input', {type: 'range', class: 'divide', min: 0, max: 100, value: 0, oninput: () => set_divide(+divider.value)});
        controls.compare = () => {
            divider.value = divide;
            compare.textContent = `${t('on the left')}: ${t(text(ex.page_comparison(compares())))}`;
        };
        const list = make('select', {onchange: () => { thing = +list.value; show_controls(); }}), things = THINGS.map((name, i) => make('option', {text: t(name), value: i}));
        let listed = 0;
        controls.thing = () => { /* those that the stage has */
            const stage = ex.page_stage();
            if (stage !== listed)
                list.replaceChildren(...things.filter((_, i) => i < 2 || (i === 2 && stage >= 6) || (i === 3 && stage >= 3 && stage < 13) || (i === 4 && stage >= 2) || (i === 5 && stage >= 8) || (i === 6 && stage >= 13) || (i === 7 && stage >= 14)));
            listed = stage;
            list.value = thing;
            thing = +list.value;
            const words = thing ? text(ex.page_thing(thing)).split(', ')[1] : '';
            tuned.textContent = words ? `${t(words.replace(/ [^ ]+$/, ''))} ${words.match(/[^ ]+$/)[0]}` : '';
            [...pad.children].slice(4).forEach((child, i) => child.setAttribute('aria-label', t(words ? ['more', 'less'][i] : ['nearer', 'farther'][i])));
            part_two();
        };
        const pad = make('span', {class: 'pad'}, ...[['←', 'left', -1, 0], ['↑', 'up', 0, 1], ['↓', 'down', 0, -1], ['→', 'right', 1, 0]].map(
            ([sign, name, x, y]) => button(sign, t(name), () => nudge(x, y))),
            button('+', t('nearer'), () => { ex.page_tune(thing, 1); go(); }), button('−', t('farther'), () => { ex.page_tune(thing, -1); go(); }));
        const tuned = make('output', {class: 'tuned'});
        const move = make('div', {class: 'bar'}, make('label', {}, t('move') + ' ', list), pad, tuned,
            button(t('reset everything'), null, () => { ex.page_key('r'.charCodeAt(0)); reset(); go(); }));
        [...root.children].forEach(child => { child.hidden = true; child.classList.add('still'); });
        root.append(make('div', {class: 'panes'}, stage, inspector), progress, status, spoken,
            make('div', {class: 'bar dividing'}, make('label', {class: 'wide'}, compare, ' ', divider)), bar, chart.element, move);
        return {canvas: picture, other: before, status, spoken, progress, plans: views.map(view => view.firstChild), said, where, controls, chart};
    }
    function text_of_kind(kind) { return t(text(ex.page_kind(kind))); }
    function chart_of() {
        const none = () => {};
        if (chapter.chart === 'error')
            return error_chart(() => compares() !== OTHER_NUMBERS ? [] : ex.page_sobol() ? ['Sobol', t('random')] : [t('random'), 'Sobol']);
        if (chapter.chart === 'speed')
            return speed_chart(() => `${ex.page_lanes()} ${t(ex.page_lanes() > 1 ? 'rays at a time' : 'ray at a time')}, ${workers.length} ${t(workers.length > 1 ? 'workers' : 'worker')}`);
        return {element: '', begin: none, error: none, speed: none};
    }
    function show_controls() { Object.values(controls).forEach(show => show()); }

    /* ---- from here on it lives ------------------------------------------------------------------------ */

    /* The reader's own routine: the picture by it, beside the right one. */
    root.addEventListener('mine', e => {
        if (alone) /* nobody could end it */
            return;
        mine = e.detail.bytes;
        drawn_by = 'mine';
        root.classList.add('mine');
        root.classList.remove('old');
        if (workers.some(w => w.owes)) /* an answer to older code, perhaps for ever */
            hire(workers.length);
        else
            tell_all({do: 'module', name: 'mine', bytes: mine});
        set_gamma(0);
        set_divide(0);
        move_to_editor();
        again();
    });
    /* What is typed now does not compile, or would crash: the picture is of what was typed before. */
    root.addEventListener('mine-old', () => root.classList.toggle('old', drawn_by === 'mine'));
    /* There it is in sight while its routine is written. */
    function move_to_editor() {
        const editor = document.querySelector(`.edit[data-live="${root.id}"]`);
        if (!editor || root.nextElementSibling === editor)
            return;
        const top = editor.getBoundingClientRect().top;
        editor.id ||= root.id + '-editor';
        root.before(make('p', {}, make('a', {href: '#' + editor.id, text: t('The picture is now beside the editor.')})));
        editor.before(root);
        scrollBy(0, editor.getBoundingClientRect().top - top);
    }
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { if (ex.page_inspects()) show_path(); });
    addEventListener('resize', () => { if (ex.page_inspects()) show_path(); });
    document.addEventListener('visibilitychange', () => {
        if (document.hidden)
            stop();
        workers.forEach(w => heard(w, document.hidden));
        go();
    });
    new IntersectionObserver(entries => {
        visible = entries.at(-1).isIntersecting;
        go();
    }, {rootMargin: '200px'}).observe(root);
    Object.assign(report, {ex, text, images, say_path: () => told.words, opened: performance.now() - begun});
    root.live = report;
}

/* Begin: the module of a chapter came from a script of its own, so that file:// works, too. */
const modules = window.rt_live ?? {};
for (const root of document.querySelectorAll('.live[data-demo]')) {
    const name = root.dataset.demo;
    if (modules[name])
        bring_to_life(root, name, modules[name]).catch(error => {
            for (const child of [...root.children])
                child.classList.contains('still') || !root.querySelector(':scope > .still') ? child.hidden = false : child.remove();
            root.append(make('p', {class: 'status', text: `${t('This picture cannot move here')}: ${error.message}`}));
        });
}
