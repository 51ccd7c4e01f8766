// SPDX-License-Identifier: Apache-2.0
// The plots: error against the time of a ray, and against bytes. Both axes are logarithmic; what is exact (error
// 0) lies on a line of its own below the smallest error. Drawn by Chart.js.
'use strict';

const reportPlot = (() => {
    const { bytes, significant } = pageText;

    const share = (value) => `${significant(100 * value)[0]}\u202f%`;
    const distance = (value) => `${significant(value)[0]}\u202fR`;

    // What the errors are called in JSON, on the page, and by searches (`spa bake --target-metric`).
    const metrics = [
        { id: 'false_hits', label: 'False hits', of: 'Rays that hit the map and not the object', text: share },
        { id: 'missed_hits', label: 'Missed hits', of: 'Rays that hit the object and not the map', text: share },
        { id: 'mean_distance', label: 'Mean Δt', of: 'Mean distance between the hits of a ray', text: distance, search: 'mean-dt' },
        { id: 'p95_distance', label: 'p95 Δt', of: '95 % of hits are closer together than this', text: distance, search: 'p95-dt' },
        { id: 'hausdorff', label: 'Hausdorff', of: 'Largest distance between map and object', text: distance },
        { id: 'not_captured', label: 'Not captured', of: 'Share of the surface that the map lacks', text: share },
    ];
    const isSearched = (metric, name) => (metric.search ?? metric.id.replaceAll('_', '-')) === name;

    const nanoseconds = (value) => `${value < 10 ? value.toFixed(1) : Math.round(value)}\u202fns`;
    const axes = {
        speed: { title: 'ns a ray, one thread', text: nanoseconds },
        bytes: { title: 'bytes', text: (value) => bytes(value).join('\u202f').replace('.0\u202f', '\u202f') },
    };

    function colors() {
        const style = getComputedStyle(document.documentElement);
        const of = (name) => style.getPropertyValue(name).trim();
        return { map: of('--accent'), triangles: of('--triangles'), text: of('--text'), muted: of('--muted'), line: of('--line'),
            raised: of('--raised'), page: of('--page') };
    }

    const decade = (value) => 10 ** Math.floor(Math.log10(value) + 1e-9);
    // 1, 2, 5 a decade while those are few, else the decades.
    function ticksBetween(low, high) {
        const ticks = [];
        const steps = Math.log10(high / low) > 3 ? [1] : [1, 2, 5];
        for (let at = decade(low); at <= high; at *= 10)
            for (const step of steps) if (at * step >= low && at * step <= high) ticks.push(at * step);
        return ticks;
    }
    // Of bytes: powers of two.
    function binaryTicks(low, high) {
        const ticks = [];
        const step = Math.max(1, Math.ceil(Math.log2(high / low) / 8));
        for (let power = Math.ceil(Math.log2(low) / step) * step; 2 ** power <= high; power += step) ticks.push(2 ** power);
        return ticks;
    }

    // A map's points in a plot; null: it has none there. x of triangles: their own time or memory.
    const spots = {
        speed: (map) => ({ map: map.speed?.map?.ns ?? null, triangles: map.speed?.triangles?.ns ?? null }),
        bytes: (map) => ({ map: map.bytes, triangles: map.speed?.triangles?.bytes ?? null }),
    };

    // rows: {map, index, name}. chosen(row): called when a point is picked.
    function make({ kind, canvas, rows, chosen, named }) {
        let metric = metrics[0];
        let shown = rows;
        let selected = null;
        let floor = 1e-6;
        let points = []; // of maps, in the order of x
        const error = (row) => row.map.errors?.[metric.id] ?? null;
        const place = (value) => Math.max(value, floor);
        const dataset = (label, more) => ({ label, data: [], showLine: false, ...more });
        const datasets = {
            candidates: dataset('tried', { showLine: true, pointRadius: 2.5, borderWidth: 1, pointHoverRadius: 4, order: 4 }),
            link: dataset('', { showLine: true, pointRadius: 0, pointHitRadius: 0, borderWidth: 1, borderDash: [3, 3], order: 5 }),
            triangles: dataset('triangles', { pointStyle: 'triangle', pointRadius: 5, pointHoverRadius: 7, borderWidth: 1, order: 3 }),
            maps: dataset('maps', { pointRadius: 4.5, pointHoverRadius: 7, borderWidth: 1, order: 2 }),
            selected: dataset('selected', { pointRadius: 8, pointHitRadius: 0, pointHoverRadius: 8, borderWidth: 2, order: 1 }),
        };

        const chart = new Chart(canvas, {
            type: 'scatter',
            data: { datasets: Object.values(datasets) },
            options: {
                animation: false,
                responsive: true,
                maintainAspectRatio: false,
                interaction: { mode: 'nearest', intersect: true },
                onClick: (_, found) => pick(found),
                onHover: (_, found) => { canvas.style.cursor = found.length > 0 ? 'pointer' : ''; },
                elements: { point: { hitRadius: 6 } },
                plugins: {
                    legend: { display: false },
                    tooltip: {
                        displayColors: false,
                        callbacks: { title: (items) => named(items[0].raw.row), label: (item) => label(item) },
                    },
                },
                scales: {
                    x: {
                        type: 'logarithmic',
                        title: { display: true, text: axes[kind].title },
                        afterBuildTicks: (axis) => {
                            const ticks = (kind === 'bytes' ? binaryTicks : ticksBetween)(axis.min, axis.max);
                            axis.ticks = ticks.map((value) => ({ value }));
                        },
                        ticks: { autoSkip: true, maxRotation: 0, callback: (value) => axes[kind].text(value) },
                    },
                    y: {
                        type: 'logarithmic',
                        afterBuildTicks: (axis) => {
                            const ticks = ticksBetween(floor * 2, axis.max).filter((value) => value > floor * 1.5);
                            axis.ticks = [floor, ...ticks].map((value) => ({ value }));
                        },
                        ticks: { autoSkip: false, callback: (value) => (value === floor ? 'exact' : metric.text(value)) },
                    },
                },
            },
        });

        function label({ dataset: { label: of }, raw }) {
            const at = `${axes[kind].text(raw.x)}`;
            if (of === 'triangles') return [`its triangles: ${at}`, 'exact'];
            const lines = [at, `${metric.label}: ${metric.text(raw.error)}`];
            if (of === 'tried') lines.unshift(raw.chosen ? 'tried, and chosen' : 'tried');
            return lines;
        }

        function pick(found) {
            if (found.length > 0) chosen(chart.data.datasets[found[0].datasetIndex].data[found[0].index].row);
        }

        // The candidates of the search that chose the selected map, if they were judged by the metric shown.
        function candidates() {
            const search = selected?.map.search;
            if (kind !== 'bytes' || !search || !isSearched(metric, search.metric)) return [];
            return search.candidates
                .map((each, i) => ({ x: each.bytes, error: each.error, chosen: i === search.chosen, row: selected }))
                .filter((each) => each.x > 0 && each.error !== null)
                .sort((a, b) => a.x - b.x);
        }

        function update() {
            const tried = candidates();
            const judged = shown.filter((row) => error(row) !== null && spots[kind](row.map).map > 0);
            const positive = [...judged.map(error), ...tried.map((each) => each.error)].filter((value) => value > 0);
            const lowest = positive.length > 0 ? Math.min(...positive) : 1e-4;
            const highest = positive.length > 0 ? Math.max(...positive) : 1e-1;
            floor = lowest / Math.max(2.5, (highest / lowest) ** 0.12);
            const point = (row, x) => ({ x, y: place(error(row)), error: error(row), row });
            points = judged.map((row) => point(row, spots[kind](row.map).map)).sort((a, b) => a.x - b.x);
            datasets.maps.data = points;
            datasets.triangles.data = judged.filter((row) => spots[kind](row.map).triangles > 0)
                .map((row) => ({ x: spots[kind](row.map).triangles, y: floor, error: 0, row }));
            datasets.candidates.data = tried.map((each) => ({ ...each, y: place(each.error) }));
            const own = points.find((each) => each.row === selected);
            const peer = datasets.triangles.data.find((each) => each.row === selected);
            datasets.selected.data = own ? [own] : [];
            datasets.link.data = own && peer ? [own, peer] : [];
            const { y } = chart.options.scales;
            y.min = floor / 1.5;
            y.max = highest * Math.max(1.5, (highest / lowest) ** 0.05);
            const xs = [...points, ...datasets.triangles.data, ...tried].map((each) => each.x);
            const { x } = chart.options.scales;
            const [least, most] = xs.length > 0 ? [Math.min(...xs), Math.max(...xs)] : [1, 1000];
            const room = Math.max(1.15, (most / least) ** 0.04);
            x.min = least / room;
            x.max = most * room;
            canvas.setAttribute('aria-label', `${metric.label} against ${axes[kind].title}: ${points.length} maps. `
                + 'Arrow keys go from point to point; the table below says the same.');
            chart.update('none');
        }

        function paint() {
            const color = colors();
            const clear = (hexadecimal) => `${hexadecimal}90`;
            Object.assign(datasets.maps, { backgroundColor: clear(color.map), borderColor: color.map });
            Object.assign(datasets.triangles, { backgroundColor: clear(color.triangles), borderColor: color.triangles });
            Object.assign(datasets.candidates, { backgroundColor: color.page, borderColor: color.muted });
            Object.assign(datasets.link, { borderColor: color.muted });
            Object.assign(datasets.selected, { backgroundColor: 'transparent', borderColor: color.text });
            for (const axis of Object.values(chart.options.scales)) {
                axis.grid = { color: color.line };
                axis.ticks.color = color.muted;
                axis.border = { color: color.line };
                if (axis.title) axis.title.color = color.muted;
            }
            Object.assign(chart.options.plugins.tooltip, { backgroundColor: color.text, titleColor: color.page, bodyColor: color.page });
            chart.update('none');
        }

        // From point to point in the order of x.
        canvas.addEventListener('keydown', (event) => {
            const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
            if (!step || points.length === 0) return;
            event.preventDefault();
            const at = points.findIndex((each) => each.row === selected);
            chosen(points[at < 0 ? 0 : (at + step + points.length) % points.length].row, false);
        });

        return {
            chart,
            paint,
            set(changes) {
                ({ metric = metric, shown = shown, selected = selected } = changes);
                update();
            },
        };
    }

    return { axes, make, metrics, nanoseconds };
})();
