// The field from above: where robot and ball went, and where they were believed to be.

const BALL_BELIEVED = "#8c2d04";
const HEADING_EVERY_S = 0.5;
const KICK_ARROW = "M0,-9L0,-30M-5,-24L0,-31L5,-24";  // upwards, from the ball

function drawPlanLegend() {
  const dots = colour => ({stroke: colour, "stroke-width": 4, "stroke-linecap": "round", "stroke-dasharray": "0.1 7"});
  addLegend(d3.select("#legend"), [
    {line: {stroke: TRUTH, "stroke-width": 2}, text: `robot, a short line to where it heads every ${HEADING_EVERY_S} s`},
    {line: {stroke: classOf("ball").colour, "stroke-width": 2}, text: "ball"},
    {line: dots(ESTIMATE), text: "the robot’s pose as believed"},
    {line: dots(BALL_BELIEVED), text: "the ball as believed"},
    {path: {d: "M2,5L20,5M14,1L21,5L14,9", stroke: TRUTH, "stroke-width": 2, fill: "none"}, text: "kick commanded"},
    {line: {stroke: TRUTH, "stroke-width": 2, opacity: 0.3}, text: "faint: later than the chosen time"},
  ]);
}

const placeAt = (xs, ys, i) => known(xs[i]) && known(ys[i]) ? [xs[i], ys[i]] : null;
const robotAt = (place, i) => placeAt(place.x, place.y, i);
const ballAt = (place, i) => placeAt(place.ball_x, place.ball_y, i);

// Paths of the ticks that are given, in pixels.

function wayPath(ticks, point, at) {
  let pen = "M";
  let path = "";
  for (const i of ticks) {
    const place = point(i);
    if (place) path += pen + at.point(place).map(v => v.toFixed(1));
    pen = place ? "L" : "M";
  }
  return path;
}

function dotsPath(ticks, point, at) {
  return ticks.map(point).filter(known).map(p => `M${at.point(p).map(v => v.toFixed(1))}h0`).join("");
}

// Robots look along their y axis.
function headingsPath(ticks, {time_s: time, truth}, at) {
  let next = -Infinity;
  let path = "";
  for (const i of ticks) {
    const place = robotAt(truth, i);
    if (!place || !known(truth.beta_deg[i]) || time[i] < next) continue;
    next = time[i] + HEADING_EVERY_S - 1e-6;
    const beta = truth.beta_deg[i] * Math.PI / 180;
    const [x, y] = at.point(place);
    const tip = [x - 13 * Math.sin(beta), y - 13 * Math.cos(beta)];
    path += `M${x.toFixed(1)},${y.toFixed(1)}L${tip.map(v => v.toFixed(1))}`;
  }
  return path;
}

// The layers of a way, lowest first, each with its path through the ticks.
function wayLayers(episode, at) {
  const {truth, believed} = episode;
  return [
    {name: "way ball", path: ticks => wayPath(ticks, i => ballAt(truth, i), at)},
    {name: "way robot", path: ticks => wayPath(ticks, i => robotAt(truth, i), at)},
    {name: "way robot headings", path: ticks => headingsPath(ticks, episode, at)},
    {name: "dots pose", path: ticks => dotsPath(ticks, i => robotAt(believed, i), at)},
    {name: "dots ball", path: ticks => dotsPath(ticks, i => ballAt(believed, i), at)},
  ];
}

// Draws all of the way faintly, and strongly what has passed. Returns what moves on to a tick.
function addWay(svg, episode, at) {
  const all = d3.range(episode.time_s.length);
  const layers = wayLayers(episode, at);
  svg.append("g").attr("class", "later").selectAll("path").data(layers).enter().append("path")
      .attr({class: d => d.name, d: d => d.path(all)});
  const passed = svg.append("g").attr("class", "passed").selectAll("path").data(layers).enter().append("path")
      .attr("class", d => d.name);
  const kicks = addKicks(svg, episode, at);
  return tick => {
    const ticks = all.slice(0, tick + 1);
    passed.attr("d", d => d.path(ticks));
    kicks.style("opacity", i => i <= tick ? null : 0.3);
  };
}

function addKicks(svg, {kick_ticks: kicks, truth, time_s: time}, at) {
  const seen = kicks.filter(i => ballAt(truth, i) && known(truth.beta_deg[i]));
  const kick = svg.selectAll("g.kick").data(seen).enter().append("g")
      .attr({class: "kick", transform: i => `translate(${at.point(ballAt(truth, i))}) rotate(${-truth.beta_deg[i]})`});
  kick.append("title").text(i => `kick at ${secondsText(time[i])} s`);
  kick.append("path").attr({class: "halo", d: KICK_ARROW});
  kick.append("path").attr("d", KICK_ARROW);
  return kick;
}

