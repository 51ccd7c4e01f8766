// SPDX-License-Identifier: Apache-2.0
// Tables whose headers sort them. A column has an id and says whether it is a `number`.
'use strict';

const pageSorting = (() => {
    // As at the start.
    const unsorted = { id: null, descending: false };

    // The three states of a header: largest or first names first, the other way round, as at the start.
    function next(sorted, column) {
        const first = column.number === true;
        if (sorted.id !== column.id) return { id: column.id, descending: first };
        return sorted.descending === first ? { id: column.id, descending: !first } : unsorted;
    }

    // Those whose key is null come last either way; equal ones keep their order.
    function ordered(rows, key, descending) {
        const sign = descending ? -1 : 1;
        const keyed = rows.map((row) => ({ row, key: key(row) }));
        keyed.sort((a, b) => {
            if (a.key === null || b.key === null) return (a.key === null) - (b.key === null);
            return a.key < b.key ? -sign : a.key > b.key ? sign : 0;
        });
        return keyed.map(({ row }) => row);
    }

    // What the headers say of it.
    function mark(cells, sorted) {
        const direction = sorted.descending ? 'descending' : 'ascending';
        for (const cell of cells)
            cell.setAttribute('aria-sort', cell.dataset.column === sorted.id ? direction : 'none');
    }

    return { mark, next, ordered, unsorted };
})();
