// How a sigma becomes a colour, and the key that explains it.

const UNSEEN = {not_seen: {colour: "#000000", label: "seen by no camera"},
                unobservable: {colour: "#b4bcc6", label: "not observable"}};

// Light is good. The stops are of Viridis, whose lightness falls evenly; the other scale has grey in its middle.
const SEQUENCE = ["#fde725", "#7ad151", "#22a884", "#2a788e", "#414487", "#440154"];
const DIVERGENCE = ["#2166ac", "#92c5de", "#f0f0f0", "#f4a582", "#b2182b"];

const stops = ([low, high], colours) => colours.map((c, i) => low + i / (colours.length - 1) * (high - low));

// Logarithmic: the bound of a distance covers three decades.
function sigmaScale(values) {
  const positiveValues = values.filter(v => v > 0);
  const [low, high] = positiveValues.length ? d3.extent(positiveValues) : [1, 10];
  const domain = [Math.log10(low), Math.log10(Math.max(high, 1.01 * low))];
  const colour = d3.scale.linear().domain(stops(domain, SEQUENCE)).range(SEQUENCE).interpolate(d3.interpolateLab);
  return {colour: v => colour(Math.log10(v)), axis: d3.scale.log().domain(domain.map(d => Math.pow(10, d)))};
}

// Of a ratio: alike on both sides of 1.
function ratioScale(values) {
  const most = Math.max(1.05, d3.max(values.map(v => Math.max(v, 1 / v))) || 1.05);
  const domain = [-Math.log10(most), Math.log10(most)];
  const colour = d3.scale.linear().domain(stops(domain, DIVERGENCE)).range(DIVERGENCE).interpolate(d3.interpolateLab);
  return {colour: v => colour(Math.log10(v)), axis: d3.scale.log().domain([1 / most, most])};
}

// One picture pixel a place; rows from top to bottom.
function picture(columns, rows, colourAt) {
  const canvas = document.createElement("canvas");
  canvas.width = columns;
  canvas.height = rows;
  const context = canvas.getContext("2d");
  for (let j = 0; j < rows; ++j) {
    for (let i = 0; i < columns; ++i) {
      context.fillStyle = colourAt(i, j);
      context.fillRect(i, j, 1, 1);
    }
  }
  return canvas.toDataURL();
}

// Round numbers of one, two and five times powers of ten; few of a narrow domain.
function ticksOf(axis) {
  const [low, high] = axis.domain();
  const round = [].concat(...d3.range(-6, 4).map(e => [1, 2, 5].map(d => d * Math.pow(10, e))));
  const within = round.filter(v => v >= low * 0.999 && v <= high * 1.001);
  return within.length >= 2 ? within : [low, Math.sqrt(low * high), high];
}

function drawKey(box, {colour, axis}, format, title) {
  const width = Math.min(380, contentWidth(box));
  const scale = axis.copy().range([20, width - 20]);
  const svg = addSvg(box, width, 46, title).attr("class", "key");
  addText(svg, "axis-label", width / 2, 10, title);
  const steps = d3.range(0, width - 40);
  svg.selectAll("rect").data(steps).enter().append("rect")
      .attr({x: d => 20 + d, y: 15, width: 1.2, height: 11, fill: d => colour(scale.invert(20 + d))});
  let free = 0;  // where the next label may begin
  for (const tick of ticksOf(axis)) {
    const text = format(tick).replace(/(\.\d*?)0+(?=\D|$)/, "$1").replace(/\.(?=\D|$)/, "");
    const half = 3.2 * text.length;
    if (scale(tick) - half < free) continue;
    free = scale(tick) + half + 6;
    addText(svg, "tick", scale(tick), 40, text).style("text-anchor", "middle");
  }
}
