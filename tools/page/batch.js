// SPDX-License-Identifier: Apache-2.0
// The table of a batch report. What comes from assets (names, messages) goes into the page as text only.
'use strict';

(() => {
    const report = JSON.parse(document.getElementById('report').textContent);

    // Rows that are added at once, as the reader comes near the end of those that are there.
    const chunk = 100;

    const statuses = {
        failed: { label: 'failed', sign: '✕' },
        not_started: { label: 'not started', sign: '…' },
        baked: { label: report.dry_run ? 'to bake' : 'baked', sign: report.dry_run ? '→' : '✓' },
        up_to_date: { label: 'up to date', sign: '=' },
    };
    const reasons = {
        new: 'first map',
        sources: 'sources changed',
        options: 'options changed',
        version: 'other version',
        damaged: 'map was damaged',
        forced: 'forced',
    };
    const exitCodes = ['ok', 'usage', 'input/output', 'invalid data', 'internal', 'unsupported', 'limits'];

    const { bytes, element, fold, group, literal, percent, plural, quantity, seconds, significant } = pageText;

    // ---- Columns ----

    const cells = (asset) => {
        if (asset.size === null) return null;
        const [width, height = width] = asset.size.split('x').map(Number);
        return width * height * (asset.layers ?? 1);
    };
    const ending = ({ signal, exit_code: code }) => {
        if (signal !== null) return signal;
        return code ? `${exitCodes[code] ?? 'exit'} (${code})` : 'failed';
    };
    // A short form of what is said under the row, and its weight: errors first.
    const notes = (asset) => {
        if (asset.status === 'failed') return ending(asset);
        if (asset.warnings.length > 0) return plural(asset.warnings.length, 'warning');
        return asset.diagnostics ? 'diagnostics' : '';
    };
    const weight = (asset) =>
        asset.status === 'failed' ? 1e9 : asset.warnings.length > 0 ? asset.warnings.length : asset.diagnostics ? 0.5 : null;

    const number = (id, label, title, key, text) => ({ id, label, title, key, text, number: true });
    const measured = report.assets.some((asset) => asset.figures !== null);
    const shot = report.assets.some((asset) => asset.figures?.rays);

    const columns = [
        { id: 'source', label: 'Source', title: 'Path below its input folder', key: (a) => a.source },
        { id: 'status', label: 'Status', title: 'What became of it, and why', key: (a) => Object.keys(statuses).indexOf(a.status) },
        number('triangles', 'Triangles', 'Of the asset', (a) => a.triangles, (n) => [group(n), '']),
        number('source_bytes', 'Asset', 'Bytes of the asset and the files it refers to', (a) => a.source_bytes, bytes),
        number('output_bytes', 'Map', 'Bytes of the .spa file', (a) => a.output_bytes, bytes),
        number('size', 'Size × layers', 'Cells a side of an octahedral map, or width × height; layers stored', cells,
            (n, a) => [`${a.size.replace('x', '×')} × ${a.layers ?? '?'}`, '']),
        ...(measured ? [
            number('distance', 'p95 distance', '95 % of the asset’s surface is nearer to the map than this, in units of R',
                (a) => a.figures?.surface_distance?.p95 ?? null, (n) => [significant(n)[0], 'R']),
            number('captured', 'Captured', 'Share of the asset’s area that the map stands for',
                (a) => a.figures?.captured_area ?? null, percent(2)),
        ] : []),
        ...(shot ? [
            number('false_hits', 'False hits', 'Rays that meet the map and not the asset',
                (a) => a.figures?.rays?.false_hits?.share ?? null, percent(3)),
            number('missed_hits', 'Missed hits', 'Rays that meet the asset and not the map',
                (a) => a.figures?.rays?.missed_hits?.share ?? null, percent(3)),
        ] : []),
        number('seconds', 'Time', 'Wall clock', (a) => a.seconds, seconds),
        number('memory', 'Memory', 'Largest resident memory of its process', (a) => a.peak_memory_bytes, bytes),
        { id: 'notes', label: 'Notes', title: 'Errors, warnings, diagnostics', key: weight, text: notes },
    ];

    // ---- Rows ----

    const pictured = document.querySelector('script[id^="thumbnail-"]') !== null;
    const rows = report.assets.map((asset, index) => ({ asset, index, name: asset.source.toLowerCase() }));

    function picture({ asset, index }) {
        const data = document.getElementById(`thumbnail-${index}`)?.textContent;
        const cell = element('td', 'picture');
        if (!data) {
            cell.append(element('span', '', asset.status === 'failed' ? statuses.failed.sign : '–'));
            return cell;
        }
        const image = document.createElement('img');
        image.alt = '';
        image.width = image.height = 48;
        image.src = 'data:image/png;base64,' + data;
        cell.append(image);
        return cell;
    }

    function sourceCell(asset) {
        const slash = asset.source.lastIndexOf('/') + 1;
        const cell = element('td', 'source', literal(asset.source.slice(slash)));
        if (slash > 0) cell.append(element('small', '', literal(asset.source.slice(0, slash))));
        return cell;
    }

    function statusCell(asset) {
        const status = statuses[asset.status];
        const cell = element('td', `status ${asset.status}`, `${status.sign} ${status.label}`);
        if (asset.reason !== null) cell.append(element('small', '', reasons[asset.reason] ?? asset.reason));
        return cell;
    }

    function valueCell(column, asset) {
        const key = column.key(asset);
        const cell = element('td', column.number ? 'value number' : 'value');
        cell.dataset.label = column.label;
        if (key === null) cell.classList.add('empty');
        else if (column.number) cell.append(quantity(column.text(key, asset)));
        else cell.append(column.text(asset));
        return cell;
    }

    // What was said about the asset; null: nothing.
    function saidRow(asset) {
        const said = [];
        if (asset.error !== null) said.push(element('p', 'failed', literal(asset.error)));
        if (asset.warnings.length === 1) {
            said.push(element('p', 'unit', 'warning: ', literal(asset.warnings[0])));
        } else if (asset.warnings.length > 1) {
            const list = element('ul', '', ...asset.warnings.map((warning) => element('li', '', literal(warning))));
            said.push(fold(plural(asset.warnings.length, 'warning'), list));
        }
        if (asset.diagnostics) {
            const lines = asset.diagnostics.trimEnd().replaceAll('\t', '    ').split(/\r?\n/);
            const text = element('pre', '');
            lines.forEach((line, i) => text.append(i > 0 ? '\n' : '', literal(line)));
            said.push(fold('diagnostics', text));
        }
        if (said.length === 0) return null;
        const cell = element('td', '', ...said);
        cell.colSpan = columns.length;
        return element('tr', 'said', cell);
    }

    // A <tbody> an asset: its row, and what was said about it.
    function body(row) {
        const { asset } = row;
        const line = element('tr', 'row', sourceCell(asset), statusCell(asset),
            ...columns.slice(2).map((column) => valueCell(column, asset)));
        const result = element('tbody', `is_${asset.status}`, line);
        const said = saidRow(asset);
        if (said) result.append(said);
        if (pictured) {
            line.prepend(picture(row));
            line.cells[0].rowSpan = result.rows.length;
        }
        result.setAttribute('role', 'rowgroup');
        for (const tr of result.rows) {
            tr.setAttribute('role', 'row');
            for (const td of tr.cells) td.setAttribute('role', 'cell');
        }
        return result;
    }

    // ---- Order and filter ----

    const byDefault = (a, b) => (a.asset.status !== 'failed') - (b.asset.status !== 'failed') || a.index - b.index;
    let order = [...rows].sort(byDefault);
    let shown = order;
    let sorted = pageSorting.unsorted;
    const chosen = new Set();
    let words = [];

    function toggleSort(column) {
        sorted = pageSorting.next(sorted, column);
        if (sorted.id === null) order.sort(byDefault);
        else order = pageSorting.ordered(order, (row) => column.key(row.asset), sorted.descending);
        pageSorting.mark(document.querySelectorAll('th[data-column]'), sorted);
        show();
    }

    function matches({ asset, name }) {
        const some = ['failed', 'not_started', 'baked', 'up_to_date'].some((status) => chosen.has(status));
        if (some && !chosen.has(asset.status)) return false;
        if (chosen.has('warnings') && asset.warnings.length === 0) return false;
        return words.every((word) => name.includes(word));
    }

    const table = document.getElementById('assets');
    const more = document.getElementById('more');
    let present = 0; // rows of `shown` that are in the table
    const nearEnd = new IntersectionObserver((entries) => {
        if (entries.some((entry) => entry.isIntersecting)) append(chunk);
    }, { rootMargin: '1500px' });

    function append(count) {
        const end = Math.min(present + count, shown.length);
        const fragment = document.createDocumentFragment();
        for (; present < end; ++present) fragment.append(body(shown[present]));
        table.append(fragment);
        more.hidden = present === shown.length;
        more.textContent = `${plural(shown.length - present, 'more asset')} below`;
        // Anew, so that it is called again if the end is near still.
        nearEnd.unobserve(more);
        nearEnd.observe(more);
    }

    function show() {
        shown = order.filter(matches);
        for (const old of [...table.tBodies]) old.remove();
        present = 0;
        append(chunk);
        document.getElementById('none').hidden = shown.length > 0;
        document.getElementById('shown').textContent = shown.length === rows.length
            ? plural(rows.length, 'asset')
            : `${group(shown.length)} of ${plural(rows.length, 'asset')}`;
    }

    // ---- Head of the page ----

    const counts = report.counts;

    function headline() {
        const parts = [];
        if (counts.failed > 0) parts.push(`${group(counts.failed)} failed`);
        if (counts.not_started > 0) parts.push(`${group(counts.not_started)} not started`);
        parts.push(`${group(counts.baked)} ${statuses.baked.label}`);
        if (counts.up_to_date > 0) parts.push(`${group(counts.up_to_date)} up to date`);
        return parts.join(', ');
    }

    function notice() {
        if (report.stopped_by === 'signal') return 'Stopped by an interrupt before all assets had their turn.';
        if (report.stopped_by === 'output') return 'Stopped, because an output could not be written.';
        return report.dry_run ? 'A dry run: nothing was baked.' : '';
    }

    const sum = (key) => report.assets.reduce((total, asset) => total + (asset[key] ?? 0), 0);

    function facts() {
        const list = document.getElementById('facts');
        const add = (name, value, below) => {
            const text = element('dd', '', quantity(value));
            if (below) text.append(element('small', '', below));
            list.append(element('div', '', element('dt', '', name), text));
        };
        const [source, output] = [sum('source_bytes'), sum('output_bytes')];
        add('Assets', [group(rows.length), ''], report.shard ? `shard ${report.shard.index} of ${report.shard.count}` : '');
        add('Time', seconds(report.seconds), `${plural(report.jobs, 'job')}, ${seconds(sum('seconds')).join(' ')} of work`);
        add('Size of assets', bytes(source), plural(sum('triangles'), 'triangle'));
        const withBoth = report.assets.filter((a) => a.output_bytes !== null && a.source_bytes > 0);
        const share = withBoth.reduce((t, a) => t + a.output_bytes, 0) / withBoth.reduce((t, a) => t + a.source_bytes, 0);
        const inAssets = withBoth.length > 0 ? `${Number((100 * share).toPrecision(3))} % of their assets` : '';
        add('Size of maps', bytes(output), inAssets);
        if (report.memory_bytes !== null) add('Memory limit', bytes(report.memory_bytes), '');
        if (report.timeout_seconds !== null) add('Time limit', seconds(report.timeout_seconds), 'for each asset');
    }

    function bar() {
        const whole = document.getElementById('bar');
        whole.hidden = rows.length === 0;
        whole.setAttribute('aria-label', headline());
        for (const status of Object.keys(statuses)) {
            if (counts[status] === 0) continue;
            const piece = element('span', status);
            piece.style.flexGrow = counts[status];
            piece.title = `${group(counts[status])} ${statuses[status].label}`;
            whole.append(piece);
        }
    }

    function chips() {
        const add = (id, label, count) => {
            if (count === 0) return;
            const chip = element('button', id, label, element('b', '', group(count)));
            chip.type = 'button';
            chip.dataset.filter = id;
            chip.setAttribute('aria-pressed', 'false');
            chip.addEventListener('click', () => {
                if (!chosen.delete(id)) chosen.add(id);
                chip.setAttribute('aria-pressed', String(chosen.has(id)));
                show();
            });
            document.getElementById('chips').append(chip);
        };
        for (const [id, status] of Object.entries(statuses)) add(id, `${status.sign} ${status.label}`, counts[id]);
        add('warnings', 'with warnings', report.assets.filter((asset) => asset.warnings.length > 0).length);
    }

    function head() {
        const row = document.getElementById('head');
        if (pictured) {
            row.append(element('td', 'picture'));
            row.cells[0].setAttribute('role', 'cell');
        }
        for (const column of columns) {
            const button = element('button', '', column.label);
            button.type = 'button';
            button.title = column.title;
            button.addEventListener('click', () => toggleSort(column));
            const cell = element('th', column.number ? 'number' : '', button);
            cell.dataset.column = column.id;
            cell.setAttribute('role', 'columnheader');
            cell.setAttribute('aria-sort', 'none');
            row.append(cell);
        }
    }

    document.title = `spa batch: ${headline()}`;
    document.getElementById('title').textContent = headline();
    document.getElementById('folders').append('spa batch: ',
        ...report.inputs.flatMap((input, i) => [i > 0 ? ', ' : '', literal(input)]), ' → ', literal(report.output));
    document.getElementById('notice').textContent = notice();
    document.getElementById('notice').hidden = notice() === '';
    document.getElementById('footer').append(`Written by ${report.generator.name} ${report.generator.version}. `,
        'Distances are in units of R, the radius of the asset’s bounding sphere.');
    facts();
    bar();
    chips();
    head();
    show();

    document.getElementById('filter').addEventListener('input', (event) => {
        words = event.target.value.toLowerCase().split(/\s+/).filter((word) => word !== '');
        show();
    });
    // On paper nobody scrolls.
    window.addEventListener('beforeprint', () => append(Infinity));
})();
