// What the maps show is chosen by the controls.

const page = JSON.parse(document.getElementById("data").textContent);

const CONTROLS = ["level", "knowledge", "errors", "form"];
const chosen = () => Object.fromEntries(CONTROLS.map(id => [id, document.getElementById(id).value]));

function fillControl(id, values, labels) {
  d3.select("#" + id).selectAll("option").data(values).enter().append("option").attr("value", d => d)
      .text(d => labels[d] || d);
}

function describeLattice() {
  d3.select("#lattice").text(`${page.points.length + page.under_robot} points, ${fixed(page.step, 2)} m apart over ` +
      `${fixed(2 * page.half_width, 1)} m × ${fixed(2 * page.half_width, 1)} m; ${page.under_robot} under the robot ` +
      "left out.");
}

function begin() {
  describeLattice();
  const whole = page.cells.filter(isWhole);
  if (whole.length === 0) {
    d3.selectAll("#controls, #legend, #maps").remove();
    d3.select("#results").append("p").attr("class", "notice").text("This page holds no measurements.");
    drawFindings(page);
    drawAlone(page);
    return;
  }
  drawResults(page);
  drawFindings(page);
  drawAlone(page);
  fillControl("level", Object.keys(LEVELS).filter(l => whole.some(c => c.level === l)), LEVELS);
  fillControl("knowledge", uniqueOf(whole, "knowledge"), KNOWLEDGE);
  drawLegend();
  const draw = () => drawMaps(page, chosen());
  CONTROLS.forEach(id => d3.select("#" + id).on("change", draw));
  draw();
  redrawOnResize(draw);
}

begin();
