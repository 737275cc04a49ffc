// Curves over time with a cursor.

const CHART = {left: 44, right: 10, top: 8, bottom: 20, height: 96};
const TROUBLE_COLOUR = "#fbe3b8";
const OVER_COLOUR = "#e9ecf0";
const SERIES_COLOURS = ["#0072b2", "#d55e00", "#2a9d6f", "#7a3b8f", "#8a6d00", "#cc4c8b", "#56a3d9", "#3c4450"];

// Beyond the number of colours they come again, dashed.
const seriesStyle = index => ({
  stroke: SERIES_COLOURS[index % SERIES_COLOURS.length],
  "stroke-dasharray": index < SERIES_COLOURS.length ? null : "4 2.5",
});

// A domain that holds all known values and 0, and is never empty.
function domainOf(values, least) {
  const all = values.filter(known).concat(0);
  const [low, high] = [d3.min(all), d3.max(all)];
  const room = Math.max(high - low, least) * 0.06;
  return [low < 0 ? low - room : 0, Math.max(high, low < 0 ? 0 : least) + room];
}

// The title of a chart, and what its curves mean, each with its value at the cursor.
function addChartHead(figure, {title, series, format}) {
  const head = figure.append("figcaption");
  head.append("span").attr("class", "chart-title").text(title);
  const list = head.append("ul").attr("class", "legend").classed("alone", series.every(s => s.name === ""));
  const item = addLegend(list, series.map((s, i) => ({
    line: {"stroke-width": 2, ...s.style || seriesStyle(i)}, text: s.name})));
  const value = item.append("b").attr("class", "value");
  return tick => value.text((d, i) => fixed(tick < 0 ? null : series[i].values[tick], format));
}

function drawCurveLegend() {
  const box = "M1,0H23V10H1Z";
  addLegend(d3.select("#curve-legend"), [
    {path: {d: "M12,0V10", class: "cursor"}, text: "the chosen time"},
    {path: {d: "M8,0L16,0L12,7Z", fill: TRUTH}, text: "kick commanded"},
    {path: {d: box, fill: TROUBLE_COLOUR}, text: "the drive was not ok and stopped the robot"},
    {path: {d: box, fill: OVER_COLOUR}, text: "the episode is over"},
  ]);
}

// Runs of ticks at which the drive was not ok, from the middle between two ticks to the next one.
function addTroubles(clip, episode, x) {
  const {time_s: time, troubles} = episode;
  const edge = (i, j) => x(((time[i] === undefined ? time[j] : time[i]) + time[j]) / 2);
  const band = clip.selectAll("g.trouble").data(troubles).enter().append("g").attr("class", "trouble");
  const left = d => edge(d.from - 1, d.from);
  const width = d => Math.max(1.5, edge(d.to + 1, d.to) - left(d));
  const word = d => d.status.replace(/_/g, " ");
  band.append("rect").attr({x: left, y: 0, height: CHART.height, width, fill: TROUBLE_COLOUR});
  band.append("title").text(d => `drive: ${word(d)}`);
  band.filter(d => width(d) > 14).append("text").text(word)
      .attr("transform", d => `translate(${left(d) + width(d) / 2 + 4},${CHART.height / 2}) rotate(-90)`);
}

function addKickLines(clip, {kick_ticks: kicks, time_s: time}, x) {
  const kick = clip.selectAll("g.kick-line").data(kicks).enter().append("g")
      .attr({class: "kick-line", transform: i => translate(x(time[i]), 0)});
  kick.append("line").attr("y2", CHART.height);
  kick.append("path").attr("d", "M-4,0L4,0L0,6Z");
  kick.append("title").text(i => `kick at ${secondsText(time[i])} s`);
}

