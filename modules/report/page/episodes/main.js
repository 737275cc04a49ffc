// Which start is shown.

const page = JSON.parse(document.getElementById("data").textContent);
const starts = startsOf(page.episodes);
const contenders = contendersOf(page);
let selected = -1;

// A panel for each contender, under its name. `draw` is given those that have an episode.
function addPanels(section, start) {
  const box = d3.select(section).html("");
  return contenders.map(contender => {
    const panel = box.append("article").attr("class", "panel");
    panel.append("h4").text(contender);
    const episode = episodeOf(start, contender);
    if (!episode) addAbsent(panel, "No episode from this start.");
    return {panel, episode};
  });
}

// The times of all ticks, in order and each once.
function timesOf({episodes}) {
  return [...new Set([].concat(...episodes.map(e => e.time_s)))].sort(d3.ascending);
}

function drawPanels(section, start, draw) {
  return addPanels(section, start).filter(p => p.episode)
      .map(({panel, episode}) => ({episode, follow: draw(panel, episode)}));
}

function drawStart() {
  const start = starts[selected];
  const times = timesOf(start);
  const span = [Math.min(0, times[0] || 0), Math.max(times[times.length - 1] || 0, 0.1)];
  const reach = startReach(start);
  const charts = (section, chartsOf, absent) => drawCharts(addPanels(section, start), chartsOf, span, absent);
  load(times, [].concat(
      drawPanels("#plans", start, (panel, episode) => drawPlan(panel, episode, reach)),
      drawPanels("#views", start, drawViews),
      charts("#signals", signalCharts, "This controller shows nothing of its inside."),
      charts("#estimates", estimateCharts),
      charts("#commands", commandCharts)));
}

function select(index) {
  if (index < 0 || index >= starts.length || index === selected) return;
  selected = index;
  d3.select("#selected").text(`Seed ${starts[index].seed} (${index + 1} of ${starts.length})`);
  d3.select("#previous").property("disabled", index === 0);
  d3.select("#next").property("disabled", index === starts.length - 1);
  markRow(document.getElementById("starts"), index);
  setPlaying(false);
  drawStart();
  seek(lastIndex());
}

// The address names the start and the time, so that it can be passed on: #2,3.40 is the second start at 3.4 s.

let remembering = 0;

function rememberTime() {
  clearTimeout(remembering);
  remembering = setTimeout(() => {
    if (timeNow() !== null && !player.playing) location.replace(`#${selected + 1},${timeNow()}`);
  }, 300);
}

function goToAddress() {
  const [start, time] = location.hash.slice(1).split(",").map(Number);
  select(Math.max(0, Math.min(starts.length, start || 1) - 1));
  if (Number.isFinite(time) && time !== timeNow()) seekTime(time);
}

function begin() {
  if (page.summaries.length > 0) drawOutcomes(page.summaries); else d3.select("#outcomes").remove();
  if (starts.length === 0) {
    d3.selectAll("#player, #episode").remove();
    d3.select("#starts").attr("class", "notice").text("This page holds no episodes to show.");
    return;
  }
  drawPlanLegend();
  drawCurveLegend();
  drawStarts(starts, contenders, select);
  startPlayer();
  d3.select("#previous").on("click", () => select(selected - 1));
  d3.select("#next").on("click", () => select(selected + 1));
  d3.select(window).on("hashchange", goToAddress);
  goToAddress();
  redrawOnResize(() => {
    drawStart();
    show(player.index);
  });
}

begin();
