// SPDX-License-Identifier: Apache-2.0
// Runs before the page's own script: notes what goes wrong, and brings what checks need.
'use strict';

const probe = (() => {
    let checks = 0;
    const failures = [];
    const complaints = []; // of the browser: errors, refusals by the policy, what is said on the console

    window.addEventListener('error', (event) => complaints.push(`error: ${event.message}`), true);
    window.addEventListener('unhandledrejection', (event) => complaints.push(`rejection: ${event.reason}`));
    document.addEventListener('securitypolicyviolation', (event) => {
        complaints.push(`policy: ${event.violatedDirective} ${event.blockedURI}`);
    });
    for (const level of ['error', 'warn', 'log']) console[level] = (...words) => complaints.push(words.join(' '));

    // Without a screen, and with a clock that jumps, the browser may never come to its next frame.
    window.requestAnimationFrame = (callback) => setTimeout(() => callback(performance.now()), 16);

    function equal(what, value, expected) {
        ++checks;
        const [a, b] = [value, expected].map((each) => JSON.stringify(each));
        if (a !== b) failures.push(`${what}: ${a}, not ${b}`);
    }
    const all = (selector, within = document) => [...within.querySelectorAll(selector)];
    const text = (selector) => document.querySelector(selector).textContent;
    const report = () => JSON.parse(text('#report'));
    const header = (id) => document.querySelector(`th[data-column="${id}"]`);

    // The characters that the page shows as their numbers, as themselves.
    function raw(node) {
        const copy = node.cloneNode(true);
        for (const each of all('.unseen', copy))
            each.replaceWith(String.fromCodePoint(Number.parseInt(each.textContent.slice(2), 16)));
        return copy.textContent;
    }
    // The assets' names in the order of the table.
    const names = () => all('tbody td.source').map((cell) => {
        const [name, folder] = all('bdi', cell);
        return (folder ? raw(folder) : '') + raw(name);
    });

    function type(words) {
        const box = document.getElementById('filter');
        box.value = words;
        box.dispatchEvent(new Event('input', { bubbles: true }));
    }
    const chip = (id) => document.querySelector(`#chips button[data-filter="${id}"]`);

    // One click on a header. The order that must follow: values in order, no value last, equal ones as before.
    function checkSort(id, value, direction) {
        const before = names();
        header(id).querySelector('button').click();
        equal(`aria-sort of ${id}`, header(id).getAttribute('aria-sort'), direction);
        equal(`headers sorted by, ${id}`, all('th:not([aria-sort="none"])').length, 1);
        const byName = new Map(report().assets.map((asset) => [asset.source, value(asset)]));
        const sign = direction === 'descending' ? -1 : 1;
        const expected = before.map((name, place) => ({ name, place, value: byName.get(name) })).sort((a, b) => {
            if (a.value === b.value) return a.place - b.place;
            if (a.value === null) return 1;
            if (b.value === null) return -1;
            return a.value < b.value ? -sign : sign;
        });
        equal(`${id} ${direction}`, names(), expected.map(({ name }) => name));
    }

    function finish() {
        const result = document.createElement('pre');
        result.id = 'findings';
        result.textContent = JSON.stringify({ checks, failures });
        document.body.append(result);
    }
    // Runs the checks; an error of theirs is a failure too.
    async function run(body) {
        try {
            await body();
        } catch (error) {
            failures.push(`${error}\n${error.stack}`);
        }
        finish();
    }

    return { all, checkSort, chip, complaints, equal, header, names, raw, report, run, text, type };
})();
