/* An instance of a demo's module, as the page and each of its workers has one; and what a worker does.
 * The worker gets both functions as text: see hire in live.js. */

/* ---- an instance of a module: in the page and in each worker -------------------------- */

/* The functions that a C library wants of its system: time, and text to print. */
function open(module, width, height) {
    const imports = {};
    let ex;
    for (const {module: from, name} of WebAssembly.Module.imports(module))
        (imports[from] ??= {})[name] = () => 0;
    const system = imports.wasi_snapshot_preview1 ?? {};
    system.clock_time_get = (id, precision, at) => {
        const now = BigInt(Math.round(1e6 * (performance.timeOrigin + performance.now())));
        new DataView(ex.memory.buffer).setBigUint64(at, now, true);
        return 0;
    };
    system.fd_write = (file, list, count, written) => {
        const memory = new DataView(ex.memory.buffer);
        let all = 0;
        for (let i = 0; i < count; i++) /* the editor shows what is printed */
            all += memory.getUint32(list + 8 * i + 4, true);
        memory.setUint32(written, all, true);
        return 0;
    };
    system.proc_exit = status => { throw new Error(`exit ${status}`); };
    ex = new WebAssembly.Instance(module, imports).exports;
    ex._initialize();
    if (ex.page_start(width, height) !== 0)
        throw new Error('not enough memory');
    const bytes = (at, size) => new Uint8Array(ex.memory.buffer, at, size);
    const text = at => { const m = bytes(at); return new TextDecoder().decode(m.subarray(0, m.indexOf(0))); };
    return {
        ex, bytes, text,
        /* The path of a sample: plans of these sizes, from above and from the side; its table; and its words. */
        path({x, y, sample, letter, sizes}) {
            ex.page_inspect(x, y, sample);
            const plans = sizes.map(([width, height], side) => {
                const count = ex.page_plan(width, height, letter, side), lines = bytes(ex.page_lines(), 24 * count).slice().buffer;
                const labels = Array.from({length: ex.page_labels()}, (_, i) => ({name: text(ex.page_label(i)), x: ex.page_label_x(i), y: ex.page_label_y(i)}));
                return {floats: new Float32Array(lines), kinds: new Int32Array(lines), labels};
            });
            return {plans, table: text(ex.page_table()), words: text(ex.page_explain())};
        },
        wish() { const at = ex.page_wish(); return bytes(at, ex.page_wish_size()).slice(); },
        obey(wish) { const at = ex.page_wish(); bytes(at, wish.length).set(wish); ex.page_obey(); },
    };
}

/* ---- what a worker does: answers messages by post ------------------------------------- */

