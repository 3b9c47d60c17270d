// SPDX-License-Identifier: BSD-3-Clause
// The drift of the energy over time, signed, linear near zero and logarithmic beyond, with a cursor at the present time.

const SUPERSCRIPT = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function powerOfTen(k) {
  const digits = String(Math.abs(k)).split("").map((d) => SUPERSCRIPT[d]).join("");
  return "10" + (k < 0 ? "⁻" : "") + digits;
}

class Plot {
  constructor(canvas, motions, colours, start, end) {
    this.canvas = canvas;
    this.motions = motions;
    this.colours = colours;
    this.start = start;
    this.end = end;
    this.backing = document.createElement("canvas");
    // Linear below a hundredth of the quietest curve, as a power of ten, so that it too can be told from zero.
    let quietest = Infinity, low = 0, high = 0;
    for (const m of motions) {
      let most = 0;
      for (const e of m.energy) {
        low = Math.min(low, e);
        high = Math.max(high, e);
        most = Math.max(most, Math.abs(e));
      }
      if (most > 0) quietest = Math.min(quietest, most);
    }
    this.exponent = isFinite(quietest) ? Math.max(-16, Math.floor(Math.log10(quietest / 100))) : -16;
    this.threshold = 10 ** this.exponent;
    this.low = Math.min(this.scaled(low), high > 0 && low === 0 ? 0 : -0.3);
    this.high = Math.max(this.scaled(high), low < 0 && high === 0 ? 0 : 0.3);
  }

  scaled(e) { return Math.sign(e) * Math.log10(1 + Math.abs(e) / this.threshold); }

  layout() {
    const ratio = window.devicePixelRatio || 1, width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    for (const c of [this.canvas, this.backing]) {
      c.width = Math.round(width * ratio);
      c.height = Math.round(height * ratio);
    }
    Object.assign(this, { ratio, width, height, left: 62, right: width - 14, top: 8, bottom: height - 26 });
    this.drawBacking();
  }

  x(t) { return this.left + (this.right - this.left) * (t - this.start) / Math.max(this.end - this.start, 1e-300); }
  y(e) { return this.bottom - (this.bottom - this.top) * (this.scaled(e) - this.low) / (this.high - this.low); }
  time(x) { return this.start + (this.end - this.start) * Math.min(1, Math.max(0, (x - this.left) / (this.right - this.left))); }

  yTicks() {
    const ticks = [[0, "0"]], room = (this.bottom - this.top) / (this.high - this.low);
    const every = Math.max(1, Math.ceil(17 / Math.max(room, 1e-9)));
    const most = Math.ceil(Math.max(this.high, -this.low));
    for (let k = 0; k <= most; ++k) {
      if (k % every !== 0 || k === 0 && room < 40) continue;
      for (const sign of [1, -1]) {
        const e = sign * 10 ** (this.exponent + k), s = this.scaled(e);
        if (s >= this.low && s <= this.high && Math.abs(s) * room > 15) ticks.push([e, (sign < 0 ? "−" : "") + powerOfTen(this.exponent + k)]);
      }
    }
    return ticks;
  }

  drawBacking() {
    const pen = this.backing.getContext("2d");
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.clearRect(0, 0, this.width, this.height);
    pen.font = "11.5px system-ui, 'DejaVu Sans', sans-serif";
    pen.lineWidth = 1;
    pen.textBaseline = "middle";
    pen.textAlign = "right";
    for (const [e, label] of this.yTicks()) {
      const y = Math.round(this.y(e)) + 0.5;
      pen.strokeStyle = e === 0 ? theme.soft : theme.rule;
      pen.beginPath();
      pen.moveTo(this.left, y);
      pen.lineTo(this.right, y);
      pen.stroke();
      pen.fillStyle = theme.soft;
      pen.fillText(label, this.left - 7, y);
    }
    pen.textBaseline = "top";
    const step = round((this.end - this.start) / Math.max(2, Math.floor(this.width / 110))), digits = Math.max(0, -Math.floor(Math.log10(step)));
    for (let k = Math.ceil(this.start / step); k * step <= this.end * (1 + 1e-12); ++k) {
      const x = Math.round(this.x(k * step)) + 0.5, label = (k * step).toFixed(Math.min(digits, 12)), last = x > this.right - 30;
      pen.textAlign = last ? "right" : "center";
      pen.strokeStyle = theme.rule;
      pen.beginPath();
      pen.moveTo(x, this.top);
      pen.lineTo(x, this.bottom + 4);
      pen.stroke();
      pen.fillText(label + (last ? " s" : ""), last ? Math.min(x + 12, this.width) : x, this.bottom + 8);
    }
    this.motions.forEach((m, i) => this.drawCurve(pen, m, this.colours[i], i));
  }

  /// Of all instants that share a column of pixels, the lowest and the highest.
  drawCurve(pen, motion, colour, number) {
    pen.strokeStyle = colour;
    pen.lineWidth = Math.max(1.2, 2.2 - 0.15 * number);
    pen.setLineDash(motion.run.dash);
    pen.lineJoin = "round";
    pen.beginPath();
    let column = null, low = 0, high = 0, last = 0, started = false;
    const flush = () => {
      for (const y of last === low ? [high, low] : [low, high]) {
        if (started) pen.lineTo(column / 2, y);
        else pen.moveTo(column / 2, y);
        started = true;
      }
      pen.lineTo(column / 2, last);
    };
    for (let k = 0; k < motion.times.length; ++k) {
      const c = Math.round(2 * this.x(motion.times[k])), y = this.y(motion.energy[k]);
      if (c !== column) {
        if (column !== null) flush();
        column = c;
        low = high = y;
      }
      low = Math.min(low, y);
      high = Math.max(high, y);
      last = y;
    }
    if (column !== null) flush();
    pen.stroke();
    pen.setLineDash([]);
  }

  draw(t) {
    const pen = this.canvas.getContext("2d");
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    pen.drawImage(this.backing, 0, 0);
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    const x = this.x(t);
    pen.strokeStyle = theme.ink;
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(x, this.top - 4);
    pen.lineTo(x, this.bottom + 4);
    pen.stroke();
    this.motions.forEach((m, i) => {
      if (t > m.end) return;
      pen.fillStyle = this.colours[i];
      pen.strokeStyle = theme.paper;
      pen.lineWidth = 1.5;
      pen.beginPath();
      pen.arc(x, this.y(m.energy[m.instant(t)]), 4.5, 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
    });
  }
}
