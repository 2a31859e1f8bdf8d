// Wheel: closer at the pointer; with Shift both axes. Drag: along. Double click: all of it.
"use strict";
for (const svg of document.querySelectorAll("svg[data-frame]")) {
  const [left, right, top, bottom, ...whole] = svg.dataset.frame.split(" ").map(Number);
  const series = svg.querySelector(".series"), mesh = svg.querySelector(".mesh");
  const NS = "http://www.w3.org/2000/svg";
  const make = (name, attributes, parent) => {
    const element = document.createElementNS(NS, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return parent.appendChild(element);
  };
  const id = "clip" + Math.random().toString(36).slice(2);
  const clip = make("clipPath", { id }, svg);
  make("rect", { x: left, y: top, width: right - left, height: bottom - top }, clip);
  series.parentNode.setAttribute("clip-path", `url(#${id})`);
  const axes = make("g", {}, svg);
  svg.insertBefore(axes, series.parentNode);
  const numbers = [...mesh.querySelectorAll("text")].filter((text) => isFinite(text.textContent.trim()));
  const grid = [...mesh.querySelectorAll("line,polyline")];
  let range = [...whole];
  const ticks = (low, high, count) => {
    const raw = (high - low) / count, decade = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((k) => k * decade).find((step) => step >= raw);
    const all = [];
    for (let k = Math.ceil(low / step); k * step <= high; k++) all.push(+(k * step).toPrecision(10));
    return all;
  };
  const draw = () => {
    const [x0, x1, y0, y1] = range, [u0, u1, v0, v1] = whole;
    const sx = (u1 - u0) / (x1 - x0), sy = (v1 - v0) / (y1 - y0);
    const width = right - left, height = bottom - top;
    const tx = left - left * sx - ((x0 - u0) / (x1 - x0)) * width;
    const ty = bottom - bottom * sy + ((y0 - v0) / (y1 - y0)) * height;
    series.setAttribute("transform", `matrix(${sx} 0 0 ${sy} ${tx} ${ty})`);
    const isWhole = range.every((value, k) => value === whole[k]);
    for (const element of [...numbers, ...grid]) element.style.display = isWhole ? "" : "none";
    axes.replaceChildren();
    if (isWhole) return;
    const line = (a) => make("line", { ...a, stroke: "#e2e5e9" }, axes);
    const text = (x, y, anchor, value) => {
      const style = { "font-family": "sans-serif", "font-size": 12, fill: "#282c34" };
      make("text", { x, y, "text-anchor": anchor, ...style }, axes).textContent = value;
    };
    for (const value of ticks(x0, x1, Math.max(2, width / 80))) {
      const x = left + ((value - x0) / (x1 - x0)) * width;
      line({ x1: x, x2: x, y1: top, y2: bottom });
      text(x, bottom + 16, "middle", value);
    }
    for (const value of ticks(y0, y1, Math.max(2, height / 40))) {
      const y = bottom - ((value - y0) / (y1 - y0)) * height;
      line({ x1: left, x2: right, y1: y, y2: y });
      text(left - 6, y + 4, "end", value);
    }
  };
  const at = (event) => {
    const point = new DOMPoint(event.clientX, event.clientY);
    const { x, y } = point.matrixTransform(svg.getScreenCTM().inverse());
    return [(x - left) / (right - left), (bottom - y) / (bottom - top)];
  };
  svg.addEventListener("wheel", (event) => {
    event.preventDefault();
    const [px, py] = at(event), factor = Math.exp(event.deltaY / 400);
    const scaled = (low, high, part, [lowest, highest]) => {
      const middle = low + part * (high - low);
      return [Math.max(lowest, middle - (middle - low) * factor), Math.min(highest, middle + (high - middle) * factor)];
    };
    const x = scaled(range[0], range[1], px, [whole[0], whole[1]]);
    const y = event.shiftKey ? scaled(range[2], range[3], py, [whole[2], whole[3]]) : range.slice(2);
    range = [...x, ...y];
    draw();
  }, { passive: false });
  let held = null;
  svg.addEventListener("pointerdown", (event) => { held = at(event); svg.setPointerCapture(event.pointerId); });
  svg.addEventListener("pointerup", () => { held = null; });
  svg.addEventListener("pointermove", (event) => {
    if (!held) return;
    const now = at(event);
    const moved = (low, high, part, [lowest, highest]) => {
      const shift = Math.min(Math.max(-part * (high - low), lowest - low), highest - high);
      return [low + shift, high + shift];
    };
    range = [
      ...moved(range[0], range[1], now[0] - held[0], [whole[0], whole[1]]),
      ...moved(range[2], range[3], now[1] - held[1], [whole[2], whole[3]]),
    ];
    held = now;
    draw();
  });
  svg.addEventListener("dblclick", () => { range = [...whole]; draw(); });
}
