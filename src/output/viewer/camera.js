
// The camera turns about a point: `yaw` and `pitch` say from where it looks, z is up on the screen.

const kHalfAngle = Math.tan((14 * Math.PI) / 180);  // of what is seen above the middle
const kMargin = 1.08;

class Camera {
  // `views`: by name, the directions to the eye.
  constructor(corners, views) {
    this.corners = corners;
    this.views = views;
    const low = [0, 1, 2].map((i) => corners.reduce((m, p) => Math.min(m, p[i]), Infinity));
    const high = [0, 1, 2].map((i) => corners.reduce((m, p) => Math.max(m, p[i]), -Infinity));
    this.middle = low.map((value, i) => 0.5 * (value + high[i]));
    this.box = [0, 1, 2, 3, 4, 5, 6, 7].map((n) => [0, 1, 2].map((i) => ((n >> i) & 1 ? high[i] : low[i])));
    this.radius = Math.max(1, corners.reduce((m, p) => Math.max(m, Math.hypot(...p.map((v, i) => v - this.middle[i]))), 0));
    // Below the lowest corner, so that what lies on the ground is not in its own shadow.
    this.ground = low[2] - Math.min(0.5, 0.01 * this.radius);
    this.aspect = 1;
    this.look('iso');
  }

  look(view) {
    const [x, y, z] = this.views[view];
    this.yaw = Math.atan2(y, x);
    this.pitch = Math.atan2(z, Math.hypot(x, y));
    this.fit();
  }

  // As near as it gets with all of the sweep in view.
  fit() {
    this.fitted = true;
    this.target = this.middle;
    const { out, right, up } = this.directions();
    // First about the middle of the box, then about the middle of what is seen.
    for (let round = 0; round < 3; ++round) {
      let least = 0;
      const box = [Infinity, -Infinity, Infinity, -Infinity];
      for (const p of this.corners) {
        const d = [0, 1, 2].map((i) => p[i] - this.target[i]);
        const depth = dot(d, out);
        const x = dot(d, right);
        const y = dot(d, up);
        least = Math.max(least, depth + (kMargin * Math.abs(y)) / kHalfAngle,
          depth + (kMargin * Math.abs(x)) / (kHalfAngle * this.aspect));
      }
      this.distance = Math.max(least, 1);
      for (const p of this.corners) {
        const d = [0, 1, 2].map((i) => p[i] - this.target[i]);
        const scale = this.distance / (this.distance - dot(d, out));
        const x = dot(d, right) * scale;
        const y = dot(d, up) * scale;
        box[0] = Math.min(box[0], x);
        box[1] = Math.max(box[1], x);
        box[2] = Math.min(box[2], y);
        box[3] = Math.max(box[3], y);
      }
      if (round === 2) break;
      const dx = 0.5 * (box[0] + box[1]);
      const dy = 0.5 * (box[2] + box[3]);
      this.target = this.target.map((value, i) => value + dx * right[i] + dy * up[i]);
    }
  }

  directions() {
    const { yaw, pitch } = this;
    const out = [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch)];
    const right = [-Math.sin(yaw), Math.cos(yaw), 0];
    return { out, right, up: cross(out, right) };
  }

  eye() {
    const { out } = this.directions();
    return this.target.map((value, i) => value + this.distance * out[i]);
  }

  turn(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.pitch + pitch));
    this.fitted = false;
  }

  zoom(factor) {
    this.distance = Math.min(20 * this.radius, Math.max(0.02 * this.radius, this.distance * factor));
    this.fitted = false;
  }

  // By parts of the height of the picture.
  move(x, y) {
    const { right, up } = this.directions();
    const scale = 2 * kHalfAngle * this.distance;
    this.target = this.target.map((value, i) => value - scale * (x * right[i] - y * up[i]));
    this.fitted = false;
  }

  // From the world to clip space, column after column.
  matrix() {
    const { out, right, up } = this.directions();
    const eye = this.eye();
    // As narrow as the box of the scene and its shadow allow, for the sake of depth.
    const depths = this.box.map((p) => dot(out, eye) - dot(out, p));
    const reach = Math.max(...depths) + 2 * this.radius;
    const near = Math.max(0.02 * this.distance, Math.min(...depths) * 0.95);
    const sx = 1 / (kHalfAngle * this.aspect);
    const sy = 1 / kHalfAngle;
    const a = (reach + near) / (reach - near);
    const b = (2 * reach * near) / (reach - near);
    const rows = [
      [...right.map((v) => v * sx), -sx * dot(right, eye)],
      [...up.map((v) => v * sy), -sy * dot(up, eye)],
      [...out.map((v) => -v * a), a * dot(out, eye) - b],
      [...out.map((v) => -v), dot(out, eye)],
    ];
    return [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]));
  }

  // The direction of the ray through a point of the picture, from −1 to 1 each way.
  ray(x, y) {
    const { out, right, up } = this.directions();
    return [0, 1, 2].map((i) => x * kHalfAngle * this.aspect * right[i] + y * kHalfAngle * up[i] - out[i]);
  }
}
