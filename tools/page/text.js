// SPDX-License-Identifier: Apache-2.0
// Numbers and names as text of a page. What comes from strangers becomes text nodes only.
'use strict';

const pageText = (() => {
    const group = (n) => n.toLocaleString('en-US').replaceAll(',', '\u202f');
    const plural = (n, one, many = one + 's') => `${group(n)} ${n === 1 ? one : many}`;

    // A number and its unit, so that the unit can stand back.
    function bytes(n) {
        const units = ['B', 'KiB', 'MiB', 'GiB', 'TiB'];
        let unit = 0;
        for (; n >= 1023.95 && unit + 1 < units.length; ++unit) n /= 1024;
        return [unit === 0 ? String(n) : n.toFixed(1), units[unit]];
    }
    function seconds(s) {
        if (s < 0.0995) return [String(Math.ceil(1000 * s)), 'ms'];
        if (s < 59.95) return [s < 9.995 ? s.toFixed(2) : s.toFixed(1), 's'];
        const all = Math.round(s);
        const pad = (n) => String(n).padStart(2, '0');
        if (all < 3600) return [`${Math.floor(all / 60)}:${pad(all % 60)}`, 'min'];
        return [`${Math.floor(all / 3600)}:${pad(Math.floor(all / 60) % 60)}:${pad(all % 60)}`, 'h'];
    }
    function significant(n) {
        if (n === 0) return ['0', ''];
        return [n < 1e-4 ? n.toExponential(1) : String(Number(n.toPrecision(3))), ''];
    }
    const percent = (decimals) => (share) => [(100 * share).toFixed(decimals), '%'];

    // Controls, marks of direction and what takes no room: a name could hide behind them.
    const unseen = /[\u0000-\u001f\u007f-\u009f\u00ad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200f\u2028-\u202e\u2060-\u206f\u3164\ufe00-\ufe0f\ufeff\uffa0\ufff0-\ufffb]|[\u{e0000}-\u{e0fff}]/u;

    function element(tag, className, ...children) {
        const result = document.createElement(tag);
        if (className) result.className = className;
        result.append(...children);
        return result;
    }

    // Text of which every character is seen.
    function literal(text) {
        const result = document.createElement('bdi');
        let plain = '';
        for (const character of text) {
            if (!unseen.test(character)) {
                plain += character;
                continue;
            }
            const code = character.codePointAt(0).toString(16).toUpperCase().padStart(4, '0');
            result.append(plain, element('span', 'unseen', `U+${code}`));
            plain = '';
        }
        result.append(plain);
        return result;
    }

    function quantity([number, unit]) {
        return element('span', '', number, ...(unit ? [element('span', 'unit', '\u202f' + unit)] : []));
    }

    function fold(summary, content) {
        return element('details', '', element('summary', '', summary), content);
    }

    return { bytes, element, fold, group, literal, percent, plural, quantity, seconds, significant };
})();
