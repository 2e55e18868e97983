// The editor in a page, and what the compiler and the judge say below it.
import { defaultKeymap, history, historyKeymap, indentWithTab } from '@codemirror/commands';
import { cpp } from '@codemirror/lang-cpp';
import { bracketMatching, indentOnInput, indentUnit, syntaxHighlighting } from '@codemirror/language';
import { lintGutter, setDiagnostics } from '@codemirror/lint';
import { EditorState } from '@codemirror/state';
import {
    drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers,
} from '@codemirror/view';
import { classHighlighter } from '@lezer/highlight';
import { element } from './element.js';
import starters from 'starters'; // { rt_hit_sphere: text }, from tests/classroom/starter

const PAUSE = 600; // ms after the last key, then it is compiled
const LONGEST = 30000; // ms for compiling: some C can keep a compiler busy for ever

/* global MEGABYTES */ // what the compiler weighs: put here by build-edit.sh

// ---- what the reader has typed is kept ------------------------------------------------

const place = routine => `rt.h: ${routine}`;

function kept(routine) {
    try {
        return localStorage.getItem(place(routine)) ?? starters[routine];
    } catch { // a browser that keeps nothing
        return starters[routine];
    }
}

function keep(routine, code) {
    try {
        if (code === starters[routine])
            localStorage.removeItem(place(routine));
        else
            localStorage.setItem(place(routine), code);
    } catch { // nothing to be done: there is the button "save"
    }
}

// ---- the compiler's worker: one for all editors of a page -----------------------------

let worker, listener, patience, ready = false, number = 0;

function end() {
    clearTimeout(patience);
    worker?.terminate();
    worker = undefined;
    ready = false;
}

function heard(data) {
    if (data.number !== undefined && data.number !== number)
        return; // about a text that is no more
    ready ||= Boolean(data.ready);
    clearTimeout(patience);
    if (data.begun || data.judging || data.alive)
        patience = setTimeout(() => {
            end();
            listener({
                broken: data.begun ? `does not compile: no end within ${LONGEST / 1000} seconds`
                    : 'The judge does not answer. Please try again.',
            });
        }, LONGEST);
    listener(data);
}

// listen(answer) gets what comes, until somebody asks anew.
function ask(folder, question, listen) {
    listener?.({ dropped: true });
    listener = listen;
    if (!worker) {
        worker = new Worker(`${folder}edit-worker.js`, { type: 'module' });
        worker.onmessage = ({ data }) => heard(data);
        worker.onerror = event => listener({ broken: `The compiler stopped: ${event.message}` });
    }
    worker.postMessage({ number: ++number, ...question });
}

// ---- one editor -----------------------------------------------------------------------

// What others' programs print, without what is no text.
const printable = text => text.replace(/[^\n\t\x20-\x7e\u00a0-\uffff]/g, '?');

const plural = (n, word) => `${n} ${word}${n === 1 ? '' : 's'}`;

