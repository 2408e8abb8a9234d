// The table of all cases: sorted by a click on a column, filtered by words and comparisons.
const MOST_ROWS = 500;

/** A filter's words: "pcf3", "map.resolution=512", "mae<0.01". Returns whether a row passes all; throws on nonsense. */
function parseFilter(text) {
  const tests = text.trim().split(/\s+/).filter(Boolean).map(word => {
    const compare = /^([\w.]+)(<=|>=|<|>)(.+)$/.exec(word);
    if (!compare) {
      const low = word.toLowerCase();
      return row => DATA.axes.some(a => (a.key + "=" + row.settings[a.key]).toLowerCase().includes(low) ||
        valueLabel(a.key, row.settings[a.key]).toLowerCase().includes(low));
    }
    const [, name, operator, limit] = compare;
    const column = [...COLUMNS.values()].find(c => c.key === name || c.key === "setting:" + name ||
      c.key.split(".").includes(name));
    if (!column) throw new Error("no number is called " + name);
    if (!isNumeric(limit)) throw new Error(limit + " is no number");
    const bound = Number(limit);
    const holds = { "<": v => v < bound, "<=": v => v <= bound, ">": v => v > bound, ">=": v => v >= bound }[operator];
    return row => holds(rawNumber(row, column.key));
  });
  return row => tests.every(test => test(row));
}

function tableColumns() {
  const settings = DATA.axes.map(a => ({ key: "setting:" + a.key, title: settingLabel(a.key), help: a.key,
    number: a.values.every(isNumeric), value: row => a.values.every(isNumeric) ? Number(row.settings[a.key]) :
      a.values.indexOf(row.settings[a.key]), text: row => valueLabel(a.key, row.settings[a.key]) }));
  const numbers = DATA.columns.filter(c => ROWS.some(row => Number.isFinite(rawNumber(row, c.key)))).map(c => ({
    key: c.key, title: c.label.replace("1 - ", "") + (c.unit === "ms" || c.unit === "px" || c.unit === "B" ?
      " [" + c.unit + "]" : ""), help: c.help, number: true, value: row => rawNumber(row, c.key),
    text: row => short(rawNumber(row, c.key)) }));
  const failed = { key: "failed", title: "Failed", help: "Why there are no numbers.", value: row => row.failed || "",
    text: row => row.failed || "", why: true };
  return [{ key: "case", title: "Case", help: "Its number in the sweep.", number: true, value: row => row.case,
    text: row => String(row.case) }, ...settings, ...numbers, ...(ROWS.some(r => r.failed) ? [failed] : [])];
}

function sortRows(rows, column, ascending) {
  const missing = v => v === "" || (typeof v === "number" && Number.isNaN(v));
  return [...rows].sort((a, b) => {
    const va = column.value(a), vb = column.value(b);
    if (missing(va) || missing(vb)) return missing(va) - missing(vb) || a.case - b.case;
    return (va < vb ? -1 : va > vb ? 1 : 0) * (ascending ? 1 : -1) || a.case - b.case;
  });
}

/** @param on cases of the frontier; choose called with the row clicked */
function fillTable(table, columns, rows, sort, on, chosen, all, choose, resort) {
  table.tHead.replaceChildren(make("tr", {}, ...columns.map(c => {
    const head = make("th", { scope: "col", class: c.number ? "number" : "", title: c.help },
      make("button", { type: "button", onclick: () => resort(c.key) }, c.title));
    if (sort.key === c.key) head.setAttribute("aria-sort", sort.ascending ? "ascending" : "descending");
    return head;
  })));
  const sorted = sortRows(rows, columns.find(c => c.key === sort.key), sort.ascending);
  const shown = all ? sorted : sorted.slice(0, MOST_ROWS);
  table.tBodies[0].replaceChildren(...shown.map(row => make("tr", {
    class: (on.has(row.case) ? "on" : "beaten") + (row === chosen ? " chosen" : ""), "data-case": row.case,
    onclick: () => choose(row),
  }, ...columns.map(c => make("td", { class: c.why ? "why" : c.number ? "number" : "" }, c.text(row))))));
  return shown.length;
}
