// SPDX-License-Identifier: GPL-3.0-or-later
// The interactive parts of the report. Each <script class="live"> holds the data of one picture as JSON; the picture in its figure is what is
// printed, and what a browser without scripts shows.
(() => {
  "use strict";
  const floats = text => new Float32Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
  const element = (name, parent, text, className) => {
    const made = document.createElement(name);
    if (text) made.textContent = text;
    if (className) made.className = className;
    if (parent) parent.append(made);
    return made;
  };
  // Labels of ticks, whatever the language of the browser: with the decimals of their distance; on logarithms powers of ten, below two of them also 2 and 5.
  const number = text => text.replace("-", "−");
  const tick = (value, step) => {
    let decimals = 0;
    while (decimals < 6 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6 * step * 10 ** decimals) decimals++;
    return number(decimals < 6 && Math.abs(value) < 1e6 ? value.toFixed(decimals) : String(+value.toPrecision(3)));
  };
  const even = (u, ticks, index, space, step) => ticks.map(v => v == null ? "" : Math.abs(v) < 1e-9 * step ? "0" : tick(v, step));
  const powers = (u, ticks) => {
    const mantissa = v => Math.round(v / 10 ** Math.floor(Math.log10(v) + 1e-9));
    const few = ticks.filter(v => v && mantissa(v) === 1).length < 2;
    return ticks.map(v => !v || !(few ? [1, 2, 5] : [1]).includes(mantissa(v)) ? "" : number(v >= 1e-3 && v < 1e5 ? String(+v.toPrecision(3)) : v.toExponential(0)));
  };
  // Room (px) for labels beside an axis; of an axis kept while uPlot settles.
  const beside = labels => 17 + 7.2 * Math.max(0, ...labels.map(t => t.length));
  const room = least => (u, labels, index, cycle) => cycle > 1 ? u.axes[index]._size : Math.max(least, beside(labels || []));
  const axis = (label, size) => ({ label, size, values: even, labelSize: 18, font: "11px sans-serif", labelFont: "11px sans-serif", stroke: "#5b6b7b", grid: { stroke: "#edf0f4", width: 1 } });
  const plots = window.fretworkReport = { plots: [], scenes: [] };  // for scripts and tests

  // Histories and spectra: zoom by dragging, a double click shows all.
  function lines(data, place, width, height) {
    const x = typeof data.x === "string" ? floats(data.x) : Float64Array.from({ length: data.x.count }, (_, i) => data.x.start + i * data.x.step);
    const all = data.series.map(s => floats(s.values));
    const series = data.series.map(s => ({ label: s.name, stroke: s.colour, width: s.width ?? 1, points: { show: false }, value: (u, v) => v == null ? "–" : v.toPrecision(5) }));
    const plot = new uPlot({
      width, height,
      scales: { x: { time: false, distr: data.log ? 3 : 1 }, y: { distr: data.log ? 3 : 1 } },
      axes: [axis(data.xlabel, 34), axis(data.ylabel, room(58))].map(one => data.log ? { ...one, values: powers } : one),
      series: [{ label: data.xlabel, value: (u, v) => v == null ? "–" : v.toPrecision(7) }, ...series],
      bands: (data.bands || []).map(([upper, lower, fill]) => ({ series: [upper + 1, lower + 1], fill })),
      cursor: { drag: { x: true, y: true, uni: 30 } },
    }, [x, ...all.map(values => Array.from(values, v => Number.isFinite(v) ? v : null))], place);
    plots.plots.push(plot);
  }

  // An orbit: paths as lines, samples in contact as dots.
  function orbit(data, place, width) {
    const path = (dots) => (u, index) => {
      uPlot.orient(u, index, (series, xs, ys, scaleX, scaleY, toX, toY, left, top, wide, high, moveTo, lineTo, rect, arc) => {
        const [x, y] = u.data[index], shape = new Path2D(), r = dots ? 1.6 * devicePixelRatio : 0;
        let pen = false;
        for (let i = 0; i < x.length; i++) {
          if (!Number.isFinite(x[i]) || !Number.isFinite(y[i])) { pen = false; continue; }
          const px = toX(x[i], scaleX, wide, left), py = toY(y[i], scaleY, high, top);
          if (dots) { shape.moveTo(px + r, py); arc(shape, px, py, r, 0, 2 * Math.PI); }
          else if (pen) shape.lineTo(px, py);
          else shape.moveTo(px, py);
          pen = true;
        }
        u.ctx.save();
        u.ctx.beginPath(); u.ctx.rect(left, top, wide, high); u.ctx.clip();
        const colour = data.series[index - 1].colour;
        if (dots) { u.ctx.fillStyle = colour; u.ctx.fill(shape); }
        else { u.ctx.strokeStyle = colour; u.ctx.lineWidth = (data.series[index - 1].width ?? 1) * devicePixelRatio; u.ctx.stroke(shape); }
        u.ctx.restore();
      });
      return null;
    };
    const ranges = { x: data.x, y: data.y };
    const left = Math.max(50, beside(data.y.map(v => v.toFixed(0))));
    const scale = key => ({ time: false, auto: false, range: (u, low, high) => low == null || u.whole ? ranges[key] : [low, high] });
    const plot = new uPlot({
      mode: 2, width, height: width - 16 - (left - 50), padding: [8, 8, 0, 0],  // a square between the axes
      scales: { x: scale("x"), y: scale("y") },
      axes: [{ ...axis(data.xlabel, 34), space: 36 }, axis(data.ylabel, left)],  // of 180 px
      series: [{}, ...data.series.map(s => ({ label: s.name, stroke: s.colour, fill: s.colour, paths: path(s.dots), facets: [{ scale: "x", auto: false }, { scale: "y", auto: false }] }))],
      legend: { show: false },
      cursor: { drag: { x: true, y: true, uni: 0 }, points: { show: false }, dataIdx: () => null, bind: { dblclick: u => () => whole(u) } },
    }, [null, ...data.series.map(s => [floats(s.x), floats(s.y)])], place);
    const whole = u => u.batch(() => { u.setScale("x", { min: data.x[0], max: data.x[1] }); u.setScale("y", { min: data.y[0], max: data.y[1] }); });
    whole(plot);
    plots.plots.push(plot);
  }

  // The structure: beams as tubes of a radius for the eye, supports as rings, restraints as cones, loads as arrows, modes in motion.
  function scene(data, place, width, height) {
    const bar = element("p", place, "", "bar-of-scene");
    element("label", bar, "show ");
    const select = element("select", bar);
    ["at rest", ...data.modes.map(mode => mode.name)].forEach((name, i) => { element("option", select, name).value = i; });
    element("span", bar, " turn: drag · zoom: wheel · shift: right button", "soft");
    const renderer = new THREE.WebGLRenderer({ antialias: true });
    renderer.setPixelRatio(devicePixelRatio);
    renderer.setSize(width, height);
    place.append(renderer.domElement);
    const world = new THREE.Scene();
    world.background = new THREE.Color(0xffffff);
    const rest = floats(data.nodes), count = rest.length / 3, ends = data.lines;
    const box = new THREE.Box3().setFromArray(rest), middle = box.getCenter(new THREE.Vector3());
    const size = box.getSize(new THREE.Vector3()).length() || 1;
    const camera = new THREE.PerspectiveCamera(35, width / height, 1e-3 * size, 20 * size);
    camera.up.set(0, 0, 1);
    camera.position.copy(middle).add(new THREE.Vector3(...data.eye).normalize().multiplyScalar(1.95 * size));
    const controls = new THREE.OrbitControls(camera, renderer.domElement);
    controls.target.copy(middle);
    controls.update();
    world.add(new THREE.AmbientLight(0xffffff, 0.65));
    const light = new THREE.DirectionalLight(0xffffff, 0.55);
    light.position.set(1, -2, 3);
    world.add(light);
    const material = colour => new THREE.MeshLambertMaterial({ color: colour });
    const radius = 0.004 * size;
    const beams = new THREE.InstancedMesh(new THREE.CylinderGeometry(radius, radius, 1, 10), material(0x1f5fa8), ends.length / 2);
    beams.frustumCulled = false;
    world.add(beams);
    const up = new THREE.Vector3(0, 1, 0), a = new THREE.Vector3(), b = new THREE.Vector3(), turn = new THREE.Quaternion(), matrix = new THREE.Matrix4();
    function bend(nodes) {
      for (let i = 0; i < ends.length / 2; i++) {
        a.fromArray(nodes, 3 * ends[2 * i]); b.fromArray(nodes, 3 * ends[2 * i + 1]);
        const length = a.distanceTo(b), centre = a.clone().add(b).multiplyScalar(0.5);
        turn.setFromUnitVectors(up, b.sub(a).normalize());
        beams.setMatrixAt(i, matrix.compose(centre, turn, new THREE.Vector3(1, length, 1)));
      }
      beams.instanceMatrix.needsUpdate = true;
    }
    const mark = (shape, colour, at, along, from) => {
      const mesh = new THREE.Mesh(shape, material(colour));
      mesh.position.set(...at);
      if (along) mesh.quaternion.setFromUnitVectors(from, new THREE.Vector3(...along).normalize());
      world.add(mesh);
    };
    const forward = new THREE.Vector3(0, 0, 1);
    for (const c of data.contacts) mark(new THREE.TorusGeometry(3 * radius, 0.7 * radius, 8, 24), 0xd95f0e, c.at, c.axis, forward);
    for (const at of data.restraints) mark(new THREE.BoxGeometry(5 * radius, 5 * radius, 5 * radius), 0x1c2733, at);
    for (const load of data.loads) world.add(new THREE.ArrowHelper(new THREE.Vector3(...load.direction).normalize(), new THREE.Vector3(...load.at), 0.07 * size, 0x2a8a3e, 0.025 * size, 0.015 * size));
    const draw = () => renderer.render(world, camera);
    const shapes = data.modes.map(mode => floats(mode.shape));
    const moved = rest.slice();
    let running = false, visible = true;
    function frame(now) {
      running = visible && +select.value > 0;
      if (!running) return;
      const shape = shapes[select.value - 1], factor = 0.08 * size * Math.sin(now / 1000 * 2 * Math.PI / 1.6);
      for (let i = 0; i < 3 * count; i++) moved[i] = rest[i] + factor * shape[i];
      bend(moved); draw();
      requestAnimationFrame(frame);
    }
    const start = () => { if (!running && visible && +select.value > 0) { running = true; requestAnimationFrame(frame); } };
    select.onchange = () => { if (+select.value === 0) { bend(rest); draw(); } start(); };
    new IntersectionObserver(entries => { visible = entries.at(-1).isIntersecting; start(); }).observe(place);
    controls.addEventListener("change", draw);
    bend(rest); draw();
    plots.scenes.push({ camera, controls, renderer, select });
  }

  const makers = { lines, orbit, scene };
  function make(script) {
    const figure = script.closest("figure"), drawn = figure.querySelector(".static");
    const { width, height } = drawn.getBoundingClientRect();
    const data = JSON.parse(script.textContent);
    const place = element("div", null, "", "live-picture");
    drawn.before(place);
    try {
      makers[data.kind](data, place, Math.max(220, Math.round(width)), Math.max(150, Math.round(data.height || height)));
      figure.classList.add("on");
    } catch (error) { // without WebGL the drawn picture stays
      place.remove();
      console.warn(`${data.kind}: ${error.message}`);
    }
  }
  const watcher = new IntersectionObserver(entries => {
    for (const entry of entries) if (entry.isIntersecting) { watcher.unobserve(entry.target); make(entry.target.querySelector("script.live")); }
  }, { rootMargin: "200px" });
  document.querySelectorAll("script.live").forEach(script => watcher.observe(script.closest("figure")));

  // Tables: a click on a head sorts, a button saves the table as CSV; long ones show their first rows, in the order in which they are sorted.
  const LONG = 20, FOLDED = 15;  // rows; page.py's style hides those after FOLDED on the screen
  const plain = cell => cell.innerHTML.replace(/·10<sup>(.*?)<\/sup>/g, "e$1").replace(/<[^>]*>/g, "").replace(/−/g, "-")
    .replace(/&lt;/g, "<").replace(/&gt;/g, ">").replace(/&amp;/g, "&").trim();
  for (const table of document.querySelectorAll("table.data")) {
    const heads = [...table.querySelectorAll("th")], body = table.querySelector("tbody");
    heads.forEach((head, column) => {
      if (!head.textContent.trim()) return;
      head.tabIndex = 0;
      head.title = "sort";
      const sort = () => {
        const way = head.getAttribute("aria-sort") === "descending" ? 1 : -1;
        heads.forEach(other => other.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", way > 0 ? "ascending" : "descending");
        const key = row => { const text = plain(row.cells[column]), number = parseFloat(text); return Number.isNaN(number) ? text : number; };
        const order = (p, q) => typeof p === typeof q ? (typeof p === "number" ? p - q : p.localeCompare(q, "en", { numeric: true })) : typeof p === "number" ? way * -1 : way;
        [...body.rows].map(row => [key(row), row]).sort((p, q) => way * order(p[0], q[0])).forEach(([, row]) => body.append(row));
      };
      head.onclick = sort;
      head.onkeydown = event => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); sort(); } };
    });
    const button = element("button", null, "CSV", "csv");
    button.onclick = () => {
      const quote = text => /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
      const text = [...table.rows].map(row => [...row.cells].map(cell => quote(plain(cell))).join(",")).join("\n");
      const link = element("a");
      link.href = URL.createObjectURL(new Blob([text + "\n"], { type: "text/csv" }));
      link.download = `${(table.closest("section")?.querySelector("h2")?.textContent || "table").replace(/\W+/g, "_").toLowerCase()}.csv`;
      link.click();
      URL.revokeObjectURL(link.href);
    };
    table.parentElement.before(button);
    if (body.rows.length <= LONG) continue;
    const fold = element("button", null, "", "fold");
    fold.onclick = () => {
      fold.textContent = table.classList.toggle("folded") ? `▾ all ${body.rows.length} rows` : `▴ the first ${FOLDED} rows`;
    };
    fold.onclick();
    table.parentElement.after(fold);
  }
})();
