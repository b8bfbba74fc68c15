// Puts the page together: words, tables, the clock that moves the view, and the buttons.

const byId = (id) => document.getElementById(id);

function element(tag, text, parent) {
  const node = document.createElement(tag);
  node.textContent = text;
  if (parent) parent.append(node);
  return node;
}

// As pictures, in which no script runs.
function fillDrawings(run) {
  byId("drawings").hidden = run.drawings.length === 0;
  for (const drawing of run.drawings) {
    element("h2", drawing.title, byId("drawings"));
    const picture = byId("drawings").appendChild(document.createElement("img"));
    picture.alt = drawing.title;
    picture.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(drawing.svg);
  }
}

function fillWords(run) {
  byId("title").textContent = run.title;
  byId("subtitle").textContent = run.subtitle;
  byId("outcome").textContent = run.outcome;
  byId("outcome").hidden = !run.outcome;
  byId("outcome").classList.toggle("bad", !run.good);
  byId("outcome").classList.toggle("doubtful", run.good && !run.rested);
  byId("numbers").hidden = run.tables.length === 0;
  for (const table of run.tables) {
    const card = document.createElement("article");
    card.className = "table";
    element("h3", table.title, card);
    const list = card.appendChild(document.createElement("dl"));
    for (const [name, value] of table.figures) {
      const row = list.appendChild(document.createElement("div"));
      element("dt", name, row);
      element("dd", value, row);
    }
    byId("tables").append(card);
  }
  byId("manifest").hidden = !run.manifest;
  byId("manifest").querySelector("pre").textContent = run.manifest;
}

function fillLegend(surface) {
  const legend = byId("legend"), percent = (v) => shortNumber(100 * v, 3) + " %";
  legend.querySelector(".caption").textContent = surface.restIsFirstFrame
    ? "mean change of the springs' length since the first frame"
    : "mean strain of a node's springs";
  const colours = [-1, -0.5, 0, 0.5, 1].map((s) => "rgb(" + strainColour(s).map(Math.round).join(",") + ")");
  legend.querySelector(".bar").style.background = "linear-gradient(to right," + colours.join(",") + ")";
  for (const text of [percent(-surface.strainRange), "0", "+" + percent(surface.strainRange)])
    element("span", text, legend.querySelector(".ticks"));
}

// Real time where the motion lasts a few seconds to a minute; else so that it is seen in a dozen.
function baseSpeed(duration) { return duration >= 3 && duration <= 60 ? 1 : duration / 12; }

function makePlayer(run, show) {
  const first = run.frameTimes[0], last = run.frameTimes[run.frameTimes.length - 1], duration = last - first;
  const player = { time: first, playing: false, speed: 1, held: null };
  const base = baseSpeed(duration) || 1;
  let before = null;

  player.seek = function (time) {
    player.time = Math.max(first, Math.min(last, time));
    show(player.held === null ? player.time : player.held);
  };
  player.play = function (on) {
    player.playing = on && duration > 0;
    byId("play").classList.toggle("playing", player.playing);
    before = null;
    if (player.playing) requestAnimationFrame(tick);
  };
  // A chart under the mouse shows its moment; the motion waits meanwhile.
  player.hold = function (time) {
    player.held = time;
    show(time === null ? player.time : Math.max(first, Math.min(last, time)));
  };
  function tick(now) {
    if (!player.playing) return;
    const passed = before === null ? 0 : Math.min(0.1, (now - before) / 1000);
    before = now;
    if (player.held === null) player.seek(first + ((player.time - first + passed * base * player.speed) % duration));
    requestAnimationFrame(tick);
  }

  const choice = byId("speed");
  for (const factor of [0.1, 0.25, 0.5, 1, 2, 4]) {
    const option = element("option", "× " + shortNumber(factor * base, 2), choice);
    option.value = factor;
    option.selected = factor === 1;
  }
  choice.addEventListener("change", () => { player.speed = Number(choice.value); });
  byId("play").addEventListener("click", () => player.play(!player.playing));
  byId("scrub").addEventListener("input", () => {
    player.play(false);
    player.seek(first + Number(byId("scrub").value) * duration);
  });
  player.showOnBar = function (time) {
    const share = duration > 0 ? (time - first) / duration : 0;
    byId("scrub").value = share;
    byId("scrub").style.setProperty("--done", (100 * share).toFixed(2) + "%");
  };
  return player;
}

