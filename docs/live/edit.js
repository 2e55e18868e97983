// "Write it yourself": fills each
//     <div class="edit" data-routines="rt_hit_sphere rt_camera_ray" data-live="live-demo01">
// What is heavy, the editor and the compiler, comes when it is wanted. When a text
// compiled, and ended for all inputs, the element data-live gets the event "mine" with
// detail { bytes: the module, routine: "rt_hit_sphere" }.
import { element } from './element.js';

/* global MEGABYTES */ // how much that is, put here by build-edit.sh

const folder = new URL('.', document.currentScript.src).href;
const enough = self.Worker && self.WebAssembly && self.DecompressionStream;

// The editor is a script of its own; one for all that are on the page.
let script;
function load() {
    script ??= new Promise((resolve, reject) => {
        document.head.append(element('script', {
            src: `${folder}editor.js`, onload: resolve, onerror: reject,
        }));
    });
    return script;
}

function begin(div) {
    const note = element('span', { className: 'edit-note' });
    const button = element('button', { type: 'button', textContent: 'Write it yourself, here' });
    note.setAttribute('role', 'status');
    if (location.protocol === 'file:') {
        div.append(element('p', {}, 'To write it on this page, you need a web server: ',
            element('code', { textContent: 'python3 -m http.server -d build/site' }), '.'));
        return;
    }
    if (!enough) {
        div.append(element('p', {}, 'To write it on this page, you need a newer browser.'));
        return;
    }
    note.textContent = `fetches a C compiler once, ${MEGABYTES} MB`;
    button.addEventListener('click', async () => {
        button.disabled = true;
        note.textContent = 'loading the editor ...';
        try {
            await load();
            div.replaceChildren();
            self.rtEditor(div, folder);
        } catch {
            script = undefined;
            button.disabled = false;
            note.textContent = 'The editor could not be loaded. Is the server still running?';
        }
    });
    div.append(element('p', {}, button, ' ', note));
}

document.head.append(element('link', { rel: 'stylesheet', href: `${folder}edit.css` }));
for (const div of document.querySelectorAll('div.edit'))
    begin(div);
