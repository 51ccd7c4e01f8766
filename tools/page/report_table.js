// SPDX-License-Identifier: Apache-2.0
// Tables that sort by any column and hold thousands of rows, of which few are in the page at a time.
'use strict';

const reportTable = (() => {
    const { element, plural, quantity } = pageText;

    // Rows that are added at once, as the reader comes near the end of those that are there.
    const chunk = 100;

    // A column of numbers: key(row) is what it sorts by, null where there is none; text(key, row) the number and
    // its unit.
    const number = (id, label, title, key, text) => ({ id, label, title, key, text, number: true });
    // A column of something else: cell(row) makes what is in it.
    const other = (id, label, title, key, cell) => ({ id, label, title, key, cell });

    // table: an empty <table>. rows: anything. named: "map", for what is said of rows that are not there yet.
    // lead(row): a first cell without a header, or null; under(row): what stands below the row, or null.
    // made(row, body): called for each row that comes into the page, changed(rows) after the order or the filter
    // changed. There are no rows before setFilter is called.
    function make({ table, columns, rows, named, lead = null, under = () => null, made = () => {}, changed = () => {} }) {
        let order = [...rows];
        let shown = order;
        let sorted = pageSorting.unsorted;
        let filter = () => true;
        let present = 0; // of `shown`, those in the page
        const bodies = new Map();

        const head = table.createTHead();
        const headRow = head.insertRow();
        const more = element('p', 'more');
        table.after(more);
        const nearEnd = new IntersectionObserver((entries) => {
            if (entries.some((entry) => entry.isIntersecting)) append(chunk);
        }, { rootMargin: '1500px' });

        function valueCell(column, row) {
            const key = column.key(row);
            const cell = element('td', column.number ? 'value number' : (column.cell ? column.id : 'value'));
            cell.dataset.label = column.label;
            if (!column.number) cell.append(column.cell(row));
            else if (key === null) cell.classList.add('empty');
            else cell.append(quantity(column.text(key, row)));
            return cell;
        }

        // A <tbody> a row: so that what stands below it goes with it.
        function body(row) {
            const line = element('tr', 'row', ...columns.map((column) => valueCell(column, row)));
            const result = element('tbody', '', line);
            const first = lead?.(row);
            if (first) line.prepend(first);
            const below = under(row);
            if (below) {
                const cell = element('td', '', below);
                cell.colSpan = columns.length + (first ? 1 : 0);
                result.append(element('tr', 'said', cell));
            }
            roles(result, 'cell');
            return result;
        }

        // Where styles take the display of tables away, browsers forget that they are some.
        function roles(group, role) {
            group.setAttribute('role', 'rowgroup');
            for (const tr of group.rows) {
                tr.setAttribute('role', 'row');
                for (const cell of tr.cells) cell.setAttribute('role', role);
            }
        }

        function append(count) {
            const end = Math.min(present + count, shown.length);
            const fragment = document.createDocumentFragment();
            for (; present < end; ++present) {
                const row = shown[present];
                bodies.set(row, body(row));
                made(row, bodies.get(row));
                fragment.append(bodies.get(row));
            }
            table.append(fragment);
            more.hidden = present === shown.length;
            more.textContent = `${plural(shown.length - present, `more ${named}`)} below`;
            // Anew, so that it is called again if the end is near still.
            nearEnd.unobserve(more);
            nearEnd.observe(more);
        }

        function show() {
            shown = order.filter(filter);
            for (const old of [...table.tBodies]) old.remove();
            bodies.clear();
            present = 0;
            append(chunk);
            changed(shown);
        }

        function toggleSort(column) {
            sorted = pageSorting.next(sorted, column);
            order = sorted.id === null ? [...rows] : pageSorting.ordered(order, column.key, sorted.descending);
            pageSorting.mark(headRow.querySelectorAll('th'), sorted);
            show();
        }

        if (lead) headRow.append(element('td', 'picture'));
        for (const column of columns) {
            const button = element('button', '', column.label);
            button.type = 'button';
            button.title = column.title;
            button.addEventListener('click', () => toggleSort(column));
            const cell = element('th', column.number ? 'number' : '', button);
            cell.dataset.column = column.id;
            cell.setAttribute('aria-sort', 'none');
            headRow.append(cell);
        }
        roles(head, 'columnheader');
        // On paper nobody scrolls.
        window.addEventListener('beforeprint', () => append(Infinity));

        return {
            setFilter(value) {
                filter = value;
                show();
            },
            // The row's <tbody>, brought into the page first; null if the filter leaves it out.
            bodyOf(row) {
                const place = shown.indexOf(row);
                if (place < 0) return null;
                if (place >= present) append(place + 1 - present);
                return bodies.get(row);
            },
        };
    }

    return { make, number, other };
})();
