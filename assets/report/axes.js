// Logarithmic axes. Values of zero stand on a line of their own beside the axis, since they have no logarithm.
class LogScale {
  /** @param from, to pixels; the line of zeros lies at `from` when there are zeros. */
  constructor(values, from, to) {
    const positive = values.filter(v => v > 0);
    this.zeros = values.some(v => v === 0);
    let low = Math.min(...positive), high = Math.max(...positive);
    if (!positive.length) low = 0.1, high = 1;
    const room = Math.max(Math.log10(high / low) * 0.07, 0.08);
    this.low = Math.log10(low) - room;
    this.high = Math.log10(high) + room;
    this.zeroAt = from;
    this.from = from + (this.zeros ? Math.sign(to - from) * 34 : 0);
    this.to = to;
  }
  at(value) {
    if (!(value > 0)) return this.zeroAt + Math.sign(this.to - this.zeroAt) * 12;
    return this.from + (Math.log10(value) - this.low) / (this.high - this.low) * (this.to - this.from);
  }
  /** Every fine tick, the ones to be labelled marked: as many as have room. */
  ticks(most) {
    const fine = [];
    for (let e = Math.floor(this.low); e <= Math.ceil(this.high); ++e)
      for (let m = 1; m < 10; ++m) {
        const log = Math.log10(m) + e;
        if (log >= this.low && log <= this.high) fine.push([m, Number((m * 10 ** e).toPrecision(6))]);
      }
    const narrow = this.high - this.low < 0.75;
    for (const steps of [narrow ? [1, 2, 3, 4, 5, 6, 7, 8, 9] : [1, 2, 5], [1, 2, 5], [1, 3], [1]]) {
      const labelled = fine.filter(([m]) => steps.includes(m));
      if (labelled.length <= most || steps.length === 1)
        return fine.map(([m, value]) => ({ value, labelled: steps.includes(m) }));
    }
  }
}

/** The values of a varied setting, where they are few enough to be the ticks. */
function ticksOf(column) {
  const axis = DATA.axes.find(a => "setting:" + a.key === column.key);
  return axis && axis.values.length <= 12 ? axis.values.map(Number) : null;
}

function axisTitle(column) {
  const turned = { absolute: "|" + column.label + "|" }[column.plotted] || column.label;
  return column.unit ? turned + " [" + column.unit + "]" : turned;
}

/** Draws frame, grid and titles into an emptied svg; returns the scales. @param xTicks values to label instead of round ones */
function drawAxes(svg, size, xs, ys, xTitle, yTitle, xTicks = null) {
  const box = { left: 74, right: size.width - 16, top: 12, bottom: size.height - 50 };
  svg.setAttribute("viewBox", "0 0 " + size.width + " " + size.height);
  svg.replaceChildren();
  const x = new LogScale(xs, box.left, box.right), y = new LogScale(ys, box.bottom, box.top);
  const line = (x1, y1, x2, y2, kind) => svg.append(make("line", { x1, y1, x2, y2, class: kind }));
  const word = (text, at, attributes) => svg.append(make("text", { ...at, ...attributes }, text));
  const places = xTicks ? xTicks.filter(v => v > 0).map(value => ({ value, labelled: true })) : x.ticks(11);
  for (const { value, labelled } of places) {
    const px = x.at(value);
    line(px, box.top, px, box.bottom, labelled ? "grid" : "minor");
    if (labelled) word(xTicks ? String(value) : short(value), { x: px, y: box.bottom + 18 }, { class: "tick", "text-anchor": "middle" });
  }
  for (const { value, labelled } of y.ticks(10)) {
    const py = y.at(value);
    line(box.left, py, box.right, py, labelled ? "grid" : "minor");
    if (labelled) word(short(value), { x: box.left - 8, y: py + 4 }, { class: "tick", "text-anchor": "end" });
  }
  if (x.zeros) {
    line(x.from - 8, box.top, x.from - 8, box.bottom, "frame");
    word("0", { x: x.at(0), y: box.bottom + 18 }, { class: "tick", "text-anchor": "middle" });
  }
  if (y.zeros) {
    line(box.left, y.from + 8, box.right, y.from + 8, "frame");
    word("0", { x: box.left - 8, y: y.at(0) + 4 }, { class: "tick", "text-anchor": "end" });
  }
  svg.append(make("rect", { x: box.left, y: box.top, width: box.right - box.left, height: box.bottom - box.top,
    class: "frame" }));
  word(xTitle, { x: (box.left + box.right) / 2, y: size.height - 8 }, { "text-anchor": "middle" });
  word(yTitle, { x: 0, y: 0 }, { "text-anchor": "middle",
    transform: "translate(14 " + (box.top + box.bottom) / 2 + ") rotate(-90)" });
  return { x, y, box };
}

// Series are told apart by colour and by shape, so that neither is needed.
const SHAPES = [
  "M0 -5.2A5.2 5.2 0 1 1 0 5.2A5.2 5.2 0 1 1 0 -5.2Z", "M-4.6 -4.6H4.6V4.6H-4.6Z", "M0 -6L5.6 4.4H-5.6Z",
  "M0 -6.3L6.3 0L0 6.3L-6.3 0Z", "M0 6L5.6 -4.4H-5.6Z", "M-1.9 -5.6H1.9V-1.9H5.6V1.9H1.9V5.6H-1.9V1.9H-5.6V-1.9H-1.9Z",
  "M0 -6L5.7 -1.9L3.5 4.9H-3.5L-5.7 -1.9Z", "M-5.6 -2.4L-2.4 -5.6L0 -2.9L2.4 -5.6L5.6 -2.4L2.9 0L5.6 2.4L2.4 5.6L0 2.9L-2.4 5.6L-5.6 2.4L-2.9 0Z",
];
// From the ninth on the shapes have a hole, and other colours than the first time.
const HOLE = "M0 -2.2A2.2 2.2 0 1 0 0 2.2A2.2 2.2 0 1 0 0 -2.2Z";
const lap = i => Math.floor(i / SHAPES.length);
const seriesColour = i => "var(--s" + ((i + 3 * lap(i)) % 8) + ")";
const seriesShape = i => SHAPES[i % SHAPES.length] + (lap(i) % 2 ? HOLE : "");
