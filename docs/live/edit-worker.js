// The C compiler in the page, and the judge: takes a text, compiles it together with
// tests/classroom/pupil_page.c, has it asked (edit-run.js) and judged (grade_page.c).
import { instantiate, text } from './wasi.js';

const SECONDS = 3; // for a kind of input, as in tests/classroom/grade.c
const LARGEST = 1 << 20; // bytes of a file, as there
const SHOWN = 4000; // letters of what the student's routines print
const STEP = 2e6; // bytes: so often it says how much has come
const STORE = 'rt.h: C compiler';

/* global VERSION */ // of the compiler: put here by build-edit.sh
const server = self.fetch.bind(self);
const here = name => new URL(name, import.meta.url).href;
let loaded = 0;

// ---- the compiler's files: from the browser's cache, or from the server ---------------

// On a page that is neither https nor localhost there is no cache.
async function store() {
    const kept = await self.caches?.open(STORE).catch(() => undefined);
    for (const request of await kept?.keys() ?? [])
        if (!request.url.endsWith(`?${VERSION}`))
            await kept.delete(request);
    return kept;
}

async function part(name, type) {
    const kept = await storing, url = here(`${name}?${VERSION}`);
    let response = await kept?.match(url);
    if (!response) {
        response = await server(url);
        if (!response.ok)
            throw new Error(`${name}: the server says ${response.status}`);
        kept?.put(url, response.clone()).catch(() => { }); // no room: it comes again
    }
    const count = new TransformStream({
        transform(chunk, out) {
            if (Math.floor(loaded / STEP) < Math.floor((loaded += chunk.length) / STEP))
                postMessage({ loaded });
            out.enqueue(chunk);
        },
    });
    let body = response.body.pipeThrough(count);
    if (name.endsWith('.bin')) // packed with gzip; not called .gz, for which servers do more
        body = body.pipeThrough(new DecompressionStream('gzip'));
    return new Response(body, { headers: { 'content-type': type } });
}

// @yowasp/clang asks for its files next to this one: they are there, but packed.
self.fetch = request => {
    const name = new URL(request).pathname.split('/').pop();
    return name === 'llvm.core.wasm' ? part('clang.bin', 'application/wasm')
        : name === 'llvm-resources.tar' ? part('libc.bin', 'application/x-tar')
            : part(name, 'application/wasm');
};

async function bytes(name) {
    const response = await server(here(name));
    if (!response.ok)
        throw new Error(`${name}: the server says ${response.status}`);
    return new Uint8Array(await response.arrayBuffer());
}

let llvm, project, judge, told = '';
const storing = store();
const opening = (async () => {
    const { runLLVM } = await import('@yowasp/clang');
    llvm = runLLVM;
    project = JSON.parse(new TextDecoder().decode(await bytes('edit-files.json')));
    project.linked = await Promise.all(project.objects.map(bytes));
    const module = await WebAssembly.compile(await bytes('grade.wasm'));
    judge = instantiate(module, said => { told += new TextDecoder().decode(said); });
    await llvm(null, {}, { fetchProgress: () => { } });
    postMessage({ ready: true });
    return true;
})().catch(error => postMessage({ broken: `The compiler could not be loaded: ${error.message}` }));

// ---- compiling ------------------------------------------------------------------------

// { "a/b.h": text } as folders in folders.
function tree(files) {
    const root = {};
    for (const [path, content] of Object.entries(files)) {
        const names = path.split('/'), last = names.pop();
        let folder = root;
        for (const name of names)
            folder = folder[name] ??= {};
        folder[last] = content;
    }
    return root;
}

// Run one of LLVM's programs: { files, said, printed }, files undefined if it failed.
function run(args, files) {
    const decoder = new TextDecoder(), printed = [];
    let said = '';
    try {
        files = llvm(args, files, {
            stdout: bytes => { if (bytes) printed.push(bytes.slice()); },
            stderr: bytes => { said += bytes ? decoder.decode(bytes, { stream: true }) : ''; },
            synchronously: true, decodeASCII: false,
        });
        return { files, said, printed };
    } catch (error) { // it failed; or its own end: out of memory, or a mistake of its
        return { said: error.code !== undefined ? said
            : `${said}\nerror: the compiler gave up: ${error.message}` };
    }
}

