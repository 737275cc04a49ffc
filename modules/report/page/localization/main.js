// What is shown by spot is chosen by the controls.

const page = JSON.parse(document.getElementById("data").textContent);

const CONTROLS = ["goals", "knowledge", "localizer", "curves"];
const chosen = () => Object.fromEntries(CONTROLS.map(id => [id, document.getElementById(id).value]));

// Keeps the choice where it is still there.
function fillControl(id, values, preferred) {
  const control = document.getElementById(id);
  const before = control.value || preferred;
  d3.select(control).html("").selectAll("option").data(values).enter().append("option").attr("value", d => d)
      .text(d => d);
  control.value = values.includes(before) ? before : values[values.length - 1];
}

function describeScope() {
  const poses = page.spots.length * Math.round(360 / page.heading_step);
  const runs = Object.keys(page.draws).filter(goals => page.draws[goals] > 0)
      .map(goals => `${page.draws[goals]} draws of the rig with ${goals} goals`);
  d3.select("#scope").text(`${page.spots.length} spots, a heading every ${page.heading_step}°: ${poses} poses; ` +
      `${runs.join(", ")}.` + (page.draws.white > 0 ? " A field with white goals looks the same from the other side: " +
      "where a localizer says so, its pose counts up to that half turn." : ""));
  d3.select("#far-off").text(`${cm(page.far_off, 0)} cm`);
}

function begin() {
  describeScope();
  drawObservations(page);
  drawFindings(page);
  if (page.cells.length === 0) {
    d3.select("#spots-section").remove();
    d3.select("#results").append("p").attr("class", "notice").text("This page holds no fixes.");
    return;
  }
  drawResults(page);
  fillControl("goals", uniqueOf(page.cells, "goals"), "coloured");
  fillControl("knowledge", uniqueOf(page.cells, "knowledge"), "corrected");
  const draw = () => {
    const {goals} = chosen();
    fillControl("localizer", uniqueOf(page.cells.filter(c => c.goals === goals), "localizer"), "composed");
    drawSpots(page, chosen());
  };
  CONTROLS.forEach(id => d3.select("#" + id).on("change", draw));
  draw();
  redrawOnResize(draw);
}

begin();
