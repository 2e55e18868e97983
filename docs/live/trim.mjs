// Of the files that come with the compiler those that C for WebAssembly needs, 2 of 30
// MB: node trim.mjs ALL.tar PART.tar. Both are: a block of 512 bytes for each file's name
// and size, then the file in whole blocks.
import { readFileSync, writeFileSync } from 'node:fs';

const wanted = [
    /^(include|lib)$/, /^include\/wasm32-wasip1(?!\/c\+\+)/, // the C library
    // clang's own
    /^include\/(__)?(std|float|limits|iso646|inttypes|tgmath|wasm_simd128)\w*\.h$/,
    /^lib\/wasm32-wasip1(\/libc\.a|\/crt1-reactor\.o)?$/,
    /^lib\/wasm32-unknown-wasip1(\/libclang_rt\.builtins\.a)?$/,
];
const all = readFileSync(process.argv[2]);
const kept = [];
for (let at = 0; at + 512 <= all.length && all[at] !== 0;) {
    const text = (from, size) => all.toString('latin1', at + from, at + from + size).split('\0')[0];
    const size = parseInt(text(124, 12), 8) || 0;
    const end = at + 512 + 512 * Math.ceil(size / 512);
    if (wanted.some(pattern => pattern.test(text(0, 100))))
        kept.push(all.subarray(at, end));
    at = end;
}
writeFileSync(process.argv[3], Buffer.concat([...kept, Buffer.alloc(1024)]));
