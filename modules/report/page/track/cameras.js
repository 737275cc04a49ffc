// What each camera saw: its picture, the panorama, the histogram and the bearings as numbers.

const MARGIN = {left: 44, right: 10};
const CURSOR = "azimuth-cursor";

const plotWidth = width => Math.floor(width - MARGIN.left - MARGIN.right);
const drawable = camera => camera.marks.filter(mark => known(mark.azimuth_deg));
const dashed = mark => mark.flags.length > 0 ? "5 3" : null;
const titleOf = mark => `${classOf(mark.object).label}: azimuth ${degrees(mark.azimuth_deg)}°, ` +
    `elevation ${degrees(mark.elevation_deg)}°` + mark.flags.map(flag => ", " + flag).join("");

function drawCameras(frame) {
  const box = d3.select("#cameras").html("");
  const highest = d3.max(frame.cameras, c => d3.max(c.histograms, h => d3.max(h.counts.concat(h.threshold)))) || 1;
  const column = box.selectAll("article").data(frame.cameras).enter().append("article").attr("class", "camera panel");
  column.each(function (camera) { drawCamera(d3.select(this), camera, highest); });
  if (frame.cameras.length === 0) box.append("p").attr("class", "absent").text("This frame holds no cameras.");
}

function drawCamera(column, camera, highest) {
  column.append("h4").text(camera.name);
  const width = contentWidth(column);
  if (camera.image && !camera.lost) {
    drawPicture(column, camera, width);
  } else {
    addAbsent(column, camera.lost ? "The image of this camera is lost." : "No picture is stored.");
  }
  if (camera.panorama && !camera.lost) drawPanorama(column, camera, width);
  if (camera.histograms.some(h => h.counts.length > 0)) drawHistogram(column, camera, width, highest);
  drawMarkTable(column, camera);
}

// The omnidirectional picture with the bearings drawn in. Pixel (0,0) is the centre of the top-left pixel.
function drawPicture(column, camera, width) {
  const {src, width: columns, height: rows} = camera.image;
  const svg = addSvg(column, width, width * rows / columns,
                     `Picture of camera ${camera.name} with ${camera.marks.length} bearings drawn in`)
      .attr({class: "picture", viewBox: `-0.5 -0.5 ${columns} ${rows}`});
  svg.append("image").attr({x: -0.5, y: -0.5, width: columns, height: rows}).attr("xlink:href", src);
  const mark = svg.selectAll("g").data(camera.marks).enter().append("g");
  mark.append("title").text(titleOf);
  mark.each(function (d) { drawMarkInPicture(d3.select(this), d, columns / width); });
}

function drawMarkInPicture(group, mark, pixel) {
  const path = d3.svg.line();
  const {colour} = classOf(mark.object);
  const lines = [["edge", mark.left_line], ["edge", mark.right_line], ["centre", mark.centre_line]];
  for (const [kind, points] of lines.filter(([, points]) => points.length > 1)) {
    group.append("path").attr({class: "halo " + kind, d: path(points)});
    group.append("path").attr({class: "mark " + kind, d: path(points), stroke: colour,
                               "stroke-dasharray": dashed(mark)});
  }
  if (!known(mark.centre_px)) return;
  const [cx, cy] = mark.centre_px;
  group.append("circle").attr({class: "halo centre", cx, cy, r: 5 * pixel});
  group.append("circle").attr({class: "mark centre", cx, cy, r: 5 * pixel, stroke: colour});
}

// The axis that panoramas and histograms share: straight ahead in the middle, left on the left.
const azimuthScale = width => d3.scale.linear().domain([-180, 180]).range([0, width]);

function addAzimuthAxis(svg, x, y, scale) {
  const roomy = scale.range()[1] > 300;
  const names = roomy ? {"-180": "−90°", "-90": "180° left", "0": "90° ahead", "90": "0° right", "180": "−90°"} :
    {"-180": "−90°", "-90": "180°", "0": "90°", "90": "0°", "180": "−90°"};
  addAxis(svg, "x", x, y, d3.svg.axis().scale(scale).orient("bottom").tickSize(5).tickPadding(3)
      .tickValues(d3.range(-180, 181, 30)).tickFormat(v => names[v] || ""))
      .selectAll("text").style("text-anchor", v => v === -180 ? "start" : v === 180 ? "end" : "middle");
  addText(svg, "axis-label", x + scale.range()[1] / 2, y + 30, "azimuth in the robot’s axes / °");
}

function addCursor(svg, clip, scale, height) {
  clip.append("line").attr({class: CURSOR, y1: 0, y2: height}).style("display", "none");
  clip.append("text").attr({class: CURSOR, y: 11}).style("display", "none");
  svg.on("mousemove", function () { moveCursor(scale, d3.mouse(this)[0] - MARGIN.left); });
  svg.on("mouseleave", () => d3.selectAll("." + CURSOR).style("display", "none"));
}

function moveCursor(scale, x) {
  const inside = x >= 0 && x <= scale.range()[1];
  const cursor = d3.selectAll("." + CURSOR).style("display", inside ? null : "none");
  cursor.filter("line").attr({x1: x, x2: x});
  cursor.filter("text").attr("x", x < scale.range()[1] / 2 ? x + 4 : x - 4)
      .style("text-anchor", x < scale.range()[1] / 2 ? "start" : "end")
      .text(fixed(wrap(90 - scale.invert(x)), 1) + "°");
}

