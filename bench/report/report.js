'use strict';

const data = JSON.parse(document.getElementById('data').textContent);
const colours = ['#2563eb', '#dc2626', '#059669', '#d97706', '#7c3aed', '#0891b2', '#be185d', '#4d7c0f', '#78350f', '#475569', '#f472b6', '#14b8a6', '#84cc16', '#1e3a8a', '#fb923c', '#111827'];
const variantNames = data.plan.variants.map(v => v.name);
const colourOf = name => colours[Math.max(0, variantNames.indexOf(name)) % colours.length];

// ---------------------------------------------------------------- small helpers

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  fill(node, attributes, children);
  return node;
}

function svg(tag, attributes = {}, ...children) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  fill(node, attributes, children);
  return node;
}

function fill(node, attributes, children) {
  for (const [key, value] of Object.entries(attributes))
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else node.setAttribute(key, value);
  for (const child of children) node.append(child);
}

/** Three significant digits, as people write them. */
function format(x) {
  if (x === null || x === undefined) return '–';
  if (x === 0) return '0';
  const size = Math.abs(x);
  if (size >= 1e5 || size < 1e-3) return x.toExponential(2).replace('e+', 'e');
  return String(Number(x.toPrecision(3)));
}

const megabytes = bytes => bytes === null ? '–' : format(bytes / 1e6);
const percent = x => x === null ? '–' : (100 * x).toFixed(1) + '%';

function intervalCell(interval, verdict = '') {
  const cell = element('td', {class: 'number ' + verdict});
  if (!interval || interval[0] === null) { cell.append('–'); return cell; }
  cell.append(format(interval[0]));
  if (interval[1] !== null)
    cell.append(element('span', {class: 'interval'}, `[${format(interval[1])}, ${format(interval[2])}]`));
  return cell;
}

function nameCell(name) {
  return element('td', {}, element('span', {class: 'swatch', style: `background:${colourOf(name)}`}), name);
}

function table(headings, rows) {
  const head = element('tr', {}, ...headings.map((h, i) => element('th', i ? {class: 'number'} : {}, h)));
  return element('div', {class: 'scroll'}, element('table', {}, element('thead', {}, head), element('tbody', {}, ...rows)));
}

function choice(label, options, onchange) {
  const select = element('select', {onchange: () => onchange(select.value)},
                         ...options.map(([value, text]) => element('option', {value}, text)));
  return [element('label', {}, label + ' ', select), select];
}

// ---------------------------------------------------------------- summary

function summaryTable(metric, at) {
  const headings = ['variant', ...data.scenes.map(s => s.name), 'geometric mean'];
  const rows = data.summary.map(summary => {
    const cells = data.scenes.map(scene => {
      const variant = scene.variants.find(v => v.name === summary.variant);
      const entry = variant && variant[at][metric];
      if (scene.failure || (variant && variant.failures.length)) return element('td', {class: 'number warning'}, 'failed');
      if (!entry) return element('td', {class: 'number'}, '–');
      if (!entry.ratio) return element('td', {class: 'number dim'}, '1');
      return intervalCell(entry.ratio, entry.verdict);
    });
    const mean = summary[at][metric];
    const last = mean ? intervalCell(mean.ratio, mean.verdict)
                      : element('td', {class: 'number dim'}, summary.variant === data.plan.baseline ? '1' : '–');
    return element('tr', {}, nameCell(summary.variant), ...cells, last);
  });
  return table(headings, rows);
}

function summarySection() {
  const holder = element('div');
  const shown = {metric: data.metrics[0].key, at: 'atEqualTime'};
  const show = () => holder.replaceChildren(summaryTable(shown.metric, shown.at));
  const [metricControl] = choice('error', data.metrics.map(m => [m.key, m.label]), value => { shown.metric = value; show(); });
  const [atControl] = choice('at', [['atEqualTime', 'equal time'], ['atEqualSpp', 'equal samples']], value => { shown.at = value; show(); });
  show();
  return element('section', {id: 'summary'},
    element('p', {}, `Error over that of “${data.plan.baseline}”: ratio of means over ${data.plan.seeds} seeds with its `
      + '95% interval. Below 1 is better; called better or worse only where the interval excludes 1.'),
    element('div', {class: 'controls'}, metricControl, atControl), holder);
}

