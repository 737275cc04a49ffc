// The paper's figures: by spot, the error over the heading and the measured places.

const CHART = {left: 40, right: 14, top: 8, bottom: 34, height: 270};
const SERIES = {first: [{key: "x", text: "X error", of: e => e[0]}, {key: "y", text: "Y error", of: e => e[1]}],
                mean: [{key: "mean", text: "position error, mean", of: e => e}]};

const COLOURS = {x: "#0072b2", y: "#d55e00", mean: "#7a3b8f"};
const DOT = "M-1.6,0a1.6,1.6 0 1 0 3.2,0a1.6,1.6 0 1 0 -3.2,0";

const isFix = entry => known(entry) && typeof entry !== "string";
const entriesOf = (cell, curves) => curves === "mean" ? cell.mean_by_heading : cell.first;

// One scale for all spots, so that they compare at a glance: that of the 99th of a hundred, so that few wrong fixes do
// not flatten the rest. What lies beyond is drawn at the border.
function reachOf(cells, curves) {
  const values = [];
  for (const cell of cells) {
    for (const entry of entriesOf(cell, curves).filter(isFix)) {
      values.push(...SERIES[curves].map(s => Math.abs(100 * s.of(entry))));
    }
  }
  values.sort(d3.ascending);
  return Math.max(0.2, 1.15 * (d3.quantile(values, 0.99) || 0));
}

function drawCurves(svg, series, entries, x, y, step) {
  const reach = y.domain()[1];
  const shown = value => Math.max(y.domain()[0], Math.min(reach, value));
  const line = d3.svg.line().defined(isFix).x((d, i) => x(i * step)).y(d => y(shown(100 * series.of(d))));
  svg.append("path").attr({class: "curve " + series.key, stroke: COLOURS[series.key], d: line(entries) || "M0,0"});
  entries.forEach((entry, i) => {
    if (!isFix(entry)) return;
    const value = 100 * series.of(entry);
    const beyond = shown(value) !== value;
    svg.append("path").attr({
      class: "mark", fill: COLOURS[series.key], transform: translate(x(i * step), y(shown(value))),
      d: !beyond ? DOT : value > 0 ? "M-4,4L4,4L0,-4Z" : "M-4,-4L4,-4L0,4Z"
    }).append("title").text(`β ${i * step}°: ${series.text} ${fixed(value, 2)} cm`);
  });
}

function drawChart(box, page, cell, curves, reach) {
  const width = contentWidth(box);
  const [w, h] = [width - CHART.left - CHART.right, CHART.height - CHART.top - CHART.bottom];
  const name = page.spots[cell.spot].name;
  const svg = addSvg(box, width, CHART.height, `Error over the heading on spot ${name}`).attr("class", "chart");
  const x = d3.scale.linear().domain([0, 360]).range([0, w]);
  const y = d3.scale.linear().domain([curves === "mean" ? 0 : -reach, reach]).range([h, 0]);
  addAxis(svg, "grid y", CHART.left, CHART.top,
          d3.svg.axis().scale(y).orient("left").ticks(5).tickSize(-w).tickFormat(""));
  addAxis(svg, "x", CHART.left, CHART.top + h,
          d3.svg.axis().scale(x).orient("bottom").tickValues([0, 90, 180, 270, 360]).tickSize(4));
  addAxis(svg, "y", CHART.left, CHART.top, d3.svg.axis().scale(y).orient("left").ticks(5).tickSize(4));
  addText(svg, "axis-label", CHART.left + w / 2, CHART.height - 3, "heading β / °");
  addVerticalLabel(svg, 10, CHART.top + h / 2, "error / cm");
  const plot = svg.append("g").attr("transform", translate(CHART.left, CHART.top));
  plot.append("line").attr({class: "zero", x1: 0, x2: w, y1: y(0), y2: y(0)});
  const entries = entriesOf(cell, curves);
  for (const series of SERIES[curves]) drawCurves(plot, series, entries, x, y, page.heading_step);
  entries.forEach((entry, i) => {
    if (isFix(entry)) return;
    const at = x(i * page.heading_step);
    plot.append("line").attr({class: "missing", x1: at, x2: at, y1: h, y2: h - 9})
        .append("title").text(`β ${i * page.heading_step}°: ${String(entry || "no pose").replace(/_/g, " ")}`);
  });
}

function drawPlaces(box, page, cell) {
  const {name, place} = page.spots[cell.spot];
  const field = page.field;
  const margin = 0.08;
  const half = [field.half_width + margin, Math.max(field.half_length, field.Fd + field.goal_depth) + margin];
  const width = contentWidth(box);
  const scale = width / (2 * half[0]);
  const svg = addSvg(box, width, 2 * half[1] * scale, `Measured places around spot ${name}`).attr("class", "plan");
  const at = {x: d3.scale.linear().domain([-half[0], half[0]]).range([0, width]),
              y: d3.scale.linear().domain([-half[1], half[1]]).range([2 * half[1] * scale, 0]), scale};
  svg.append("rect").attr({class: "carpet", width, height: 2 * half[1] * scale});
  drawField(svg, {...field, white_goals: cell.goals === "white"}, at);
  svg.append("circle").attr({class: "spot", cx: at.x(place[0]), cy: at.y(place[1]), r: page.robot_radius * scale});
  cell.first.filter(isFix).forEach(e => svg.append("circle").attr(
      {class: "place", r: 1.6, cx: at.x(place[0] + e[0]), cy: at.y(place[1] + e[1])}));
}

function drawSpotLegend(curves) {
  const list = d3.select("#legend").html("");
  addLegend(list, [
    ...SERIES[curves].map(s => ({line: {stroke: COLOURS[s.key], "stroke-width": 2}, text: s.text})),
    {line: {x1: 12, x2: 12, y1: 0, y2: 10, stroke: "#1c2430"}, text: "no pose"},
    {path: {d: "M8,9L16,9L12,1Z", fill: "#5b6675"}, text: "beyond the scale"},
    {path: {d: "M10,5a2,2 0 1 0 4,0a2,2 0 1 0 -4,0", fill: "#7a3b8f"}, text: "measured place, first draw"},
    {path: {d: "M8,5a4,4 0 1 0 8,0a4,4 0 1 0 -8,0", fill: "none", stroke: "#1c2430"}, text: "the robot"}]);
}

function drawSpots(page, {goals, knowledge, localizer, curves}) {
  const box = d3.select("#spots").html("");
  const cells = page.cells.filter(c => c.spot !== kAllSpots && c.goals === goals && c.knowledge === knowledge &&
                                       c.localizer === localizer);
  drawBySpot(page, cells);
  drawSpotLegend(curves);
  if (cells.length === 0) addAbsent(box, "This run has nothing of that kind.");
  const reach = reachOf(cells, curves);
  const places = cells.map(cell => {
    const panel = box.append("article").attr("class", "panel");
    const title = panel.append("h4").text(`Position ${page.spots[cell.spot].name} `);
    const [px, py] = page.spots[cell.spot].place;
    title.append("span").attr("class", "count").text(`(${fixed(px, 1)}, ${fixed(py, 1)}) m: mean ` +
        `${cm(cell.mean)} cm, poses ${percent(cell.ok, cell.asked)}`);
    const pair = panel.append("div").attr("class", "pair");
    return {cell, chart: pair.append("figure"), plan: pair.append("figure")};
  });
  for (const {cell, chart, plan} of places) {
    drawChart(chart, page, cell, curves, reach);
    drawPlaces(plan, page, cell);
  }
}
