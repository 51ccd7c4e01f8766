// SPDX-License-Identifier: Apache-2.0
// Checks of hostile_batch_report() (tests/support/batch_reports.cpp) as a page.
'use strict';

probe.run(async () => {
    const { all, checkSort, chip, complaints, equal, header, names, raw, report, text, type } = probe;
    const { assets } = report();
    const sources = assets.map((asset) => asset.source);

    // ---- At the start: failed ones first ----
    const failed = sources.filter((_, i) => assets[i].status === 'failed');
    const others = sources.filter((_, i) => assets[i].status !== 'failed');
    const start = [...failed, ...others];
    equal('failed', failed, ['</script><b class="injected">.glb', 'sub/folder/crash.off']);
    equal('order at the start', names(), start);
    equal('title', document.title, 'spa batch: 2 failed, 1 not started, 4 baked, 2 up to date');
    equal('heading', text('h1'), '2 failed, 1 not started, 4 baked, 2 up to date');
    equal('folders', text('#folders'), 'spa batch: assets → maps');
    equal('shown', text('#shown'), '9 assets');
    const facts = Object.fromEntries(all('#facts div').map((fact) => [
        fact.querySelector('dt').textContent, fact.querySelector('dd').innerText.replaceAll('\u202f', ' ').split('\n')]));
    equal('facts', facts, {
        'Assets': ['9', 'shard 2 of 3'],
        'Time': ['2:05 min', '2 jobs, 2:06 min of work'],
        'Size of assets': ['4.7 GiB', '1 234 605 triangles'],
        'Size of maps': ['1.9 MiB', '0.04 % of their assets'],
    });

    // ---- Names, messages and diagnostics are text ----
    equal('elements from names', all('.injected').length, 0);
    equal('scripts from names', window.injected, undefined);
    equal('images', all('tbody img').map((image) => image.src.slice(0, 22)),
        Array(all('tbody img').length).fill('data:image/png;base64,'));
    const body = (name) => all('tbody')[names().indexOf(name)];
    const script = body('</script><b class="injected">.glb');
    equal('error', all('.said .failed', script).map(raw), ['</script><script>window.injected = 1</script>']);
    equal('diagnostics', raw(script.querySelector('pre')),
        '<img class="injected" src="x" onerror="window.injected = 2">\n    second line');
    equal('diagnostics are folded', script.querySelector('details').open, false);
    script.querySelector('summary').click();
    equal('diagnostics unfold', script.querySelector('details').open, true);
    const quotes = body('"quotes" & \'more\'\\<!--.obj');
    equal('warnings', all('li', quotes).map(raw), ['a <b class="injected">bold</b> warning', 'another one']);
    equal('one warning', raw(body(sources[2]).querySelector('.said p')), 'warning: the only warning');
    // What could hide is shown as its number, and what turns text round cannot.
    equal('unseen characters', all('tbody .unseen').map((each) => each.textContent).sort(),
        ['U+0009', 'U+000A', 'U+000D', 'U+200B', 'U+202E']);
    equal('unseen characters themselves', /[\u0000-\u001f\u200b\u202e]/.test(all('td.source').map((c) => c.textContent).join('')), false);
    equal('bytes that are no UTF-8', names().includes('\ufffd\ufffd latin.obj'), true);

    // ---- Cells ----
    const cells = (name) => all('tr.row > td', body(name)).slice(2).map((cell) => cell.innerText.replaceAll('\u202f', ' '));
    equal('headers', all('th').map((cell) => cell.textContent), ['Source', 'Status', 'Triangles', 'Asset', 'Map',
        'Size × layers', 'p95 distance', 'Captured', 'False hits', 'Missed hits', 'Time', 'Memory', 'Notes']);
    equal('cells of a map', cells('sub/folder/Large.glb'), ['✓ baked\nfirst map', '1 234 567', '1000 B', '1.9 MiB',
        '640×480 × 1', '0.05 R', '100.00 %', '10.000 %', '15.000 %', '0.50 s', '64.0 MiB', 'diagnostics']);
    equal('cells of a crash', cells('sub/folder/crash.off'),
        ['✕ failed', '', '', '', '', '', '', '', '', '', '', 'SIGSEGV']);
    equal('cells of an error', cells(sources[1]).at(-1), 'invalid data (3)');
    equal('cells of a map without rays', cells(sources[3]).slice(5, 9), ['0.002 R', '50.00 %', '', '']);
    const images = all('tbody img');
    await Promise.all(images.map((image) => image.decode()));
    equal('thumbnails', names().map((name) => body(name).querySelector('img')?.naturalWidth ?? null),
        names().map((name) => (sources.indexOf(name) % 2 === 0 ? 10 + sources.indexOf(name) : null)));

    // ---- Sorting: three clicks, the last one back to the start ----
    const status = ['failed', 'not_started', 'baked', 'up_to_date'];
    const samples = { '256': 65536, '512': 262144, '640x480': 307200 };
    const values = {
        source: (a) => a.source,
        status: (a) => status.indexOf(a.status),
        triangles: (a) => a.triangles,
        source_bytes: (a) => a.source_bytes,
        output_bytes: (a) => a.output_bytes,
        size: (a) => a.size && samples[a.size] * a.layers,
        distance: (a) => a.figures && a.figures.surface_distance.p95,
        captured: (a) => a.figures && a.figures.captured_area,
        false_hits: (a) => (a.figures && a.figures.rays ? a.figures.rays.false_hits.share : null),
        missed_hits: (a) => (a.figures && a.figures.rays ? a.figures.rays.missed_hits.share : null),
        seconds: (a) => a.seconds,
        memory: (a) => a.peak_memory_bytes,
        notes: (a) => (a.status === 'failed' ? 1e9 : a.warnings.length || (a.diagnostics ? 0.5 : null)),
    };
    equal('columns', all('th').map((cell) => cell.dataset.column), Object.keys(values));
    for (const [id, value] of Object.entries(values)) {
        const button = header(id).querySelector('button');
        button.focus();
        equal(`the keyboard reaches ${id}`, document.activeElement === button && button.tabIndex === 0, true);
        const [first, second] = ['source', 'status', 'notes'].includes(id)
            ? ['ascending', 'descending'] : ['descending', 'ascending'];
        checkSort(id, value, first);
        checkSort(id, value, second);
        equal(`focus stays on ${id}`, document.activeElement === button, true);
        button.click();
        equal(`${id} not sorted by`, header(id).getAttribute('aria-sort'), 'none');
        equal(`back from ${id}`, names(), start);
    }
    // One column after another: equal ones keep the order of the one before.
    header('seconds').querySelector('button').click();
    checkSort('triangles', values.triangles, 'descending');
    equal('two with 7 triangles', names().filter((name) => [0, 2].includes(sources.indexOf(name))), [sources[2], sources[0]]);
    header('triangles').querySelector('button').click();
    header('triangles').querySelector('button').click();
    equal('order at the end', names(), start);

    // ---- Filters ----
    type('SUB obj');
    equal('no asset has both', [names(), text('#shown'), document.getElementById('none').hidden], [[], '0 of 9 assets', false]);
    type(' CRASH  sub/');
    equal('by words', names(), ['sub/folder/crash.off']);
    equal('how many', text('#shown'), '1 of 9 assets');
    type('lARGE');
    equal('whatever the case', names(), ['sub/folder/Large.glb']);
    type('<b class');
    equal('by a name', names(), [sources[1]]);
    type('');
    equal('by nothing', names(), start);
    equal('chips', all('#chips button').map((button) => button.textContent),
        ['✕ failed2', '… not started1', '✓ baked4', '= up to date2', 'with warnings2']);
    chip('up_to_date').click();
    equal('pressed', chip('up_to_date').getAttribute('aria-pressed'), 'true');
    equal('by status', names(), others.filter((name) => assets[sources.indexOf(name)].status === 'up_to_date'));
    chip('failed').click();
    equal('by two', names().length, 4);
    header('source').querySelector('button').click();
    equal('sorted while filtered', names(), sources.filter((_, i) => ['failed', 'up_to_date'].includes(assets[i].status)));
    chip('up_to_date').click();
    chip('failed').click();
    equal('released', [chip('failed').getAttribute('aria-pressed'), names()], ['false', sources]);
    chip('warnings').click();
    equal('with warnings', names(), [sources[0], sources[2]]);
    chip('warnings').click();

    // ---- Nothing went wrong, and nothing was asked of the network ----
    equal('complaints', complaints, []);
    equal('resources', performance.getEntriesByType('resource').filter((each) => !each.name.startsWith('data:')), []);
    // It is the policy that keeps it so: what tries is refused.
    const image = new Image();
    image.src = 'ADDRESS';
    const link = document.createElement('link');
    Object.assign(link, { rel: 'stylesheet', href: 'ADDRESS' });
    const inline = document.createElement('script');
    inline.textContent = 'window.injected = 4';
    document.head.append(image, link, inline);
    const refused = await fetch('ADDRESS').then(() => false, () => true);
    await new Promise((resolve) => setTimeout(resolve, 1000));
    equal('fetch is refused', refused, true);
    equal('scripts of others are refused', window.injected, undefined);
    equal('refusals', complaints.filter((each) => each.startsWith('policy:')).map((each) => each.split(' ')[1]).sort(),
        ['connect-src', 'img-src', 'script-src-elem', 'style-src-elem']);
});
