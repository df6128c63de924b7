// The fixed parts of the page: its look, and the script that draws.
#ifndef GSLAM_APPS_OPTIMIZE_SCENE_SCRIPT_H
#define GSLAM_APPS_OPTIMIZE_SCENE_SCRIPT_H

namespace app {

constexpr const char* kSceneStyle =
    R"css(body { font: 15px/1.5 sans-serif; margin: 1.5em; color: #222; background: #fff; }
h1 { font-size: 1.3em; }
.pair { display: flex; gap: 1em; flex-wrap: wrap; }
figure { margin: 0; flex: 1 1 22em; }
canvas { width: 100%; height: 60vh; background: #14171c; touch-action: none; cursor: grab; }
figcaption { text-align: center; }
.note { color: #666; }
.kind0 { color: #5aa0ff; margin-left: 1em; }
.kind1 { color: #78c878; margin-left: 1em; }
.kind2 { color: #ff963c; margin-left: 1em; }
th { text-align: left; padding-right: 1em; font-weight: normal; color: #666; vertical-align: top; }
svg { width: 100%; max-width: 600px; }
polyline { fill: none; stroke: #9a3b26; stroke-width: 2; }
)css";

// Orthographic; nearer points hide others. Both scenes are seen in the same way.
constexpr const char* kSceneScript = R"js('use strict';
const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
const floats = text => new Float32Array(bytes(text).buffer);
const scenes = packed.map(s => ({points: floats(s.points), colors: bytes(s.colors),
                                 lines: floats(s.lines), kinds: bytes(s.kinds)}));
const lineColors = ['#5aa0ff', '#78c878', '#ff963c'];
const canvases = [...document.querySelectorAll('canvas')];
let view;
const reset = () => { view = {R: [...view0.R], zoom: 1, x: 0, y: 0}; };
reset();

// Rows of the projection to pixels, and the depth.
function projection(canvas) {
  const scale = view.zoom * Math.min(canvas.width, canvas.height) / 2 / view0.radius;
  const R = view.R, c = view0.centre;
  const row = (i, factor, shift) => {
    const r = [R[3 * i] * factor, R[3 * i + 1] * factor, R[3 * i + 2] * factor];
    return [...r, shift - r[0] * c[0] - r[1] * c[1] - r[2] * c[2]];
  };
  return [row(0, scale, canvas.width / 2 + view.x), row(1, scale, canvas.height / 2 + view.y),
          row(2, 1, 0)];
}
const apply = (row, a, i) => row[0] * a[i] + row[1] * a[i + 1] + row[2] * a[i + 2] + row[3];

function drawPoints(context, canvas, scene, [X, Y, Z]) {
  const width = canvas.width, height = canvas.height;
  const image = context.createImageData(width, height);
  const depth = new Float32Array(width * height).fill(Infinity);
  const size = scene.points.length < 30000 ? 2 : 1;
  for (let i = 0; i < scene.points.length; i += 3) {
    const u = Math.round(apply(X, scene.points, i)), v = Math.round(apply(Y, scene.points, i));
    const z = apply(Z, scene.points, i);
    if (!(u >= 0 && v >= 0 && u + size <= width && v + size <= height)) continue;
    for (let k = 0; k < size * size; ++k) {
      const at = (v + (k / size | 0)) * width + u + k % size;
      if (!(z < depth[at])) continue;
      depth[at] = z;
      for (let j = 0; j < 3; ++j) image.data[4 * at + j] = scene.colors[i + j];
      image.data[4 * at + 3] = 255;
    }
  }
  context.putImageData(image, 0, 0);
}

function drawLines(context, scene, [X, Y]) {
  context.globalAlpha = 0.7;
  for (let kind = 0; kind < lineColors.length; ++kind) {
    context.strokeStyle = lineColors[kind];
    context.beginPath();
    for (let i = 0; i < scene.kinds.length; ++i) {
      if (scene.kinds[i] !== kind) continue;
      context.moveTo(apply(X, scene.lines, 6 * i), apply(Y, scene.lines, 6 * i));
      context.lineTo(apply(X, scene.lines, 6 * i + 3), apply(Y, scene.lines, 6 * i + 3));
    }
    context.stroke();
  }
  context.globalAlpha = 1;
}

function drawAll() {
  canvases.forEach((canvas, i) => {
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    const context = canvas.getContext('2d'), rows = projection(canvas);
    drawPoints(context, canvas, scenes[i], rows);
    drawLines(context, scenes[i], rows);
  });
}
let isAsked = false;
function redraw() {
  if (isAsked) return;
  isAsked = true;
  requestAnimationFrame(() => { isAsked = false; drawAll(); });
}

// Turns what is seen about the axes of the screen.
function turn(aboutY, aboutX) {
  const cy = Math.cos(aboutY), sy = Math.sin(aboutY), cx = Math.cos(aboutX), sx = Math.sin(aboutX);
  const T = [cy, 0, sy, sx * sy, cx, -sx * cy, -cx * sy, sx, cx * cy], R = view.R;
  view.R = T.map((_, i) => {
    const r = i - i % 3, c = i % 3;
    return T[r] * R[c] + T[r + 1] * R[c + 3] + T[r + 2] * R[c + 6];
  });
}

for (const canvas of canvases) {
  canvas.addEventListener('pointerdown', event => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener('pointermove', event => {
    if (event.buttons === 0) return;
    const ratio = window.devicePixelRatio || 1;
    if (event.shiftKey || event.buttons !== 1) {
      view.x += event.movementX * ratio;
      view.y += event.movementY * ratio;
    } else {
      turn(event.movementX * 0.007, -event.movementY * 0.007);
    }
    redraw();
  });
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    const factor = Math.exp(-event.deltaY * 0.001);
    view.zoom *= factor;
    view.x *= factor;
    view.y *= factor;
    redraw();
  }, {passive: false});
  canvas.addEventListener('dblclick', () => { reset(); redraw(); });
}
window.addEventListener('resize', redraw);
redraw();
)js";

}  // namespace app

#endif  // GSLAM_APPS_OPTIMIZE_SCENE_SCRIPT_H
