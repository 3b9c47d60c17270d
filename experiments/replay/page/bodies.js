// SPDX-License-Identifier: BSD-3-Clause
// What is seen of a run: bodies with their axes and vectors, what stands still, springs, trails, marks where bodies meet.

const AXES = ["#d55e00", "#009e73", "#0072b2"], OMEGA = "#e69f00", MOMENTUM = "#a0468c", MARK = "#d55e00", REACTION = "#be143c";
const HUES = ["#77aadd", "#ee8866", "#44bb99", "#eedd88", "#ffaabb", "#99ddff", "#bbcc33", "#aaaa00"];  // experiments/study/scene/body_colours.hpp
const FEW = 40, MANY = 250;       // bodies with trails and vectors; with edges and shadows
const TRAIL_POINTS = 300, MOST_MARKS = 64;

function geometryOf(surface) {
  const points = new Float32Array(bytesOf(surface.points)), corners = new Uint32Array(bytesOf(surface.corners));
  const normals = new Int16Array(bytesOf(surface.normals));
  const geometry = new THREE.BufferGeometry(), n = corners.length;
  const position = new Float32Array(3 * n), normal = new Float32Array(3 * n), shade = new Float32Array(3 * n).fill(1);
  for (let i = 0; i < n; ++i) {
    for (let c = 0; c < 3; ++c) {
      position[3 * i + c] = points[3 * corners[i] + c];
      normal[3 * i + c] = normals[3 * corners[i] + c] / 32767;
    }
  }
  // What is round shows its turning by quarters: a triangle whose normals differ, in every second quarter about axis 3.
  for (let i = 0; i < n; i += 3) {
    const bent = [0, 1, 2].some((c) => Math.abs(normal[3 * i + c] - normal[3 * i + 3 + c]) + Math.abs(normal[3 * i + c] - normal[3 * i + 6 + c]) > 1e-3);
    const x = position[3 * i] + position[3 * i + 3] + position[3 * i + 6], y = position[3 * i + 1] + position[3 * i + 4] + position[3 * i + 7];
    if (bent && x * y > 0) shade.fill(0.72, 3 * i, 3 * i + 9);
  }
  geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(normal, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(shade, 3));
  geometry.computeBoundingSphere();
  geometry.edges = new THREE.EdgesGeometry(geometry, 30);
  return geometry;
}

/// Along +z, of length 1 with the mesh scaled by it; `rod` is its thickness over its length where it is longest.
class Arrow {
  constructor(colour, radius, head) {
    const material = new THREE.MeshLambertMaterial({ color: colour });
    this.group = new THREE.Group();
    this.shaft = new THREE.Mesh(Arrow.rod, material);
    this.head = new THREE.Mesh(Arrow.cone, material);
    this.radius = radius;
    this.headLength = head;
    this.group.add(this.shaft, this.head);
  }
  point(direction, length) {
    this.group.visible = length > 1e-9;
    if (!this.group.visible) return;
    this.group.quaternion.setFromUnitVectors(Arrow.up, Arrow.unit.copy(direction).normalize());
    const head = Math.min(this.headLength, length);
    this.shaft.scale.set(this.radius, this.radius, Math.max(length - head, 1e-9));
    this.head.scale.set(head * 0.4, head * 0.4, head);
    this.head.position.set(0, 0, length - head);
  }
}
Arrow.up = new THREE.Vector3(0, 0, 1);
Arrow.unit = new THREE.Vector3();
Arrow.rod = new THREE.CylinderBufferGeometry(1, 1, 1, 12).rotateX(Math.PI / 2).translate(0, 0, 0.5);
Arrow.cone = new THREE.ConeBufferGeometry(1, 1, 16).rotateX(Math.PI / 2).translate(0, 0, 0.5);

function lineOf(capacity, colour, fades) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * capacity), 3));
  if (fades) geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(3 * capacity), 3));
  const line = new THREE.Line(geometry, new THREE.LineBasicMaterial(
    { color: fades ? 0xffffff : colour, vertexColors: fades ? THREE.VertexColors : THREE.NoColors }));
  line.frustumCulled = false;
  return line;
}

/// Kept as w, x, y, z.
function quaternionOf(data) {
  const [w, x, y, z] = data.orientation;
  return new THREE.Quaternion(x, y, z, w);
}

