// The system that a WebAssembly module of C meets here: it may compute, ask for the time
// and print. For files, other programs and the network it is ended, as in
// tests/classroom/sandbox.h. What the C library does not have here (fork, kill, getppid,
// signal.h) does not compile; the marks are the same.

export class Ended extends Error {} // the message says why

const GOOD = 0, NO_SUCH_CHANNEL = 8, CANNOT_SEEK = 70, TERMINAL = 2, FOLDER = 3;

// say(bytes) gets what is printed.
export function instantiate(module, say) {
    let memory;
    const view = () => new DataView(memory.buffer); // anew: memory may have grown
    const none = (count, size) => {
        view().setUint32(count, 0, true);
        view().setUint32(size, 0, true);
        return GOOD;
    };
    const system = {
        args_sizes_get: none,
        environ_sizes_get: none,
        args_get: () => GOOD,
        environ_get: () => GOOD,
        sched_yield: () => GOOD,
        clock_res_get(clock, at) {
            view().setBigUint64(at, 1000000n, true);
            return GOOD;
        },
        clock_time_get(clock, precision, at) {
            const ms = clock === 0 ? Date.now() : performance.now();
            view().setBigUint64(at, BigInt(Math.round(ms * 1e6)), true);
            return GOOD;
        },
        random_get(at, size) {
            for (let i = 0; i < size; i += 65536)
                crypto.getRandomValues(
                    new Uint8Array(memory.buffer, at + i, Math.min(size - i, 65536)));
            return GOOD;
        },
        fd_fdstat_get(channel, at) {
            if (channel > 3)
                return NO_SUCH_CHANNEL;
            const bytes = new Uint8Array(memory.buffer, at, 24);
            bytes.fill(0);
            bytes[0] = channel === 3 ? FOLDER : TERMINAL;
            bytes.fill(channel === 3 ? 255 : 0, 8); // all rights, or none
            return GOOD;
        },
        fd_write(channel, list, count, at) {
            if (channel !== 1 && channel !== 2)
                return NO_SUCH_CHANNEL;
            let written = 0;
            for (let i = 0; i < count; i++) {
                const from = view().getUint32(list + 8 * i, true);
                const size = view().getUint32(list + 8 * i + 4, true);
                say(new Uint8Array(memory.buffer, from, size));
                written += size;
            }
            view().setUint32(at, written, true);
            return GOOD;
        },
        fd_read(channel, list, count, at) { // nothing to read
            view().setUint32(at, 0, true);
            return channel === 0 ? GOOD : NO_SUCH_CHANNEL;
        },
        fd_seek: () => CANNOT_SEEK,
        fd_close: () => GOOD,
        // There is one folder, "/", on channel 3: without any, the C library would answer
        // by itself that a file is not there, and nobody would know that it was asked.
        fd_prestat_get(channel, at) {
            if (channel !== 3)
                return NO_SUCH_CHANNEL;
            view().setUint32(at, 0, true);
            view().setUint32(at + 4, 1, true);
            return GOOD;
        },
        fd_prestat_dir_name(channel, at) {
            view().setUint8(at, 47);
            return GOOD;
        },
        proc_exit(status) {
            throw new Ended(`it ended by itself, with status ${status}`);
        },
    };
    const refuse = () => {
        throw new Ended('ended by the system: it wanted more than to compute (files, ' +
            'other programs, the network ...)');
    };
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
        imports[from] ??= {};
        imports[from][name] = from !== 'wasi_snapshot_preview1' ? () => 0 // the picture's
            : system[name] ?? refuse;
    }
    const instance = new WebAssembly.Instance(module, imports);
    memory = instance.exports.memory;
    instance.exports._initialize?.();
    return instance.exports;
}

// A text of C's, from address at.
export function text(exports, at) {
    const bytes = new Uint8Array(exports.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}
