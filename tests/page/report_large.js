// SPDX-License-Identifier: Apache-2.0
// Checks of large_map_report(1000) (tests/support/map_reports.cpp) as a page: few of its rows are there at a time,
// and all of its points.
'use strict';

probe.run(async () => {
    const { all, complaints, equal, header, names, report, text, type } = probe;
    const { maps } = report();
    const frame = () => new Promise((resolve) => setTimeout(resolve, 50));
    const points = (kind) => Chart.getChart(`${kind}_plot`).data.datasets.find((each) => each.label === 'maps').data;

    equal('shown', text('#shown').replaceAll('\u202f', ' '), '1 000 maps');
    equal('few rows', names().length > 0 && names().length <= 300, true);
    equal('all points', [points('speed').length, points('bytes').length], [1000, 1000]);
    header('bytes').querySelector('button').click();
    const largest = [...maps].sort((a, b) => b.bytes - a.bytes);
    equal('largest', names().slice(0, 100), largest.slice(0, 100).map((map) => map.name));
    // A map far down the table is brought there by its point.
    const last = largest.at(-1);
    const canvas = document.getElementById('bytes_plot');
    canvas.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight', bubbles: true, cancelable: true }));
    await frame();
    equal('chosen by the plot', names()[all('#maps > tbody').findIndex((each) => each.classList.contains('chosen'))], last.name);
    type('part03/');
    equal('a folder', [names().length, points('bytes').length, text('#shown').replaceAll('\u202f', ' ')], [100, 100, '100 of 1 000 maps']);
    type('');
    equal('few rows again', names().length <= 300, true);
    window.dispatchEvent(new Event('beforeprint'));
    equal('all on paper', names().length, 1000);
    equal('complaints', complaints, []);
});
