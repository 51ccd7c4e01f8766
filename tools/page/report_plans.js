// SPDX-License-Identifier: Apache-2.0
// Plans of scenes: what became of each object, and why.
'use strict';

const reportPlans = (() => {
    const { bytes, element, group, literal, percent, plural, quantity, significant } = pageText;
    const sized = (n) => bytes(n).join('\u202f');
    const short = (n) => significant(n);

    const order = ['map', 'triangles', 'drop'];
    const signs = { map: '●', triangles: '▲', drop: '○' };

    function columns(plan) {
        const { number, other } = reportTable;
        const byNode = new Map(plan.objects.map((object) => [object.node, object]));
        const name = (object) => object.name ?? `node ${object.node ?? '?'}`;
        const settings = ({ settings: all }) => {
            const { size, layers, parts, ...rest } = all ?? {};
            const cell = element('span', '');
            if (size !== undefined) cell.append(literal(size), layers === undefined ? '' : ` × ${layers}`);
            const more = Object.entries(rest).map(([key, value]) => `${key.replaceAll('_', '-')} ${value}`);
            if (parts !== undefined && parts !== 'whole') more.unshift(`parts ${parts}`);
            if (more.length > 0) cell.append(element('small', '', literal(more.join(', '))));
            return cell;
        };
        const all = [
            other('object', 'Object', 'Node of the scene', name, (object) => {
                const cell = element('span', '', literal(name(object)));
                const same = byNode.get(object.same_as);
                if (same) cell.append(element('small', '', 'shares the map of ', literal(name(same))));
                return cell;
            }),
            other('decision', 'Decision', 'What it becomes', (object) => object.decision,
                (object) => element('span', `is_${order.includes(object.decision) ? object.decision : 'other'}`,
                    `${signs[object.decision] ?? '?'} `, literal(object.decision ?? 'undecided'))),
            number('triangles', 'Triangles', 'Of the object', (object) => object.triangles, (n) => [group(n), '']),
            number('ray_share', 'Rays', 'Share of secondary rays that hit it', (object) => object.ray_share, percent(2)),
            number('tolerance', 'Tolerance', 'Error that nobody sees, in R', (object) => object.tolerance, (n) => [short(n)[0], 'R']),
            other('settings', 'Settings', 'Size × layers of the map, and what else is set',
                (object) => Number.parseInt(object.settings?.size, 10) || null, settings),
            number('expected_bytes', 'Bytes', 'Expected', (object) => object.expected?.bytes ?? null, bytes),
            number('expected_ns', 'Ray', 'Expected time', (object) => object.expected?.ns ?? null, (n) => [n.toFixed(1), 'ns']),
            number('expected_error', 'Error', 'Expected, of the object', (object) => object.expected?.error ?? null, short),
            other('why', 'Why', 'In a sentence', (object) => object.why, (object) => literal(object.why ?? '')),
        ];
        return all.filter((column) => plan.objects.some((object) => column.key(object) !== null));
    }

    function facts(plan) {
        const result = element('dl', 'facts');
        const add = (name, value, below = '') => {
            const text = element('dd', '', quantity(value));
            if (below) text.append(element('small', '', below));
            result.append(element('div', '', element('dt', '', name), text));
        };
        const count = (decision) => plan.objects.filter((object) => object.decision === decision).length;
        add('Objects', [group(plan.objects.length), ''], order.map((each) => `${group(count(each))} ${each}`).join(', '));
        const { expected, request } = plan;
        if (expected?.bytes > 0) {
            const all = expected.bytes_triangles;
            add('Expected size', bytes(expected.bytes), all > 0 ? `${sized(all)} as triangles: ${group(Math.round(all / expected.bytes))} times that` : '');
        }
        if (expected?.bytes_one_size > 0)
            add('With one size for all', bytes(expected.bytes_one_size), plan.one_size === null ? '' : `${plan.one_size} cells`);
        if (expected && expected.image_error !== null) {
            const target = request.target_image_error;
            add('Expected image error', short(expected.image_error), target === null ? '' : `target ${short(target)[0]}`);
        }
        if (request.budget_bytes !== null) add('Budget', bytes(request.budget_bytes));
        if (request.samples !== null) {
            const from = request.camera === null ? '' : request.camera;
            add('Samples', [group(request.samples), ''], request.views === null ? from : plural(request.views, 'view'));
        }
        return result;
    }

    function section(plan) {
        const title = element('h2', '', 'Plan ', literal(plan.name));
        const result = element('section', 'plan', title);
        if (plan.scene !== null) result.append(element('p', 'of', 'of ', literal(plan.scene)));
        if (plan.error !== null) {
            result.append(element('p', 'failed', literal(plan.error)));
            return result;
        }
        result.append(facts(plan));
        const table = element('table', 'objects');
        table.setAttribute('role', 'table');
        result.append(table);
        const decided = (object) => (order.includes(object.decision) ? order.indexOf(object.decision) : order.length);
        const rows = plan.objects.map((object, place) => ({ object, place }))
            .sort((a, b) => decided(a.object) - decided(b.object)
                || (b.object.expected?.bytes ?? 0) - (a.object.expected?.bytes ?? 0) || a.place - b.place)
            .map(({ object }) => object);
        reportTable.make({ table, columns: columns(plan), rows, named: 'object' }).setFilter(() => true);
        if (plan.left_out > 0) result.append(element('p', 'of', `${plural(plan.left_out, 'object')} left out.`));
        return result;
    }

    function show(plans) {
        document.getElementById('plans').append(...plans.map(section));
    }

    return { show };
})();
