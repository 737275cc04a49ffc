// The results in numbers.

const GOALS = {coloured: "With coloured goals", white: "With white goals"};
const kAllSpots = -1;

const cm = (value, digits = 2) => fixed(known(value) ? 100 * value : null, digits);
const percent = (part, all, digits = 1) => all > 0 ? fixed(100 * part / all, digits) + " %" : "–";
const uniqueOf = (cells, key) => [...new Set(cells.map(c => c[key]))];
const rangeText = c => known(c.low) && known(c.high) ? `${cm(c.low)} – ${cm(c.high)}` : "";

const GROUPS = [{text: "", span: 3}, {text: "", span: 1}, {text: "Position / cm", span: 5}, {text: "X / cm", span: 2},
                {text: "Y / cm", span: 2}, {text: "Heading / °", span: 3}, {text: "Covariance", span: 2}];
const COLUMNS = ["poses", "far off", "mean", "", "median", "95 %", "largest", "mean", "95 %", "mean", "95 %", "mean",
                 "95 %", "largest", "NEES", "within"];

function numbersOf(c) {
  return [{text: percent(c.ok, c.asked)}, {text: c.far_off > 0 ? percent(c.far_off, c.ok, 2) : "none"},
          {text: cm(c.mean)}, {text: rangeText(c), name: "range"}, {text: cm(c.median)}, {text: cm(c.percentile95)},
          {text: cm(c.largest, 1)}, {text: cm(c.x)}, {text: cm(c.x95)}, {text: cm(c.y)}, {text: cm(c.y95)},
          {text: fixed(c.beta, 3)}, {text: fixed(c.beta95, 3)}, {text: fixed(c.beta_largest, 2)},
          {text: fixed(c.nees, c.nees < 100 ? 1 : 0)}, {text: known(c.within) ? percent(c.within, 1) : "–"}];
}

function addRow(body, className, cells) {
  body.append("tr").attr("class", className).selectAll("td").data(cells).enter().append("td")
      .attr("class", d => d.name || null).text(d => d.text);
}

function drawResults(page) {
  const box = d3.select("#results").html("");
  const whole = page.cells.filter(c => c.spot === kAllSpots);
  for (const goals of uniqueOf(whole, "goals")) {
    box.append("h3").text(GOALS[goals]);
    const frame = box.append("div").attr("class", "table-frame");
    const groups = [{text: "", span: 2}, {text: "", span: 2}, ...GROUPS.slice(2)];
    const body = addTable(frame, "numbers results", groups, ["Rig", "Localizer", ...COLUMNS]);
    const cells = whole.filter(c => c.goals === goals);
    cells.forEach((c, i) => {
      const isFirst = i === 0 || cells[i - 1].knowledge !== c.knowledge;
      addRow(body, isFirst ? "result group" : "result",
             [{text: isFirst ? c.knowledge : "", name: "name"}, {text: c.localizer}, ...numbersOf(c)]);
    });
  }
}

// One localizer with one rig, by spot.
function drawBySpot(page, cells) {
  const groups = [{text: "", span: 1}, {text: "", span: 2}, ...GROUPS.slice(2)];
  const body = addTable(d3.select("#by-spot").html(""), "numbers results", groups, ["Spot", ...COLUMNS]);
  for (const c of cells) addRow(body, "of-spot", [{text: page.spots[c.spot].name, name: "name"}, ...numbersOf(c)]);
}

const VERDICTS = {"agrees": "agrees", "does not agree": "differs"};

function drawObservations(page) {
  d3.select("#observations-section").style("display", page.observations.length ? null : "none");
  if (page.observations.length === 0) return;
  const knowledges = page.observations[0].ours.map(o => o.knowledge);
  const body = addTable(d3.select("#observations").html(""), "numbers observations", null,
                        ["The paper", ...knowledges.map(k => `Ours, ${k} rig`)]);
  for (const observation of page.observations) {
    const row = body.append("tr").attr("class", "observation");
    row.append("td").text(observation.paper);
    for (const ours of observation.ours) {
      const cell = row.append("td");
      cell.append("span").attr("class", "verdict " + (VERDICTS[ours.verdict] || "")).text(ours.verdict);
      cell.append("div").text(ours.figures);
    }
  }
}

function drawFindings(page) {
  const topic = d3.select("#findings").html("").selectAll("section").data(page.findings).enter().append("section");
  topic.append("h3").text(d => d.topic);
  topic.append("ul").attr("class", "findings").selectAll("li").data(d => d.sentences).enter().append("li").text(d => d);
}