class Body {
  constructor(data, number, geometry, sizes, many) {
    this.data = data;
    this.number = number;
    this.group = new THREE.Group();
    this.radius = geometry.boundingSphere.radius;
    this.colour = new THREE.Color(data.fixed ? theme.still : HUES[number % HUES.length]);
    this.material = new THREE.MeshPhongMaterial({ color: this.colour, vertexColors: THREE.VertexColors, specular: 0x222222, shininess: 40,
                                                   polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
    const mesh = new THREE.Mesh(geometry, this.material);
    mesh.castShadow = mesh.receiveShadow = !many;
    this.group.add(mesh);
    if (!many) {
      this.edges = new THREE.LineSegments(geometry.edges, new THREE.LineBasicMaterial({ color: theme.edge, transparent: true, opacity: 0.65 }));
      this.group.add(this.edges);
    }
    this.group.quaternion.copy(quaternionOf(data));
    this.group.position.fromArray(data.position);
    this.center = new THREE.Vector3().fromArray(data.center);
    if (this.center.lengthSq() > 0) this.addRod(sizes.view);
    // Column by column, as the inertia is kept; it is symmetric.
    this.inertia = new THREE.Matrix3().fromArray(data.inertia);
  }

  /// From the pivot to the mass centre, in body axes about the mass centre.
  addRod(view) {
    const length = this.center.length(), material = new THREE.MeshPhongMaterial({ color: theme.still });
    const rod = new THREE.Mesh(Arrow.rod, material), ball = new THREE.Mesh(new THREE.SphereBufferGeometry(0.012 * view, 20, 14), material);
    rod.scale.set(0.006 * view, 0.006 * view, length);
    rod.quaternion.setFromUnitVectors(Arrow.up, this.center.clone().normalize());
    rod.position.copy(this.center).negate();
    ball.position.copy(rod.position);
    rod.castShadow = ball.castShadow = true;
    this.group.add(rod, ball);
  }

  addVectors(scene, sizes) {
    this.axes = AXES.map((colour, c) => {
      const arrow = new Arrow(colour, 0.014 * this.radius, 0.14 * this.radius);
      arrow.point(new THREE.Vector3(c === 0, c === 1, c === 2), 1.45 * this.radius);
      this.group.add(arrow.group);
      return arrow.group;
    });
    this.arrow = sizes.arrow;
    this.omega = new Arrow(OMEGA, 0.03 * this.radius, 0.22 * this.radius);
    this.momentum = new Arrow(MOMENTUM, 0.03 * this.radius, 0.22 * this.radius);
    scene.add(this.omega.group, this.momentum.group);
  }

  /// L = R I Rᵀ ω about the reference point; its direction and size alone count here.
  angularMomentum(omega, out) {
    const back = Body.back.copy(this.group.quaternion).conjugate();
    return out.copy(omega).applyQuaternion(back).applyMatrix3(this.inertia).applyQuaternion(this.group.quaternion);
  }

  place(motion, at) {
    motion.position(at, this.number, this.group.position);
    motion.orientation(at, this.number, this.group.quaternion);
  }

  pointVectors(motion, at, shown, scales) {
    const omega = motion.angularVelocity(at, this.number, Body.omega);
    const reach = 1.9 * this.radius;
    this.axes.forEach((axis) => { axis.visible = shown.axes; });
    this.omega.group.visible = this.momentum.group.visible = false;
    if (shown.omega && scales.omega > 0) {
      this.omega.group.position.copy(this.group.position);
      this.omega.point(omega, reach * omega.length() / scales.omega);
    }
    if (shown.momentum && scales.momentum > 0) {
      const l = this.angularMomentum(omega, Body.l);
      this.momentum.group.position.copy(this.group.position);
      this.momentum.point(l, reach * l.length() / scales.momentum);
    }
  }
}
Body.back = new THREE.Quaternion();
Body.omega = new THREE.Vector3();
Body.l = new THREE.Vector3();

/// The curve of ω in body axes, on the inertia ellipsoid, to the scale of the arrows; turns with the body.
function polhodeOf(motion, body, scale) {
  const n = motion.times.length, stride = Math.ceil(n / 6000), points = [];
  const omega = new THREE.Vector3(), q = new THREE.Quaternion();
  for (let k = 0; k < n; k += stride) {
    motion.angularVelocity({ k, part: 0 }, body.number, omega);
    omega.applyQuaternion(motion.kept(k, body.number, q).conjugate()).multiplyScalar(1.9 * body.radius / scale);
    points.push(omega.clone());
  }
  const line = new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), new THREE.LineBasicMaterial({ color: OMEGA }));
  body.group.add(line);
  return line;
}

/// Where points and directions of bodies are, world; of the world itself, whose number is null, as given.
class Places {
  constructor(data, bodies) {
    this.data = data;
    this.bodies = bodies;
  }
  direction(number, inBody) {
    const out = new THREE.Vector3(...inBody);
    if (number === null) return out;
    const body = this.bodies[number];
    return out.applyQuaternion(body ? body.group.quaternion : quaternionOf(this.data[number]));
  }
  /// Anchors are from the reference point, which is the pivot of a pinned body.
  point(number, anchor) {
    const body = this.bodies[number], out = new THREE.Vector3(...anchor);
    if (number === null) return out;
    if (!body) return this.direction(number, anchor).add(new THREE.Vector3(...this.data[number].position));
    return out.sub(body.center).applyQuaternion(body.group.quaternion).add(body.group.position);
  }
}

/// A coil along z from 0 to 1, of radius 1 across.
function coilGeometry() {
  class Coil extends THREE.Curve {
    getPoint(t) {
      const swing = Math.max(0, Math.min(1, 12 * Math.min(t, 1 - t)));
      return new THREE.Vector3(swing * Math.cos(20 * Math.PI * t), swing * Math.sin(20 * Math.PI * t), t);
    }
  }
  const points = new Coil().getPoints(400);
  return new THREE.BufferGeometry().setFromPoints(points);
}

class Spring {
  constructor(data, places, scene, view) {
    this.data = data;
    this.places = places;
    this.view = view;
    this.line = new THREE.Line(Spring.coil || (Spring.coil = coilGeometry()), new THREE.LineBasicMaterial({ color: theme.ink }));
    this.line.frustumCulled = false;
    this.ball = new THREE.Mesh(new THREE.SphereBufferGeometry(0.008 * view, 16, 12), new THREE.MeshLambertMaterial({ color: theme.still }));
    scene.add(this.line, this.ball);
  }
  stretch(shown) {
    this.line.visible = this.ball.visible = shown;
    const from = this.places.point(this.data.body, this.data.anchor);
    const to = this.places.point(this.data.other, this.data.anchorOther);
    const d = to.clone().sub(from), length = d.length(), across = Math.min(0.02 * this.view, 0.25 * length + 1e-9);
    this.line.position.copy(from);
    if (length > 0) this.line.quaternion.setFromUnitVectors(Arrow.up, d.multiplyScalar(1 / length));
    this.line.scale.set(across, across, Math.max(length, 1e-9));
    this.ball.position.copy(to);
    this.ball.visible = shown && this.data.other === null;
  }
}