function makeView(run, surface) {
  const holder = byId("view");
  const turning = "Drag to turn, wheel to zoom, shift-drag to move, double-click to reset; space plays, arrow keys step.";
  try {
    const view = makeWebglView(holder, run, surface);
    if (view) {
      byId("hint").textContent = turning;
      return view;
    }
  } catch (error) {
    for (const canvas of holder.querySelectorAll("canvas")) canvas.remove();
  }
  const why = typeof THREE === "undefined" ? "three.js was not at hand when this page was written" : "this browser offers no WebGL";
  byId("hint").textContent = turning + " Drawn on a 2-D canvas: " + why + ".";
  return makeCanvasView(holder, run, surface);
}

function start(run) {
  const surface = makeSurface(run), camera = makeCamera(sceneBox(run, surface.bounds)), view = makeView(run, surface);
  const look = { strain: false, springs: run.triangles.length === 0, pins: true };
  let player = null, charts = null, frame = 0;

  function redraw() { view.draw(look, camera); }
  function show(time) {
    frame = surface.moveTo(time);
    byId("clock").querySelector("b").textContent = time.toFixed(2) + " s";
    byId("clock").querySelector("span").textContent = "step " + shortNumber(run.frameSteps[frame], 9);
    player.showOnBar(time);
    charts.mark(time);
    redraw();
  }
  function fit() {
    const width = byId("view").clientWidth, height = byId("view").clientHeight;
    view.resize(width, height);
    camera.resize(width / height);
    charts.draw();
    redraw();
  }
  function goTo(k) {
    player.play(false);
    player.seek(run.frameTimes[Math.max(0, Math.min(run.frames.length - 1, k))]);
  }

  player = makePlayer(run, show);
  charts = makeCharts(run, (time) => player.hold(time));
  fillLegend(surface);
  connect(run, look, camera, player, redraw, (step) => goTo(frame + step));
  new ResizeObserver(fit).observe(byId("view"));
  fit();
  // A page that is only glanced at, or printed, shows the flag in full flight.
  const last = run.frameTimes[run.frameTimes.length - 1];
  player.seek(run.good ? run.frameTimes[0] + 0.42 * (last - run.frameTimes[0]) : run.frameTimes[0]);
  if (!window.matchMedia("(prefers-reduced-motion: reduce)").matches) player.play(true);
  document.documentElement.dataset.renderer = view.name;
  window.hopmesh = { frame: goTo, renderer: view.name };
}

function connect(run, look, camera, player, redraw, stepFrames) {
  byId("springs").checked = look.springs;
  if (!run.crest) byId("plain").textContent = "Plain";
  for (const radio of document.getElementsByName("paint"))
    radio.addEventListener("change", () => {
      look.strain = radio.value === "strain";
      byId("legend").hidden = !look.strain;
      redraw();
    });
  for (const name of ["springs", "pins"])
    byId(name).addEventListener("change", () => {
      look[name] = byId(name).checked;
      redraw();
    });
  byId("home").addEventListener("click", () => {
    camera.home();
    redraw();
  });
  steer(byId("view"), camera, redraw);
  byId("view").addEventListener("keydown", (event) => {
    if (event.key === " ") player.play(!player.playing);
    else if (event.key === "ArrowRight") stepFrames(1);
    else if (event.key === "ArrowLeft") stepFrames(-1);
    else return;
    event.preventDefault();
  });
}

async function main() {
  const run = readRun();
  fillWords(run);
  fillDrawings(run);
  if (run.frames.length === 0 || run.nodes === 0) {
    byId("stage").hidden = true;
    makeCharts(run, () => {}).draw();
    window.hopmesh = { frame() {}, renderer: "none" };
  } else {
    if (run.crest) {
      run.crestImage = new Image();
      run.crestImage.src = run.crest;
      await run.crestImage.decode();
    }
    start(run);
  }
  document.documentElement.dataset.ready = "true";
}

main();
