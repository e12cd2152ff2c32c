
// Drawing with WebGL 2: all bodies at once, their places in a texture of numbers.

const kFrameWidth = 256;  // bodies a row of that texture, four texels each

const kFrames = `
  uniform highp sampler2D frames;
  uniform mat4 camera;
  uniform float lift;     // mm before the plate, of plates that can be thick
  uniform float stretch;  // what distances before the plate are multiplied by
  vec4 texel(float body, int i) {
    int b = int(body);
    return texelFetch(frames, ivec2((b % ${kFrameWidth}) * 4 + i, b / ${kFrameWidth}), 0);
  }
  vec3 placed(float body, vec3 at) {
    vec4 p = vec4(at.xy, at.z * stretch + lift * texel(body, 3).z, 1.0);
    return vec3(dot(texel(body, 0), p), dot(texel(body, 1), p), dot(texel(body, 2), p));
  }
`;

const kHead = '#version 300 es\nprecision highp float;\nprecision highp int;\n';

const kLight = `
  // Paper turned to the light is as it is printed; what turns away from it grows a little darker.
  vec3 lit(vec3 color, vec3 world) {
    vec3 n = normalize(cross(dFdx(world), dFdy(world)));
    float light = 0.76 + 0.24 * max(0.0, dot(n, normalize(vec3(-0.35, -0.45, 0.82))));
    light += 0.13 * max(0.0, dot(n, normalize(vec3(0.8, 0.5, 0.3))));
    return color * min(light, 1.0);
  }
  vec3 marked(vec3 color, vec2 state) {
    color = mix(color, vec3(0.90, 0.12, 0.10) * (0.35 + 0.65 * dot(color, vec3(0.3333))), 0.82 * state.x);
    return mix(color, vec3(1.0, 0.86, 0.45), 0.28 * state.y);
  }
`;

const kPrograms = {
  paper: [`${kHead}${kFrames}
    in vec3 at;
    in vec3 color;
    in vec3 back;
    in float body;
    out vec3 world;
    out vec3 paint;
    out vec3 behind;
    flat out vec2 state;
    void main() {
      world = placed(body, at);
      paint = color;
      behind = back;
      state = texel(body, 3).xy;
      gl_Position = camera * vec4(world, 1.0);
    }`, `${kHead}${kLight}
    in vec3 world;
    in vec3 paint;
    in vec3 behind;
    flat in vec2 state;
    out vec4 result;
    void main() { result = vec4(lit(marked(gl_FrontFacing ? paint : behind, state), world), 1.0); }`],
  picture: [`${kHead}${kFrames}
    in vec3 at;
    in vec2 place;
    in float body;
    out vec3 world;
    out vec2 where;
    flat out vec2 state;
    void main() {
      world = placed(body, at);
      where = place;
      state = texel(body, 3).xy;
      gl_Position = camera * vec4(world, 1.0);
    }`, `${kHead}${kLight}
    uniform sampler2D picture;
    in vec3 world;
    in vec2 where;
    flat in vec2 state;
    out vec4 result;
    void main() {
      vec4 c = texture(picture, where);
      result = vec4(c.a == 0.0 ? c.rgb : lit(marked(c.rgb / c.a, state), world) * c.a, c.a);
    }`],
  shadow: [`${kHead}${kFrames}
    uniform float ground;
    uniform vec2 slant;
    in vec3 at;
    in float body;
    void main() {
      vec3 p = placed(body, at);
      p.xy += slant * (p.z - ground);
      p.z = ground;
      gl_Position = camera * vec4(p, 1.0);
    }`, `${kHead}
    uniform float strength;
    out vec4 result;
    void main() { result = vec4(0.0, 0.0, 0.0, strength); }`],
  // Lines as wide as `width` pixels, a little nearer than the paper whose edges they are.
  line: [`${kHead}${kFrames}
    uniform vec2 size;
    uniform vec3 eye;
    uniform float pixel;
    in vec2 corner;
    in vec3 begin;
    in vec3 end;
    in float body;
    in vec3 style;
    out float ink;
    vec3 towards(vec3 p, float by) {
      vec3 to = eye - p;
      float d = length(to);
      return p + to / d * min(by * (0.03 + 0.06 * pixel * d), 0.3 * d);
    }
    vec3 seen(vec3 p) {
      vec4 q = camera * vec4(p, 1.0);
      return q.xyz / q.w;
    }
    // How much deeper the plane of the body lies where the line is wide, so that it is no nearer there than its paper.
    float deeper(vec3 p, vec2 shift) {
      vec3 n = vec3(texel(body, 0).z, texel(body, 1).z, texel(body, 2).z);
      vec3 t = normalize(cross(n, abs(n.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
      vec3 o = seen(p);
      vec3 a = seen(p + t) - o;
      vec3 b = seen(p + cross(n, t)) - o;
      float det = a.x * b.y - a.y * b.x;
      if (abs(det) < 1e-10) return 0.0;
      float z = dot(vec2(a.z * b.y - b.z * a.y, a.x * b.z - b.x * a.z) / det, shift);
      float most = abs(seen(towards(p, 60.0)).z - o.z);
      return clamp(z, -most, most);
    }
    void main() {
      vec3 from = towards(placed(body, begin), 1.0);
      vec3 to = towards(placed(body, end), 1.0);
      vec3 own = corner.x < 0.0 ? from : to;
      vec4 p = camera * vec4(own, 1.0);
      vec2 along = (seen(to).xy - seen(from).xy) * size;
      float length_px = length(along);
      along = length_px > 1e-4 ? along / length_px : vec2(1.0, 0.0);
      vec2 shift = (corner.x * 0.3 * along + corner.y * vec2(-along.y, along.x)) * style.x / size;
      gl_Position = p + vec4(shift, style.z * deeper(own, shift), 0.0) * p.w;
      ink = style.y;
    }`, `${kHead}
    in float ink;
    out vec4 result;
    void main() { result = vec4(vec3(0.10, 0.12, 0.15) * ink, ink); }`],
};