// The part of the time in which this episode had already ended.
function addEnd(clip, {time_s: time, outcome}, x, plot) {
  const end = time.length > 0 ? x(time[time.length - 1]) : 0;
  if (plot - end < 1) return;
  const over = clip.append("g").attr("class", "over");
  over.append("rect").attr({x: end, y: 0, width: plot - end, height: CHART.height, fill: OVER_COLOUR});
  if (outcome && plot - end > 7 * outcome.length + 16) {
    addText(over, "end", end + 6, CHART.height - 6, outcome.replace(/_/g, " "));
  }
}

function addSeries(clip, {values, carried, style}, index, episode, x, y) {
  const path = d3.svg.line().defined(i => known(values[i])).x(i => x(episode.time_s[i])).y(i => y(values[i]));
  const ticks = d3.range(episode.time_s.length);
  const {stroke, "stroke-dasharray": dashes} = style || seriesStyle(index);
  clip.append("path").attr({class: "series", d: path(ticks) || "M0,0", stroke, "stroke-dasharray": dashes || null});
  if (!carried) return;
  const rings = ticks.filter(i => known(values[i]) && carried(i))
      .map(i => `M${x(episode.time_s[i]).toFixed(1)},${y(values[i]).toFixed(1)}h0`).join("");
  if (rings === "") return;
  clip.append("path").attr({class: "ring outer", d: rings, stroke});
  clip.append("path").attr({class: "ring inner", d: rings});
}

function addTimeAxis(svg, x, plot, labelled) {
  addAxis(svg, "x", CHART.left, CHART.top + CHART.height, d3.svg.axis().scale(x).orient("bottom")
      .ticks(Math.max(3, plot / 70)).tickSize(4).tickPadding(3));
  if (labelled) addText(svg, "axis-label", CHART.left + plot / 2, CHART.top + CHART.height + 32, "time / s");
}

// `chart` {title, series [{name, values, carried?, style?}], format, domain}. `times` is the span of the time axis,
// `labelled` whether it has its name. Returns what moves on to a tick.
function drawChart(panel, chart, episode, times, labelled) {
  const figure = panel.append("figure").attr("class", "chart");
  const showValues = addChartHead(figure, chart);
  const plot = contentWidth(panel) - CHART.left - CHART.right;
  const height = CHART.top + CHART.height + CHART.bottom + (labelled ? 16 : 0);
  const svg = addSvg(figure, plot + CHART.left + CHART.right, height, `${chart.title} over time, ${episode.contender}`);
  const x = d3.scale.linear().domain(times).range([0, plot]);
  const y = d3.scale.linear().domain(chart.domain).range([CHART.height, 0]);
  addAxis(svg, "y grid", CHART.left, CHART.top, d3.svg.axis().scale(y).orient("left").ticks(4).tickSize(-plot)
      .tickPadding(6)).selectAll(".tick").filter(v => v === 0).classed("zero", true);
  const clip = addClip(svg, CHART.left, CHART.top, plot, CHART.height);
  addEnd(clip, episode, x, plot);
  addTroubles(clip, episode, x);
  addKickLines(clip, episode, x);
  chart.series.forEach((series, i) => addSeries(clip, series, i, episode, x, y));
  const cursor = clip.append("line").attr({class: "cursor", y2: CHART.height});
  addTimeAxis(svg, x, plot, labelled);
  onDrag(svg, px => seekTime(x.invert(px - CHART.left)));
  return tick => {
    showValues(tick);
    const at = tick < 0 ? 0 : x(episode.time_s[tick]);
    cursor.attr({x1: at, x2: at});
  };
}

// Calls `move` with the pixel column while a pointer is pressed in the drawing.
function onDrag(svg, move) {
  const node = svg.node();
  const column = event => event.clientX - node.getBoundingClientRect().left;
  node.addEventListener("pointerdown", event => {
    if (event.button !== 0) return;
    node.setPointerCapture(event.pointerId);
    move(column(event));
  });
  node.addEventListener("pointermove", event => {
    if (node.hasPointerCapture(event.pointerId)) move(column(event));
  });
}
