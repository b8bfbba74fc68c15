// Draws the surface with three.js. makeWebglView returns null where the browser has no WebGL or the page no three.js.

function makeWebglView(holder, run, surface) {
  if (typeof THREE === "undefined") return null;
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("webgl", { alpha: true, antialias: true });
  if (!context) return null;
  const renderer = new THREE.WebGLRenderer({ canvas, context, alpha: true, antialias: true });
  renderer.gammaOutput = true; // light is summed in linear space, shown in sRGB
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.VSMShadowMap;

  const scene = new THREE.Scene(), bounds = surface.bounds;
  const eye = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, bounds.size * 0.01, bounds.size * 100);
  addLights(scene, bounds);
  addFloor(scene, bounds);
  addPole(scene, run, bounds);
  const cloth = addCloth(scene, run, surface);
  const wires = addWires(scene, run, surface);
  const pins = addPins(scene, run, bounds);
  holder.prepend(canvas);

  return {
    name: "webgl",
    resize(width, height) {
      renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
      renderer.setSize(width, height, false);
      eye.aspect = width / height;
    },
    draw(look, camera) {
      cloth.update(look);
      wires.update(look);
      pins.update(look);
      eye.position.set(...camera.eye());
      eye.near = camera.distance * 0.02;
      eye.far = camera.distance + bounds.size * 20;
      eye.updateProjectionMatrix();
      eye.lookAt(...camera.target);
      renderer.render(scene, eye);
    },
  };
}

function linear(r, g, b) { return new THREE.Color(r / 255, g / 255, b / 255).convertSRGBToLinear(); }

function addLights(scene, bounds) {
  const centre = new THREE.Vector3(...bounds.low.map((low, k) => (low + bounds.high[k]) / 2));
  scene.add(new THREE.HemisphereLight(0xffffff, 0xb9c4cf, 0.6));
  const sun = new THREE.DirectionalLight(0xfff6e8, 0.86);
  sun.position.copy(centre).add(new THREE.Vector3(-1.05, 1.0, 0.75).multiplyScalar(bounds.size));
  sun.target.position.copy(centre);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  sun.shadow.radius = 7;
  const reach = bounds.size * 1.1;
  Object.assign(sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1 * reach, far: 4 * reach });
  scene.add(sun, sun.target);
  const fill = new THREE.DirectionalLight(0xe4eefc, 0.22); // from the other side, so that backs are not black
  fill.position.copy(centre).add(new THREE.Vector3(0.8, 0.3, -0.9).multiplyScalar(bounds.size));
  fill.target = sun.target;
  scene.add(fill);
}

// A disc with lines that fade into the paper, and the cloth's shadow on it.
function addFloor(scene, bounds) {
  const radius = bounds.size * 1.25, geometry = new THREE.PlaneBufferGeometry(2 * radius, 2 * radius);
  const picture = document.createElement("canvas");
  picture.width = picture.height = 1024;
  const ink = picture.getContext("2d");
  ink.strokeStyle = "rgba(64,84,106,0.34)";
  ink.lineWidth = 1.5;
  for (let k = 0; k <= 24; ++k) {
    const at = (k * 1024) / 24;
    ink.beginPath();
    ink.moveTo(at, 0);
    ink.lineTo(at, 1024);
    ink.moveTo(0, at);
    ink.lineTo(1024, at);
    ink.stroke();
  }
  const fade = ink.createRadialGradient(512, 512, 60, 512, 512, 505);
  fade.addColorStop(0, "rgba(0,0,0,1)");
  fade.addColorStop(1, "rgba(0,0,0,0)");
  ink.globalCompositeOperation = "destination-in";
  ink.fillStyle = fade;
  ink.fillRect(0, 0, 1024, 1024);
  const map = new THREE.CanvasTexture(picture);
  map.encoding = THREE.sRGBEncoding;
  map.anisotropy = 8;
  const lines = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ map, transparent: true, depthWrite: false }));
  const shade = new THREE.Mesh(geometry, new THREE.ShadowMaterial({ color: 0x2b3d52, opacity: 0.2 }));
  shade.material.depthWrite = false;
  shade.receiveShadow = true;
  for (const disc of [lines, shade]) {
    disc.rotation.x = -Math.PI / 2;
    disc.position.set((bounds.low[0] + bounds.high[0]) / 2, floorOf(bounds), (bounds.low[2] + bounds.high[2]) / 2);
    scene.add(disc);
  }
}