function makeProgram(gl, [vertex, fragment]) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) || 'shader');
  return new Proxy({}, {
    get: (_, name) => (name === 'program' ? program : gl.getUniformLocation(program, name)),
  });
}

// A batch of triangles; attributes by name: their numbers and how many make one.
function makeBatch(gl, program, lists, indices, each = 0) {
  const batch = { array: gl.createVertexArray(), count: indices.length };
  gl.bindVertexArray(batch.array);
  for (const [name, [values, size]] of Object.entries(lists)) {
    const at = gl.getAttribLocation(program.program, name);
    if (at < 0) continue;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(values), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
    if (each > 0 && name !== 'corner') gl.vertexAttribDivisor(at, 1);
  }
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(indices), gl.STATIC_DRAW);
  batch.each = each;
  return batch;
}

function drawBatch(gl, batch) {
  if (batch.count === 0) return;
  gl.bindVertexArray(batch.array);
  if (batch.each > 0) gl.drawElementsInstanced(gl.TRIANGLES, batch.count, gl.UNSIGNED_INT, 0, batch.each);
  else gl.drawElements(gl.TRIANGLES, batch.count, gl.UNSIGNED_INT, 0);
}

// All meshes that are wanted, as lists of numbers.
function gather(scene, wanted) {
  const lists = { at: [[], 3], color: [[], 3], back: [[], 3], place: [[], 2], body: [[], 1] };
  const indices = [];
  scene.bodies.forEach((body, number) => {
    for (const mesh of body.meshes) {
      if (!wanted(mesh)) continue;
      const first = lists.body[0].length;
      for (let i = 0; i < mesh.at.length; i += 3) {
        lists.at[0].push(mesh.at[i], mesh.at[i + 1], mesh.at[i + 2]);
        lists.color[0].push(...mesh.color.map((value) => value / 255));
        lists.back[0].push(...mesh.back.map((value) => value / 255));
        if (mesh.places) lists.place[0].push(mesh.places[(2 * i) / 3], mesh.places[(2 * i) / 3 + 1]);
        lists.body[0].push(number);
      }
      for (const index of mesh.triangles) indices.push(first + index);
    }
  });
  if (lists.place[0].length === 0) delete lists.place;
  return [lists, indices];
}

