// Where around the robot the errors are: one colour scale for all maps, so that systems compare at a glance.

// Borders of the colours, in centimetres of distance and in hundredths of a degree of direction.
const BORDERS = [0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200];
const ramp = d3.scale.linear().domain([0, 0.2, 0.45, 0.65, 0.85, 1]).interpolate(d3.interpolateLab)
    .range(["#fffbe3", "#fee08b", "#f79a4a", "#d1434b", "#7b1e57", "#240a2e"]);
const COLOURS = d3.range(BORDERS.length + 1).map(i => ramp(i / BORDERS.length));
const colourOf = d3.scale.threshold().domain(BORDERS).range(COLOURS);

const KINDS = [
  {key: "distance", title: "Distance error", unit: "cm", of: value => 100 * value, digits: 2},
  {key: "direction", title: "Direction error", unit: "0.01°", of: value => 100 * value, digits: 2}];

function drawLegend() {
  const item = d3.select("#legend").html("").selectAll("li").data(COLOURS).enter().append("li");
  item.append("span").attr("class", "step").style("background", d => d);
  item.append("span").text((d, i) => i < BORDERS.length ? `< ${BORDERS[i]}` : `≥ ${BORDERS[i - 1]}`);
  d3.select("#legend").append("li").append("span").attr("class", "hint")
      .text("cm of distance, 0.01° of direction; dashed: never measured");
}

const polarOf = ([x, y]) => [Math.atan2(y, x) * 180 / Math.PI, Math.hypot(x, y)];

function addCells(parent, page, values, kind, placeOf, size) {
  const cell = parent.selectAll("rect.cell").data(values).enter().append("rect");
  cell.attr({x: (d, i) => placeOf(page.points[i])[0] - size / 2, y: (d, i) => placeOf(page.points[i])[1] - size / 2,
             width: size, height: size})
      .attr("class", d => known(d) ? "cell" : "cell unknown")
      .style("fill", d => known(d) ? colourOf(Math.abs(kind.of(d))) : null);
  cell.append("title").text((d, i) => {
    const [azimuth, distance] = polarOf(page.points[i]);
    const value = known(d) ? `${fixed(kind.of(d), kind.digits)} ${kind.unit}` : "not measured";
    return `x ${fixed(page.points[i][0], 2)} m, y ${fixed(page.points[i][1], 2)} m ` +
        `(${fixed(distance, 2)} m at ${fixed(azimuth, 0)}°): ${value}`;
  });
}

function drawPlanMap(box, page, values, kind, description) {
  const half = page.half_width + page.step / 2;
  const at = addPlan(box, [half, half], ["x, right / m", "y, ahead / m"], description);
  addCells(at.clip, page, values, kind, at.point, page.step * at.scale);
  at.clip.append("circle").attr({class: "hull", cx: at.x(0), cy: at.y(0), r: page.robot_radius * at.scale});
}

function drawPolarMap(box, page, values, kind, description) {
  const width = contentWidth(box);
  const [w, h] = [width - PLAN.left - PLAN.right, 200];
  const svg = addSvg(box, width, h + PLAN.top + PLAN.bottom, description).attr("class", "plan");
  const x = d3.scale.linear().domain([-185, 185]).range([0, w]);
  const y = d3.scale.linear().domain([0, d3.max(page.points, p => polarOf(p)[1]) + page.step / 2]).range([h, 0]);
  const clip = addClip(svg, PLAN.left, PLAN.top, w, h);
  addAxis(svg, "x", PLAN.left, PLAN.top + h,
          d3.svg.axis().scale(x).orient("bottom").tickValues([-180, -90, 0, 90, 180]).tickSize(5));
  addAxis(svg, "y", PLAN.left, PLAN.top, d3.svg.axis().scale(y).orient("left").ticks(5).tickSize(5));
  addText(svg, "axis-label", PLAN.left + w / 2, PLAN.top + h + 34, "direction / °: 0 right, 90 ahead");
  addVerticalLabel(svg, PLAN.left - 34, PLAN.top + h / 2, "distance / m");
  const placeOf = point => { const [azimuth, distance] = polarOf(point); return [x(azimuth), y(distance)]; };
  addCells(clip, page, values, kind, placeOf, Math.max(4, w / 60));
}

function captionOf(cell, kind) {
  const {mean} = cell[kind.key];
  if (!known(mean)) return `${kind.title}: never measured`;
  return `${kind.title}, mean of all draws ${kind.key === "distance" ? cm(mean) + " cm" : angle(mean) + "°"}`;
}

// All places first: a drawing is as wide as its place, which depends on how many there are.
function addPlaces(box, cells) {
  return [].concat(...cells.map(cell => {
    const panel = box.append("article").attr("class", "panel");
    panel.append("h4").text(cell.system);
    const pair = panel.append("div").attr("class", "pair");
    return KINDS.map(kind => ({cell, kind, figure: pair.append("figure")}));
  }));
}

function drawMaps(page, {level, knowledge, errors, form}) {
  const box = d3.select("#maps").html("");
  const draw = form === "polar" ? drawPolarMap : drawPlanMap;
  const cells = page.cells.filter(c => isWhole(c) && c.level === level && c.knowledge === knowledge);
  if (cells.length === 0) addAbsent(box, "This run has nothing of that kind.");
  for (const {cell, kind, figure} of addPlaces(box, cells)) {
    figure.append("figcaption").text(captionOf(cell, kind));
    const values = cell[errors][kind.key];
    if (!values || cell.measured === 0) addAbsent(figure, "No map.");
    else draw(figure, page, values, kind, `${kind.title}, ${cell.system}`);
  }
}
