// SPDX-License-Identifier: BSD-3-Clause
// Joints of a run: anchors with the line between them, axes, where a body that rolls touches its plane, and reactions.

/// Between two points, of radius 1 before it is stretched.
function stretch(rod, from, to, radius) {
  const way = to.clone().sub(from), length = way.length();
  rod.position.copy(from);
  if (length > 0) rod.quaternion.setFromUnitVectors(Arrow.up, way.multiplyScalar(1 / length));
  rod.scale.set(radius, radius, Math.max(length, 1e-9));
}

class Joint {
  /// All of it is drawn over the bodies.
  constructor(data, number, motion, places, scene, view) {
    Object.assign(this, { data, number, motion, places, view });
    const material = new THREE.MeshLambertMaterial({ color: theme.ink, transparent: true, opacity: 0.85, depthTest: false });
    const paper = new THREE.MeshBasicMaterial({ color: theme.paper, transparent: true, depthTest: false });
    this.group = new THREE.Group();
    const add = (geometry, look, order) => {
      const mesh = new THREE.Mesh(geometry, look);
      mesh.renderOrder = order;
      this.group.add(mesh);
      return mesh;
    };
    this.rods = [0, 1, 2].map(() => add(Arrow.rod, material, 2));  // the line between the anchors and the axes of both bodies
    this.rims = [0, 1].map(() => add(Joint.ball, material, 4));
    this.dots = [0, 1].map(() => add(Joint.ball, paper, 5));
    this.arrow = new Arrow(REACTION, 0.004 * view, 0.03 * view);
    for (const mesh of this.arrow.group.children) Object.assign(mesh, { renderOrder: 3 }).material.setValues({ transparent: true, depthTest: false });
    scene.add(this.group, this.arrow.group);
  }

  /// Where the reaction acts: on the first body, or where it touches the plane on which it rolls.
  point() {
    const { ends, radius, axis, normal } = this.data, point = this.places.point(ends.body, ends.anchor);
    if (radius === 0) return point;
    const out = this.places.direction(ends.other, normal), across = this.places.direction(ends.body, axis);
    out.addScaledVector(across, -out.dot(across)).normalize();
    return point.addScaledVector(out, -radius);
  }

  force(at) { return this.motion.reaction(at, this.number, new THREE.Vector3()); }

  show(at, shown, scales) {
    const { ends, onPlane, radius, axis, axisOther } = this.data, from = this.point();
    const to = onPlane ? from : this.places.point(ends.other, ends.anchorOther);
    this.group.visible = shown.joints;
    stretch(this.rods[0], from, to, 0.002 * this.view);
    [this.places.direction(ends.body, axis), this.places.direction(ends.other, axisOther)].forEach((along, i) => {
      along.multiplyScalar(0.05 * this.view);
      const rod = this.rods[i + 1];
      rod.visible = radius === 0 && along.lengthSq() > 0;
      stretch(rod, from.clone().sub(along), from.clone().add(along), 0.0016 * this.view);
    });
    [from, to].forEach((place, i) => {
      this.rims[i].position.copy(place);
      this.dots[i].position.copy(place);
      this.rims[i].scale.setScalar(0.007 * this.view);
      this.dots[i].scale.setScalar(0.0045 * this.view);
    });
    this.arrow.group.visible = false;
    if (!shown.reactions || !(scales.force > 0) || this.motion.joints === 0) return;
    const force = this.force(at), share = force.length() / scales.force;
    this.arrow.group.position.copy(from);
    if (share > 0.02) this.arrow.point(force, Joint.reach * this.view * share);
  }
}
Joint.ball = new THREE.SphereBufferGeometry(1, 16, 12);
Joint.reach = 0.2;  // length of the arrow of the largest reaction over the size of the scene
