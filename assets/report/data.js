// The sweep's results, and the arithmetic of the frontier. The same rules as the program's (renderer/measure/frontier.h).
const DATA = JSON.parse(document.getElementById("data").textContent);
const ROWS = DATA.rows;
const byId = id => document.getElementById(id);

/** An element with attributes, text and children; text is never markup. */
function make(name, attributes = {}, ...children) {
  const svg = make.svg.has(name);
  const element = svg ? document.createElementNS("http://www.w3.org/2000/svg", name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
}
make.svg = new Set(["svg", "g", "path", "line", "rect", "text", "circle", "title", "defs", "clipPath"]);

function fieldAt(row, key) {
  let at = row;
  for (const part of key.split(".")) {
    if (at === null || typeof at !== "object") return NaN;
    at = at[part];
  }
  return typeof at === "number" ? at : NaN;
}

// Axes are columns, or "setting:KEY" of a varied setting with numbers.
function settingAxis(key) {
  const info = DATA.setting_info[key] || {};
  return { key: "setting:" + key, label: info.label || key, unit: info.unit || "", help: info.help || "",
    plotted: "as_is", noise: "", bound: "" };
}
const isNumeric = text => text !== "" && Number.isFinite(Number(text));
const NUMERIC_SETTINGS = DATA.axes.filter(a => a.values.every(isNumeric)).map(a => settingAxis(a.key));
const COLUMNS = new Map([...DATA.columns, ...NUMERIC_SETTINGS].map(c => [c.key, c]));

function rawNumber(row, key) {
  return key.startsWith("setting:") ? Number(row.settings[key.slice(8)]) : fieldAt(row, key);
}
/** Whether only an upper bound of a number is known. */
function isBound(row, key) {
  const group = COLUMNS.get(key).bound;
  return !!group && group.split(".").reduce((at, part) => (at ? at[part] : null), row)?.below_noise === true;
}
function plotted(row, key) {
  const value = isBound(row, key) ? Math.max(0, fieldAt(row, COLUMNS.get(key).bound + ".median_high")) : rawNumber(row, key);
  switch (COLUMNS.get(key).plotted) {
    case "absolute": return Math.abs(value);
    case "lacking_to_one": return Math.max(0, 1 - value);
    case "no": return NaN;
    default: return value;
  }
}
const hasNumbers = key => ROWS.some(row => Number.isFinite(plotted(row, key)));
const ERROR_AXES = DATA.columns.filter(c => c.key.startsWith("error.") && hasNumbers(c.key));
const COST_AXES = [...DATA.columns.filter(c => !c.key.startsWith("error.") && hasNumbers(c.key)),
  ...NUMERIC_SETTINGS.filter(c => hasNumbers(c.key))];

function dotsOf(rows, x, y) {
  const noise = (row, key) => {
    const field = COLUMNS.get(key).noise;
    return field ? fieldAt(row, field) || 0 : 0;
  };
  return rows.map(row => ({ row, cost: plotted(row, x), error: plotted(row, y), costNoise: noise(row, x),
    errorNoise: noise(row, y), bound: isBound(row, x), on: false, tied: false }))
    .filter(d => Number.isFinite(d.cost) && Number.isFinite(d.error));
}

// Noise beyond this share of a value is ignorance, which speaks for no dot.
const MOST_ALIKE = 0.03;

/** Whether a is no worse on either axis beyond noise, and better on one. */
function dominates(a, b, withNoise = true) {
  const cost = withNoise ? Math.max(a.costNoise, b.costNoise) : 0;
  const error = withNoise ? Math.max(a.errorNoise, b.errorNoise) : 0;
  return a.cost <= b.cost + Math.min(cost, MOST_ALIKE * b.cost) &&
    a.error <= b.error + Math.min(error, MOST_ALIKE * b.error) &&
    (a.cost < b.cost - cost || a.error < b.error - error);
}

/** Marks what nothing beats; tied is what only noise keeps from being beaten. */
function markFrontier(dots) {
  const likely = [...dots].sort((a, b) => a.error - b.error || a.cost - b.cost);
  for (const dot of dots) {
    dot.on = !likely.some(d => dominates(d, dot));
    dot.tied = dot.on && likely.some(d => dominates(d, dot, false));
  }
  return dots;
}

/** What else the frontier offers to the owner of `present`. */
function advice(present, dots) {
  const cheapest = list => list.reduce((best, d) => (!best || d.cost < best.cost ? d : best), null);
  const on = dots.filter(d => d.on);
  const noise = (d, key) => Math.max(d[key], present[key]);
  return {
    better: cheapest(on.filter(d => d.error < present.error - noise(d, "errorNoise") &&
      d.cost > present.cost + noise(d, "costNoise"))),
    cheaper: cheapest(on.filter(d => d.error <= present.error + noise(d, "errorNoise") &&
      d.cost < present.cost - noise(d, "costNoise"))),
  };
}

/** Least-squares slope of log y over log x. */
function logSlope(points) {
  const p = points.filter(([x, y]) => x > 0 && y > 0).map(([x, y]) => [Math.log(x), Math.log(y)]);
  const mx = p.reduce((s, [x]) => s + x, 0) / p.length, my = p.reduce((s, [, y]) => s + y, 0) / p.length;
  const xx = p.reduce((s, [x]) => s + (x - mx) ** 2, 0), xy = p.reduce((s, [x, y]) => s + (x - mx) * (y - my), 0);
  return xx > 0 ? xy / xx : NaN;
}

/** Three significant digits, with a thousand as 1.00 k where units are not. */
function short(value, unit = "") {
  if (!Number.isFinite(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const prefixes = [[1e9, " G"], [1e6, " M"], [1e4, " k"]];
  for (const [factor, prefix] of prefixes)
    if (size >= factor) return digits(value / (factor === 1e4 ? 1e3 : factor)) + prefix + unit;
  const text = size < 1e-3 ? value.toExponential(1).replace("e-", "\u00b710\u207b").replace(/\u207b(\d+)$/, (m, d) =>
    "\u207b" + [...d].map(c => "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[Number(c)]).join("")) : digits(value);
  return unit ? text + " " + unit : text;
}
function digits(value) {
  return String(Number(value.toPrecision(3)));
}

/** A value of a setting as people say it. */
function valueLabel(key, value) {
  const info = DATA.setting_info[key];
  return (info && info.choices && info.choices[value]) || value;
}
function settingLabel(key) {
  const info = DATA.setting_info[key];
  return (info && info.label) || key;
}
const shortName = row => DATA.axes.map(a => valueLabel(a.key, row.settings[a.key])).join(" \u00b7 ");