// ---------------------------------------------------------------- plot

function decadeTicks(low, high) {
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
    for (const m of [1, 2, 5]) {
      const x = m * Math.pow(10, e);
      if (x >= low * 0.999 && x <= high * 1.001) ticks.push({x, major: m === 1});
    }
  return ticks;
}

function plotRange(scene, curveKey, metric) {
  const xs = [], ys = [];
  for (const variant of scene.variants)
    variant[curveKey].forEach((point, i) => {
      if (point[0] > 0) { xs.push(scene.grid[i]); ys.push(point[0]); }
      if (point[1] > 0) ys.push(point[1], point[2]);
    });
  for (const point of scene.imports) { xs.push(point.point.seconds); ys.push(point.point[metric]); }
  if (!xs.length) return null;
  return {x0: Math.min(...xs) / 1.1, x1: Math.max(...xs) * 1.1, y0: Math.min(...ys) / 1.3, y1: Math.max(...ys) * 1.3};
}

function drawAxes(plot, range, X, Y, w, h, pad, label) {
  for (const tick of decadeTicks(range.x0, range.x1)) {
    plot.append(svg('line', {class: 'grid', x1: X(tick.x), x2: X(tick.x), y1: pad, y2: h - pad, opacity: tick.major ? 1 : 0.4}));
    plot.append(svg('text', {x: X(tick.x), y: h - pad + 18, 'text-anchor': 'middle'}, format(tick.x)));
  }
  for (const tick of decadeTicks(range.y0, range.y1)) {
    plot.append(svg('line', {class: 'grid', x1: pad, x2: w - 20, y1: Y(tick.x), y2: Y(tick.x), opacity: tick.major ? 1 : 0.4}));
    plot.append(svg('text', {x: pad - 8, y: Y(tick.x) + 4, 'text-anchor': 'end'}, format(tick.x)));
  }
  plot.append(svg('text', {x: (w + pad) / 2, y: h - 6, 'text-anchor': 'middle'}, 'seconds, training included'));
  plot.append(svg('text', {x: 14, y: h / 2, 'text-anchor': 'middle', transform: `rotate(-90 14 ${h / 2})`}, label));
}

/** The slope of an estimator that has nothing left to learn: error falls as 1 / time. */
function drawGuide(plot, range, X, Y) {
  const x0 = range.x0, y0 = range.y1 / 1.2, x1 = Math.min(range.x1, x0 * y0 / range.y0), y1 = y0 * x0 / x1;
  plot.append(svg('path', {class: 'guide', d: `M${X(x0)} ${Y(y0)}L${X(x1)} ${Y(y1)}`}, svg('title', {}, 'slope -1')));
  const xm = Math.sqrt(x0 * x1), ym = Math.sqrt(y0 * y1);
  plot.append(svg('text', {x: X(xm) + 6, y: Y(ym) - 6}, 'slope −1'));
}

function drawCurve(plot, scene, variant, curveKey, X, Y) {
  const colour = colourOf(variant.name);
  const points = variant[curveKey].map((p, i) => ({x: scene.grid[i], y: p[0], low: p[1], high: p[2]})).filter(p => p.y > 0);
  const band = points.filter(p => p.low > 0);
  if (band.length > 1) {
    const upper = band.map(p => `${X(p.x)} ${Y(p.high)}`), lower = band.map(p => `${X(p.x)} ${Y(p.low)}`).reverse();
    plot.append(svg('path', {d: `M${upper.concat(lower).join('L')}Z`, fill: colour, opacity: 0.14}));
  }
  if (points.length > 1)
    plot.append(svg('path', {d: 'M' + points.map(p => `${X(p.x)} ${Y(p.y)}`).join('L'), fill: 'none', stroke: colour, 'stroke-width': 2}));
  for (const p of points)
    plot.append(svg('circle', {cx: X(p.x), cy: Y(p.y), r: 3, fill: colour},
                    svg('title', {}, `${variant.name}: ${format(p.y)} [${format(p.low)}, ${format(p.high)}] at ${format(p.x)} s`)));
}

