// The camera of both ways of drawing: it circles a target. Drag turns, wheel and pinch zoom, shift-drag moves.

const FIELD_OF_VIEW = 30; // degrees, upright

function makeCamera(bounds) {
  const camera = { azimuth: 0, elevation: 0, distance: 1, target: [0, 0, 0], aspect: 1, touched: false };

  camera.axes = function () {
    const ca = Math.cos(camera.azimuth), sa = Math.sin(camera.azimuth);
    const ce = Math.cos(camera.elevation), se = Math.sin(camera.elevation);
    return { back: [sa * ce, se, ca * ce], right: [ca, 0, -sa], up: [-sa * se, ce, -ca * se] };
  };
  camera.eye = function () {
    const { back } = camera.axes();
    return camera.target.map((t, k) => t + camera.distance * back[k]);
  };
  // The nearest place from which every corner of the motion's box is in the picture.
  camera.fit = function () {
    const { back, right, up } = camera.axes();
    const upright = Math.tan((FIELD_OF_VIEW / 2) * (Math.PI / 180)) * 0.9, wide = upright * camera.aspect;
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    camera.distance = 1e-6;
    for (let corner = 0; corner < 8; ++corner) {
      const p = [0, 1, 2].map((k) => (corner & (1 << k) ? bounds.high[k] : bounds.low[k]) - camera.target[k]);
      const needed = Math.max(Math.abs(dot(p, right)) / wide, Math.abs(dot(p, up)) / upright);
      camera.distance = Math.max(camera.distance, needed + dot(p, back));
    }
  };
  camera.home = function () {
    camera.azimuth = -0.42;
    camera.elevation = 0.14;
    camera.target = bounds.low.map((low, k) => (low + bounds.high[k]) / 2);
    camera.touched = false;
    camera.fit();
  };
  camera.turn = function (dx, dy) {
    camera.azimuth -= dx * 0.008;
    camera.elevation = Math.min(1.5, Math.max(-1.5, camera.elevation + dy * 0.008));
    camera.touched = true;
  };
  camera.move = function (dx, dy, height) {
    const { right, up } = camera.axes();
    const unit = (2 * camera.distance * Math.tan((FIELD_OF_VIEW / 2) * (Math.PI / 180))) / height;
    camera.target = camera.target.map((t, k) => t + unit * (dy * up[k] - dx * right[k]));
    camera.touched = true;
  };
  camera.zoom = function (factor) {
    camera.distance = Math.min(bounds.size * 40, Math.max(bounds.size * 0.05, camera.distance * factor));
    camera.touched = true;
  };
  camera.resize = function (aspect) {
    camera.aspect = aspect;
    if (!camera.touched) camera.fit();
  };
  camera.home();
  return camera;
}

// Mouse, pen and fingers on the element move the camera; redraw is called after each change.
function steer(element, camera, redraw) {
  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  element.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = pointers.size === 2 ? spread() : 0;
    const dx = event.clientX - last.x, dy = event.clientY - last.y;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (pointers.size === 2) camera.zoom(before / Math.max(1, spread()));
    else if (event.shiftKey || event.buttons & 6) camera.move(dx, dy, element.clientHeight);
    else camera.turn(dx, dy);
    redraw();
  });
  const release = (event) => pointers.delete(event.pointerId);
  element.addEventListener("pointerup", release);
  element.addEventListener("pointercancel", release);
  element.addEventListener("contextmenu", (event) => event.preventDefault());
  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom(Math.exp(Math.max(-100, Math.min(100, event.deltaY)) * 0.0015));
    redraw();
  }, { passive: false });
  element.addEventListener("dblclick", () => {
    camera.home();
    redraw();
  });
}
