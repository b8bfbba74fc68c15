// The mesh at a moment: places between two frames, normals, strain and its colours. Knows nothing of how it is drawn.

// Squeezed, at rest, stretched.
const STRAIN_COLOURS = [[38, 92, 158], [243, 240, 232], [189, 73, 40]];

function strainColour(share) { // -1 ... 1
  const t = Math.max(-1, Math.min(1, Number.isFinite(share) ? share : 1));
  const end = STRAIN_COLOURS[t < 0 ? 0 : 2], rest = STRAIN_COLOURS[1];
  return rest.map((c, k) => c + (end[k] - c) * Math.abs(t));
}

// 1, 2 or 5 times a power of ten, not below the value.
function niceAbove(value) {
  const power = Math.pow(10, Math.floor(Math.log10(value)));
  return [1, 2, 5, 10].map((m) => m * power).find((m) => m >= value * 0.999) || value;
}

function makeSurface(run) {
  const nodes = run.nodes, springs = run.springs, triangles = run.triangles;
  const surface = {
    positions: new Float32Array(nodes * 3),
    normals: new Float32Array(nodes * 3),
    strains: new Float32Array(nodes), // mean over the node's springs
    springStrains: new Float32Array(springs.length / 2),
    strainRange: 0.01,
  };
  const springsOf = new Float32Array(nodes);
  for (const node of springs) springsOf[node] += 1;

  const lengthOf = (p, s) => {
    const a = springs[2 * s] * 3, b = springs[2 * s + 1] * 3;
    return Math.hypot(p[a] - p[b], p[a + 1] - p[b + 1], p[a + 2] - p[b + 2]);
  };
  // A spring without a rest length has no strain of its own: its first length takes the place.
  const unstrained = Float32Array.from(run.restLengths, (rest, s) => rest || lengthOf(run.frames[0], s) || 1);
  surface.restIsFirstFrame = run.restLengths.length > 0 && run.restLengths.every((rest) => rest === 0);

  surface.measureStrain = function (p) {
    surface.strains.fill(0);
    for (let s = 0; s < unstrained.length; ++s) {
      const strain = lengthOf(p, s) / unstrained[s] - 1;
      surface.springStrains[s] = strain;
      surface.strains[springs[2 * s]] += strain;
      surface.strains[springs[2 * s + 1]] += strain;
    }
    for (let n = 0; n < nodes; ++n) surface.strains[n] /= springsOf[n] || 1;
  };

  function sumNormals(p) {
    const out = surface.normals.fill(0);
    for (let i = 0; i < triangles.length; i += 3) {
      const a = triangles[i] * 3, b = triangles[i + 1] * 3, c = triangles[i + 2] * 3;
      const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
      const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      for (const k of [a, b, c]) {
        out[k] += nx;
        out[k + 1] += ny;
        out[k + 2] += nz;
      }
    }
    for (let k = 0; k < out.length; k += 3) {
      const size = Math.hypot(out[k], out[k + 1], out[k + 2]) || 1;
      out[k] /= size;
      out[k + 1] /= size;
      out[k + 2] /= size;
    }
  }

  // Straight from one frame to the next.
  surface.moveTo = function (time) {
    const k = lastNotAbove(run.frameTimes, time), next = Math.min(k + 1, run.frames.length - 1);
    const span = run.frameTimes[next] - run.frameTimes[k];
    const t = span > 0 ? Math.max(0, Math.min(1, (time - run.frameTimes[k]) / span)) : 0;
    const a = run.frames[k], b = run.frames[next], out = surface.positions;
    for (let i = 0; i < out.length; ++i) out[i] = t === 0 ? a[i] : a[i] + (b[i] - a[i]) * t;
    sumNormals(out);
    surface.measureStrain(out);
    return k;
  };

  surface.strainRange = rangeOfStrain(run, surface);
  surface.bounds = boundsOf(run);
  return surface;
}

// The scale's end: beyond all but the last hundredth of what two dozen frames show; of a motion that diverged, half.
function rangeOfStrain(run, surface) {
  const sizes = [];
  const stride = Math.max(1, Math.floor(run.frames.length / 24));
  for (let k = 0; k < run.frames.length; k += stride) {
    surface.measureStrain(run.frames[k]);
    for (const strain of surface.strains) if (Number.isFinite(strain)) sizes.push(Math.abs(strain));
  }
  sizes.sort((a, b) => a - b);
  return niceAbove(Math.max(sizes[Math.floor(sizes.length * (run.good ? 0.99 : 0.5))] || 0, 1e-6));
}

// The box of the whole motion; what a diverging run throws far away does not count.
function boundsOf(run) {
  const start = boxOf(run.frames.slice(0, 1), [0, 0, 0], Infinity);
  const size = Math.hypot(...start.high.map((h, k) => h - start.low[k])) || 1;
  const centre = start.high.map((h, k) => (h + start.low[k]) / 2);
  const box = boxOf(run.frames, centre, run.good ? Infinity : 0.8 * size);
  box.size = Math.hypot(...box.high.map((h, k) => h - box.low[k])) || 1;
  return box;
}

function boxOf(frames, centre, reach) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const frame of frames)
    for (let i = 0; i < frame.length; ++i) {
      if (!Number.isFinite(frame[i]) || Math.abs(frame[i] - centre[i % 3]) > reach) continue;
      low[i % 3] = Math.min(low[i % 3], frame[i]);
      high[i % 3] = Math.max(high[i % 3], frame[i]);
    }
  return Number.isFinite(low[0] + low[1] + low[2]) ? { low, high } : { low: [-1, -1, -1], high: [1, 1, 1] };
}

// Pinned nodes in one line hang from a pole (upright: it stands on the floor) or a rod: its two ends, or null.
function poleOf(run, bounds) {
  const at = (n) => Array.from(run.frames[0].subarray(n * 3, n * 3 + 3));
  if (run.pinned.length < 3) return null;
  const a = at(run.pinned[0]), b = at(run.pinned[run.pinned.length - 1]);
  const d = b.map((v, k) => v - a[k]), length = Math.hypot(...d);
  if (!(length > 0)) return null;
  for (const n of run.pinned) {
    const p = at(n).map((v, k) => v - a[k]), along = (p[0] * d[0] + p[1] * d[1] + p[2] * d[2]) / length;
    if (Math.hypot(...p.map((v, k) => v - (along * d[k]) / length)) > 1e-3 * length) return null;
  }
  const [low, high] = a[1] < b[1] ? [a, b] : [b, a];
  const upright = (high[1] - low[1]) / length > 0.99;
  const floor = floorOf(bounds), over = 0.05 * length;
  const beyond = (p, sign) => p.map((v, k) => v + (sign * over * (high[k] - low[k])) / length);
  return { upright, ends: [upright ? [low[0], floor, low[2]] : beyond(low, -1), beyond(high, 1)] };
}

// What the camera looks at: the motion and the pole it hangs from.
function sceneBox(run, bounds) {
  const pole = poleOf(run, bounds), low = bounds.low.slice(), high = bounds.high.slice();
  for (const end of pole ? pole.ends : [])
    for (const k of [0, 1, 2]) {
      low[k] = Math.min(low[k], end[k]);
      high[k] = Math.max(high[k], end[k]);
    }
  return { low, high, size: bounds.size };
}

function floorOf(bounds) { return bounds.low[1] - 0.06 * bounds.size; }