function join(pieces) {
    const all = new Uint8Array(pieces.reduce((sum, { length }) => sum + length, 0));
    let at = 0;
    for (const piece of pieces) {
        all.set(piece, at);
        at += piece.length;
    }
    return all;
}

// What the compiler says, as a list; line is 0 if it is about no line of the file.
function messages(said, name) {
    const list = [];
    for (const line of said.split('\n')) {
        const at = /^(.+?):(\d+):(\d+): (?:fatal )?(error|warning|note): (.*)$/.exec(line);
        const bare = /^(?:(?:clang|wasm-ld): )?(error|warning): (?:\S+\.o: )?(.*)$/.exec(line);
        if (at) {
            const file = at[1].replace(/^\.\//, ''), own = file === name;
            list.push({
                file, line: own ? +at[2] : 0, column: +at[3], kind: at[4],
                text: own ? at[5] : `${file}, line ${at[2]}: ${at[5]}`,
            });
        } else if (bare) {
            list.push({ file: '', line: 0, column: 0, kind: bare[1], text: bare[2] });
        }
    }
    return list;
}

// Natively: cc -std=c99 -O1 -ffp-contract=off -Wall, by grade.c. Here clang prints the object:
// in a file it would change thousands of places, and this file system copies the whole file each time.
function compile(code, name) {
    const size = new TextEncoder().encode(code).length;
    if (size === 0 || size > LARGEST)
        return { said: size === 0 ? 'empty' : 'larger than a megabyte', list: [] };
    const made = run(['clang', ...project.flags, `-DSUBMISSION="${name}"`,
        '-c', 'all.c', '-o', '-'],
        tree({
            ...project.files, [name]: code,
            'all.c': `#include "${project.source}"\n#include "replaces.h"\n`,
        }));
    let list = messages(made.said, name);
    if (!made.files) {
        const others = list.filter(m => m.kind === 'error' && m.file !== 'replaces.h');
        return others.length === 0 && list.length > 0 ? {
            said: '#define rt_... must come before #include "rt.h", and name a function of yours',
            list: list.filter(m => m.line > 0),
        } : { said: 'does not compile', list };
    }
    const objects = {};
    project.linked.forEach((object, i) => { objects[`${i}.o`] = object; });
    const linked = run(['wasm-ld', ...project.link, 'all.o', ...Object.keys(objects),
        ...project.libraries, '-o', 'all.wasm'], { ...objects, 'all.o': join(made.printed) });
    list = [...list, ...messages(linked.said, name)];
    if (!linked.files)
        return { said: 'does not compile', list };
    return { list, bytes: linked.files['all.wasm'] };
}

// ---- asking and judging ---------------------------------------------------------------

// The worker with the student's module; runner.wasm is that. It is kept for the next
// text, and ended only when it does not answer: to start one takes time.
let runner, waiting; // who waits for its next answer

function stop(result) {
    runner?.terminate();
    runner = undefined;
    waiting?.(result);
}

// Its answer to a message; { why } if there is none within so many seconds.
function ask(message, seconds, heard) {
    return new Promise(resolve => {
        const late = setTimeout(() => stop({ why: `no end within ${seconds} seconds` }),
            1000 * seconds);
        waiting = result => {
            clearTimeout(late);
            waiting = undefined;
            resolve(result);
        };
        runner.onmessage = ({ data }) => data.said ? heard(data.said) : waiting?.(data);
        runner.onerror = event => {
            event.preventDefault();
            stop({ why: `it crashed: ${event.message}` });
        };
        runner.postMessage(message);
    });
}

// Give it the module: no student's time. Some browsers now and then lose a worker that
// starts.
async function start(wasm, stale) {
    for (const seconds of [1, 4, 16]) {
        runner ??= new Worker(here('edit-run.js'));
        const { ready } = await ask({ bytes: wasm }, seconds, () => { });
        if (stale())
            return;
        if (ready) {
            runner.wasm = wasm;
            return;
        }
        stop();
    }
    throw new Error('the browser cannot start a worker');
}

// The verdict about one kind of input is printed; undefined if meanwhile there is a newer
// text.
async function judgeKind(wasm, kind, routine, heard, stale) {
    if (runner?.wasm !== wasm)
        await start(wasm, stale);
    if (stale())
        return undefined;
    const count = judge.page_ask(kind, 0), ins = judge.page_ins(), outs = judge.page_outs();
    const inputs = new Float32Array(judge.memory.buffer, judge.page_inputs(), count * ins).slice();
    const got = await ask({ routine, count, ins, outs, inputs }, SECONDS, heard);
    if (stale())
        return undefined;
    if (got.answers) {
        new Float32Array(judge.memory.buffer, judge.page_answers(), got.answers.length)
            .set(got.answers);
    } else {
        const why = new TextEncoder().encode(got.why).subarray(0, judge.page_why_size() - 1);
        const to = new Uint8Array(judge.memory.buffer, judge.page_why(), why.length + 1);
        to.set(why);
        to[why.length] = 0;
    }
    return { more: judge.page_judge(got.answers ? 1 : 0), ...got };
}

// All that the module replaces; undefined, too, if there is a newer text.
async function judgeAll(wasm, names, stale) {
    const result = { marks: [], dangerous: false, printed: 0, output: '' };
    const decoder = new TextDecoder();
    const heard = said => {
        if (result.output.length < SHOWN)
            result.output += decoder.decode(said, { stream: true });
    };
    told = '';
    if (waiting) // it is busy with an older text
        stop({});
    for (let i = 0; i < judge.page_routines(); i++) {
        const name = text(judge, judge.page_name(i));
        if (!names.includes(name))
            continue;
        judge.page_begin(i);
        for (let k = 0, more = true; more && k < judge.page_kinds(); k++) {
            if (!judge.page_is_of(k, i))
                continue;
            const got = await judgeKind(wasm, k, name, heard, stale);
            if (!got)
                return undefined;
            postMessage({ alive: true });
            result.dangerous ||= !got.answers;
            result.printed += got.printed ?? 0;
            more = got.more;
        }
        result.marks.push({
            routine: name, chapter: judge.page_chapter(i),
            good: judge.page_end(), all: judge.page_all(),
        });
    }
    return { ...result, verdict: told };
}

let turn = 0;

// Each answer has the number of its question.
async function attempt({ number, code, name }) {
    const mine = ++turn, stale = () => mine !== turn;
    if (!await opening)
        return;
    await new Promise(resolve => setTimeout(resolve)); // is there a newer text already?
    if (stale())
        return;
    postMessage({ number, begun: true });
    const from = performance.now();
    const { bytes, said, list } = compile(code, name);
    const times = { compile: performance.now() - from };
    if (!bytes)
        return postMessage({ number, said, list, times });
    const names = WebAssembly.Module.exports(new WebAssembly.Module(bytes))
        .map(({ name }) => name).filter(name => name.startsWith('answer_'))
        .map(name => name.slice(7));
    if (names.length === 0)
        return postMessage({
            number, list, times,
            said: 'replaces nothing: there is no line like #define rt_reflect my_reflect',
        });
    postMessage({ number, list, times, names, judging: true });
    const result = await judgeAll(bytes, names, stale);
    if (!result)
        return;
    postMessage({ ...result, number, list, times, names, bytes }, [bytes.buffer]);
}

onmessage = ({ data }) => attempt(data).catch(error =>
    postMessage({ number: data.number, broken: `The judge stopped: ${error.message}` }));