function errorPlot(scene, metric, hidden) {
  const curveKey = metric === 'relMseTrimmed' ? 'trimmedCurve' : 'curve';
  const range = plotRange(scene, curveKey, metric);
  if (!range) return element('p', {class: 'dim'}, 'No picture was finished early enough for a curve.');
  const w = 1100, h = 480, pad = 62;
  const X = x => pad + (w - 20 - pad) * Math.log(x / range.x0) / Math.log(range.x1 / range.x0);
  const Y = y => h - pad - (h - 2 * pad) * Math.log(y / range.y0) / Math.log(range.y1 / range.y0);
  const plot = svg('svg', {class: 'plot', viewBox: `0 0 ${w} ${h}`, role: 'img', 'aria-label': `error against time, ${scene.name}`});
  drawAxes(plot, range, X, Y, w, h, pad, data.metrics.find(m => m.key === metric).label);
  drawGuide(plot, range, X, Y);
  for (const variant of scene.variants)
    if (!hidden.has(variant.name)) drawCurve(plot, scene, variant, curveKey, X, Y);
  for (const point of scene.imports) {
    const x = X(point.point.seconds), y = Y(point.point[metric]);
    plot.append(svg('path', {d: `M${x - 5} ${y}L${x} ${y - 5}L${x + 5} ${y}L${x} ${y + 5}Z`, fill: '#111'}));
    plot.append(svg('text', {x: x + 8, y: y + 4}, point.name));
  }
  return plot;
}

function plotSection(scene) {
  const holder = element('div');
  const hidden = new Set();
  let metric = 'relMse';
  const show = () => holder.replaceChildren(errorPlot(scene, metric, hidden));
  const [control] = choice('error', data.metrics.slice(0, 2).map(m => [m.key, m.label]), value => { metric = value; show(); });
  const toggles = scene.variants.map(variant => {
    const box = element('input', {type: 'checkbox', onchange: () => { box.checked ? hidden.delete(variant.name) : hidden.add(variant.name); show(); }});
    box.checked = true;
    return element('label', {}, box, ' ', element('span', {class: 'swatch', style: `background:${colourOf(variant.name)}`}), variant.name);
  });
  show();
  return element('section', {}, element('h3', {}, 'Error against time'), element('div', {class: 'controls'}, control, ...toggles), holder);
}

// ---------------------------------------------------------------- tables of a scene

function comparisonTable(scene, key) {
  const headings = ['variant', ...data.metrics.flatMap(m => [m.label, 'ratio'])];
  const rows = scene.variants.map(variant => element('tr', {}, nameCell(variant.name), ...data.metrics.flatMap(m => {
    const entry = variant[key][m.key];
    if (!entry) return [element('td', {class: 'number'}, '–'), element('td', {class: 'number'}, '–')];
    return [intervalCell(entry.error), entry.ratio ? intervalCell(entry.ratio, entry.verdict) : element('td', {class: 'number dim'}, '1')];
  })));
  return table(headings, rows);
}

function costTable(scene) {
  const headings = ['variant', 'seeds', 'spp', 'seconds', 'training s', 'CPU s', 'M rays', 'guided', 'memory MB', 'field MB',
                    'relMSE × CPU s', `s to ${data.plan.baseline}’s error`, 'bias of the mean'];
  const rows = scene.variants.map(variant => {
    const m = variant.means;
    const cells = [String(variant.seeds), format(m.spp), format(m.seconds), format(m.trainSeconds), format(m.cpuSeconds),
                   m.rays === null ? '–' : format(m.rays / 1e6), percent(m.guidedShare), megabytes(m.peakMemoryBytes), megabytes(m.fieldBytes)]
      .map(text => element('td', {class: 'number'}, text));
    return element('tr', {}, nameCell(variant.name), ...cells, intervalCell(variant.inefficiency),
                   intervalCell(variant.secondsToBaseline), intervalCell(variant.bias));
  });
  return table(headings, rows);
}