// The sides of plates that are flat, along all of their edges: 1 before the plate and 1 behind it.
function gatherWalls(scene) {
  const lists = { at: [[], 3], color: [[], 3], back: [[], 3], body: [[], 1] };
  const indices = [];
  scene.bodies.forEach((body, number) => {
    const paper = body.meshes.find((mesh) => !mesh.drawn);
    if (!body.flat || !paper) return;
    const color = paper.back.map((value) => value / 255);
    for (const list of [body.edges.cut, body.edges.fold]) {
      for (let i = 0; i + 5 < list.length; i += 6) {
        const first = lists.body[0].length;
        for (const [end, side] of [[0, -1], [3, -1], [3, 1], [0, 1]]) {
          lists.at[0].push(list[i + end], list[i + end + 1], side);
          lists.color[0].push(...color);
          lists.back[0].push(...color);
          lists.body[0].push(number);
        }
        for (const index of [0, 1, 2, 0, 2, 3]) indices.push(first + index);
      }
    }
  });
  return [lists, indices];
}

const kLineStyles = { cut: [0.75, 0.80], fold: [0.55, 0.38], line: [0.6, 0.95] };  // half width in px, ink

function gatherLines(scene) {
  const lists = {
    corner: [[-1, -1, 1, -1, 1, 1, -1, 1], 2],
    begin: [[], 3],
    end: [[], 3],
    body: [[], 1],
    style: [[], 3],
  };
  scene.bodies.forEach((body, number) => {
    for (const [kind, style] of Object.entries(kLineStyles)) {
      const list = body.edges[kind];
      for (let i = 0; i + 5 < list.length; i += 6) {
        lists.begin[0].push(list[i], list[i + 1], list[i + 2]);
        lists.end[0].push(list[i + 3], list[i + 4], list[i + 5]);
        lists.body[0].push(number);
        lists.style[0].push(...style, body.flat ? 1 : 0);
      }
    }
  });
  return lists;
}

