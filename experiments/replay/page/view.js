// SPDX-License-Identifier: BSD-3-Clause
// One run's scene: what of it is where at a time, and what surrounds it.

/// m, world, of a pinned body.
function pivotOf(body) {
  return new THREE.Vector3(...body.center).negate().applyQuaternion(quaternionOf(body)).add(new THREE.Vector3(...body.position));
}

/// Where all of a motion is, by axis and sorted; about the middle of its bodies at each instant, or about the origin.
function spansOf(motions, aboutMiddle) {
  const spans = [[], [], []], middle = new THREE.Vector3();
  for (const m of motions) {
    const stride = Math.max(1, Math.floor(m.times.length * m.moving / 20000));
    for (let k = 0; k < m.times.length; k += stride) {
      if (aboutMiddle) m.middle({ k, part: 0 }, middle);
      for (let i = 3 * k * m.moving; i < 3 * (k + 1) * m.moving; ++i) spans[i % 3].push(m.positions[i] - middle.getComponent(i % 3));
    }
  }
  spans.forEach((all) => all.sort((p, q) => p - q));
  return spans;
}

/// What flies off, as bodies of a method that is lost, does not set the scale: a hundredth at either end is left out.
function boxOf(spans, radius) {
  const box = new THREE.Box3();
  spans.forEach((all, c) => {
    box.min.setComponent(c, all[Math.floor(0.01 * (all.length - 1))] - radius);
    box.max.setComponent(c, all[Math.ceil(0.99 * (all.length - 1))] + radius);
  });
  return box;
}

/// Of all runs together, so that every view has the same camera and the same scales. Where nothing stands still and bodies
/// go far away together, the pictures follow their middle.
function sizesOf(data, motions) {
  const still = [];
  let radius = 0, stands = false;
  motions.forEach((m) => {
    const { bodies, springs, joints } = data.scenes[m.run.scene], links = [...springs, ...joints.filter((j) => !j.onPlane).map((j) => j.ends)];
    links.forEach((l) => l.other === null && still.push(new THREE.Vector3(...l.anchorOther)));
    bodies.forEach((b) => {
      stands = stands || b.fixed;
      if (b.surface !== undefined && !b.fixed) radius = Math.max(radius, b.radius);
      if (b.center && Math.hypot(...b.center) > 0) still.push(pivotOf(b));
    });
  });
  let box = boxOf(spansOf(motions, false), radius);
  const near = boxOf(spansOf(motions, true), radius), length = (x) => x.getSize(new THREE.Vector3()).length();
  const follows = !stands && still.length === 0 && length(box) > 6 * length(near);
  if (follows) box = near;
  still.forEach((x) => box.expandByPoint(x));
  const level = data.scenes.some((s) => s.bodies.some((b) => b.normal));
  return { box, radius, level, follows, view: length(box), center: box.getCenter(new THREE.Vector3()) };
}

/// The largest |ω| and |L| of the bodies with vectors, and the largest reaction: arrows are relative to them.
function vectorScales(views) {
  const scales = { omega: 0, momentum: 0, force: 0 }, l = new THREE.Vector3(), omega = new THREE.Vector3();
  for (const { motion, moving, joints } of views) {
    const stride = Math.ceil(motion.times.length / 500);
    for (let k = 0; k < motion.times.length; k += stride) {
      for (const body of moving) {
        motion.angularVelocity({ k, part: 0 }, body.number, omega);
        scales.omega = Math.max(scales.omega, omega.length());
        motion.kept(k, body.number, body.group.quaternion);
        scales.momentum = Math.max(scales.momentum, body.angularMomentum(omega, l).length());
      }
      if (motion.joints > 0) joints.forEach((j) => { scales.force = Math.max(scales.force, j.force({ k, part: 0 }).length()); });
    }
  }
  return scales;
}

/// The square of half-width s on the plane n·x = c about the point nearest to p, cut by the half-spaces n·x >= c.
function cutSquare(plane, others, p, s) {
  const n = new THREE.Vector3(...plane.normal), c = plane.offset;
  const middle = p.clone().addScaledVector(n, c - n.dot(p));
  const u = Math.abs(n.z) > 0.9 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 0, 1).cross(n).normalize();
  const v = n.clone().cross(u).normalize();
  u.copy(v).cross(n);
  let polygon = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => middle.clone().addScaledVector(u, a * s).addScaledVector(v, b * s));
  for (const other of others) {
    const m = new THREE.Vector3(...other.normal), next = [];
    polygon.forEach((a, i) => {
      const b = polygon[(i + 1) % polygon.length], da = m.dot(a) - other.offset, db = m.dot(b) - other.offset;
      if (da >= 0) next.push(a);
      if (da * db < 0) next.push(a.clone().lerp(b, da / (da - db)));
    });
    polygon = next;
  }
  return { polygon, u, v };
}

/// A round number near x.
function round(x) {
  const ten = 10 ** Math.floor(Math.log10(x)), m = x / ten;
  return ten * (m < 1.5 ? 1 : m < 3.5 ? 2 : m < 7.5 ? 5 : 10);
}

