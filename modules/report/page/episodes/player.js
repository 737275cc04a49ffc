// The time of the player, in which all contenders move in step: an index into the times of all their ticks.

const player = {times: [], index: 0, followers: [], playing: false, clock_s: 0, frame_ms: null};

const timeNow = () => player.times.length > 0 ? player.times[player.index] : null;
const lastIndex = () => Math.max(0, player.times.length - 1);

// The last tick that has begun at a time; −1 where there are none.
function tickAt(episode, time) {
  const ticks = episode.time_s.length;
  return ticks === 0 ? -1 : Math.max(0, d3.bisectRight(episode.time_s, time) - 1);
}

function load(times, followers) {
  player.times = times;
  player.followers = followers;
  d3.select("#slider").attr("max", lastIndex()).property("disabled", times.length < 2);
  d3.select("#play").property("disabled", times.length < 2);
}

function show(index) {
  player.index = Math.max(0, Math.min(lastIndex(), index));
  const time = timeNow();
  for (const {episode, follow} of player.followers) follow(tickAt(episode, time === null ? 0 : time));
  const text = `${secondsText(time)} s`;
  d3.select("#slider").property("value", player.index).attr("aria-valuetext", text);
  const end = player.times[lastIndex()];
  d3.select("#time").text(known(end) ? `${text} of ${secondsText(end)} s` : "no ticks");
}

// Moves the player by hand.
function seek(index) {
  show(index);
  player.clock_s = timeNow();
  rememberTime();
}

function seekTime(time) {
  seek(d3.bisectRight(player.times, time + 1e-6) - 1);
}

// Playing: the clock runs with the screen's frames.

function setPlaying(playing) {
  player.playing = playing && player.times.length > 1;
  d3.select("#play").text(player.playing ? "❚❚ Pause" : "▶ Play").attr("aria-pressed", player.playing);
  if (!player.playing) {
    rememberTime();
    return;
  }
  if (player.index === lastIndex()) show(0);
  player.clock_s = timeNow();
  player.frame_ms = null;
  requestAnimationFrame(playFrame);
}

function playFrame(now_ms) {
  if (!player.playing) return;
  const speed = Number(d3.select("#speed").property("value"));
  if (player.frame_ms !== null) player.clock_s += speed * (now_ms - player.frame_ms) / 1000;
  player.frame_ms = now_ms;
  show(d3.bisectRight(player.times, player.clock_s) - 1);
  if (player.index === lastIndex()) setPlaying(false); else requestAnimationFrame(playFrame);
}

// Keys

const ownsSpace = target => target instanceof Element && target.closest("button, select, a") !== null;
const ownsArrows = target => target instanceof Element && target.closest("select") !== null;

function onKey() {
  const {key, altKey, ctrlKey, metaKey, shiftKey, target} = d3.event;
  if (altKey || ctrlKey || metaKey) return;
  if (key === " " && !ownsSpace(target)) {
    setPlaying(!player.playing);
  } else if ((key === "ArrowLeft" || key === "ArrowRight") && !ownsArrows(target)) {
    const direction = key === "ArrowLeft" ? -1 : 1;
    if (shiftKey) seekTime(timeNow() + direction); else seek(player.index + direction);
  } else {
    return;
  }
  d3.event.preventDefault();
}

// A button that was clicked gives the keyboard back to the player; one that was reached by keys keeps it.
function onClick() {
  const active = document.activeElement;
  if (d3.event.detail > 0 && active && active.closest("button")) active.blur();
}

function startPlayer() {
  d3.select("#play").on("click", () => setPlaying(!player.playing));
  d3.select("#slider").on("input", function () { seek(Number(this.value)); });
  d3.select(document).on("keydown", onKey).on("click", onClick);
  setPlaying(false);
}
