// Numbers, colours and small helpers of drawing.

// Okabe and Ito's palette, which colour-blind people can tell apart.
const CLASSES = {
  ball: {label: "ball", colour: "#d55e00"},
  yellow_goal: {label: "yellow goal", colour: "#d9a400"},
  blue_goal: {label: "blue goal", colour: "#0072b2"},
  obstacle: {label: "obstacle", colour: "#3c4450"},
  line: {label: "line", colour: "#8b95a3"},
  field: {label: "field", colour: "#2a9d6f"},
};
const ESTIMATE = "#7a3b8f";
const TRUTH = "#1c2430";

const classOf = object => CLASSES[object] || {label: object, colour: "#3c4450"};

// null is "not known". A minus is typeset as one, and nothing is called −0.
function fixed(value, digits) {
  if (value === null || value === undefined) return "–";
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

const known = value => value !== null && value !== undefined;
const metres = value => fixed(value, 3);
const degrees = value => fixed(value, 2);
const millimetres = value => fixed(known(value) ? 1000 * value : null, 0);
const centimetres = value => fixed(known(value) ? 100 * value : null, 1);
const signed = (value, text) => known(value) && Number(text.replace("−", "-")) > 0 ? "+" + text : text;

// Degrees into [0, 360) and into [−180, 180).
const positive = angle => (angle % 360 + 360) % 360;
const wrap = angle => positive(angle + 180) - 180;

// Where the page shows an azimuth: degrees to the right of straight ahead.
const rightOfAhead = azimuth => wrap(90 - azimuth);

const translate = (x, y) => `translate(${x},${y})`;

function contentWidth(selection) {
  const style = getComputedStyle(selection.node());
  return selection.node().clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
}

// An SVG of the given size in CSS pixels with a description for those who cannot see it.
function addSvg(parent, width, height, description) {
  const svg = parent.append("svg").attr({width, height, viewBox: `0 0 ${width} ${height}`, role: "img"});
  svg.attr("aria-label", description);
  return svg;
}

// A nested SVG, which clips what is drawn in it.
function addClip(svg, x, y, width, height) {
  return svg.append("svg").attr({x, y, width, height, overflow: "hidden"});
}

function addAxis(svg, className, x, y, axis) {
  const group = svg.append("g").attr({class: "axis " + className, transform: translate(x, y)}).call(axis);
  group.selectAll("text").text(function () { return this.textContent.replace("-", "−"); });
  return group;
}

function addText(svg, className, x, y, text) {
  return svg.append("text").attr({class: className, x, y}).text(text);
}

// The label of a vertical axis, which reads upwards.
function addVerticalLabel(svg, x, y, text) {
  return addText(svg, "axis-label", 0, 0, text).attr({transform: `translate(${x},${y}) rotate(-90)`});
}

function addTable(parent, className, groups, columns) {
  const table = parent.append("table").attr("class", className);
  const head = table.append("thead");
  if (groups) {
    head.append("tr").selectAll("th").data(groups).enter().append("th")
        .attr({colspan: d => d.span, scope: "colgroup"}).text(d => d.text);
  }
  head.append("tr").selectAll("th").data(columns).enter().append("th").attr("scope", "col").text(d => d);
  return table.append("tbody");
}

function addStatus(parent, status, good = "ok") {
  const text = status === null ? "–" : status.replace(/_/g, " ");
  parent.append("span").attr("class", status === good || status === null ? "status" : "status bad").text(text);
}

function addAbsent(parent, text) {
  parent.append("div").attr("class", "absent").text(text);
}

// Entries {line, text} or {path, text}: the attributes of a stroke and what it stands for. Returns the items.
function addLegend(list, entries) {
  const item = list.selectAll("li").data(entries).enter().append("li");
  item.append("svg").attr({width: 24, height: 10, "aria-hidden": true})
      .each(function ({line, path}) {
        const shape = d3.select(this).append(path ? "path" : "line");
        shape.attr(path || {x1: 1, x2: 23, y1: 5, y2: 5, ...line});
      });
  item.append("span").text(d => d.text);
  return item;
}

// Drawings have the width of their place, so a new width draws them anew.
function redrawOnResize(draw) {
  let width = window.innerWidth;
  let timer = 0;
  d3.select(window).on("resize", () => {
    if (window.innerWidth === width) return;
    width = window.innerWidth;
    clearTimeout(timer);
    timer = setTimeout(draw, 100);
  });
}

// Marks the row of a table that scrolls in its box, and scrolls the box, not the page, until the row can be seen.
function markRow(box, index) {
  const head = box.querySelector("thead").offsetHeight;
  d3.select(box).select("tbody").selectAll("tr").classed("selected", (d, i) => i === index)
      .attr("aria-current", (d, i) => i === index ? "true" : null)
      .filter((d, i) => i === index).each(function () {
        const top = this.offsetTop - head;
        const bottom = this.offsetTop + this.offsetHeight - box.clientHeight;
        box.scrollTop = Math.min(top, Math.max(bottom, box.scrollTop));
      });
}