function work(post) {
    const PART = 4096, SLICE = 12, SHOW = 33; /* pixels, as in page.c; milliseconds */
    const instances = {}, targets = {};
    const channel = new MessageChannel(); /* to come back after other messages were heard */
    let k, n, width, height, job = null, shown = 0, waiting = false;

    const size = part => Math.min(PART, width * height - part * PART);
    const own = () => { const list = []; for (let p = k; p * PART < width * height; p += n) list.push(p); return list; };
    const target = (name, other) => targets[name + other] ??= {samples: 0, next: 0, dirty: new Map(), rays: 0, squares: 0, sum: 0};

    function send(done) {
        const t = target(job.name, job.other), list = [...t.dirty];
        shown = performance.now();
        post({k, run: job.run, other: job.to_other, samples: t.samples, rays: t.rays, squares: t.squares, sum: t.sum, done,
            busy: job.busy, parts: list.map(p => p[0]), pixels: list.map(p => p[1])}, list.map(p => p[1].buffer));
        t.dirty.clear();
    }
    function proceed() {
        waiting = false;
        if (!job)
            return;
        const {ex, bytes} = instances[job.name], t = target(job.name, job.other), list = own();
        const start = performance.now();
        while (t.samples < job.samples && performance.now() - start < SLICE) {
            const part = list[t.next], at = ex.page_refine(part, job.other);
            if (!at)
                throw new Error('not enough memory');
            t.dirty.set(part, bytes(at, 4 * size(part)).slice());
            if (++t.next === list.length) {
                t.next = t.rays = t.squares = t.sum = 0;
                t.samples++;
                for (const p of list) {
                    t.rays += ex.page_rays(p, job.other);
                    t.squares += ex.page_squares(p, job.other);
                    t.sum += ex.page_sum(p, job.other);
                }
            }
        }
        job.busy += performance.now() - start;
        if (t.samples >= job.samples) {
            send(true);
            job = null;
        } else {
            if (performance.now() - shown > SHOW)
                send(false);
            wait();
        }
    }
    function wait() {
        if (!waiting)
            channel.port2.postMessage(0);
        waiting = true;
    }
    const answer = {
        start(m) { ({k, n, width, height} = m); },
        module(m) {
            instances[m.name] = open(new WebAssembly.Module(m.bytes), width, height);
            for (const key of Object.keys(targets).filter(key => key.startsWith(m.name)))
                delete targets[key];
        },
        draft(m) { /* what is being refined is void: something moved */
            const {ex, bytes, obey} = instances[m.name], start = performance.now();
            job = null;
            obey(m.wish);
            const at = ex.page_draft(), w = ex.page_draft_width(), h = ex.page_draft_height();
            const pixels = new Uint8ClampedArray(bytes(at, 4 * w * h));
            post({k, draft: m.number, width: w, height: h, pixels, took: performance.now() - start}, [pixels.buffer]);
        },
        refine(m) {
            const {ex, obey} = instances[m.name], t = target(m.name, m.other);
            obey(m.wish);
            if (m.anew) {
                own().forEach(part => ex.page_forget(part, m.other));
                Object.assign(t, {samples: 0, next: 0});
                t.dirty.clear();
            }
            job = {...m, busy: 0};
            wait();
        },
        encode(m) { /* the same picture, other bytes */
            const {ex, bytes, obey} = instances[m.name], list = own();
            obey(m.wish);
            const pixels = list.map(part => bytes(ex.page_encode(part, m.other), 4 * size(part)).slice());
            post({k, run: m.run, encoded: true, other: m.to_other, parts: list, pixels}, pixels.map(p => p.buffer));
        },
        collect(m) { /* all that is known about our parts */
            const {ex, bytes} = instances.chapter, g = ex.page_guide_size();
            const parts = own().map(part => ({part,
                pixels: bytes(ex.page_pixels(part), 12 * size(part)).slice(), half: bytes(ex.page_half(part), 12 * size(part)).slice(),
                guides: bytes(ex.page_guides(part), g * size(part)).slice()}));
            post({k, run: m.run, collected: parts}, parts.flatMap(p => [p.pixels.buffer, p.half.buffer, p.guides.buffer]));
        },
        finish(m) { /* the parts of all workers, without their noise */
            const {ex, bytes, obey} = instances.chapter, g = ex.page_guide_size();
            obey(m.wish);
            const to = {pixels: ex.page_pixels(-1), half: ex.page_half(-1), guides: ex.page_guides(-1)};
            for (const p of m.parts) {
                bytes(to.pixels + 12 * PART * p.part, p.pixels.length).set(p.pixels);
                bytes(to.half + 12 * PART * p.part, p.half.length).set(p.half);
                bytes(to.guides + g * PART * p.part, p.guides.length).set(p.guides);
            }
            const start = performance.now(), at = ex.page_finish(m.samples), took = performance.now() - start;
            const pixels = new Uint8ClampedArray(bytes(at, at ? 4 * width * height : 0)); /* none: it is not wanted any more */
            post({k, run: m.run, finished: pixels, samples: m.samples, took, error: at && m.last ? ex.page_finished_error() : -1}, [pixels.buffer]);
        },
        path(m) {
            const {path, obey} = instances[m.name];
            obey(m.wish);
            post({k, told: m.number, ...path(m)});
        },
        stop() { job = null; },
    };
    channel.port1.onmessage = () => guard(proceed);
    function guard(f, m) {
        try {
            f(m);
        } catch (error) {
            job = null;
            post({k, failed: String(error.message ?? error)});
        }
    }
    return m => guard(answer[m.do], m);
}
