// Asks a student's module, tests/classroom/pupil_page.c, in a worker of its own: who
// waits for the answers (edit-worker.js) ends the worker if they do not come.
import { Ended, instantiate } from './wasi.js';

const SHOWN = 4000; // bytes of what a kind of input prints

let module;

// Why it stopped, in the words of tests/classroom/sandbox.h.
function reason(error) {
    if (error instanceof Ended)
        return error.message;
    const words = error.message; // each browser has its own
    if (/call stack|recursion/i.test(words))
        return 'it crashed: the stack is full (does a function call itself without end?)';
    if (/out of bounds/i.test(words))
        return 'it crashed: it read or wrote outside its memory';
    if (/unreachable/i.test(words))
        return 'it crashed: it reached a place that it must not reach (NULL, abort, assert, no return)';
    return `it crashed: ${words}`;
}

function ask({ routine, count, ins, outs, inputs }) {
    let printed = 0;
    const say = bytes => {
        const room = SHOWN - printed;
        if (room > 0)
            postMessage({ said: bytes.slice(0, room) });
        printed += bytes.length;
    };
    try {
        const pupil = instantiate(module, say); // a new one, with no memory of the last
        const at = pupil.pupil_inputs(count * ins, count * outs);
        new Float32Array(pupil.memory.buffer, at, inputs.length).set(inputs);
        const from = pupil[`answer_${routine}`](count, ins, outs);
        const answers = new Float32Array(pupil.memory.buffer, from, count * outs).slice();
        return { answers, printed };
    } catch (error) {
        return { why: reason(error), printed };
    }
}

onmessage = ({ data }) => {
    if (data.bytes) {
        module = new WebAssembly.Module(data.bytes);
        postMessage({ ready: true });
    } else {
        postMessage(ask(data));
    }
};