class Painter {
  // `ready`: called when a picture has come that was not there before.
  constructor(gl, scene, ready) {
    this.gl = gl;
    this.scene = scene;
    this.programs = {};
    for (const [name, texts] of Object.entries(kPrograms)) this.programs[name] = makeProgram(gl, texts);
    const { paper, picture, shadow, line } = this.programs;
    this.paper = makeBatch(gl, paper, ...gather(scene, (mesh) => !mesh.drawn && mesh.picture === undefined));
    this.prints = makeBatch(gl, paper, ...gather(scene, (mesh) => mesh.drawn && mesh.picture === undefined));
    this.walls = makeBatch(gl, paper, ...gatherWalls(scene));
    this.shadow = makeBatch(gl, shadow, ...gather(scene, (mesh) => !mesh.drawn));
    const lines = gatherLines(scene);
    this.lines = makeBatch(gl, line, lines, [0, 1, 2, 0, 2, 3], lines.body[0].length);
    if (this.lines.each === 0) this.lines.count = 0;
    this.pictures = scene.pictures.map((address, number) => ({
      batch: makeBatch(gl, picture, ...gather(scene, (mesh) => mesh.picture === number)),
      texture: this.load(address, ready),
    }));
    this.rows = Math.max(1, Math.ceil(scene.bodies.length / kFrameWidth));
    this.numbers = new Float32Array(this.rows * kFrameWidth * 16);
    this.frames = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.frames);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  }

  load(address, ready) {
    const gl = this.gl;
    const texture = { texture: gl.createTexture(), there: false };
    const image = new Image();
    image.addEventListener('load', () => {
      if (gl.isContextLost()) return;
      const most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
      const scale = Math.min(1, most / Math.max(image.naturalWidth, image.naturalHeight));
      let source = image;
      if (scale < 1) {
        source = document.createElement('canvas');
        source.width = Math.max(1, Math.floor(scale * image.naturalWidth));
        source.height = Math.max(1, Math.floor(scale * image.naturalHeight));
        source.getContext('2d').drawImage(image, 0, 0, source.width, source.height);
      }
      gl.bindTexture(gl.TEXTURE_2D, texture.texture);
      gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, true);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, source);
      gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
      texture.there = true;
      ready();
    });
    image.src = address;
    return texture;
  }

  place(degrees, paper) {
    const { gl, scene, numbers } = this;
    scene.bodies.forEach((body, number) => {
      const { axes, origin } = body.node;
      const by = apart(scene, body, degrees, paper);
      body.shift = by;
      for (let row = 0; row < 3; ++row) {
        const at = 16 * number + 4 * row;
        numbers[at] = axes[row];
        numbers[at + 1] = axes[3 + row];
        numbers[at + 2] = axes[6 + row];
        numbers[at + 3] = origin[row] + by[row];
      }
      numbers[16 * number + 12] = body.collides ? 1 : 0;
      numbers[16 * number + 13] = body.hovered ? 1 : 0;
      numbers[16 * number + 14] = body.flat ? 1 : 0;
    });
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.frames);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 4 * kFrameWidth, this.rows, 0, gl.RGBA, gl.FLOAT, numbers);
  }

  use(program, matrix) {
    const gl = this.gl;
    gl.useProgram(program.program);
    gl.uniform1i(program.frames, 0);
    gl.uniformMatrix4fv(program.camera, false, matrix);
    this.lay(program, 0, 1);
  }
  lay(program, lift, stretch) {
    this.gl.uniform1f(program.lift, lift);
    this.gl.uniform1f(program.stretch, stretch);
  }

  // `scale`: pixels of the picture a pixel of the page; `paper`: its thickness in mm; `edges`: whether they are drawn.
  draw(camera, degrees, scale, paper, edges) {
    const { gl, programs } = this;
    const width = gl.drawingBufferWidth;
    const height = gl.drawingBufferHeight;
    const sides = paper > 0 ? [paper / 2, -paper / 2] : [0];
    this.place(degrees, paper);
    const matrix = new Float32Array(camera.matrix());
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.disable(gl.CULL_FACE);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    if (camera.eye()[2] > camera.ground) this.drawShadow(matrix, camera.ground);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.disable(gl.BLEND);
    this.use(programs.paper, matrix);
    for (const side of sides) {
      this.lay(programs.paper, side, 1);
      drawBatch(gl, this.paper);
    }
    if (paper > 0) {
      this.lay(programs.paper, 0, paper / 2);
      drawBatch(gl, this.walls);
    }
    // What is printed is seen from the front only.
    gl.enable(gl.CULL_FACE);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(0, -4);
    this.lay(programs.paper, paper / 2, 1);
    drawBatch(gl, this.prints);
    gl.enable(gl.BLEND);
    this.use(programs.picture, matrix);
    this.lay(programs.picture, paper / 2, 1);
    gl.activeTexture(gl.TEXTURE1);
    gl.uniform1i(programs.picture.picture, 1);
    for (const { batch, texture } of this.pictures) {
      if (!texture.there) continue;
      gl.bindTexture(gl.TEXTURE_2D, texture.texture);
      drawBatch(gl, batch);
    }
    gl.activeTexture(gl.TEXTURE0);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.disable(gl.CULL_FACE);
    if (edges) this.drawLines(camera, matrix, scale, sides);
    gl.disable(gl.BLEND);
  }

  drawLines(camera, matrix, scale, sides) {
    const { gl, programs } = this;
    const width = gl.drawingBufferWidth;
    const height = gl.drawingBufferHeight;
    this.use(programs.line, matrix);
    gl.uniform2f(programs.line.size, width / scale / 2, height / scale / 2);
    gl.uniform3fv(programs.line.eye, camera.eye());
    gl.uniform1f(programs.line.pixel, (2 * kHalfAngle * scale) / height);
    for (const side of sides) {
      this.lay(programs.line, side, 1);
      drawBatch(gl, this.lines);
    }
  }

  // A soft shadow of several hard ones, each of which covers a place once.
  drawShadow(matrix, ground) {
    const { gl, programs } = this;
    gl.disable(gl.DEPTH_TEST);
    gl.enable(gl.STENCIL_TEST);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE);
    this.use(programs.shadow, matrix);
    gl.uniform1f(programs.shadow.ground, ground);
    gl.uniform1f(programs.shadow.strength, 0.019);
    for (let i = 0; i < 8; ++i) {
      const angle = (i * Math.PI) / 4;
      const spread = i % 2 === 0 ? 0.035 : 0.075;
      gl.uniform2f(programs.shadow.slant, 0.12 + spread * Math.cos(angle), 0.16 + spread * Math.sin(angle));
      gl.stencilMask(1 << i);
      gl.stencilFunc(gl.NOTEQUAL, 255, 1 << i);
      drawBatch(gl, this.shadow);
    }
    gl.stencilMask(255);
    gl.disable(gl.STENCIL_TEST);
  }
}