self.rtEditor = (div, folder) => {
    const routines = div.dataset.routines.split(/\s+/).filter(name => starters[name]);
    const live = document.getElementById(div.dataset.live ?? '');
    let routine = routines[0], timer;

    const mine = () => `my_${routine.slice(3)}.c`;
    const choice = element('select', {}, ...routines.map(name => element('option', {}, name)));
    const label = element('label', {}, 'routine ', choice);
    const button = (text, act) => {
        const made = element('button', { type: 'button', textContent: text });
        made.addEventListener('click', act);
        return made;
    };
    const save = button('', () => download());
    const status = element('p', { className: 'edit-status' });
    const said = element('ul', { className: 'edit-list' });
    const verdict = element('pre', { className: 'edit-verdict' });
    const printed = element('pre', { className: 'edit-printed' });
    const output = element('div', { hidden: true }, element('p', {}, 'It prints:'), printed);
    printed.tabIndex = 0; // it may have to be scrolled
    printed.setAttribute('role', 'region');
    printed.setAttribute('aria-label', 'what it prints');
    const room = element('div');
    status.setAttribute('role', 'status');
    label.hidden = routines.length < 2;
    div.append(element('p', { className: 'edit-tools' }, label,
        button('compile and try', attempt), button('start over', restore), save),
    room, status, said, verdict, output);

    function state() {
        return EditorState.create({
            doc: kept(routine),
            extensions: [
                lineNumbers(), lintGutter(), history(), drawSelection(), bracketMatching(),
                indentOnInput(), indentUnit.of('    '), highlightActiveLine(), cpp(),
                syntaxHighlighting(classHighlighter), EditorView.lineWrapping,
                keymap.of([{ key: 'Mod-Enter', run: attempt }, ...defaultKeymap,
                    ...historyKeymap, indentWithTab]),
                EditorView.contentAttributes.of({
                    tabindex: '0',
                    'aria-label': `${mine()}, in C. Ctrl-Enter compiles; ` +
                        'Escape, then Tab leaves the editor',
                }),
                EditorView.updateListener.of(update => update.docChanged && changed()),
            ],
        });
    }

    const view = new EditorView({ parent: room });
    const code = () => view.state.doc.toString();

    function show(name) {
        routine = name;
        save.textContent = `save ${mine()}`;
        view.setState(state());
        attempt();
    }

    function changed() {
        keep(routine, code());
        clearTimeout(timer);
        timer = setTimeout(attempt, PAUSE);
    }

    function restore() {
        view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: starters[routine] } });
        attempt();
    }

    // The file that "make try" takes.
    function download() {
        const url = URL.createObjectURL(new Blob([code()], { type: 'text/x-csrc' }));
        element('a', { href: url, download: mine() }).click();
        setTimeout(() => URL.revokeObjectURL(url), 1000);
    }

    function attempt() {
        clearTimeout(timer);
        const name = mine();
        ask(folder, { code: code(), name }, data => answered(data, name));
        status.textContent = ready ? 'compiling ...' : 'loading the compiler ...';
        return true; // the key is used
    }

    function clear() {
        said.replaceChildren();
        verdict.textContent = '';
        output.hidden = true;
        mark([]);
    }

    function answered(data, name) {
        if (data.loaded) {
            status.textContent = `loading the compiler: ${(data.loaded / 1e6).toFixed(0)} of ` +
                `${MEGABYTES} MB ...`;
        } else if (data.ready || data.begun) {
            status.textContent = 'compiling ...';
        } else if (data.dropped) {
            status.textContent = '';
        } else if (data.alive) {
            return;
        } else if (data.broken) {
            end();
            clear();
            status.textContent = data.broken;
        } else {
            clear();
            list(data.list);
            if (data.said)
                live?.dispatchEvent(new CustomEvent('mine-old'));
            const seconds = `compiled in ${(data.times.compile / 1000).toFixed(1)} s`;
            status.textContent = data.said ? `${name}: ${data.said}`
                : data.judging ? `${seconds}, testing ...` : seconds;
            if (data.verdict)
                judged(data);
        }
    }

    function judged({ verdict: text, output: prints, printed: size, ...data }) {
        const { marks, names, bytes, dangerous } = data;
        const good = marks.reduce((sum, m) => sum + m.good, 0);
        const all = marks.reduce((sum, m) => sum + m.all, 0);
        verdict.textContent = text;
        status.textContent += `: ${good === all ? 'all right' : `${good} of ${all} right`}`;
        if (dangerous) // as "make try" has it
            verdict.textContent += 'no picture: it would crash, or never end\n';
        if (prints) {
            output.hidden = false;
            const more = size - new TextEncoder().encode(prints).length;
            printed.textContent = printable(prints) +
                (more > 0 ? `\n... and ${plural(more, 'byte')} more` : '');
        }
        live?.dispatchEvent(dangerous ? new CustomEvent('mine-old') : new CustomEvent('mine', {
            detail: { bytes, routine: names.includes(routine) ? routine : names[0] },
        }));
    }

    // ---- errors, in the lines and below ----

    function position(message) {
        const doc = view.state.doc;
        const line = doc.line(Math.min(message.line, doc.lines));
        return { from: Math.min(line.from + message.column - 1, line.to), line };
    }

    function mark(list) {
        view.dispatch(setDiagnostics(view.state, list.filter(m => m.line > 0).map(message => {
            const { from: at, line } = position(message);
            // there must be a letter to be marked
            const from = at === line.to ? Math.max(at - 1, line.from) : at;
            const word = /^\w*/.exec(line.text.slice(from - line.from))[0].length;
            return {
                from, to: Math.min(from + Math.max(word, 1), line.to), message: message.text,
                severity: message.kind === 'note' ? 'info' : message.kind,
            };
        })));
    }

    function list(messages) {
        mark(messages);
        said.replaceChildren(...messages.map(message => {
            const words = `${message.kind === 'error' ? '' : `${message.kind}: `}${message.text}`;
            if (message.line === 0)
                return element('li', { className: message.kind }, words);
            const go = button(`line ${message.line}`, () => {
                view.dispatch({
                    selection: { anchor: position(message).from }, scrollIntoView: true,
                });
                view.focus();
            });
            return element('li', { className: message.kind }, go, ` ${words}`);
        }));
    }

    live?.addEventListener('mine-failed', ({ detail }) => {
        status.textContent += `. The picture ${detail}`;
    });
    choice.addEventListener('change', () => show(choice.value));
    show(routine);
    view.focus();
};
