// What the run left for this page: decoded from the JSON block, turned so that up is +y.

function decode(text, Type) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return new Type(bytes.buffer);
}

// In place, x y z after x y z; the same quarter turn as in mesh.glb.
function turnUpright(positions, up) {
  if (up === "y") return;
  for (let i = 0; i < positions.length; i += 3) {
    const x = positions[i], y = positions[i + 1], z = positions[i + 2];
    if (up === "x") {
      positions[i] = -y;
      positions[i + 1] = x;
    } else {
      positions[i + 1] = z;
      positions[i + 2] = -y;
    }
  }
}

function readRun() {
  const run = JSON.parse(document.getElementById("data").textContent);
  run.triangles = decode(run.triangles, Uint32Array);
  run.uv = decode(run.uv, Float32Array);
  run.springs = decode(run.springs, Uint32Array);
  run.restLengths = decode(run.restLengths, Float32Array);
  run.frameTimes = decode(run.frameTimes, Float64Array);
  run.frameSteps = decode(run.frameSteps, Float64Array);
  run.stepTimes = decode(run.stepTimes, Float64Array);
  for (const series of run.series) series.values = decode(series.values, Float64Array);
  const all = decode(run.frames, Float32Array);
  turnUpright(all, run.up);
  run.frames = Array.from(run.frameTimes, (_, k) => all.subarray(k * run.nodes * 3, (k + 1) * run.nodes * 3));
  return run;
}

// 0.000123 -> "1.23e-4", 1234.5 -> "1234.5": short, and never wider than it needs to be.
function shortNumber(value, digits = 4) {
  if (value === 0) return "0";
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  const text = size >= 1e6 || size < 1e-3
    ? value.toExponential(Math.max(0, digits - 2)).replace(/\.?0+e/, "e").replace("e+", "e")
    : grouped(String(Number(size >= 1000 ? value.toFixed(size < 10000 ? 1 : 0) : value.toPrecision(digits))));
  return text.replace(/-/g, "−");
}

// 45380 -> "45 380": thin spaces from five digits on.
function grouped(text) {
  return /\d{5}/.test(text) ? text.replace(/\B(?=(\d{3})+(?!\d))(?<!\.\d*)/g, "\u202f") : text;
}

// The index of the last entry of a rising list that is not above the value.
function lastNotAbove(list, value) {
  let low = 0, high = list.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (list[middle] <= value) low = middle;
    else high = middle - 1;
  }
  return low;
}
