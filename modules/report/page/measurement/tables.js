// The results in numbers.

const KNOWLEDGE = {nominal: "nominal", corrected: "corrected", calibrated: "calibrated", true: "true"};
const LEVELS = {images: "On images", bearings: "On bearings"};

const cm = (value, digits = 2) => fixed(known(value) ? 100 * value : null, digits);
const angle = value => fixed(value, 4);
const rangeText = (low, high, text) => known(low) && known(high) ? `${text(low)} – ${text(high)}` : "";

const isWhole = cell => cell.differences === "all";
const uniqueOf = (cells, key) => [...new Set(cells.map(c => c[key]))];

const RESULT_GROUPS = [
  {text: "", span: 3}, {text: "Distance / cm", span: 9}, {text: "Direction / °", span: 7}];
const RESULT_COLUMNS = ["System", "Rig", "measured", "mean", "", "common", "median", "RMS", "95 %", "largest", "free",
                        "bound", "mean", "", "common", "median", "RMS", "95 %", "bound"];

// Where a system left cases out, means compare over those that all answered.
const isPartial = cell => cell.common < cell.asked;

function statisticsCells(s, common, text) {
  return [{text: text(s.mean), name: "mean"}, {text: rangeText(s.low, s.high, text), name: "range"},
          {text: common === undefined ? "" : text(common), name: "common"}, {text: text(s.median)}, {text: text(s.rms)}, {text: text(s.percentile95)}];
}

function resultCells(cell, isFirst) {
  return [{text: isFirst ? cell.system : "", name: "system"}, {text: KNOWLEDGE[cell.knowledge] || cell.knowledge},
          {text: cell.measured === cell.asked ? `all ${cell.asked}` : `${cell.measured} of ${cell.asked}`},
          ...statisticsCells(cell.distance, isPartial(cell) ? cell.common_distance : undefined, cm),
          {text: cm(cell.distance.largest, 1)}, {text: cm(cell.distance_free_bound)},
          {text: cm(cell.distance_bound)},
          ...statisticsCells(cell.direction, isPartial(cell) ? cell.common_direction : undefined, angle), {text: angle(cell.direction_bound)}];
}

function drawResults(page) {
  const box = d3.select("#results").html("");
  const whole = page.cells.filter(isWhole);
  for (const level of Object.keys(LEVELS).filter(l => whole.some(c => c.level === l))) {
    const cells = whole.filter(c => c.level === level);
    box.append("h3").text(LEVELS[level]);
    const frame = box.append("div").attr("class", "table-frame");
    const body = addTable(frame, "numbers results", RESULT_GROUPS, RESULT_COLUMNS);
    cells.forEach((cell, i) => {
      const isFirst = i === 0 || cells[i - 1].system !== cell.system;
      body.append("tr").attr("class", isFirst ? "result group" : "result").selectAll("td")
          .data(resultCells(cell, isFirst)).enter().append("td").attr("class", d => d.name || null).text(d => d.text);
    });
  }
}

function drawFindings(page) {
  const topic = d3.select("#findings").html("").selectAll("section").data(page.findings).enter().append("section");
  topic.append("h3").text(d => d.topic);
  topic.append("ul").attr("class", "findings").selectAll("li").data(d => d.sentences).enter().append("li").text(d => d);
}

const aloneText = cell =>
    cm(cell.distance.mean) + (isPartial(cell) ? ` (${cm(cell.common_distance)} of ${cell.common}/${cell.asked})` : "");

// One row a system, one column a kind of difference.
function drawAlone(page) {
  const cells = page.cells.filter(c => !isWhole(c));
  d3.select("#alone-section").style("display", cells.length ? null : "none");
  if (cells.length === 0) return;
  const kinds = uniqueOf(cells, "differences");
  const box = d3.select("#alone").html("");
  const body = addTable(box, "numbers", null, ["System", ...kinds.map(k => k.replace(/_/g, " "))]);
  for (const system of uniqueOf(cells, "system")) {
    const row = body.append("tr").attr("class", "alone");
    row.append("td").text(system);
    for (const kind of kinds) {
      const cell = cells.find(c => c.system === system && c.differences === kind);
      row.append("td").text(cell ? aloneText(cell) : "–");
    }
  }
}
