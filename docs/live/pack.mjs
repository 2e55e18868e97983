// What the compiler in the page is given, as one file: node pack.mjs SOURCE FILES...
// <replaces.h prints it; the environment has FLAGS and OBJECTS (names). See
// build-edit.sh.
import { readFileSync } from 'node:fs';

const words = text => (text ?? '').split(/\s+/).filter(Boolean);
const [source, ...paths] = process.argv.slice(2);

// In the compiler's file system ".." goes nowhere, and -I. finds all of ours.
const plain = text => text.replace(/^(\s*#\s*include\s*")(?:\.\.\/)+/gm, '$1');
const files = { 'replaces.h': readFileSync(0, 'utf8') };
for (const path of paths)
    files[path] = plain(readFileSync(path, 'utf8'));

const library = '/usr/lib/wasm32-wasip1';
console.log(JSON.stringify({
    source, files, objects: words(process.env.OBJECTS),
    flags: [
        '--target=wasm32-wasip1', '-std=c99', '-O1', '-ffp-contract=off', '-Wall', '-I.',
        // a module has memory at address 0, too: whoever uses NULL is to crash, as
        // natively
        '-fsanitize=null', '-fsanitize-trap=null', '-fno-caret-diagnostics', ...words(process.env.FLAGS),
    ],
    // Natively memory ends at 1 GB, and the stack at 8 MB; a page has less to give away.
    // The stack comes first, so that who leaves it leaves the memory, and does not write
    // on data.
    link: [
        '-m', 'wasm32', `-L${library}`, `${library}/crt1-reactor.o`, '--entry', '_initialize',
        '--strip-all', '-z', 'stack-size=8388608', '--stack-first', '--max-memory=268435456',
        '--wrap=malloc', '--wrap=calloc', '--wrap=realloc', // see pupil_page.c
    ],
    libraries: ['-lc', '/usr/lib/wasm32-unknown-wasip1/libclang_rt.builtins.a'],
}));
