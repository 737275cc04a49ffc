// The maps: from above, and unrolled over the azimuth.

const short = value => !known(value) ? "–" : fixed(value, Math.max(0, Math.min(5, 2 - Math.floor(Math.log10(value)))));
const lengthText = value => !known(value) ? "–" : value < 0.01 ? `${short(1000 * value)} mm` :
  value < 1 ? `${short(100 * value)} cm` : `${short(value)} m`;
const angleText = value => known(value) ? `${short(value)}°` : "–";

const QUANTITIES = [
  {key: "distance", title: "distance", text: lengthText},
  {key: "direction_deg", title: "direction", text: angleText},
];

// Of both kinds of knowledge, so that their colours mean the same.
const allValues = (places, key) => places.floor[key].concat(places.free[key]).filter(known);

function readout(places, index, distance, azimuth) {
  const seen = `${places.cameras[index]} of ${page.cameras.length} cameras`;
  const where = `${fixed(distance, 2)} m at ${fixed(azimuth, 0)}°`;
  const sigma = places[knowledge];
  const status = sigma.status[index];
  const values = status === "ok" ?
    `σ distance ${lengthText(sigma.distance[index])}, direction ${angleText(sigma.direction_deg[index])}, ` +
    `position ${lengthText(sigma.position[index])}` : UNSEEN[status] ? UNSEEN[status].label : status;
  d3.select("#readout").text(`${where}: ${values} (${seen})`);
}

const colourOf = (places, index, value, scale) => known(value) ? scale.colour(value) :
  (UNSEEN[places[knowledge].status[index]] || UNSEEN.unobservable).colour;

function addUnseenLegend(box, places) {
  const used = Object.keys(UNSEEN).filter(status => places[knowledge].status.indexOf(status) >= 0);
  const list = box.append("ul").attr("class", "legend");
  const item = list.selectAll("li").data(used).enter().append("li");
  item.append("svg").attr({width: 14, height: 12, "aria-hidden": true}).append("rect")
      .attr({x: 0.5, y: 0.5, width: 13, height: 11, stroke: "#5b6675", fill: d => UNSEEN[d].colour});
  item.append("span").text(d => UNSEEN[d].label);
}

// From above

function drawAbove(box, quantity) {
  box.append("h4").text(`σ of the ${quantity.title}`);
  const places = page.cells;
  const values = places[knowledge][quantity.key];
  const n = page.columns;
  const half = n * page.step / 2;
  const scale = sigmaScale(allValues(places, quantity.key));
  const at = addPlan(box, [half, half], ["x / m, right", "y / m, ahead"], `σ of the ${quantity.title} from above`);
  const index = (i, j) => (n - 1 - j) * n + i;  // the picture's first row is the farthest ahead
  const colour = (i, j) => colourOf(places, index(i, j), values[index(i, j)], scale);
  const size = 2 * half * at.scale;
  at.clip.attr("class", "map").append("image").attr({x: 0, y: 0, width: size, height: size,
      "xlink:href": picture(n, n, colour), preserveAspectRatio: "none"});
  at.clip.selectAll("circle.range").data([1, 2, 4]).enter().append("circle")
      .attr({class: "range", cx: at.x(0), cy: at.y(0), r: d => d * at.scale});
  at.clip.selectAll("circle.viewpoint").data(page.cameras.filter(c => c.position)).enter().append("circle")
      .attr({class: "viewpoint", cx: c => at.x(c.position[0]), cy: c => at.y(c.position[1]), r: 3})
      .append("title").text(c => c.name);
  const cell = size / n;
  follow(at.clip, size, size, cell, cell, (i, j) => {
    const x = (i - (n - 1) / 2) * page.step;
    const y = ((n - 1) / 2 - j) * page.step;
    readout(places, index(i, j), Math.hypot(x, y), positive(Math.atan2(y, x) * 180 / Math.PI));
  });
  drawKey(box, scale, quantity.text, `σ of the ${quantity.title}`);
  addUnseenLegend(box, places);
}

// Unrolled over the azimuth, which falls from left to right, as one looks outwards

function ratiosOf(values) {
  const n = page.directions;
  return values.map((value, k) => {
    const ring = values.slice(n * Math.floor(k / n), n * (Math.floor(k / n) + 1)).filter(known);
    return known(value) ? value / d3.mean(ring) : null;
  });
}

function drawUnrolled(box, quantity) {
  box.append("h4").text(`σ of the ${quantity.title}, against the mean at the same distance`);
  const [places, n, rows] = [page.polar, page.directions, page.distances.length];
  if (n === 0 || rows === 0) return addAbsent(box, "No distances within the map.");
  const ratios = ratiosOf(places[knowledge][quantity.key]);
  const scale = ratioScale(ratios.filter(known));
  const width = contentWidth(box) - 58;
  const height = Math.min(260, 14 * rows);
  const svg = addSvg(box, width + 58, height + 50, `σ of the ${quantity.title} over azimuth and distance`);
  const clip = addClip(svg, 46, 8, width, height).attr("class", "map");
  // Column 0 is half a turn left of ahead; ahead is 90°.
  const direction = i => positive(270 - 360 * (i + 0.5) / n);
  const index = (i, j) => (rows - 1 - j) * n + Math.floor(direction(i) / 360 * n);
  const colour = (i, j) => colourOf(places, index(i, j), ratios[index(i, j)], scale);
  clip.append("image").attr({x: 0, y: 0, width, height, "xlink:href": picture(n, rows, colour),
                             preserveAspectRatio: "none"});
  const x = d3.scale.linear().domain([270, -90]).range([0, width]);
  addAxis(svg, "x", 46, 8 + height,
          d3.svg.axis().scale(x).orient("bottom").tickValues(d3.range(-90, 271, 45)).tickSize(5)
              .tickFormat(d => `${positive(d)}°`));
  const y = d3.scale.ordinal().domain(d3.range(rows)).rangeBands([height, 0]);
  const every = Math.ceil(rows / 8);
  addAxis(svg, "y", 46, 8, d3.svg.axis().scale(y).orient("left").tickSize(5)
      .tickValues(d3.range(rows).filter(i => i % every === every - 1)).tickFormat(i => fixed(page.distances[i], 2)));
  addText(svg, "axis-label", 46 + width / 2, height + 44, "azimuth: 180° left, 90° ahead, 0° right");
  addVerticalLabel(svg, 10, 8 + height / 2, "distance / m");
  follow(clip, width, height, width / n, height / rows, (i, j) => {
    const k = index(i, j);
    readout(places, k, page.distances[rows - 1 - j], 360 / n * (k % n + 0.5));
  });
  drawKey(box, scale, value => `×${fixed(value, 2)}`, "times the mean of all directions");
  addUnseenLegend(box, places);
}

// Tells of the place under the pointer and marks it.
function follow(clip, width, height, cellWidth, cellHeight, tell) {
  const mark = clip.append("rect").attr({class: "pointed", width: cellWidth, height: cellHeight})
      .style("display", "none");
  clip.append("rect").attr({class: "surface", x: 0, y: 0, width, height})
      .on("mousemove", function () {
        const [px, py] = d3.mouse(this);
        const i = Math.max(0, Math.min(Math.round(width / cellWidth) - 1, Math.floor(px / cellWidth)));
        const j = Math.max(0, Math.min(Math.round(height / cellHeight) - 1, Math.floor(py / cellHeight)));
        mark.style("display", null).attr({x: i * cellWidth, y: j * cellHeight});
        tell(i, j);
      })
      .on("mouseleave", () => {
        mark.style("display", "none");
        d3.select("#readout").text("");
      });
}
