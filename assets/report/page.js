// What the page shows, redrawn from `state` whenever a person changes it.
const state = {
  x: DATA.frontier.x, y: DATA.frontier.y, colour: DATA.axes.length ? DATA.axes[0].key : "", filter: "",
  sort: { key: "case", ascending: true }, chosen: null, hovered: null, allRows: false,
};
let dots = [];
const TABLE = tableColumns();

function series(row) {
  const axis = DATA.axes.find(a => a.key === state.colour);
  return axis ? Math.max(0, axis.values.indexOf(row.settings[axis.key])) : 0;
}

function options(select, list, value, change) {
  select.replaceChildren(...list.map(([key, label, help]) => make("option", { value: key, title: help || "" }, label)));
  select.value = value;
  select.addEventListener("change", () => { change(select.value); redraw(); });
}

function header() {
  const p = DATA.picture, title = DATA.scene.name.split("/").pop() + ": what accuracy costs";
  document.title = title;
  byId("title").textContent = title;
  const where = [p.width + " \u00d7 " + p.height + " pixels", DATA.scene.triangles.toLocaleString("en") + " triangles",
    DATA.renderer];
  where.push("reference: a light " + (DATA.truth === "area" ? "with its size" : "as a point or direction"));
  if (DATA.clock) where.push("times: " + DATA.clock + ", " + DATA.rounds + " rounds");
  byId("where").append(where.filter(Boolean).join(" \u00b7 "));
  if (DATA.cpu_rasteriser && DATA.clock)
    byId("where").append(" ", make("span", { class: "badge" }, "CPU rasteriser: times do not predict a GPU"));
  if (!DATA.clock) byId("where").append(" \u00b7 no times were taken");
}

function summary() {
  const on = dots.filter(d => d.on).length, merged = DATA.combinations - DATA.cases, parts = [];
  parts.push(DATA.finished + " of " + DATA.cases + " cases measured");
  if (merged) parts.push(merged + " more combinations differ only in settings without effect");
  if (DATA.failed) parts.push(DATA.failed + " failed");
  parts.push(on + " on the frontier");
  byId("summary").textContent = parts.join("; ") + ".";
}

function caption() {
  const axis = DATA.axes.find(a => a.key === state.colour), box = byId("frontier-caption");
  box.replaceChildren("Lower and further left is better. Coloured: the Pareto front; grey: something is better on one " +
    "axis and no worse on the other. Dashed ring: within noise of a better one. Whiskers: noise of the time. Names: " +
    DATA.axes.map(a => settingLabel(a.key).toLowerCase()).join(" \u00b7 ") + ".");
  if (!axis) return;
  const key = make("div", { class: "key" });
  axis.values.forEach((value, i) => {
    if (!ROWS.some(r => r.settings[axis.key] === value)) return;
    const mark = make("svg", { viewBox: "-8 -8 16 16", style: "width:14px;display:inline-block;vertical-align:-2px" },
      make("path", { d: seriesShape(i), class: "dot", style: "fill:" + seriesColour(i) }));
    key.append(make("span", { class: "plain-line" }, mark, " " + valueLabel(axis.key, value)), "\u2003");
  });
  box.append(key);
}

function pair(label, text) {
  return [make("dt", {}, label), make("dd", {}, text)];
}

/** The cost of a dot; of one below its noise, the bound. */
function costText(dot, unit) {
  return (dot.bound ? "< " : "") + short(dot.cost, unit);
}

