/* Charts that grow with a live picture: begin() for a new one, error() or speed() when more is known. */

/* The error against the samples, both as logarithms: a straight line for each picture. names() of the
 * pictures, if there are two. */
function error_chart(names) {
    const element = make('div', {class: 'chart'});
    const w = 320, h = 180, left = 44, bottom = 26, lines = [[], []];
    const x = samples => left + Math.log2(samples) / 10 * (w - left - 16), y = error => 8 + (Math.log10(2) - Math.log10(error)) / 3 * (h - 8 - bottom);
    function draw() {
        const grid = [1, 4, 16, 64, 256, 1024].map(s => `<line x1="${x(s)}" x2="${x(s)}" y1="8" y2="${h - bottom}"/><text x="${x(s)}" y="${h - 10}" text-anchor="middle">${s}</text>`)
            .concat([1, 0.1, 0.01].map(e => `<line x1="${left}" x2="${w - 16}" y1="${y(e)}" y2="${y(e)}"/><text x="${left - 4}" y="${y(e) + 4}" text-anchor="end">${100 * e} %</text>`));
        const curves = lines.map((line, i) => line.length === 0 ? '' :
            `<polyline class="curve-${i}" points="${line.map(p => `${x(p[0]).toFixed(1)},${y(p[1]).toFixed(1)}`).join(' ')}"/>` +
            line.map(p => `<circle class="curve-${i}" cx="${x(p[0]).toFixed(1)}" cy="${y(p[1]).toFixed(1)}" r="2.5"/>`).join(''));
        const last = lines.map(line => line.at(-1)).filter(Boolean).map(p => `${p[0]} ${t('samples')}: ${(100 * p[1]).toFixed(1)} %`).join('; ');
        const key = names().map((name, i) => `<text class="curve-${i}" x="${w - 12}" y="${22 + 14 * i}" text-anchor="end">${name}</text>`).join('');
        element.innerHTML = `<svg viewBox="0 0 ${w} ${h}" role="img" aria-label="${t('error')}, ${t('samples')}: ${last}">${grid.join('')}${curves.join('')}${key}</svg>` +
            `<p>${t('error')} (%), ${t('samples')}</p>`;
    }
    draw();
    return {element, speed: () => {}, begin() { lines[0] = []; lines[1] = []; draw(); }, error(which, samples, error) {
        if (samples > (lines[which].at(-1)?.[0] ?? 0) && samples <= 1024) {
            lines[which].push([samples, error]);
            draw();
        }
    }};
}
/* Millions of rays a second, for each setting() that was tried. */
function speed_chart(setting) {
    const element = make('div', {class: 'chart'}), tried = new Map();
    return {element, begin: () => {}, error: () => {}, speed(rate) {
        const key = setting();
        tried.set(key, Math.max(rate, tried.get(key) ?? 0));
        const most = Math.max(...tried.values());
        element.replaceChildren(make('p', {text: t('million rays a second')}), ...[...tried].map(([name, value]) =>
            make('div', {class: 'speed'}, make('span', {text: name}), make('meter', {min: 0, max: most, value, 'aria-label': name}), make('b', {text: value.toFixed(1)}))));
    }};
}
