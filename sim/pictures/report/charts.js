// A chart for each series, over time. The line that marks the moment is shared: with the other charts and with the 3-D view.

const CHART_HEIGHT = 180, LEFT = 52, RIGHT = 10, TOP = 14, BOTTOM = 34;

function svg(parent, tag, attributes, text) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const name of Object.keys(attributes || {})) node.setAttribute(name, attributes[name]);
  if (text !== undefined) node.textContent = text;
  parent.appendChild(node);
  return node;
}

// Powers of ten where all values are above zero and lie more than three decades apart, the first small ones of a start
// from rest left aside; round numbers elsewhere.
function makeScale(values) {
  const finite = Array.from(values).filter(Number.isFinite);
  let low = Infinity, high = -Infinity;
  for (const v of finite) {
    low = Math.min(low, v);
    high = Math.max(high, v);
  }
  if (!finite.length) [low, high] = [0, 1];
  const usual = finite.sort((a, b) => a - b)[Math.floor(finite.length * 0.05)];
  if (low > 0 && high / usual > 1000) return logScale(low, high);
  if (low > 0 && low < 0.6 * high) low = 0; // a bar's worth of honesty: near zero, show zero
  if (low === high) [low, high] = low === 0 ? [0, 1] : [Math.min(0, 2 * low), Math.max(0, 2 * low)];
  const step = niceAbove((high - low) / 4.5);
  const first = Math.floor(low / step + 1e-9), last = Math.ceil(high / step - 1e-9);
  const ticks = Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step);
  const from = ticks[0], to = ticks[ticks.length - 1];
  return { log: false, ticks, share: (v) => (v - from) / (to - from) };
}

function logScale(low, high) {
  const from = Math.floor(Math.log10(low)), to = Math.ceil(Math.log10(high)), stride = Math.ceil((to - from) / 5);
  const ticks = [];
  for (let power = from; power <= to; power += stride) ticks.push(Math.pow(10, power));
  return { log: true, ticks, share: (v) => (Math.log10(v) - from) / (to - from) };
}

function tickText(value, log) {
  if (!log) return shortNumber(value, 6);
  const power = Math.round(Math.log10(value));
  return "10" + [...String(power)].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("");
}

// The lowest and the highest value of each pixel column: no spike is lost, however long the run.
function curvePath(times, values, x, y, width) {
  const perColumn = Math.max(1, Math.floor(values.length / (2 * width)));
  let path = "", pen = "M";
  const put = (k) => {
    if (!Number.isFinite(values[k])) pen = "M";
    else {
      path += pen + x(times[k]).toFixed(1) + " " + y(values[k]).toFixed(1);
      pen = "L";
    }
  };
  for (let start = 0; start < values.length; start += perColumn) {
    let low = start, high = start;
    for (let k = start; k < Math.min(start + perColumn, values.length); ++k) {
      if (values[k] < values[low]) low = k;
      if (values[k] > values[high]) high = k;
    }
    put(Math.min(low, high));
    if (low !== high) put(Math.max(low, high));
  }
  return path;
}

function makeChart(parent, run, series, onHover) {
  const count = Math.min(run.stepTimes.length, series.values.length);
  const times = run.stepTimes.subarray(0, count), values = series.values.subarray(0, count);
  const scale = makeScale(values), card = document.createElement("article");
  card.className = "chart";
  const head = document.createElement("h3"), name = document.createElement("span"), now = document.createElement("b");
  name.textContent = series.name;
  const unit = document.createElement("small");
  unit.textContent = [series.unit, scale.log ? "log scale" : ""].filter(Boolean).join(" · ");
  name.append(unit);
  head.append(name, now);
  card.append(head);
  parent.append(card);
  const picture = svg(card, "svg", { role: "img" });
  picture.setAttribute("aria-label", name.textContent + " over time");
  let width = 0, cursor = null, dot = null, moment = times[0];

  const near = times[0] > 0 && times[0] < 0.1 * times[count - 1]; // the first step's end: the axis begins at 0
  const from = near ? 0 : times[0], to = times[count - 1] > from ? times[count - 1] : from + 1;
  const x = (t) => LEFT + ((t - from) / (to - from)) * (width - LEFT - RIGHT);
  const y = (v) => TOP + (1 - scale.share(v)) * (CHART_HEIGHT - TOP - BOTTOM);

  function drawAxes() {
    const floor = CHART_HEIGHT - BOTTOM;
    for (const tick of scale.ticks) {
      svg(picture, "line", { class: "grid", x1: LEFT, x2: width - RIGHT, y1: y(tick), y2: y(tick) });
      svg(picture, "text", { x: LEFT - 8, y: y(tick) + 4, "text-anchor": "end" }, tickText(tick, scale.log));
    }
    svg(picture, "line", { class: "axis", x1: LEFT, x2: width - RIGHT, y1: floor, y2: floor });
    const step = niceAbove((to - from) / Math.max(2, width / 65));
    for (let k = Math.ceil(from / step - 1e-9); k * step <= to * (1 + 1e-9); ++k)
      svg(picture, "text", { x: x(k * step), y: floor + 15, "text-anchor": "middle" }, shortNumber(k * step));
    svg(picture, "text", { x: (LEFT + width - RIGHT) / 2, y: floor + 30, "text-anchor": "middle" }, "time (s)");
  }

  function draw() {
    width = card.clientWidth - 32;
    if (width < 40) return;
    picture.replaceChildren();
    picture.setAttribute("viewBox", "0 0 " + width + " " + CHART_HEIGHT);
    drawAxes();
    const path = curvePath(times, values, x, y, width);
    if (!scale.log && scale.ticks[0] === 0 && path.indexOf("M", 1) < 0 && path) {
      const ground = y(0).toFixed(1);
      svg(picture, "path", { class: "area", d: path + "L" + x(times[count - 1]).toFixed(1) + " " + ground + "L" + x(times[0]).toFixed(1) + " " + ground + "Z" });
    }
    svg(picture, "path", { class: "curve", d: path });
    cursor = svg(picture, "line", { class: "cursor", y1: TOP, y2: CHART_HEIGHT - BOTTOM });
    dot = svg(picture, "circle", { class: "dot", r: 3.5 });
    mark(moment);
  }

  function mark(time) {
    moment = time;
    const k = lastNotAbove(times, time), at = x(Math.max(from, Math.min(to, time))), value = values[k];
    now.textContent = shortNumber(value) + (series.unit ? " " + series.unit : "");
    if (!cursor) return;
    cursor.setAttribute("x1", at);
    cursor.setAttribute("x2", at);
    const shown = Number.isFinite(value) && time >= from;
    dot.setAttribute("visibility", shown ? "visible" : "hidden");
    if (!shown) return;
    dot.setAttribute("cx", x(times[k]));
    dot.setAttribute("cy", y(value));
  }

  picture.addEventListener("pointermove", (event) => {
    const left = event.clientX - picture.getBoundingClientRect().left;
    onHover(Math.max(from, Math.min(to, from + ((left - LEFT) / (width - LEFT - RIGHT)) * (to - from))));
  });
  picture.addEventListener("pointerleave", () => onHover(null));
  return { draw, mark };
}

function makeCharts(run, onHover) {
  const drawable = run.series.filter((s) => s.values.length > 0 && run.stepTimes.length > 0);
  document.getElementById("over-time").hidden = drawable.length === 0;
  const charts = drawable.map((s) => makeChart(document.getElementById("charts"), run, s, onHover));
  return {
    draw() { for (const chart of charts) chart.draw(); },
    mark(time) { for (const chart of charts) chart.mark(time); },
  };
}
