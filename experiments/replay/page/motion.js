// SPDX-License-Identifier: BSD-3-Clause
// The motion of a run: unpacked from the page's data, and where everything is at any time between its first and last instant.

function bytesOf(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}

const IMPACT = { t: 0, a: 1, b: 2, point: 3, normal: 6, impulse: 9, size: 10 };

class Motion {
  constructor(run) {
    this.run = run;
    this.moving = run.moving;
    this.times = new Float64Array(bytesOf(run.times));
    this.positions = new Float32Array(bytesOf(run.positions));
    this.orientations = new Int16Array(bytesOf(run.orientations));
    this.rates = new Int16Array(bytesOf(run.rates));
    this.reactions = new Float32Array(bytesOf(run.reactions));
    this.joints = this.reactions.length / 3 / this.times.length;  // with reactions
    this.energy = new Float32Array(bytesOf(run.energy));
    this.momentumDrift = run.momentumDrift ? new Float32Array(bytesOf(run.momentumDrift)) : null;
    this.impacts = new Float32Array(bytesOf(run.impacts));
    this.start = this.times[0];
    this.end = this.times[this.times.length - 1];
  }

  /// The last instant that is not after t, from 0.
  instant(t) {
    let low = 0, high = this.times.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= t) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /// Where t lies: an instant, and how far on the way to the next one. Never beyond what was recorded.
  at(t) {
    const k = this.instant(t);
    if (k + 1 >= this.times.length || t <= this.times[k]) return { k, part: 0 };
    return { k, part: (t - this.times[k]) / (this.times[k + 1] - this.times[k]) };
  }

  position(at, body, out) {
    const i = 3 * (at.k * this.moving + body), p = this.positions;
    out.set(p[i], p[i + 1], p[i + 2]);
    if (at.part > 0) {
      const j = i + 3 * this.moving;
      out.x += at.part * (p[j] - p[i]);
      out.y += at.part * (p[j + 1] - p[i + 1]);
      out.z += at.part * (p[j + 2] - p[i + 2]);
    }
    return out;
  }

  /// Of all bodies, however heavy.
  middle(at, out) {
    const x = Motion.one;
    out.set(0, 0, 0);
    for (let i = 0; i < this.moving; ++i) out.add(this.position(at, i, x));
    return out.multiplyScalar(1 / this.moving);
  }

  /// Kept as w, x, y, z.
  kept(k, body, out) {
    const i = 4 * (k * this.moving + body), q = this.orientations;
    return out.set(q[i + 1], q[i + 2], q[i + 3], q[i]).normalize();
  }

  orientation(at, body, out) {
    this.kept(at.k, body, out);
    if (at.part > 0) out.slerp(this.kept(at.k + 1, body, Motion.other), at.part);
    return out;
  }

  /// rad/s, world.
  angularVelocity(at, body, out) {
    const i = 3 * (at.k * this.moving + body), j = at.part > 0 ? i + 3 * this.moving : i, w = this.rates, s = this.run.fastest / 32767;
    const mix = (n) => s * (w[i + n] + at.part * (w[j + n] - w[i + n]));
    return out.set(mix(0), mix(1), mix(2));
  }

  /// N, world, of a joint on its first body.
  reaction(at, joint, out) {
    const i = 3 * (at.k * this.joints + joint), j = at.part > 0 ? i + 3 * this.joints : i, f = this.reactions;
    const mix = (n) => f[i + n] + at.part * (f[j + n] - f[i + n]);
    return out.set(mix(0), mix(1), mix(2));
  }

  impactCount() { return this.impacts.length / IMPACT.size; }
  impactTime(n) { return this.impacts[n * IMPACT.size]; }

  /// The number of the first impact after t.
  firstImpactAfter(t) {
    let low = 0, high = this.impactCount();
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.impactTime(middle) > t) high = middle;
      else low = middle + 1;
    }
    return low;
  }
}
Motion.other = new THREE.Quaternion();
Motion.one = new THREE.Vector3();
