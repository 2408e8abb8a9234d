// The plot of error over cost: every case a dot, the frontier as a stair.
const PLOT = { width: 940, height: 560 };

/** The dot nearest to a place in the plot within some pixels. */
function nearestDot(shown, svg, event) {
  const area = svg.getBoundingClientRect(), scale = PLOT.width / area.width;
  const px = (event.clientX - area.left) * scale, py = (event.clientY - area.top) * scale;
  let best = null, least = 26 ** 2;
  for (const dot of shown) {
    const d = (dot.px - px) ** 2 + (dot.py - py) ** 2;
    if (d < least) best = dot, least = d;
  }
  return best;
}

/** Names beside the dots of the frontier where there is room for them. */
function placeLabels(svg, dots, box) {
  const taken = dots.map(d => [d.px - 7, d.py - 7, d.px + 7, d.py + 7]);
  const free = r => r[0] >= box.left && r[2] <= box.right && r[1] >= box.top && r[3] <= box.bottom &&
    !taken.some(t => r[0] < t[2] && t[0] < r[2] && r[1] < t[3] && t[1] < r[3]);
  for (const dot of dots.filter(d => d.on).sort((a, b) => a.tied - b.tied || a.px - b.px)) {
    const text = shortName(dot.row), width = text.length * 6.6, height = 14;
    const places = [[11, -height - 3], [11, -height / 2], [-width / 2, -height - 10], [11, 5], [-width - 11, 4],
      [-width - 11, -height - 3], [-width / 2, 10]];
    for (const [dx, dy] of places) {
      const r = [dot.px + dx, dot.py + dy, dot.px + dx + width, dot.py + dy + height];
      if (!free(r)) continue;
      taken.push(r);
      svg.append(make("text", { x: r[0], y: r[3] - 3, class: "label" }, text));
      break;
    }
  }
}

function stairs(dots, box) {
  const best = dots.filter(d => d.on && !d.tied).sort((a, b) => a.px - b.px || b.py - a.py);
  if (!best.length) return "";
  let path = "M" + best[0].px + " " + box.top + "V" + best[0].py;
  for (const d of best.slice(1)) path += "H" + d.px + "V" + d.py;
  return path + "H" + box.right;
}

function noiseBand(svg, dots, scales) {
  const noise = dots.map(d => d.errorNoise).filter(n => n > 0).sort((a, b) => a - b);
  if (!noise.length) return;
  const { y, box } = scales, top = Math.min(Math.max(y.at(noise[noise.length >> 1]), box.top), box.bottom);
  if (box.bottom - top < 1) return;
  svg.append(make("rect", { x: box.left, y: top, width: box.right - box.left, height: box.bottom - top,
    class: "noise" }, make("title", {}, "Below the noise of the ray-traced reference: differences here have no meaning.")));
}

/** Draws `dots` (marked); returns them with their places. @param series number of a row's series */
function drawFrontier(svg, dots, xColumn, yColumn, series, chosen) {
  const scales = drawAxes(svg, PLOT, dots.map(d => d.cost), dots.map(d => d.error), axisTitle(xColumn),
    axisTitle(yColumn), ticksOf(xColumn));
  const { x, y, box } = scales;
  noiseBand(svg, dots, scales);
  for (const d of dots) d.px = x.at(d.cost), d.py = y.at(d.error);
  svg.append(make("path", { d: stairs(dots, box), class: "stairs", id: "frontier-line" }));
  const whisker = d => make("line", { x1: Math.max(x.at(Math.max(d.cost - d.costNoise, d.cost / 10)), box.left),
    x2: Math.min(x.at(d.cost + d.costNoise), box.right), y1: d.py, y2: d.py, class: "whisker" });
  for (const d of [...dots].sort((a, b) => a.on - b.on)) {
    if (d.costNoise > 0 && (d.on || d.row === chosen)) svg.append(whisker(d));
    const i = series(d.row);
    const mark = make("path", { d: seriesShape(i), transform: "translate(" + d.px + " " + d.py + ")",
      class: "dot" + (d.on ? "" : " beaten") + (d.row === chosen ? " chosen" : ""), "data-case": d.row.case });
    if (d.on && d.bound) mark.style.fill = "var(--page)", mark.style.stroke = seriesColour(i);
    else if (d.on) mark.style.fill = seriesColour(i);
    if (d.row === chosen && !d.on) mark.style.fill = seriesColour(i), mark.style.fillOpacity = 1;
    svg.append(mark);
    if (d.tied) svg.append(make("circle", { cx: d.px, cy: d.py, r: 9.5, class: "tie" }));
  }
  placeLabels(svg, dots, box);
}

/** Error over resolution, one line a series of cases that differ in nothing else; rows of the table of slopes. */
function drawSlopes(svg, rows, yColumn, series) {
  const key = "map.resolution", groups = new Map();
  for (const row of rows) {
    const error = plotted(row, yColumn.key), n = Number(row.settings[key]);
    if (!Number.isFinite(error) || !Number.isFinite(n)) continue;
    const rest = DATA.axes.filter(a => a.key !== key);
    const name = rest.map(a => valueLabel(a.key, row.settings[a.key])).join(" \u00b7 ") || DATA.scene.name;
    if (!groups.has(name)) groups.set(name, { name, series: series(row), points: [] });
    groups.get(name).points.push([n, error, row]);
  }
  const lines = [...groups.values()].filter(g => g.points.length > 1);
  const all = lines.flatMap(g => g.points);
  const { x, y, box } = drawAxes(svg, { width: 940, height: 460 }, all.map(p => p[0]), all.map(p => p[1]),
    "Map resolution [texels]", axisTitle(yColumn), ticksOf(COLUMNS.get("setting:" + key)));
  const positive = all.filter(p => p[1] > 0).sort((a, b) => a[0] - b[0] || b[1] - a[1]);
  if (positive.length) {
    const n0 = positive[0][0], e0 = Math.min(positive[0][1] * 1.25, 10 ** y.high);  // clear of the first dot
    const end = Math.min(10 ** x.high, n0 * e0 / 10 ** y.low), near = n0 * (end / n0) ** 0.06;
    svg.append(make("path", { d: "M" + x.at(n0) + " " + y.at(e0) + "L" + x.at(end) + " " + y.at(e0 * n0 / end),
      class: "guide", id: "slope-guide" }));
    svg.append(make("text", { x: x.at(near) + 8, y: y.at(e0 * n0 / near) - 6, class: "label" }, "slope \u22121"));
  }
  for (const g of lines) {
    g.points.sort((a, b) => a[0] - b[0]);
    g.slope = logSlope(g.points);
    const path = make("path", { d: "M" + g.points.map(p => x.at(p[0]) + " " + y.at(p[1])).join("L"), class: "series" });
    path.style.stroke = seriesColour(g.series);
    svg.append(path);
    for (const [n, e] of g.points) {
      const mark = make("path", { d: seriesShape(g.series), class: "dot",
        transform: "translate(" + x.at(n) + " " + y.at(e) + ") scale(.8)" }, make("title", {}, g.name + ", " + n));
      mark.style.fill = seriesColour(g.series);
      svg.append(mark);
    }
  }
  return lines;
}
