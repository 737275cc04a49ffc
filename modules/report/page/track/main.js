// Which frame is shown, and how one moves between them.

const frames = JSON.parse(document.getElementById("data").textContent);
let selected = -1;

function headline(frame, index) {
  const spot = frame.label ? `, spot ${frame.label}` : "";
  const set = frame.set ? `${frame.set}, ` : "";
  return `${set}frame ${frame.frame}${spot} (${index + 1} of ${frames.length})`;
}

function drawFrame() {
  const frame = frames[selected];
  drawNotices(frame);
  drawCameras(frame);
  drawPlan(frame);
  drawNumbers(frame);
  drawCloseUps(frame);
}

function select(index) {
  if (index < 0 || index >= frames.length || index === selected) return;
  selected = index;
  d3.select("#selected").text(headline(frames[index], index));
  d3.select("#previous").property("disabled", index === 0);
  d3.select("#next").property("disabled", index === frames.length - 1);
  markRow(document.getElementById("frames"), index);
  drawFrame();
  location.replace(`#${index + 1}`);
}

function onKey() {
  const {key, altKey, ctrlKey, metaKey, shiftKey} = d3.event;
  if (altKey || ctrlKey || metaKey || shiftKey) return;
  const step = {ArrowLeft: -1, ArrowRight: 1}[key];
  if (!step) return;
  d3.event.preventDefault();
  select(selected + step);
}

const indexOfAddress = () => Math.max(0, Math.min(frames.length, parseInt(location.hash.slice(1), 10) || 1) - 1);

function start() {
  if (frames.length === 0) {
    d3.selectAll("#legend, #selection, #frame, #sets").remove();
    d3.select("#frames").attr("class", "notice").text("This page holds no frames: none were processed.");
    return;
  }
  drawLegend();
  drawSets(frames);
  drawFrames(frames, select);
  d3.select("#previous").on("click", () => select(selected - 1));
  d3.select("#next").on("click", () => select(selected + 1));
  d3.select(document).on("keydown", onKey);
  d3.select(window).on("hashchange", () => select(indexOfAddress()));
  select(indexOfAddress());
  redrawOnResize(drawFrame);
}

start();
