// What is given, the table, and which knowledge the maps show.

const page = JSON.parse(document.getElementById("data").textContent);
let knowledge = page.knowledge;

function drawGiven() {
  const floor = page.floor_sigma > 0 ? ` to ${lengthText(page.floor_sigma)}` : " exactly";
  d3.select("#given").text(
      `Here: ${page.rig}, ${page.cameras.length} ${page.cameras.length === 1 ? "camera" : "cameras"}; a ball of radius ` +
      `${lengthText(page.ball_radius)} with its centre ${lengthText(page.height)} above the floor, which, where its ` +
      `height is known, is known${floor}; contrast ${short(page.contrast)} grey levels over the three channels, noise ` +
      `${short(page.noise)} grey levels, blur ${page.blur_px > 0 ? short(page.blur_px) : 0} px. The ball’s apparent ` +
      `size ${page.diameter ? "tells a distance as well" : "is not used"}.`);
}

const COLUMNS = ["Distance from the robot / m", "Height", "mean", "worst", "mean", "worst", "measurable directions"];

function drawSummary() {
  const groups = [{text: "", span: 2}, {text: "σ of the distance", span: 2}, {text: "σ of the direction", span: 2},
                  {text: "", span: 1}];
  const body = addTable(d3.select("#summary"), "numbers", groups, COLUMNS);
  body.selectAll("tr").data(page.rows).enter().append("tr").attr("class", "ring")
      .selectAll("td").data(row => [
        fixed(row.distance, 2), row.knowledge === "floor" ? "known" : "not known", lengthText(row.mean_distance),
        lengthText(row.worst_distance), angleText(row.mean_direction_deg), angleText(row.worst_direction_deg),
        `${row.measurable} of ${row.directions}`])
      .enter().append("td").text(d => d);
}

function drawMaps() {
  for (const name of ["floor", "free"]) d3.select(`#${name}`).attr("aria-pressed", String(name === knowledge));
  d3.select("#readout").text("");
  for (const [section, draw] of [["#above", drawAbove], ["#unrolled", drawUnrolled]]) {
    const panels = d3.select(section).html("").selectAll("article").data(QUANTITIES);
    panels.enter().append("article").attr("class", "panel");  // all of them first: they share the width
    panels.each(function (quantity) { draw(d3.select(this), quantity); });
  }
}

function show(name) {
  knowledge = name;
  drawMaps();
}

drawGiven();
if (page.rows.length > 0) drawSummary(); else d3.select("#summary").remove();
for (const name of ["floor", "free"]) d3.select(`#${name}`).on("click", () => show(name));
drawMaps();
redrawOnResize(drawMaps);
