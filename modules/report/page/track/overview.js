// The legend, the summary of each set and the table of all frames.

function drawLegend() {
  const entries = ["ball", "yellow_goal", "blue_goal", "obstacle"].map(object => ({
    line: {stroke: classOf(object).colour, "stroke-width": 3}, text: classOf(object).label}));
  entries.push({line: {stroke: "#5b6675", "stroke-width": 1.5, "stroke-dasharray": "4 3"},
                text: "dashed: a flagged bearing, part of the object may be hidden; in a histogram, the threshold"});
  addLegend(d3.select("#legend"), entries);
}

// The median and the largest of the known values, each with its unit; how many there are is said elsewhere.
function spread(frames, value, format) {
  const values = frames.map(value).filter(known).map(Math.abs);
  return values.length === 0 ? ["–", "–"] : [format(d3.median(values)), format(d3.max(values))];
}

function setSummary(name, frames) {
  const fixes = frames.filter(f => f.fix !== null);
  const ball = spread(frames, f => f.ball_error && f.ball_error.length, millimetres);
  const position = spread(frames, f => f.fix_error && f.fix_error.length, centimetres);
  const beta = spread(frames, f => f.fix_error && f.fix_error.beta_deg, degrees);
  const tick = spread(frames, f => f.tick_us, v => fixed(v, 0));
  return [name, frames.length,
          `${frames.filter(f => f.ball.status === "ok").length} of ${frames.length}`, ball[0], ball[1],
          fixes.length ? `${fixes.filter(f => f.fix.status === "ok").length} of ${fixes.length}` : "–",
          position[0], position[1], beta[0], beta[1], tick[0], tick[1]];
}

function drawSets(frames) {
  const groups = [
    {text: "", span: 2}, {text: "Ball", span: 1}, {text: "Ball error / mm", span: 2}, {text: "Pose", span: 1},
    {text: "Pose error / cm", span: 2}, {text: "Heading error / °", span: 2}, {text: "Tick / µs", span: 2}];
  const columns = ["Set", "Frames", "measured", "median", "largest", "measured", "median", "largest", "median",
                   "largest", "median", "largest"];
  const rows = d3.nest().key(f => f.set).entries(frames).map(set => setSummary(set.key, set.values));
  const body = addTable(d3.select("#sets"), "numbers", groups, columns);
  body.selectAll("tr").data(rows).enter().append("tr").attr("class", "set")
      .selectAll("td").data(row => row).enter().append("td").text(d => d);
}

const FRAME_GROUPS = [
  {text: "", span: 3}, {text: "Ball, measured", span: 2}, {text: "Ball, true", span: 2}, {text: "Ball error", span: 2},
  {text: "Pose error", span: 2}, {text: "Status", span: 2}, {text: "", span: 1}];
const FRAME_COLUMNS = ["Set", "Frame", "Spot", "distance / m", "direction / °", "distance / m", "direction / °", "mm",
                       "direction / °", "cm", "heading / °", "ball", "pose", "Tick / µs"];

function frameCells(frame) {
  const ball = frame.ball.measured || {};
  const truth = frame.true_ball || {};
  const ballError = frame.ball_error || {};
  const fixError = frame.fix_error || {};
  return [
    {text: frame.set}, {text: frame.frame, button: true}, {text: frame.label || "–"},
    {text: metres(ball.distance)}, {text: degrees(ball.direction_deg)},
    {text: metres(truth.distance)}, {text: degrees(truth.direction_deg)},
    {text: millimetres(ballError.length)}, {text: signed(ballError.direction_deg, degrees(ballError.direction_deg))},
    {text: centimetres(fixError.length)}, {text: signed(fixError.beta_deg, degrees(fixError.beta_deg))},
    {status: frame.ball.status}, {status: frame.fix ? frame.fix.status : null},
    {text: fixed(frame.tick_us, 0)}];
}

function fillCell(cell) {
  const td = d3.select(this);
  if (cell.button) {
    td.append("button").attr({type: "button", class: "link"}).text(cell.text);
  } else if ("status" in cell) {
    addStatus(td, cell.status);
  } else {
    td.text(cell.text);
  }
}

function drawFrames(frames, select) {
  const body = addTable(d3.select("#frames"), "numbers selectable", FRAME_GROUPS, FRAME_COLUMNS);
  body.selectAll("tr").data(frames).enter().append("tr").attr("class", "frame").on("click", (d, i) => select(i))
      .selectAll("td").data(frameCells).enter().append("td").each(fillCell);
}
