// SPDX-License-Identifier: Apache-2.0
// What stands below a map's row: its images, its sections, how it was baked, what was tried.
'use strict';

const reportDetails = (() => {
    const { bytes, element, group, literal, plural, significant } = pageText;
    const sized = (n) => bytes(n).join('\u202f');

    function list(title, pairs) {
        const items = pairs.map(([name, value]) => element('div', '', element('dt', '', literal(name)), element('dd', '', value)));
        return element('section', '', element('h3', '', title), element('dl', 'pairs', ...items));
    }

    // Columns of numbers.
    const numbers = ['Stored', 'Decoded', 'Bytes', 'Error'];

    function plainTable(title, head, rows) {
        const table = element('table', 'plain');
        table.append(element('thead', '', element('tr', '', ...head.map((text) => element('th', numbers.includes(text) ? 'number' : '', text)))));
        table.append(element('tbody', '', ...rows));
        return element('section', '', element('h3', '', title), table);
    }

    function sections(map) {
        const rows = map.sections.map((section) => {
            const meter = element('meter');
            meter.max = Math.max(1, map.bytes);
            meter.value = section.stored_bytes;
            meter.title = `${group(section.stored_bytes)} of ${group(map.bytes)} bytes`;
            return element('tr', '',
                element('td', '', literal(section.type), section.count > 1 ? ` × ${section.count}` : ''),
                element('td', '', meter),
                element('td', 'number', sized(section.stored_bytes)),
                element('td', 'number', sized(section.raw_bytes)));
        });
        return plainTable('Sections', ['Type', '', 'Stored', 'Decoded'], rows);
    }

    function facts(map) {
        const image = (each) => (each ? `${each.size.replace('x', '×')} ${each.format}` : 'none');
        const pairs = [['file', literal(map.path)], ['container version', literal(map.version)],
            ['parts', group(map.shape.parts)], ['depth', image(map.shape.depth)], ['colour', image(map.shape.color)],
            ['normals', image(map.shape.normals)]];
        if (map.speed?.map) pairs.push(['traced bytes', sized(map.speed.map.bytes)]);
        if (map.speed?.triangles) pairs.push(['bytes of the triangles’ hierarchy', sized(map.speed.triangles.bytes)]);
        if (map.source) {
            pairs.push(['source', literal(map.source.name ?? '?')]);
            if (map.source.bytes !== null) pairs.push(['bytes of the source', sized(map.source.bytes)]);
        }
        if (map.errors) pairs.push(['errors from', map.errors.from === 'file' ? 'the file' : 'rays through the source']);
        return list('Map', pairs);
    }

    function settings(map) {
        if (map.settings === null || Object.keys(map.settings).length === 0) return null;
        return list('Baked with', Object.entries(map.settings).map(([name, value]) => [name.replaceAll('_', '-'), literal(value)]));
    }

    // Of the settings only those in which the candidates differ.
    function search(map) {
        const { search: found } = map;
        if (found === null) return null;
        const all = found.candidates;
        const names = [...new Set(all.flatMap((each) => Object.keys(each.settings ?? {})))]
            .filter((name) => new Set(all.map((each) => each.settings?.[name])).size > 1);
        const rows = all.map((each, i) => element('tr', i === found.chosen ? 'chosen' : '',
            element('td', '', i === found.chosen ? '✓ chosen' : ''),
            ...names.map((name) => element('td', '', literal(each.settings?.[name] ?? ''))),
            element('td', 'number', each.bytes === null ? '' : sized(each.bytes)),
            element('td', 'number', each.error === null ? '' : significant(each.error)[0]),
            element('td', '', each.met === null ? '' : each.met ? 'met' : 'missed')));
        const section = plainTable('Tried', ['', ...names.map((name) => name.replaceAll('_', '-')), 'Bytes', 'Error', 'Target'], rows);
        section.insertBefore(why(found), section.children[1]);
        return section;
    }

    function why(found) {
        const sentence = element('p', 'why', 'Asked for ', literal(found.metric ?? 'error'), ' of at most ',
            found.target === null ? '?' : significant(found.target)[0]);
        if (found.max_bytes !== null) sentence.append(` in at most ${sized(found.max_bytes)}`);
        sentence.append(`; ${plural(found.candidates.length, 'candidate')} tried, cheapest first`);
        const chosen = found.candidates[found.chosen];
        if (chosen && chosen.error !== null)
            sentence.append(`; the chosen one has ${significant(chosen.error)[0]}`);
        if (found.stopped_by !== null) sentence.append('; stopped by ', literal(found.stopped_by));
        sentence.append('.');
        return sentence;
    }

    function sheet(index, map) {
        const data = document.getElementById(`sheet-${index}`)?.textContent;
        if (!data) return null;
        const image = document.createElement('img');
        image.src = 'data:image/png;base64,' + data;
        image.alt = `The images of ${map.name}, coarser than they are`;
        const link = element('figure', 'sheet', image);
        return link;
    }

    // Everything, made when it is asked for.
    function of({ map, index }) {
        const result = element('div', 'details');
        const pieces = [sheet(index, map), search(map), facts(map), settings(map), sections(map)];
        result.append(...pieces.filter((piece) => piece !== null));
        return result;
    }

    return { of };
})();