function addPole(scene, run, bounds) {
  const pole = poleOf(run, bounds);
  if (!pole) return;
  const [a, b] = pole.ends.map((p) => new THREE.Vector3(...p));
  const radius = bounds.size * 0.0065;
  const brass = new THREE.MeshStandardMaterial({ color: linear(196, 160, 92), roughness: 0.45, metalness: 0.25 });
  const shaft = new THREE.Mesh(new THREE.CylinderBufferGeometry(radius, radius, a.distanceTo(b), 24), brass);
  shaft.position.copy(a).add(b).multiplyScalar(0.5);
  shaft.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), b.clone().sub(a).normalize());
  for (const end of pole.upright ? [b] : [a, b]) {
    const knob = new THREE.Mesh(new THREE.SphereBufferGeometry(radius * 2.1, 32, 24), brass);
    knob.position.copy(end);
    knob.castShadow = true;
    scene.add(knob);
  }
  shaft.castShadow = true;
  scene.add(shaft);
}

// A node is several vertices where the picture's coordinates jump.
function splitVertices(run) {
  const known = new Map(), nodes = [], uv = [], index = [];
  run.triangles.forEach((node, corner) => {
    const u = run.uv[2 * corner], v = run.uv[2 * corner + 1], key = node + " " + u + " " + v;
    if (!known.has(key)) {
      known.set(key, nodes.length);
      nodes.push(node);
      uv.push(u, v);
    }
    index.push(known.get(key));
  });
  return { nodes, uv, index };
}

function addCloth(scene, run, surface) {
  const { nodes, uv, index } = splitVertices(run);
  const geometry = new THREE.BufferGeometry();
  const attribute = (name) => {
    const values = new THREE.BufferAttribute(new Float32Array(nodes.length * 3), 3);
    geometry.setAttribute(name, values);
    return values;
  };
  const position = attribute("position"), normal = attribute("normal"), colour = attribute("color");
  geometry.setAttribute("uv", new THREE.Float32BufferAttribute(uv, 2));
  geometry.setIndex(index);
  const common = { side: THREE.DoubleSide, roughness: 0.82, metalness: 0, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
  const plain = new THREE.MeshStandardMaterial({ ...common, color: run.crest ? 0xffffff : linear(74, 118, 170) });
  const strained = new THREE.MeshStandardMaterial({ ...common, vertexColors: THREE.VertexColors });
  if (run.crest) {
    plain.map = new THREE.Texture(run.crestImage);
    Object.assign(plain.map, { encoding: THREE.sRGBEncoding, flipY: false, anisotropy: 8, needsUpdate: true });
  }
  const mesh = new THREE.Mesh(geometry, plain);
  mesh.castShadow = true;
  mesh.frustumCulled = false;
  scene.add(mesh);

  function fill(target, source) {
    nodes.forEach((node, v) => target.setXYZ(v, source[3 * node], source[3 * node + 1], source[3 * node + 2]));
    target.needsUpdate = true;
  }
  return {
    update(look) {
      fill(position, surface.positions);
      fill(normal, surface.normals);
      mesh.material = look.strain ? strained : plain;
      if (!look.strain) return;
      nodes.forEach((node, v) => {
        const c = linear(...strainColour(surface.strains[node] / surface.strainRange));
        colour.setXYZ(v, c.r, c.g, c.b);
      });
      colour.needsUpdate = true;
    },
  };
}

function addWires(scene, run, surface) {
  const position = new THREE.BufferAttribute(new Float32Array(run.springs.length * 3), 3);
  const colour = new THREE.BufferAttribute(new Float32Array(run.springs.length * 3), 3);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", position);
  geometry.setAttribute("color", colour);
  const material = new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors, transparent: true });
  const lines = new THREE.LineSegments(geometry, material);
  lines.frustumCulled = false;
  scene.add(lines);
  const p = surface.positions, calm = linear(232, 236, 240), bare = linear(52, 72, 96);
  return {
    update(look) {
      lines.visible = look.springs;
      if (!look.springs) return;
      material.opacity = run.triangles.length && !look.strain ? 0.45 : 1; // the picture stays visible below
      run.springs.forEach((node, k) => {
        const share = surface.springStrains[k >> 1] / surface.strainRange;
        const c = look.strain ? linear(...strainColour(share).map((v) => v * 0.72)) : run.triangles.length ? calm : bare;
        position.setXYZ(k, p[3 * node], p[3 * node + 1], p[3 * node + 2]);
        colour.setXYZ(k, c.r, c.g, c.b);
      });
      position.needsUpdate = colour.needsUpdate = true;
    },
  };
}

function addPins(scene, run, bounds) {
  const radius = Math.min(bounds.size * 0.0085, (0.35 * bounds.size) / Math.sqrt(run.nodes));
  const material = new THREE.MeshStandardMaterial({ color: linear(214, 170, 74), roughness: 0.35, metalness: 0.1 });
  const balls = new THREE.InstancedMesh(new THREE.SphereBufferGeometry(radius, 20, 14), material, Math.max(1, run.pinned.length));
  const place = new THREE.Matrix4();
  run.pinned.forEach((n, k) => balls.setMatrixAt(k, place.makeTranslation(...run.frames[0].subarray(n * 3, n * 3 + 3))));
  balls.frustumCulled = false;
  scene.add(balls);
  return { update(look) { balls.visible = look.pins && run.pinned.length > 0; } };
}
