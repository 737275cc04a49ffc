// Which curves an episode has: its controller's inside, its estimates' errors, its commands.

const scaled = (values, factor) => values.map(v => known(v) ? factor * v : null);
const single = (colour, values, carried) => [{name: "", values, carried, style: {stroke: colour}}];

// The controller's signals, one chart for each unit, the weights first.
function signalCharts(episode) {
  const units = d3.nest().key(s => s.unit).entries(episode.signals);
  return units.map(({key: unit, values: series}) => unit === "" ?
    {key: "weights", title: "Weights", series, format: 2, domain: [0, 1.04]} :
    {key: "signal " + unit, title: `Percepts and task errors / ${unit}`, series, format: 2, least: 0.01});
}

function estimateCharts({believed}) {
  const ball = classOf("ball").colour;
  return [
    {key: "pose", title: "Pose: position error / cm", format: 1, least: 1,
     series: single(ESTIMATE, scaled(believed.pose_error_m, 100), i => !believed.measured_pose[i])},
    {key: "beta", title: "Pose: heading error / °", format: 1, least: 1,
     series: single(ESTIMATE, believed.beta_error_deg, i => !believed.measured_pose[i])},
    {key: "ball", title: "Ball: position error / cm", format: 1, least: 1,
     series: single(ball, scaled(believed.ball_error_m, 100), i => !believed.measured_ball[i])},
  ];
}

function commandCharts({command}) {
  return [
    {key: "speed", title: "Speed / m/s", format: 2, least: 0.1, series: [
      {name: "speed", values: command.speed, style: {stroke: TRUTH}}, {name: "ahead", values: command.vy},
      {name: "to the right", values: command.vx}]},
    {key: "turn rate", title: "Turn rate / °/s, positive to the left", format: 0, least: 10,
     series: single(TRUTH, command.turn_rate_deg)},
  ];
}

// Charts of one key have one domain in all episodes of the start, so that they can be compared.
function shareDomains(charts) {
  for (const {values: alike} of d3.nest().key(c => c.key).entries(charts.filter(c => !c.domain))) {
    const domain = domainOf([].concat(...[].concat(...alike.map(c => c.series)).map(s => s.values)), alike[0].least);
    for (const chart of alike) chart.domain = domain;
  }
}

// Draws into the panels of a section what `chartsOf` makes of each episode. Returns what moves on to a tick.
function drawCharts(panels, chartsOf, times, absent) {
  const drawn = panels.filter(p => p.episode).map(p => ({...p, charts: chartsOf(p.episode)}));
  shareDomains([].concat(...drawn.map(d => d.charts)));
  return drawn.map(({panel, episode, charts}) => {
    if (charts.length === 0) addAbsent(panel, absent);
    const followers = charts.map((c, i) => drawChart(panel, c, episode, times, i === charts.length - 1));
    return {episode, follow: tick => followers.forEach(follow => follow(tick))};
  });
}