function gridTexture() {
  const side = 256, canvas = document.createElement("canvas"), pen = canvas.getContext("2d");
  canvas.width = canvas.height = side;
  pen.fillStyle = theme.floor;
  pen.fillRect(0, 0, side, side);
  pen.strokeStyle = theme.line;
  pen.lineWidth = 3;
  pen.strokeRect(0, 0, side, side);
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.anisotropy = 8;
  return texture;
}

/// A square of that half-width on the plane, near what is seen; none where other half-spaces leave nothing of it.
function planeGeometry(plane, others, sizes, half, tile) {
  const { polygon, u, v } = cutSquare(plane, others, sizes.center, half), position = [], uv = [], normal = [];
  if (polygon.length < 3) return null;
  for (let i = 1; i + 1 < polygon.length; ++i) {
    for (const x of [polygon[0], polygon[i], polygon[i + 1]]) {
      position.push(x.x, x.y, x.z);
      uv.push(x.dot(u) / tile, x.dot(v) / tile);
      normal.push(...plane.normal);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
  geometry.setAttribute("uv", new THREE.Float32BufferAttribute(uv, 2));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normal, 3));
  return geometry;
}

/// A half-space: the floor solid, tiled and with shadows near the bodies, walls faint and seen from inside only.
function planeMesh(plane, others, sizes) {
  const level = plane.normal[2] > 0.7, size = Math.max(sizes.view, 1e-6), tile = round(size / 10);
  const geometry = planeGeometry(plane, others, sizes, (level ? 8 : 0.75) * size, tile);
  if (!geometry) return null;
  const material = new THREE.MeshBasicMaterial({ map: gridTexture(), transparent: !level, opacity: level ? 1 : 0.3, depthWrite: level,
                                                 polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  const group = new THREE.Group(), near = level && planeGeometry(plane, others, sizes, 0.9 * size, tile);
  group.add(new THREE.Mesh(geometry, material));
  if (near) {
    const shadow = new THREE.Mesh(near, new THREE.ShadowMaterial({ color: 0x1d2b3a, opacity: 0.22 }));
    shadow.receiveShadow = true;
    group.add(shadow);
  }
  group.tile = level ? tile : 0;
  return group;
}

/// Where bodies met lately: a ring across the normal and a line along it, larger for a larger impulse.
class Marks {
  constructor(motion, scene, radius) {
    this.motion = motion;
    this.radius = radius;
    this.largest = 0;
    for (let i = IMPACT.impulse; i < motion.impacts.length; i += IMPACT.size) this.largest = Math.max(this.largest, motion.impacts[i]);
    const ring = new THREE.RingBufferGeometry(0.8, 1, 32), stick = Arrow.rod;
    this.pool = [];
    for (let i = 0; i < Math.min(MOST_MARKS, motion.impactCount()); ++i) {
      const material = new THREE.MeshBasicMaterial({ color: MARK, transparent: true, side: THREE.DoubleSide, depthTest: false });
      const group = new THREE.Group(), line = new THREE.Mesh(stick, material);
      line.scale.set(0.06, 0.06, 1.6);
      group.add(new THREE.Mesh(ring, material), line);
      group.material = material;
      group.renderOrder = 2;
      group.visible = false;
      scene.add(group);
      this.pool.push(group);
    }
  }
  show(t, life, shown) {
    const end = this.motion.firstImpactAfter(t), x = this.motion.impacts;
    let used = 0;
    for (let n = end - 1; shown && n >= 0 && used < this.pool.length; --n) {
      const age = (t - this.motion.impactTime(n)) / life, i = n * IMPACT.size;
      if (age > 1) break;
      const mark = this.pool[used++];
      mark.visible = true;
      mark.material.opacity = 1 - age;
      mark.position.set(x[i + IMPACT.point], x[i + IMPACT.point + 1], x[i + IMPACT.point + 2]);
      mark.quaternion.setFromUnitVectors(Arrow.up, Arrow.unit.set(x[i + IMPACT.normal], x[i + IMPACT.normal + 1], x[i + IMPACT.normal + 2]).normalize());
      const size = this.largest > 0 ? Math.cbrt(x[i + IMPACT.impulse] / this.largest) : 1;
      mark.scale.setScalar(this.radius * (0.1 + 0.3 * size) * (1 + 0.4 * age));
    }
    for (; used < this.pool.length; ++used) this.pool[used].visible = false;
  }
}

class View {
  constructor(data, run, motion, sizes, duration) {
    this.motion = motion;
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(theme.sky);
    this.scene.fog = new THREE.Fog(theme.sky, 1, 2);
    const setting = data.scenes[run.scene], planes = setting.bodies.filter((b) => b.normal);
    this.many = motion.moving > MANY;
    this.bodies = setting.bodies.map((b, i) => (b.normal ? null : new Body(b, i, setting.geometries[b.surface], sizes, this.many)));
    this.bodies.forEach((b) => b && this.scene.add(b.group));
    this.moving = motion.moving <= FEW ? this.bodies.slice(0, motion.moving) : [];
    this.moving.forEach((b) => b.addVectors(this.scene, sizes));
    this.tile = 0;
    this.planes = planes.map((p) => planeMesh(p, planes.filter((o) => o !== p), sizes)).filter((p) => p);
    this.planes.forEach((p) => { this.scene.add(p); this.tile = this.tile || p.tile; });
    const places = new Places(setting.bodies, this.bodies);
    this.springs = setting.springs.map((s) => new Spring(s, places, this.scene, sizes.view));
    this.joints = setting.joints.map((j, i) => new Joint(j, i, motion, places, this.scene, sizes.view));
    this.marks = new Marks(motion, this.scene, sizes.radius);
    this.window = Math.min(duration, Math.max(2, duration / 6));
    this.trails = this.moving.map((b) => {
      const line = lineOf(TRAIL_POINTS + 2, b.colour, true);
      this.scene.add(line);
      return line;
    });
    this.travels = this.moving.map((b) => this.travel(b) > 0.05 * b.radius);
    this.light(sizes);
    this.middle = new THREE.Vector3();
    this.addDots(0.008 * sizes.view);
  }

  light(sizes) {
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xb8c0ca, 0.72));
    const sun = new THREE.DirectionalLight(0xffffff, 0.36), reach = 0.75 * sizes.view;
    sun.position.copy(sizes.center).add(new THREE.Vector3(0.3, -0.75, 1.2).multiplyScalar(2 * sizes.view));
    sun.target.position.copy(sizes.center);
    sun.castShadow = this.planes.length > 0 && !this.many;
    Object.assign(sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1 * sizes.view, far: 6 * sizes.view });
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.bias = -0.003;
    this.scene.add(sun, sun.target);
  }

  /// Bodies that are too small to be seen.
  addDots(least) {
    for (const body of this.bodies.slice(0, this.motion.moving).filter((b) => b.radius < least)) {
      const material = new THREE.PointsMaterial({ color: body.colour, size: 5, sizeAttenuation: false });
      body.group.add(new THREE.Points(new THREE.BufferGeometry().setFromPoints([new THREE.Vector3()]), material));
    }
  }

  /// m, how far a body gets from where it began.
  travel(body) {
    const m = this.motion, first = m.position({ k: 0, part: 0 }, body.number, new THREE.Vector3()), x = new THREE.Vector3();
    let most = 0;
    for (let k = 0; k < m.times.length; k += Math.ceil(m.times.length / 400)) {
      most = Math.max(most, m.position({ k, part: 0 }, body.number, x).distanceTo(first));
    }
    return most;
  }

  /// Of the mass centre, or where that stays, of the tip of ω.
  drawTrail(i, at, t, shown, scales) {
    const line = this.trails[i], body = this.moving[i], m = this.motion;
    const reach = scales.omega > 0 ? 1.9 * body.radius / scales.omega : 0;
    line.visible = shown && (this.travels[i] || reach > 0);
    if (!line.visible) return;
    const first = m.instant(Math.max(m.start, t - this.window)), stride = Math.max(1, Math.ceil((at.k - first) / TRAIL_POINTS));
    const position = line.geometry.attributes.position, colour = line.geometry.attributes.color, x = new THREE.Vector3(), c = new THREE.Color();
    const sky = this.scene.background, ink = new THREE.Color(this.travels[i] ? body.colour : OMEGA);
    let n = 0;
    const add = (where) => {
      if (this.travels[i]) m.position(where, body.number, x);
      else m.angularVelocity(where, body.number, x).multiplyScalar(reach).add(body.group.position);
      position.setXYZ(n, x.x, x.y, x.z);
      const age = Math.min(1, (t - m.times[where.k]) / this.window);
      c.copy(ink).lerp(sky, 0.85 * age);
      colour.setXYZ(n++, c.r, c.g, c.b);
    };
    for (let k = Math.ceil(first / stride) * stride; k <= at.k && n < TRAIL_POINTS + 1; k += stride) add({ k, part: 0 });
    add(at);
    line.geometry.setDrawRange(0, n);
    position.needsUpdate = colour.needsUpdate = true;
  }

  /// What is there at t, or at the end of what was recorded.
  show(t, shown, scales, life) {
    const at = this.motion.at(t), now = Math.min(t, this.motion.end);
    for (let i = 0; i < this.motion.moving; ++i) this.bodies[i].place(this.motion, at);
    this.moving.forEach((b, i) => {
      b.pointVectors(this.motion, at, shown, scales);
      this.drawTrail(i, at, now, shown.trails, scales);
      if (shown.polhode && !b.polhode && scales.omega > 0) b.polhode = polhodeOf(this.motion, b, scales.omega);
      if (b.polhode) b.polhode.visible = shown.polhode;
    });
    this.springs.forEach((s) => s.stretch(shown.springs));
    this.joints.forEach((j) => j.show(at, shown, scales));
    this.planes.forEach((p) => { p.visible = shown.floor; });
    this.marks.show(now, life, shown.marks);
    if (shown.follow) this.motion.middle(at, this.middle);
    else this.middle.set(0, 0, 0);
    return at;
  }
}
