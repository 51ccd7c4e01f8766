// SPDX-License-Identifier: Apache-2.0
// Checks of hostile_map_report() (tests/support/map_reports.cpp) as a page.
'use strict';

probe.run(async () => {
    const { all, complaints, equal, header, names, raw, report, text, type } = probe;
    const { maps } = report();
    const sources = maps.map((map) => map.name);
    const body = (name) => all('#maps > tbody').find((each) => {
        const [own, folder] = all('td.source bdi', each);
        return (folder ? raw(folder) : '') + raw(own) === name;
    });
    const button = (name) => body(name).querySelector('td.source button');
    const opened = () => all('#maps > tbody.chosen').map((each) => names()[all('#maps > tbody').indexOf(each)]);
    const canvas = (kind) => document.getElementById(`${kind}_plot`);
    const plot = (kind) => Chart.getChart(canvas(kind));
    const points = (kind, label = 'maps') => plot(kind).data.datasets.find((each) => each.label === label).data;
    const metric = (id) => document.querySelector(`#metrics input[value="${id}"]`).click();
    const frame = () => new Promise((resolve) => setTimeout(resolve, 50));

    // ---- What strangers wrote is text ----
    equal('names', names(), sources);
    equal('nothing was injected', [all('.injected').length, window.injected], [0, undefined]);
    equal('unseen characters', all('#maps .unseen').map((each) => each.textContent).sort(),
        ['U+0009', 'U+000A', 'U+000D', 'U+200B', 'U+202E']);
    equal('error', raw(body(sources[3]).querySelector('.failed')), maps[3].error);
    equal('warnings', all('li', body(sources[0])).map(raw), maps[0].warnings);
    equal('title', text('#title'), '8 maps, 2 plans, 1 not read');

    // ---- The plots ----
    // Pixels that are not as the corner: something is drawn.
    function ink(kind) {
        const { width, height } = canvas(kind);
        const { data } = canvas(kind).getContext('2d').getImageData(0, 0, width, height);
        let count = 0;
        for (let i = 3; i < data.length; i += 4) if (data[i] > 0) ++count;
        return count / (width * height);
    }
    for (const kind of ['speed', 'bytes']) {
        equal(`${kind}: is large`, canvas(kind).width > 300 && canvas(kind).height > 200, true);
        const drawn = ink(kind);
        equal(`${kind}: is drawn, and not all over: ${drawn}`, drawn > 0.005 && drawn < 0.5, true);
    }
    const has = (id) => (map) => map.errors !== null && map.errors[id] !== null && map.speed !== null;
    const plotted = (kind, id, of) => equal(`${kind} of ${id}`, points(kind).map(({ x, error }) => [x, error]),
        maps.filter(has(id)).map((map) => [of(map), map.errors[id]]).sort((a, b) => a[0] - b[0]));
    equal('metrics', all('#metrics label').map((label) => label.textContent),
        ['False hits', 'Missed hits', 'Mean Δt', 'p95 Δt', 'Hausdorff', 'Not captured']);
    for (const id of ['mean_distance', 'hausdorff', 'false_hits']) {
        metric(id);
        plotted('speed', id, (map) => map.speed.map.ns);
        plotted('bytes', id, (map) => map.bytes);
        equal(`exact ones lie below all others: ${id}`, points('speed').filter(({ error, y }) => error === 0
            && y < Math.min(...points('speed').filter((each) => each.error > 0).map((each) => each.y))).length, 1);
    }
    equal('triangles', points('speed', 'triangles').map(({ x }) => x).sort(), [120, 160]);
    equal('unplotted', text('#unplotted').startsWith('4 maps without this figure'), true);

    // A pointer goes over a point, and clicks it.
    const at = (kind, index) => {
        const chart = plot(kind);
        const element = chart.getDatasetMeta(chart.data.datasets.findIndex((each) => each.label === 'maps')).data[index];
        const box = canvas(kind).getBoundingClientRect();
        return { clientX: box.left + element.x, clientY: box.top + element.y, bubbles: true };
    };
    async function pointer(kind, event, index) {
        canvas(kind).dispatchEvent(new MouseEvent(event, at(kind, index)));
        await frame();
    }
    await pointer('speed', 'mousemove', 0);
    const tooltip = plot('speed').tooltip;
    equal('hover says which', tooltip.title, [sources[1]]);
    equal('and what', tooltip.body[0].lines, ['40\u202fns', 'False hits: 0.2\u202f%']);
    equal('nothing is chosen yet', opened(), []);
    await pointer('speed', 'click', 0);
    equal('a click chooses', opened(), [sources[1]]);
    equal('in the other plot too', points('bytes', 'selected').map(({ row }) => row.map.name), [sources[1]]);
    equal('expanded', button(sources[1]).getAttribute('aria-expanded'), 'true');
    const details = () => document.querySelector('#maps tbody.chosen .details');
    equal('settings', all('dl.pairs', details())[1].textContent,
        '<img class="injected" src=x></script><script>window.injected = 1</script>');
    await pointer('bytes', 'click', 1);
    equal('another click', opened(), [sources[0]]);

    // ---- What was tried ----
    const tried = () => document.querySelector('.details table.plain');
    equal('tried: settings that differ', all('th', tried()).map((each) => each.textContent),
        ['', 'size', '</td><b class="injected">', 'Bytes', 'Error', 'Target']);
    equal('tried: the chosen one', all('tr.chosen td', tried()).map((each) => each.textContent),
        ['✓ chosen', '128', '128', '29.3\u202fKiB', '0.003', 'met']);
    equal('why', document.querySelector('.details .why').textContent, 'Asked for mean-dt of at most 0.004 in at most 97.7\u202fKiB; '
        + '3 candidates tried, cheapest first; the chosen one has 0.003; stopped by <img class="injected" src=x>.');
    equal('tried are not drawn by another metric', points('bytes', 'tried').length, 0);
    metric('mean_distance');
    equal('tried are drawn by theirs', points('bytes', 'tried').map(({ x, y }) => [x, y]), [[4000, 0.02], [9000, 0.008], [30000, 0.003]]);
    button(sources[0]).click();
    equal('let go', [opened(), points('bytes', 'tried').length], [[], 0]);

    // The keyboard goes from point to point.
    canvas('speed').focus();
    equal('the keyboard reaches a plot', document.activeElement === canvas('speed'), true);
    const order = points('speed').map(({ row }) => row.map.name);
    for (const name of [order[0], order[1], order[2]]) {
        canvas('speed').dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight', bubbles: true, cancelable: true }));
        equal('next point', opened(), [name]);
    }
    canvas('speed').dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft', bubbles: true, cancelable: true }));
    equal('the one before', opened(), [order[1]]);
    button(order[1]).click();

    // ---- Cells, order, filter ----
    const cells = (name) => all('tr.row > td', body(name)).map((cell) => cell.innerText.replaceAll('\u202f', ' '));
    equal('headers', all('#maps > thead th').map((cell) => cell.textContent), ['Map', 'Size × layers', 'Parts', 'Bytes', 'Triangles',
        'Ray: map', 'Ray: triangles', 'Speedup', 'False hits', 'Missed hits', 'Mean Δt', 'Hausdorff', 'Not captured', 'Notes']);
    equal('cells', cells(sources[0]).slice(2), ['128 × 2', '1', '29.3 KiB', '1 000', '80.0 ns', '160 ns', '2.00 ×', '0.030 %',
        '0.060 %', '0.003 R', '0.06 R', '0.15 %', '2 warnings']);
    equal('cells of what was not read', cells(sources[3]).slice(2), ['', '', '', '', '', '', '', '', '', '', '', '', 'not read']);
    const values = { bytes: (map) => map.bytes, map_ns: (map) => map.speed?.map.ns ?? null,
        hausdorff: (map) => map.errors?.hausdorff ?? null };
    for (const [id, value] of Object.entries(values)) {
        const sorted = [...maps].sort((a, b) => {
            const [x, y] = [value(a), value(b)];
            return x === null || y === null ? (x === null) - (y === null) : y - x;
        });
        header(id).querySelector('button').click();
        equal(`by ${id}`, [header(id).getAttribute('aria-sort'), names()], ['descending', sorted.map((map) => map.name)]);
        header(id).querySelector('button').click();
        header(id).querySelector('button').click();
        equal(`back from ${id}`, [header(id).getAttribute('aria-sort'), names()], ['none', sources]);
    }
    type('SUB large');
    equal('filter', [names(), text('#shown')], [['sub/folder/Large.spa'], '1 of 8 maps']);
    equal('the plots show what the table does', points('bytes').map(({ row }) => row.map.name), ['sub/folder/Large.spa']);
    type('none such');
    equal('none', [names(), document.getElementById('none').hidden], [[], false]);
    type('');
    equal('all again', names(), sources);
    const images = all('#maps tbody img');
    await Promise.all(images.map((image) => image.decode()));
    equal('thumbnails', images.map((image) => image.naturalWidth), sources.map((_, i) => 10 + i).filter((width) => width % 2 === 0));

    // ---- Plans ----
    const [plan, unread] = all('section.plan');
    equal('plan', raw(plan.querySelector('h2')), 'Plan PLAN.json');
    equal('a plan that was not read', raw(unread.querySelector('.failed')), report().plans[1].error);
    equal('objects', all('td.object', plan).map((cell) => cell.innerText),
        ['again\nshares the map of <b class="injected">boot</b>', '<b class="injected">boot</b>', 'wall', 'pebble']);
    equal('decisions', all('td.decision', plan).map((cell) => cell.textContent), ['● map', '● map', '▲ triangles', '○ drop']);
    equal('reasons', all('td.why', plan).map((cell) => cell.textContent),
        [3, 1, 0, 2].map((i) => report().plans[0].objects[i].why));
    equal('totals', all('dl.facts dd', plan).map((each) => each.innerText.replaceAll('\u202f', ' ')),
        ['4\n2 map, 1 triangles, 1 drop', '19.5 KiB\n976.6 KiB as triangles: 50 times that', '117.2 KiB\n256 cells',
            '0.008\ntarget 0.01', '64\n</script><b class="injected">']);

    // ---- Nothing went wrong, and nothing was asked of the network ----
    equal('terms of the library', text('#licenses').includes('Chart.js Contributors') && text('#licenses').includes('Jukka Kurkela'), true);
    equal('nothing was injected at the end', [all('.injected').length, window.injected], [0, undefined]);
    equal('complaints', complaints, []);
    equal('resources', performance.getEntriesByType('resource').filter((each) => !each.name.startsWith('data:')), []);
    const image = new Image();
    image.src = 'ADDRESS';
    const refused = await fetch('ADDRESS').then(() => false, () => true);
    await new Promise((resolve) => setTimeout(resolve, 500));
    equal('fetch is refused', refused, true);
    equal('refusals', complaints.filter((each) => each.startsWith('policy:')).map((each) => each.split(' ')[1]).sort(),
        ['connect-src', 'img-src']);
});