function details() {
  const row = state.hovered || state.chosen, box = byId("details");
  if (!row) {
    const unit = COLUMNS.get(state.x).unit;
    box.replaceChildren(make("h3", {}, "The frontier"), make("ol", {}, ...dots.filter(d => d.on)
      .sort((a, b) => a.cost - b.cost).slice(0, 20).map(d => make("li", {}, make("button", { type: "button",
        class: "plain", onclick: () => choose(d.row) }, shortName(d.row)), make("span", { class: "figures" },
        short(d.error) + " at " + costText(d, unit))))), make("p", {}, "Point at a dot for its settings and picture; click to keep it."));
    return;
  }
  const picture = DATA.pictures[row.case] || {}, dot = dots.find(d => d.row === row);
  box.replaceChildren(...(picture.thumbnail ? [make("img", { src: picture.thumbnail, alt: "The picture of this case" })] : []),
    make("h3", {}, shortName(row)));
  if (row.failed) return box.append(make("p", {}, "Failed: " + row.failed));
  const list = make("dl");
  for (const column of [COLUMNS.get(state.y), COLUMNS.get(state.x)]) {
    const noise = column.noise ? fieldAt(row, column.noise) : 0;
    list.append(...pair(column.label.replace("1 - ", ""), short(rawNumber(row, column.key)) + (noise > 0 ? " \u00b1 " +
      short(noise) : "") + (["ms", "px", "B"].includes(column.unit) ? " " + column.unit : "")));
  }
  box.append(list);
  if (dot) box.append(...adviceText(dot).map(t => make("p", {}, t)));
  for (const note of row.notes || []) box.append(make("p", {}, "Note: " + note));
  if (row.command) box.append(make("p", {}, make("code", {}, row.command)));
}

function adviceText(dot) {
  const { better, cheaper } = advice(dot, dots), unit = COLUMNS.get(state.x).unit, out = [];
  out.push(dot.tied ? "On the frontier within noise." : dot.on ? "On the frontier." : "Beaten by another case.");
  if (better) out.push("The next better costs " + short(better.cost - dot.cost, unit) + " more: " + shortName(better.row) + ".");
  if (cheaper) out.push("The same error is to be had for " + short(dot.cost - cheaper.cost, unit) + " less: " +
    shortName(cheaper.row) + ".");
  return out;
}

function gallery() {
  const on = dots.filter(d => d.on).sort((a, b) => a.cost - b.cost);
  const known = on.filter(d => (DATA.pictures[d.row.case] || {}).artefacts);
  byId("gallery").replaceChildren(...known.map(d => make("figure", { "data-case": d.row.case },
    make("img", { src: DATA.pictures[d.row.case].artefacts, alt: "Artefact map", loading: "lazy" }),
    make("figcaption", {}, shortName(d.row) + ": " + short(d.error) + " at " + short(d.cost, COLUMNS.get(state.x).unit)))));
  byId("gallery-section").hidden = !known.length;
  const legend = byId("legend");
  legend.replaceChildren(...DATA.artefact_legend.flatMap(([label, colour]) => [make("span", { class: "swatch",
    style: "background:" + colour }), label]));
  if (known.length < on.length)
    legend.append("\u2003" + (on.length - known.length) + " more are in the folder pictures/ beside this page.");
}

function choose(row) {
  state.chosen = state.chosen === row ? null : row;
  redraw();
}

function redraw() {
  let passes = () => true, note = "";
  try {
    passes = parseFilter(state.filter);
  } catch (e) {
    note = e.message;
  }
  const rows = ROWS.filter(passes);
  if (!note && rows.length < ROWS.length) note = rows.length + " of " + ROWS.length + " cases";
  byId("filter-note").textContent = note;
  const x = COLUMNS.get(state.x), y = COLUMNS.get(state.y);
  dots = markFrontier(dotsOf(rows, state.x, state.y));
  drawFrontier(byId("frontier-plot"), dots, x, y, series, state.chosen);
  summary();
  caption();
  details();
  gallery();
  slopes(rows, y);
  const on = new Set(dots.filter(d => d.on).map(d => d.row.case));
  const shown = fillTable(byId("cases"), TABLE, rows, state.sort, on, state.chosen, state.allRows, choose, key => {
    state.sort = { key, ascending: state.sort.key === key ? !state.sort.ascending : true };
    redraw();
  });
  byId("more").replaceChildren(...(shown < rows.length ? [make("button", { type: "button", class: "plain",
    onclick: () => { state.allRows = true; redraw(); } }, "Show all " + rows.length + " cases")] : []));
}

