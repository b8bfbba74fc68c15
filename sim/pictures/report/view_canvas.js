// Draws the surface on a plain 2-D canvas: for browsers without WebGL and for pages written without three.js.

const TEXTURED_AT_MOST = 4000; // triangles; beyond that each takes one colour of the picture
const SHADES = 20, DARKEST = 0.62; // copies of the picture, from dark to full light

function makeCanvasView(holder, run, surface) {
  const canvas = document.createElement("canvas"), ink = canvas.getContext("2d");
  const pole = poleOf(run, surface.bounds), screen = new Float32Array(run.nodes * 3), light = [-0.49, 0.66, 0.56];
  const picture = run.crest ? readPicture(run.crestImage) : null;
  let width = 1, height = 1, project = null;
  holder.prepend(canvas);

  function projector(camera) {
    const { back, right, up } = camera.axes(), eye = camera.eye();
    const zoom = height / 2 / Math.tan((FIELD_OF_VIEW / 2) * (Math.PI / 180));
    return (x, y, z) => {
      const d = [x - eye[0], y - eye[1], z - eye[2]];
      const along = (axis) => d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
      const depth = -along(back), scale = zoom / Math.max(depth, 1e-3 * camera.distance);
      return [width / 2 + scale * along(right), height / 2 - scale * along(up), depth];
    };
  }

  function shadeOf(i) { // of triangle i: how much light falls on it, from either side
    let sum = 0;
    for (let c = 0; c < 3; ++c)
      for (let k = 0; k < 3; ++k) sum += (surface.normals[run.triangles[3 * i + c] * 3 + k] * light[k]) / 3;
    return DARKEST + (1 - DARKEST) * Math.abs(sum);
  }

  // False for what a diverged motion threw beyond any picture, and for what lies behind the eye.
  function inSight(i) {
    return [0, 1, 2].every((c) => {
      const n = run.triangles[3 * i + c] * 3;
      return Math.abs(screen[n]) < 1e5 && Math.abs(screen[n + 1]) < 1e5 && screen[n + 2] > 0;
    });
  }

  function colourOf(i, look) {
    if (look.strain) {
      const mean = [0, 1, 2].reduce((sum, c) => sum + surface.strains[run.triangles[3 * i + c]] / 3, 0);
      return strainColour(mean / surface.strainRange);
    }
    if (!picture) return [74, 118, 170];
    const at = [0, 1].map((k) => (run.uv[6 * i + k] + run.uv[6 * i + 2 + k] + run.uv[6 * i + 4 + k]) / 3);
    return picture.colour(at[0], at[1]);
  }

  // The triangle, a hair wider than it is: so no seam is seen between neighbours.
  function trace(i) {
    const n = [0, 1, 2].map((c) => run.triangles[3 * i + c] * 3);
    const middle = [0, 1].map((k) => (screen[n[0] + k] + screen[n[1] + k] + screen[n[2] + k]) / 3);
    ink.beginPath();
    for (const at of n) {
      const dx = screen[at] - middle[0], dy = screen[at + 1] - middle[1];
      const wider = 1 + 1.7 / Math.max(1, Math.hypot(dx, dy));
      ink.lineTo(middle[0] + dx * wider, middle[1] + dy * wider);
    }
    ink.closePath();
  }

  // The picture laid over one triangle by the affine map that takes its three corners to the screen.
  function paintPicture(i, shade) {
    const [a, b, c] = [0, 1, 2].map((k) => run.triangles[3 * i + k] * 3);
    const [u, v] = [0, 1].map((axis) => [0, 1, 2].map((k) => run.uv[6 * i + 2 * k + axis] * picture.size[axis]));
    const du1 = u[1] - u[0], du2 = u[2] - u[0], dv1 = v[1] - v[0], dv2 = v[2] - v[0];
    const det = du1 * dv2 - du2 * dv1;
    if (Math.abs(det) < 1e-9) return;
    const row = (k) => {
      const d1 = screen[b + k] - screen[a + k], d2 = screen[c + k] - screen[a + k];
      const along = (d1 * dv2 - d2 * dv1) / det, down = (d2 * du1 - d1 * du2) / det;
      return [along, down, screen[a + k] - along * u[0] - down * v[0]];
    };
    const x = row(0), y = row(1);
    ink.save();
    trace(i);
    ink.clip();
    ink.transform(x[0], y[0], x[1], y[1], x[2], y[2]);
    ink.drawImage(picture.shaded[Math.round(((shade - DARKEST) / (1 - DARKEST)) * (SHADES - 1))], 0, 0);
    ink.restore();
  }

  function paintTriangle(i, look) {
    const shade = Math.max(DARKEST, Math.min(1, shadeOf(i) || 0));
    if (picture && !look.strain && run.triangles.length / 3 <= TEXTURED_AT_MOST) return paintPicture(i, shade);
    trace(i);
    ink.fillStyle = "rgb(" + colourOf(i, look).map((c) => Math.round(c * shade)).join(",") + ")";
    ink.fill();
  }

  function paintSurface(look) {
    const depth = (i) => [0, 1, 2].reduce((sum, c) => sum + screen[run.triangles[3 * i + c] * 3 + 2], 0);
    const order = Array.from({ length: run.triangles.length / 3 }, (_, i) => i).filter(inSight).map((i) => [depth(i), i]);
    for (const [, i] of order.sort((a, b) => b[0] - a[0])) paintTriangle(i, look);
  }

  function paintSprings(look) {
    ink.lineWidth = 1;
    const plain = run.triangles.length ? "rgba(255,255,255,0.55)" : "rgb(52,72,96)";
    for (let s = 0; s < run.springs.length / 2; ++s) {
      const a = run.springs[2 * s] * 3, b = run.springs[2 * s + 1] * 3;
      const strained = () => strainColour(surface.springStrains[s] / surface.strainRange).map((v) => Math.round(v * 0.72));
      ink.strokeStyle = look.strain ? "rgb(" + strained().join(",") + ")" : plain;
      ink.beginPath();
      ink.moveTo(screen[a], screen[a + 1]);
      ink.lineTo(screen[b], screen[b + 1]);
      ink.stroke();
    }
  }

  function paintPole() {
    if (!pole) return;
    const [a, b] = pole.ends.map((p) => project(...p));
    ink.strokeStyle = "rgb(178,146,88)";
    ink.lineWidth = 5;
    ink.lineCap = "round";
    ink.beginPath();
    ink.moveTo(a[0], a[1]);
    ink.lineTo(b[0], b[1]);
    ink.stroke();
  }

  function paintPins() {
    ink.fillStyle = "rgb(214,170,74)";
    ink.strokeStyle = "rgba(90,64,16,0.6)";
    ink.lineWidth = 1;
    for (const n of run.pinned) {
      ink.beginPath();
      ink.arc(screen[3 * n], screen[3 * n + 1], 3.5, 0, 7);
      ink.fill();
      ink.stroke();
    }
  }

  return {
    name: "canvas",
    resize(w, h) {
      const ratio = Math.min(2, window.devicePixelRatio || 1);
      [width, height] = [w, h];
      canvas.width = Math.round(w * ratio);
      canvas.height = Math.round(h * ratio);
      ink.setTransform(ratio, 0, 0, ratio, 0, 0);
    },
    draw(look, camera) {
      project = projector(camera);
      const p = surface.positions;
      for (let n = 0; n < run.nodes; ++n) screen.set(project(p[3 * n], p[3 * n + 1], p[3 * n + 2]), 3 * n);
      ink.clearRect(0, 0, width, height);
      paintPole();
      paintSurface(look);
      if (look.springs) paintSprings(look);
      if (look.pins) paintPins();
    },
  };
}

function readPicture(image) {
  const n = 64, bytes = shadedCopy(image, n, n, 1).getContext("2d").getImageData(0, 0, n, n).data;
  const cell = (t) => Math.max(0, Math.min(n - 1, Math.floor(t * n)));
  const size = [image.naturalWidth, image.naturalHeight];
  return {
    size,
    shaded: Array.from({ length: SHADES }, (_, k) => shadedCopy(image, ...size, DARKEST + ((1 - DARKEST) * k) / (SHADES - 1))),
    colour: (u, v) => Array.from(bytes.subarray((cell(v) * n + cell(u)) * 4, (cell(v) * n + cell(u)) * 4 + 3)),
  };
}

function shadedCopy(image, width, height, shade) {
  const copy = document.createElement("canvas");
  copy.width = width;
  copy.height = height;
  const ink = copy.getContext("2d");
  ink.drawImage(image, 0, 0, width, height);
  ink.fillStyle = "rgba(4,10,24," + (1 - shade) + ")";
  ink.fillRect(0, 0, width, height);
  return copy;
}