function failureList(scene) {
  const items = scene.variants.flatMap(v => v.failures.map(f => element('li', {class: 'warning'}, `${v.name}, seed ${f.seed}: ${f.why}`)));
  const missing = scene.variants.reduce((sum, v) => sum + v.missing, 0);
  if (missing) items.push(element('li', {class: 'warning'}, `${missing} cell(s) have not been run yet`));
  return items.length ? element('ul', {}, ...items) : '';
}

function referenceNote(reference) {
  if (!reference) return element('p', {class: 'warning'}, 'There is no reference.');
  const parts = [`Reference: ${reference.spp} spp, its own relMSE ${format(reference.noise)} (from two halves), lowest error measured ${format(reference.lowestError)}.`];
  if (reference.agreement) {
    const a = reference.agreement;
    parts.push(`Second estimator (relMSE ${format(reference.checkNoise)}): ${a.agrees ? 'agrees' : 'DISAGREES'}; worst of ${a.tests} tests (tiles and the whole) |t| = `
      + `${format(a.worstT)} (chance ${format(a.chanceOfWorst)}), mean differs by ${percent(a.meanDifference)}.`);
  }
  if (reference.foreignError !== null) parts.push(`A picture made by others differs from it by relMSE ${format(reference.foreignError)} (without the worst 0.1%).`);
  if (reference.note) parts.push(reference.note);
  const node = element('p', {class: 'dim'}, parts.join(' '));
  const warnings = [];
  if (!reference.converged) warnings.push('The reference is not converged to a tenth of the lowest error: errors near its own are inflated.');
  if (reference.agreement && !reference.agreement.agrees) warnings.push('The two reference estimators disagree: one of them is biased, or has not found all light.');
  return element('div', {}, node, ...warnings.map(w => element('p', {class: 'warning'}, w)));
}

// ---------------------------------------------------------------- pictures

function viewerTag(side, text) {
  return element('span', {class: 'tag', style: side + ':6px'}, text);
}