function slopes(rows, y) {
  const axis = DATA.axes.find(a => a.key === "map.resolution"), section = byId("slopes");
  section.hidden = !axis || axis.values.length < 2;
  if (section.hidden) return;
  const lines = drawSlopes(byId("slope-plot"), rows, y, series);
  byId("slope-table").tBodies[0].replaceChildren(...lines.map(g => make("tr", {}, make("td", {}, g.name),
    make("td", { class: "number" }, Number.isFinite(g.slope) ? g.slope.toFixed(2).replace("-", "\u2212") : "\u2013"))));
}

function start() {
  header();
  options(byId("error-axis"), ERROR_AXES.map(c => [c.key, c.label, c.help]), state.y, v => { state.y = v; });
  options(byId("cost-axis"), COST_AXES.map(c => [c.key, c.label, c.help]), state.x, v => { state.x = v; });
  options(byId("colour-by"), DATA.axes.map(a => [a.key, settingLabel(a.key), a.key]), state.colour,
    v => { state.colour = v; });
  byId("filter").addEventListener("input", e => { state.filter = e.target.value; redraw(); });
  byId("controls").addEventListener("submit", e => e.preventDefault());
  const plot = byId("frontier-plot");
  plot.addEventListener("pointermove", e => {
    const dot = nearestDot(dots, plot, e);
    if ((dot && dot.row) === state.hovered) return;
    state.hovered = dot && dot.row;
    details();
  });
  for (const mark of document.querySelectorAll("#picture .case"))
    mark.addEventListener("click", () => choose(ROWS.find(row => row.case === Number(mark.dataset.case))));
  plot.addEventListener("pointerleave", () => { state.hovered = null; details(); });
  plot.addEventListener("click", e => { const dot = nearestDot(dots, plot, e); if (dot) choose(dot.row); });
  byId("columns").append(...DATA.columns.filter(c => ROWS.some(row => Number.isFinite(rawNumber(row, c.key))))
    .flatMap(c => [make("dt", {}, c.label.replace("1 - ", "") + (c.unit ? " [" + c.unit + "]" : "")),
      make("dd", {}, c.help)]));
  if (location.hash === "#figure") document.body.classList.add("figure");
  redraw();
  if (location.hash === "#selftest") selftest();
}

/** What a test reads from the page: the same actions as a person's, and what they led to. */
function selftest() {
  const listed = selector => [...document.querySelectorAll(selector)].map(e => Number(e.dataset.case));
  const out = { dots: listed("#frontier-plot .dot").length, frontier: dots.filter(d => d.on).map(d => d.row.case),
    tied: dots.filter(d => d.tied).map(d => d.row.case), order: listed("#cases tbody tr"), errors: window.pageErrors };
  out.marks = new Set([...Array(16).keys()].map(i => seriesShape(i))).size;
  const header = TABLE.findIndex(c => c.key === state.y);
  const click = () => document.querySelectorAll("#cases thead button")[header].click();
  click();
  out.ascending = listed("#cases tbody tr");
  click();
  out.descending = listed("#cases tbody tr");
  const axis = DATA.axes[0];
  byId("filter").value = axis ? axis.key + "=" + axis.values[0] : "";
  byId("filter").dispatchEvent(new Event("input"));
  out.filtered = listed("#cases tbody tr");
  out.filtered_dots = listed("#frontier-plot .dot").length;
  byId("filter").value = "nonsense<1";
  byId("filter").dispatchEvent(new Event("input"));
  out.filter_note = byId("filter-note").textContent;
  byId("filter").value = "";
  byId("filter").dispatchEvent(new Event("input"));
  out.axes = {};
  for (const x of COST_AXES) {
    byId("cost-axis").value = x.key;
    byId("cost-axis").dispatchEvent(new Event("change"));
    out.axes[x.key] = listed("#frontier-plot .dot").length;
  }
  byId("cost-axis").value = DATA.frontier.x;
  byId("cost-axis").dispatchEvent(new Event("change"));
  choose(ROWS[0]);
  out.details = byId("details").textContent;
  out.slopes = [...document.querySelectorAll("#slope-table tbody tr")].map(r => [...r.cells].map(c => c.textContent));
  out.gallery = listed("#gallery figure");
  byId("selftest").textContent = JSON.stringify(out);
}

start();