// A robot as a disc that looks upwards, a ball as a disc. Each can be placed, and hides where its place is not known.

const place = (shape, point, beta_deg, at) => {
  shape.style("display", point && known(beta_deg) ? null : "none");
  if (point && known(beta_deg)) shape.attr("transform", `translate(${at.point(point)}) rotate(${-beta_deg})`);
};

function addRobot(svg, kind, title, at) {
  const r = Math.max(5, (page.robot_radius || 0) * at.scale);
  const robot = svg.append("g").attr("class", "robot " + kind);
  robot.append("title").text(title);
  robot.append("circle").attr("r", r);
  robot.append("line").attr({y1: 0, y2: -r});
  return robot;
}

function addBall(svg, kind, title, at) {
  const ball = svg.append("g").attr("class", "played-ball " + kind);
  ball.append("title").text(title);
  ball.append("circle").attr("r", Math.max(3.5, (page.ball_radius || 0) * at.scale));
  return ball;
}

function addPlayers(svg, {truth, believed}, at) {
  const trueBall = addBall(svg, "truth", "the ball", at);
  const trueRobot = addRobot(svg, "truth", "the robot", at);
  const robot = addRobot(svg, "estimate", "the robot’s pose as believed", at);
  const ball = addBall(svg, "estimate", "the ball as believed", at);
  return tick => {
    place(trueBall, ballAt(truth, tick), 0, at);
    place(trueRobot, robotAt(truth, tick), truth.beta_deg[tick], at);
    place(robot, robotAt(believed, tick), believed.beta_deg[tick], at);
    place(ball, ballAt(believed, tick), 0, at);
    robot.classed("carried", !believed.measured_pose[tick]);
    ball.classed("carried", !believed.measured_ball[tick]);
  };
}

function addObstacles(svg, at) {
  for (const {position, radius} of page.obstacles.filter(o => o.position && known(o.radius))) {
    svg.append("circle").attr({class: "obstacle", cx: at.x(position[0]), cy: at.y(position[1]), r: radius * at.scale})
        .append("title").text("obstacle");
  }
}

// How far off is what is believed at a tick: two lines.
function readout({believed}, tick) {
  const how = measured => measured ? "measured" : "carried along";
  const pose = known(believed.pose_error_m[tick]) ?
    `off by ${centimetres(believed.pose_error_m[tick])} cm and ${fixed(believed.beta_error_deg[tick], 1)}°, ` +
    how(believed.measured_pose[tick]) : "not known";
  const ball = known(believed.ball_error_m[tick]) ?
    `off by ${centimetres(believed.ball_error_m[tick])} cm, ${how(believed.measured_ball[tick])}` : "not known";
  return [`Pose ${pose}`, `Ball ${ball}`];
}

function statusAt(episode, tick) {
  const trouble = episode.troubles.find(t => t.from <= tick && tick <= t.to);
  return trouble ? trouble.status : "ok";
}

function drawPlan(panel, episode, reach) {
  const line = panel.select("h4").append("span").attr("class", "outcome");
  addStatus(line, episode.outcome || null, SUCCESS);
  line.append("span").text(` after ${secondsText(episode.duration_s)} s, ${kicksText(episode.kicks)}`);
  const status = line.append("span").attr("class", "drive");
  const at = addPlan(panel, reach, ["X / m", "Y / m"],
                     `The field from above with the ways of robot and ball of ${episode.contender}`);
  at.clip.append("rect").attr({class: "carpet", width: "100%", height: "100%"});
  drawField(at.clip, page.field, at);
  addObstacles(at.clip, at);
  const followers = [addWay(at.clip, episode, at), addPlayers(at.clip, episode, at)];
  const caption = panel.append("p").attr("class", "caption readout").selectAll("span").data([0, 1]).enter()
      .append("span");
  return tick => {
    followers.forEach(follow => follow(tick));
    caption.data(readout(episode, tick)).text(d => d);
    status.html("").call(addStatus, statusAt(episode, tick) === "ok" ? null : `drive: ${statusAt(episode, tick)}`);
    status.style("display", statusAt(episode, tick) === "ok" ? "none" : null);
  };
}

// One reach for all contenders, so that their fields are of one size.
function startReach({episodes}) {
  const points = [].concat(...episodes.map(({truth}) => d3.range(truth.x.length)
      .map(i => [Math.max(Math.abs(truth.x[i]), Math.abs(truth.ball_x[i])),
                 Math.max(Math.abs(truth.y[i]), Math.abs(truth.ball_y[i]))])));
  return fieldReach(page.field, points);
}
