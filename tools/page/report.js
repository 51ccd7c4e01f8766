// SPDX-License-Identifier: Apache-2.0
// The page of spa report: plots and table of the maps, which show and choose the same ones.
'use strict';

(() => {
    const { bytes, element, fold, group, literal, percent, plural, quantity, significant } = pageText;
    const report = JSON.parse(document.getElementById('report').textContent);
    const rows = report.maps.map((map, index) => ({ map, index, name: map.name.toLowerCase() }));
    const read = rows.filter((row) => row.map.error === null);

    // ---- Columns ----

    const errorOf = (id) => ({ map }) => map.errors?.[id] ?? null;
    const nsOf = (what) => ({ map }) => map.speed?.[what]?.ns ?? null;
    const times = (row) => {
        const [map, triangles] = [nsOf('map')(row), nsOf('triangles')(row)];
        return map > 0 && triangles !== null ? triangles / map : null;
    };
    const inR = (n) => [significant(n)[0], 'R'];
    const inNs = (n) => [n < 99.95 ? n.toFixed(1) : String(Math.round(n)), 'ns'];
    // A short form of what is said below the row.
    function notes({ map }) {
        if (map.error !== null) return 'not read';
        if (map.warnings.length > 0) return plural(map.warnings.length, 'warning');
        return map.search ? `${map.search.candidates.length} tried` : '';
    }

    const button = (row) => {
        const { map } = row;
        const slash = map.name.lastIndexOf('/') + 1;
        const name = element('button', '', literal(map.name.slice(slash)));
        name.type = 'button';
        name.setAttribute('aria-expanded', 'false');
        name.addEventListener('click', () => choose(row));
        const cell = element('span', '', name);
        if (slash > 0) cell.append(element('small', '', literal(map.name.slice(0, slash))));
        return cell;
    };

    const { number, other } = reportTable;
    const errorColumn = (id, label, title, text) => number(id, label, title, errorOf(id), text);
    const columns = [
        other('source', 'Map', 'Path below its folder', ({ map }) => map.name, button),
        number('size', 'Size × layers', 'Cells a side of an octahedral map, or width × height; layers stored',
            ({ map }) => map.shape?.samples ?? null,
            (n, { map }) => [`${map.shape.depth?.size.replace('x', '×') ?? '?'} × ${map.shape.layers}`, '']),
        number('parts', 'Parts', 'Maps in the file', ({ map }) => map.shape?.parts ?? null, (n) => [group(n), '']),
        number('bytes', 'Bytes', 'Of the file', ({ map }) => map.bytes, bytes),
        number('triangles', 'Triangles', 'Of the source', ({ map }) => map.source?.triangles ?? null, (n) => [group(n), '']),
        number('map_ns', 'Ray: map', 'Time of a ray through the map, one thread', nsOf('map'), inNs),
        number('triangles_ns', 'Ray: triangles', 'Time of a ray through the source’s triangles, one thread', nsOf('triangles'), inNs),
        number('times', 'Speedup', 'Time through the triangles divided by that through the map', times, (n) => [n.toFixed(2), '×']),
        errorColumn('false_hits', 'False hits', 'Rays that hit the map and not the source', percent(3)),
        errorColumn('missed_hits', 'Missed hits', 'Rays that hit the source and not the map', percent(3)),
        errorColumn('mean_distance', 'Mean Δt', 'Mean distance between the hits of a ray, in R', inR),
        errorColumn('hausdorff', 'Hausdorff', 'Largest distance between map and source, in R', inR),
        errorColumn('not_captured', 'Not captured', 'Share of the source’s area that the map lacks', percent(2)),
        other('notes', 'Notes', 'What stands below', (row) => notes(row) || null, (row) => notes(row)),
    ].filter((column) => ['source', 'bytes', 'notes'].includes(column.id)
        || (column.id === 'parts' ? rows.some(({ map }) => map.shape?.parts > 1) : rows.some((row) => column.key(row) !== null)));

    // ---- Rows ----

    const pictured = document.querySelector('script[id^="thumbnail-"]') !== null;

    function picture({ map, index }) {
        const data = document.getElementById(`thumbnail-${index}`)?.textContent;
        const cell = element('td', 'picture');
        if (!data) {
            cell.append(element('span', '', map.error === null ? '–' : '✕'));
            return cell;
        }
        const image = document.createElement('img');
        image.alt = '';
        image.width = image.height = 48;
        image.src = 'data:image/png;base64,' + data;
        cell.append(image);
        return cell;
    }

    function under({ map }) {
        if (map.error !== null) return element('p', 'failed', literal(map.error));
        if (map.warnings.length === 0) return null;
        if (map.warnings.length === 1) return element('p', 'unit', 'warning: ', literal(map.warnings[0]));
        return fold(plural(map.warnings.length, 'warning'),
            element('ul', '', ...map.warnings.map((warning) => element('li', '', literal(warning)))));
    }

    const table = reportTable.make({
        table: document.getElementById('maps'),
        columns,
        rows,
        named: 'map',
        lead: pictured ? picture : null,
        under,
        made: (row, body) => {
            if (row === selected) open(body);
        },
        changed: (shown) => {
            for (const plot of plots) plot.set({ shown });
            document.getElementById('none').hidden = shown.length > 0;
            document.getElementById('shown').textContent = shown.length === rows.length
                ? plural(rows.length, 'map') : `${group(shown.length)} of ${plural(rows.length, 'map')}`;
        },
    });

    // ---- What is chosen: the same in both plots and in the table ----

    let selected = null;

    function open(body) {
        if (body.classList.contains('chosen')) return;
        body.classList.add('chosen');
        body.querySelector('td.source button').setAttribute('aria-expanded', 'true');
        if (selected.map.error !== null) return;
        const cell = element('td', '', reportDetails.of(selected));
        cell.colSpan = columns.length + (pictured ? 1 : 0);
        cell.setAttribute('role', 'cell');
        const line = element('tr', 'opened', cell);
        line.setAttribute('role', 'row');
        body.append(line);
    }

    function close(body) {
        body.classList.remove('chosen');
        body.querySelector('td.source button').setAttribute('aria-expanded', 'false');
        body.querySelector('tr.opened')?.remove();
    }

    // Chosen again it is let go. scrolls: to the row, for a choice that was not made there.
    function choose(row, scrolls = false) {
        document.querySelectorAll('#maps > tbody.chosen').forEach(close);
        selected = selected === row ? null : row;
        for (const plot of plots) plot.set({ selected });
        const body = selected && table.bodyOf(selected);
        if (!body) return;
        open(body);
        if (scrolls) body.scrollIntoView({ block: 'nearest' });
    }

    // ---- Plots ----

    const plots = [];
    let metric = reportPlot.metrics[0];

    function makePlots() {
        const has = (each) => read.some((row) => errorOf(each.id)(row) !== null);
        const known = reportPlot.metrics.filter(has);
        document.getElementById('plots').hidden = known.length === 0;
        if (known.length === 0) return;
        [metric] = known;
        for (const kind of ['speed', 'bytes']) {
            const canvas = document.getElementById(`${kind}_plot`);
            const timed = kind === 'bytes' || read.some((row) => nsOf('map')(row) !== null);
            canvas.closest('figure').hidden = !timed;
            if (!timed) continue;
            plots.push(reportPlot.make({ kind, canvas, rows: read, named: (row) => row.map.name,
                chosen: (row, scrolls = true) => choose(row, scrolls) }));
        }
        for (const each of known) {
            const radio = element('input');
            Object.assign(radio, { type: 'radio', name: 'metric', value: each.id, checked: each === metric });
            radio.addEventListener('change', () => setMetric(each));
            const label = element('label', '', radio, each.label);
            label.title = each.of;
            document.getElementById('metrics').append(label);
        }
        const mark = (className, sign, text) => element('span', className, `${sign} `, element('span', '', text));
        const marks = [mark('of_maps', '●', 'maps')];
        if (read.some((row) => nsOf('triangles')(row) !== null)) marks.push(mark('of_triangles', '▲', 'their triangles, which are exact'));
        if (read.some((row) => row.map.search)) marks.push(mark('of_tried', '○', 'tried for the chosen map'));
        document.getElementById('marks').append(...marks);
        for (const plot of plots) plot.paint();
        setMetric(metric);
    }

    function setMetric(value) {
        metric = value;
        for (const plot of plots) plot.set({ metric });
        const unknown = read.filter((row) => errorOf(metric.id)(row) === null);
        document.getElementById('unplotted').textContent = unknown.length === 0 ? ''
            : `${plural(unknown.length, 'map')} without this figure: not measured (spa bake --measure), `
                + 'and no source was found to measure against (--source).';
    }

    const dark = window.matchMedia('(prefers-color-scheme: dark)');
    const repaint = () => { for (const plot of plots) plot.paint(); };
    dark.addEventListener('change', repaint);
    for (const when of ['beforeprint', 'afterprint']) window.addEventListener(when, () => {
        for (const plot of plots) plot.chart.resize();
        repaint();
    });

    // ---- Head of the page ----

    const sum = (of) => read.reduce((total, row) => total + (of(row) ?? 0), 0);
    function median(of) {
        const values = read.map(of).filter((value) => value !== null).sort((a, b) => a - b);
        return values.length === 0 ? null : values[Math.floor((values.length - 1) / 2)];
    }

    function headline() {
        const parts = [];
        if (rows.length > 0 || report.plans.length === 0) parts.push(plural(rows.length, 'map'));
        if (report.plans.length > 0) parts.push(plural(report.plans.length, 'plan'));
        const unread = rows.length - read.length;
        return parts.join(', ') + (unread > 0 ? `, ${group(unread)} not read` : '');
    }

    function facts() {
        const add = (name, value, below = '') => {
            if (value === null) return;
            const text = element('dd', '', quantity(value));
            if (below) text.append(element('small', '', below));
            document.getElementById('facts').append(element('div', '', element('dt', '', name), text));
        };
        if (read.length === 0) return;
        const source = sum(({ map }) => map.source?.bytes);
        add('Size of maps', bytes(sum(({ map }) => map.bytes)), source > 0 ? `${bytes(source).join(' ')} of sources` : '');
        const triangles = sum(({ map }) => map.source?.triangles);
        if (triangles > 0) add('Triangles', [group(triangles), ''], 'of the sources');
        const [through, peer, faster] = [nsOf('map'), nsOf('triangles'), times].map(median);
        if (through !== null) add('Ray through a map', inNs(through), `median; ${group(report.rays)} random chords`);
        if (peer !== null) add('Ray through triangles', inNs(peer), `median; ${faster.toFixed(2)} times as long, in the middle`);
        const hits = [errorOf('false_hits'), errorOf('missed_hits')].map(median);
        if (hits[0] !== null) add('False hits', percent(3)(hits[0]), hits[1] === null ? 'median' : `median; ${percent(3)(hits[1]).join(' ')} missed`);
        const distance = median(errorOf('mean_distance'));
        if (distance !== null) add('Mean Δt', inR(distance), 'median of the maps');
    }

    document.title = `spa report: ${headline()}`;
    document.getElementById('title').textContent = headline();
    document.getElementById('folders').append('spa report: ',
        ...report.inputs.flatMap((input, i) => [i > 0 ? ', ' : '', literal(input)]));
    document.getElementById('footer').append(`Written by ${report.generator.name} ${report.generator.version}. `,
        'Distances are in units of R, the radius of the object’s bounding sphere. Errors: docs/measures.md.');
    document.getElementById('maps_section').hidden = rows.length === 0;
    facts();
    makePlots();
    table.setFilter(() => true);
    reportPlans.show(report.plans);

    document.getElementById('filter').addEventListener('input', (event) => {
        const words = event.target.value.toLowerCase().split(/\s+/).filter((word) => word !== '');
        table.setFilter(({ name }) => words.every((word) => name.includes(word)));
    });
})();
