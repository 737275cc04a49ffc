// How often each contender reached the goal, and how well it knew where it was.

const SUCCESS = "goal";  // the outcome that counts as a success

const percent = rate => known(rate) ? fixed(100 * rate, 0) : "–";
const secondsText = value => fixed(value, 2);

// The words of all other outcomes, in the order in which they first occur.
const otherOutcomes = summaries =>
  unique([].concat(...summaries.map(s => s.outcomes.map(o => o.word)))).filter(word => word !== SUCCESS);

function countOf(summary, word) {
  return d3.sum(summary.outcomes.filter(o => o.word === word), o => o.count);
}

const INTERVAL = {width: 190, height: 22, left: 8, right: 8};

const intervalScale = () => d3.scale.linear().domain([0, 1]).range([INTERVAL.left, INTERVAL.width - INTERVAL.right])
    .clamp(true);

// A rate as a dot on its interval, between 0 and 100 %.
function drawInterval(cell, {contender, rate, rate_low: low, rate_high: high}) {
  const x = intervalScale();
  const middle = INTERVAL.height / 2;
  const svg = addSvg(cell, INTERVAL.width, INTERVAL.height,
                     `${contender}: ${percent(rate)} %, interval ${percent(low)} to ${percent(high)} %`)
      .attr("class", "interval");
  svg.selectAll("line.grid").data([0, 0.25, 0.5, 0.75, 1]).enter().append("line")
      .attr({class: "grid", x1: x, x2: x, y1: 0, y2: INTERVAL.height});
  if (known(low) && known(high)) {
    svg.append("line").attr({class: "range", x1: x(low), x2: x(high), y1: middle, y2: middle});
    svg.selectAll("line.end").data([low, high]).enter().append("line")
        .attr({class: "range", x1: x, x2: x, y1: middle - 4, y2: middle + 4});
  }
  if (known(rate)) svg.append("circle").attr({cx: x(rate), cy: middle, r: 4.5});
}

function drawIntervalHead(cell) {
  const x = intervalScale();
  const svg = addSvg(cell.text(""), INTERVAL.width, 12, "from 0 to 100 %").attr("class", "interval");
  svg.selectAll("text").data([0, 0.5, 1]).enter().append("text").attr({x, y: 11})
      .style("text-anchor", d => d === 0 ? "start" : d === 1 ? "end" : "middle")
      .attr("dx", d => d === 0 ? -INTERVAL.left : d === 1 ? INTERVAL.right : 0).text(d => `${100 * d} %`);
}

function outcomeCells(summary, others) {
  const interval = known(summary.rate_low) && known(summary.rate_high) ?
    `${percent(summary.rate_low)} – ${percent(summary.rate_high)}` : "–";
  return [summary.contender, summary.episodes, summary.goals, percent(summary.rate), interval, summary]
      .concat(others.map(word => countOf(summary, word)))
      .concat([secondsText(summary.median_time_s), centimetres(summary.pose_error_m),
               centimetres(summary.ball_error_m)]);
}

function drawOutcomes(summaries) {
  const others = otherOutcomes(summaries);
  const groups = [{text: "", span: 3}, {text: "Success rate / %", span: 3}, {text: "Time to the goal / s", span: 1},
                  {text: "Mean error / cm", span: 2}];
  if (others.length > 0) groups.splice(2, 0, {text: "Other outcomes", span: others.length});
  const columns = ["Contender", "Episodes", "Goals", "rate", "95 % interval", ""]
      .concat(others.map(word => word.replace(/_/g, " ")), ["median", "pose", "ball"]);
  const table = d3.select("#outcomes");
  const body = addTable(table, "numbers", groups, columns);
  table.selectAll("thead tr:last-child th").filter((d, i) => i === 5).each(function () {
    drawIntervalHead(d3.select(this));
  });
  body.selectAll("tr").data(summaries).enter().append("tr").attr("class", "contender")
      .selectAll("td").data(summary => outcomeCells(summary, others)).enter().append("td").each(function (cell, i) {
        if (i === 5) drawInterval(d3.select(this), cell); else d3.select(this).text(cell);
      });
}