function pictureViewer(pictures) {
  const width = pictures[0].width, height = pictures[0].height;
  const shown = Math.min(1130, Math.max(width, 640));
  const view = {left: pictures[0], right: pictures[pictures.length > 1 ? 1 : 0], split: 0.5, zoom: 1, x: 0, y: 0};
  const leftImage = element('img', {alt: ''}), rightImage = element('img', {alt: ''});
  const clip = element('div', {class: 'clip'}, rightImage), handle = element('div', {class: 'handle'});
  const box = element('div', {class: 'viewer', style: `width:${shown}px;aspect-ratio:${width}/${height}`}, leftImage, clip, handle);
  const crops = element('div', {class: 'crops'});

  function update() {
    const transform = `translate(${view.x}px,${view.y}px) scale(${view.zoom})`;
    for (const [image, picture] of [[leftImage, view.left], [rightImage, view.right]]) {
      if (image.src !== picture.source) image.src = picture.source;
      image.style.transform = transform;
    }
    clip.style.clipPath = `inset(0 0 0 ${100 * view.split}%)`;
    handle.style.left = 100 * view.split + '%';
    box.querySelectorAll('.tag').forEach(tag => tag.remove());
    box.append(viewerTag('left', view.left.label), viewerTag('right', view.right.label));
  }
  function keepInside() {
    const r = box.getBoundingClientRect();
    view.x = Math.min(0, Math.max(r.width * (1 - view.zoom), view.x));
    view.y = Math.min(0, Math.max(r.height * (1 - view.zoom), view.y));
  }
  box.addEventListener('wheel', event => {
    event.preventDefault();
    const r = box.getBoundingClientRect(), px = event.clientX - r.left, py = event.clientY - r.top;
    const zoom = Math.min(32, Math.max(1, view.zoom * Math.pow(1.2, -Math.sign(event.deltaY))));
    view.x = px - (px - view.x) * zoom / view.zoom;
    view.y = py - (py - view.y) * zoom / view.zoom;
    view.zoom = zoom;
    keepInside();
    update();
  }, {passive: false});
  box.addEventListener('dblclick', event => {
    const r = box.getBoundingClientRect();
    drawCrops(crops, pictures, ((event.clientX - r.left - view.x) / view.zoom) / r.width, ((event.clientY - r.top - view.y) / view.zoom) / r.height);
  });
  let dragged = null;
  box.addEventListener('pointerdown', event => { dragged = {handle: event.target === handle, x: event.clientX - view.x, y: event.clientY - view.y}; box.setPointerCapture(event.pointerId); });
  box.addEventListener('pointerup', () => { dragged = null; });
  box.addEventListener('pointermove', event => {
    if (!dragged) return;
    const r = box.getBoundingClientRect();
    if (dragged.handle) view.split = Math.min(1, Math.max(0, (event.clientX - r.left) / r.width));
    else { view.x = event.clientX - dragged.x; view.y = event.clientY - dragged.y; keepInside(); }
    update();
  });

  const options = pictures.map((p, i) => [String(i), p.label]);
  const [leftControl] = choice('left', options, i => { view.left = pictures[i]; update(); });
  const [rightControl, rightSelect] = choice('right', options, i => { view.right = pictures[i]; update(); });
  rightSelect.value = String(pictures.indexOf(view.right));
  update();
  return element('section', {}, element('h3', {}, 'Pictures of the first seed'),
    element('div', {class: 'controls'}, leftControl, rightControl,
      element('span', {class: 'dim'}, 'drag the bar; wheel zooms, drag moves; double-click cuts the same crop out of all')),
    box, crops);
}

/** The same square of every picture, 32 pixels wide, about (u, v) in [0, 1]^2. */
function drawCrops(holder, pictures, u, v) {
  const side = 32;
  holder.replaceChildren(...pictures.filter(p => !p.isError).map(picture => {
    const canvas = element('canvas', {width: side, height: side});
    const image = new Image();
    image.onload = () => canvas.getContext('2d').drawImage(image, Math.round(u * image.width - side / 2), Math.round(v * image.height - side / 2), side, side, 0, 0, side, side);
    image.src = picture.source;
    return element('figure', {}, canvas, element('figcaption', {title: picture.label}, picture.label));
  }));
}

// ---------------------------------------------------------------- the page

function sceneSection(scene) {
  const section = element('section', {id: 'scene-' + scene.name}, element('h2', {}, scene.name));
  if (scene.failure) { section.append(element('p', {class: 'warning'}, scene.failure)); return section; }
  section.append(referenceNote(scene.reference), failureList(scene), plotSection(scene),
    element('h3', {}, `At equal time: ${format(scene.equalSeconds)} s`), comparisonTable(scene, 'atEqualTime'),
    element('h3', {}, `At equal samples: ${format(scene.equalSpp)} per pixel`), comparisonTable(scene, 'atEqualSpp'),
    element('h3', {}, 'What it took'), costTable(scene));
  const pictures = data.pictures[scene.name] || [];
  if (pictures.length) section.append(pictureViewer(pictures));
  return section;
}

function machineLine() {
  const m = data.machine;
  return `${m.processor}, ${m.threads} threads, ${m.memoryGB} GB; ${m.system}, Linux ${m.kernel}; ${m.compiler}, ${m.build}; guiding ${m.version}; ${m.date} UTC`;
}

document.getElementById('report').replaceChildren(
  element('h1', {}, `guiding-bench: ${data.plan.name}`),
  element('p', {}, data.plan.description),
  element('p', {class: 'dim'}, machineLine()),
  summarySection(),
  ...data.scenes.map(sceneSection));
document.body.dataset.ready = 'true';