function drawPanorama(column, camera, width) {
  const {src} = camera.panorama;
  const plot = plotWidth(width);
  const elevations = [camera.max_elevation_deg, camera.min_elevation_deg];
  const height = Math.max(100, plot * (elevations[0] - elevations[1]) / 360);
  const svg = addSvg(column, width, height + 44, `Panorama of camera ${camera.name} over the azimuth`)
      .attr("class", "panorama");
  const x = azimuthScale(plot);
  const y = d3.scale.linear().domain(elevations).range([0, height]);
  const clip = addClip(svg, MARGIN.left, 6, plot, height);
  // The picture begins at the azimuth +180°, so it is drawn twice, a full turn apart; the overlap hides the seam.
  for (const start of [-90, -450]) {
    clip.append("image").attr({x: x(start), y: 0, width: plot + 1, height, preserveAspectRatio: "none"})
        .attr("xlink:href", src);
  }
  clip.selectAll("g").data(drawable(camera)).enter().append("g")
      .each(function (mark) { drawMarkInPanorama(d3.select(this), mark, x, height); });
  addCursor(svg, clip, x, height);
  addAzimuthAxis(svg, MARGIN.left, height + 6, x);
  addAxis(svg, "y", MARGIN.left, 6, d3.svg.axis().scale(y).orient("left").ticks(4).tickSize(4));
  addVerticalLabel(svg, 10, 6 + height / 2, "elevation / °");
}

function drawMarkInPanorama(group, mark, x, height) {
  group.append("title").text(titleOf(mark));
  const {colour} = classOf(mark.object);
  const lines = [["centre", mark.azimuth_deg]];
  if (known(mark.left_deg) && known(mark.right_deg)) lines.unshift(["edge", mark.left_deg], ["edge", mark.right_deg]);
  for (const [kind, azimuth] of lines) {
    const at = {x1: x(rightOfAhead(azimuth)), x2: x(rightOfAhead(azimuth)), y1: 0, y2: height};
    group.append("line").attr(at).attr("class", "halo " + kind);
    group.append("line").attr(at).attr({class: "mark " + kind, stroke: colour, "stroke-dasharray": dashed(mark)});
  }
}

// The paper's Fig. 4. The square-root scale shows a small ball beside a wide goal.
function drawHistogram(column, camera, width, highest) {
  const plot = plotWidth(width);
  const height = 120;
  const svg = addSvg(column, width, height + 44, `Extracted pixels of camera ${camera.name} over the azimuth`)
      .attr("class", "histogram");
  const x = azimuthScale(plot);
  const y = d3.scale.sqrt().domain([0, highest * 1.05]).range([height, 0]);
  addAxis(svg, "y grid", MARGIN.left, 6, d3.svg.axis().scale(y).orient("left").tickValues(roundCounts(y))
      .tickFormat(d3.format("d")).tickSize(-plot));
  const clip = addClip(svg, MARGIN.left, 6, plot, height);
  clip.selectAll("g").data(camera.histograms).enter().append("g")
      .each(function (curve) { drawCurve(d3.select(this), curve, x, y, plot); });
  addCursor(svg, clip, x, height);
  addAzimuthAxis(svg, MARGIN.left, height + 6, x);
  addVerticalLabel(svg, 10, 6 + height / 2, "pixels per bin, √ scale");
}

// Round numbers up to the top of the scale, far enough apart to be read.
function roundCounts(y) {
  const ticks = [0];
  for (const count of [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000]) {
    if (count <= y.domain()[1] && y(ticks[ticks.length - 1]) - y(count) > 13) ticks.push(count);
  }
  return ticks;
}

function drawCurve(group, curve, x, y, width) {
  const {colour, label} = classOf(curve.object);
  const bins = curve.counts.length;
  const points = curve.counts.map((count, i) => [rightOfAhead(-180 + 360 * (i + 0.5) / bins), count])
      .sort((a, b) => a[0] - b[0]);
  group.append("title").text(label);
  const shape = {x: d => x(d[0]), y: d => y(d[1])};
  group.append("path").attr({class: "area", fill: colour, d: d3.svg.area().x(shape.x).y0(y(0)).y1(shape.y)(points)});
  group.append("path").attr({class: "curve", stroke: colour, d: d3.svg.line().x(shape.x).y(shape.y)(points)});
  if (!known(curve.threshold)) return;
  group.append("line").attr({class: "threshold", x1: 0, x2: width, y1: y(curve.threshold), y2: y(curve.threshold),
                             stroke: colour});
}

function drawMarkTable(column, camera) {
  if (camera.marks.length === 0) {
    column.append("p").attr("class", "hint").text("No bearings.");
    return;
  }
  const body = addTable(column, "numbers marks", null, ["bearing", "azimuth / °", "elevation / °", "width / °"]);
  for (const mark of camera.marks) {
    const {label, colour} = classOf(mark.object);
    const row = body.append("tr");
    const name = row.append("td");
    name.append("span").attr("class", "swatch").style("background", colour);
    name.append("span").text(label);
    const width = known(mark.left_deg) && known(mark.right_deg) ? positive(mark.left_deg - mark.right_deg) : null;
    row.selectAll("td.number").data([mark.azimuth_deg, mark.elevation_deg, width]).enter().append("td").text(degrees);
    if (mark.flags.length === 0) continue;
    row.classed("continued", true);
    body.append("tr").append("td").attr({colspan: 4, class: "hint"}).text("flagged: " + mark.flags.join(", "));
  }
}
