// SPDX-License-Identifier: Apache-2.0
// Checks of large_batch_report(10000) (tests/support/batch_reports.cpp) as a page: few of its rows are there at a
// time, whatever is done.
'use strict';

probe.run(async () => {
    const { all, complaints, equal, header, names, report, text, type } = probe;
    const { assets } = report();
    const few = 500;
    const isFew = (what) => equal(`${what}: few rows`, names().length > 0 && names().length <= few, true);
    const click = (id) => header(id).querySelector('button').click();
    const frame = () => new Promise((resolve) => setTimeout(resolve, 50));

    equal('shown', text('#shown').replaceAll('\u202f', ' '), '10 000 assets');
    isFew('at the start');
    const start = [...assets.filter((a) => a.status === 'failed'), ...assets.filter((a) => a.status !== 'failed')];
    const begins = (what, order) => {
        isFew(what);
        equal(what, names().slice(0, 100), order.slice(0, 100).map((asset) => asset.source));
    };
    begins('at the start', start);
    click('triangles');
    const byTriangles = [...start].sort((a, b) => (b.triangles ?? -1) - (a.triangles ?? -1));
    begins('most triangles', byTriangles);
    click('seconds');
    begins('longest', [...byTriangles].sort((a, b) => (b.seconds ?? -1) - (a.seconds ?? -1)));
    click('seconds');
    click('seconds');
    begins('at the start again', start);

    // Scrolling brings more, to the end.
    const before = names().length;
    window.scrollTo(0, document.body.scrollHeight);
    for (let i = 0; i < 100 && names().length === before; ++i) await frame();
    equal('more by scrolling', names().length > before, true);
    type('asset04999');
    equal('one of many', names(), ['part04/asset04999.glb']);
    type('part03/');
    begins('a folder', start.filter((asset) => asset.source.startsWith('part03/')));
    equal('how many', text('#shown').replaceAll('\u202f', ' '), '1 000 of 10 000 assets');
    for (let i = 0; i < 200 && names().length < 1000; ++i) {
        window.scrollTo(0, document.body.scrollHeight);
        await frame();
    }
    equal('to the end', [names().length, document.getElementById('more').hidden], [1000, true]);
    // On paper all of them.
    type('part04/');
    isFew('another folder');
    window.dispatchEvent(new Event('beforeprint'));
    equal('on paper', names().length, 1000);
    type('');
    begins('all', start);
    type('asset00001');
    equal('images are those of their assets', all('tbody img').length, 0);
    type('asset00004');
    const [image] = all('tbody img');
    await image.decode();
    equal('image of asset 4', image.naturalWidth, 14);
    equal('complaints', complaints, []);
});
