// The plan of a frame: the field where there is one, else the robot frame; and close-ups of the two estimates.

const ELLIPSE_95 = Math.sqrt(5.991);  // radius in standard deviations that holds 95 % of a planar distribution

// A pose maps the robot frame to the frame of the plan.
const IDENTITY = {x: 0, y: 0, beta_deg: 0};

function apply(pose, point) {
  const beta = pose.beta_deg * Math.PI / 180;
  return [pose.x + Math.cos(beta) * point[0] - Math.sin(beta) * point[1],
          pose.y + Math.sin(beta) * point[0] + Math.cos(beta) * point[1]];
}

// What the plan shows, all in one frame. `pose` places the cameras and their rays.
function planOf(frame) {
  const measured = frame.fix && frame.fix.measured;
  const pose = measured || frame.true_pose;
  if (frame.field && pose) {
    return {
      field: frame.field, pose, measured, truth: frame.true_pose, axes: ["X / m", "Y / m"],
      ball: frame.ball_in_field, trueBall: frame.true_ball_in_field,
      caption: "The field from above" + (measured ? "." : "; no pose is measured, so the rays start at the true one."),
    };
  }
  const ball = frame.ball.measured;
  return {
    field: null, pose: IDENTITY, measured: IDENTITY, truth: null, axes: ["x / m, right", "y / m, ahead"],
    ball: ball && {point: ball.point, covariance: ball.covariance},
    trueBall: frame.true_ball && frame.true_ball.point,
    caption: "The robot frame from above" + (frame.field ? ", as the pose in the field is not known." : "."),
  };
}

// Half the width and height that the plan must show, metres.
function reach(plan, frame) {
  const points = [plan.ball && plan.ball.point, plan.trueBall].filter(known);
  if (plan.field) return fieldReach(plan.field, points);
  const cameras = d3.max(frame.cameras, c => c.position && Math.hypot(...c.position)) || 0;
  const radius = 1.15 * Math.max(0.8, 3 * cameras, farthest(points, 0), farthest(points, 1));
  return [radius, radius];
}

function drawPlan(frame) {
  const box = d3.select("#plan").html("");
  const plan = planOf(frame);
  const [halfWidth, halfHeight] = reach(plan, frame);
  const at = addPlan(box, [halfWidth, halfHeight], plan.axes, plan.caption);
  const {clip} = at;
  clip.append("rect").attr({class: plan.field ? "carpet" : "floor", width: "100%", height: "100%"});
  if (plan.field) drawField(clip, plan.field, at); else drawRings(clip, Math.hypot(halfWidth, halfHeight), at);
  drawRays(clip, frame, plan.pose, at, 2 * Math.hypot(halfWidth, halfHeight));
  if (plan.truth) drawRobot(clip, frame, plan.truth, at, "truth");
  if (plan.measured) drawRobot(clip, frame, plan.measured, at, "estimate");
  if (plan.ball) drawEstimate(clip, plan.ball.point, plan.ball.covariance, at, classOf("ball").colour);
  if (plan.trueBall) drawTruth(clip, plan.trueBall, at);
  drawPlanCaption(box, plan);
}

function drawPlanCaption(box, plan) {
  const robot = plan.field ? " Violet: the estimated pose; dashed: the true one." : "";
  box.append("p").attr("class", "caption").text(`${plan.caption}${robot} Thin lines: bearings from each camera. ` +
      "Ball: dot with 95 % ellipse as measured, cross where it truly is.");
}

function drawRings(svg, radius, at) {
  const step = [0.25, 0.5, 1, 2, 5, 10, 20, 50].find(s => radius / s <= 8) || 100;
  for (const r of d3.range(step, radius, step)) {
    svg.append("circle").attr({class: "ring", cx: at.x(0), cy: at.y(0), r: r * at.scale});
    addText(svg, "ring-label", at.x(r * Math.SQRT1_2) + 3, at.y(r * Math.SQRT1_2) - 3, `${r} m`);
  }
  svg.append("line").attr({class: "ring", x1: 0, x2: "100%", y1: at.y(0), y2: at.y(0)});
  svg.append("line").attr({class: "ring", x1: at.x(0), x2: at.x(0), y1: 0, y2: "100%"});
}

// The bearings from above, each from its camera's viewpoint.
function drawRays(svg, frame, pose, at, length) {
  for (const camera of frame.cameras.filter(c => c.position)) {
    const start = at.point(apply(pose, camera.position));
    for (const mark of drawable(camera)) {
      const azimuth = mark.azimuth_deg * Math.PI / 180;
      const end = at.point(apply(pose, [camera.position[0] + length * Math.cos(azimuth),
                                        camera.position[1] + length * Math.sin(azimuth)]));
      const ray = svg.append("line").attr({class: "ray " + mark.object, x1: start[0], y1: start[1], x2: end[0],
                                           y2: end[1], stroke: classOf(mark.object).colour});
      ray.attr("stroke-dasharray", dashed(mark)).append("title").text(`${camera.name}, ${titleOf(mark)}`);
    }
  }
}

// The robot: the polygon of its cameras, with an arrow ahead. `kind` is estimate or truth.
function drawRobot(svg, frame, pose, at, kind) {
  const cameras = frame.cameras.filter(c => c.position);
  const corners = cameras.map(c => at.point(apply(pose, c.position)));
  const robot = svg.append("g").attr("class", "robot " + kind);
  robot.append("title").text(kind === "truth" ? "true pose" : "estimated pose");
  if (corners.length > 2) robot.append("path").attr("d", "M" + corners.join("L") + "Z");
  const origin = at.point([pose.x, pose.y]);
  const tip = at.point(apply(pose, [0, Math.max(0.4, 30 / at.scale)]));
  robot.append("line").attr({x1: origin[0], y1: origin[1], x2: tip[0], y2: tip[1]});
  const heading = Math.atan2(tip[1] - origin[1], tip[0] - origin[0]) * 180 / Math.PI;
  robot.append("path").attr({class: "tip", d: "M0,0L-8,3.5L-8,-3.5Z",
                             transform: `translate(${tip}) rotate(${heading})`});
  if (pose.covariance) addEllipse(robot, [pose.x, pose.y], pose.covariance, at);
  if (kind === "truth") return;
  robot.selectAll("circle.viewpoint").data(corners).enter().append("circle")
      .attr({class: "viewpoint", cx: d => d[0], cy: d => d[1], r: 2.5});
  const arms = corners.map(c => Math.hypot(c[0] - origin[0], c[1] - origin[1]));
  if (d3.min(arms) < 14) return;  // too small for names
  const outside = (i, axis) => corners[i][axis] + 13 * (corners[i][axis] - origin[axis]) / arms[i];
  robot.selectAll("text").data(cameras).enter().append("text").text(c => c.name)
      .attr({x: (d, i) => outside(i, 0), y: (d, i) => outside(i, 1) + 4});
}

// Half axes and direction of the 95 % ellipse of the covariance [xx, xy, yy].
function ellipseOf([xx, xy, yy]) {
  const middle = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  return {major: ELLIPSE_95 * Math.sqrt(Math.max(0, middle + spread)),
          minor: ELLIPSE_95 * Math.sqrt(Math.max(0, middle - spread)),
          angle_deg: Math.atan2(2 * xy, xx - yy) / 2 * 180 / Math.PI};
}

function addEllipse(svg, point, covariance, at) {
  const {major, minor, angle_deg: angle} = ellipseOf(covariance);
  svg.append("ellipse").attr({class: "confidence", rx: major * at.scale, ry: minor * at.scale,
                              transform: `translate(${at.point(point)}) rotate(${-angle})`});
}

function drawEstimate(svg, point, covariance, at, colour) {
  if (!point) return;
  const group = svg.append("g").attr("class", "estimated-point").style({stroke: colour, fill: colour});
  group.append("title").text("as measured, with 95 % ellipse");
  if (covariance) addEllipse(group, point, covariance, at);
  group.append("circle").attr({cx: at.x(point[0]), cy: at.y(point[1]), r: 3.5});
}

function drawTruth(svg, point, at) {
  const [x, y] = at.point(point);
  const cross = svg.append("path").attr({class: "true-point", d: `M${x - 8},${y}h16M${x},${y - 8}v16`});
  cross.append("title").text("the truth");
}

// An estimate beside the truth, large enough to see the error. The origin is the truth, or without it the estimate.
function drawCloseUp(box, {title, axes, point, covariance, truth, colour}) {
  const figure = box.append("figure").attr("class", "close-up panel");
  const origin = truth || point;
  figure.append("figcaption").text(title + (truth ? ", relative to the truth" : ", relative to the estimate"));
  const width = contentWidth(figure);
  const side = width - PLAN.left - PLAN.right;
  const svg = addSvg(figure, width, side + PLAN.top + PLAN.bottom, title);
  const ellipse = covariance ? ellipseOf(covariance).major : 0;
  const error = [point[0] - origin[0], point[1] - origin[1]];
  const half = 1.15 * Math.max(0.005, Math.hypot(...error), Math.abs(error[0]) + ellipse, Math.abs(error[1]) + ellipse);
  const x = d3.scale.linear().domain([-half, half]).range([0, side]);
  const y = d3.scale.linear().domain([-half, half]).range([side, 0]);
  const at = {x, y, scale: side / (2 * half), point: p => [x(p[0]), y(p[1])]};
  const clip = addClip(svg, PLAN.left, PLAN.top, side, side);
  clip.append("rect").attr({class: "floor", width: side, height: side});
  drawEstimate(clip, error, covariance, at, colour);
  if (truth) drawTruth(clip, [0, 0], at);
  const centimetre = scale => scale.copy().domain([-100 * half, 100 * half]);
  addPlanAxes(svg, axes, centimetre(x), centimetre(y), PLAN.left, side, side);
}

function drawCloseUps(frame) {
  const box = d3.select("#close-ups").html("");
  const ball = frame.ball.measured;
  const pose = frame.fix && frame.fix.measured;
  if (ball && ball.point) {
    drawCloseUp(box, {title: "Ball", axes: ["x / cm, right", "y / cm, ahead"], point: ball.point,
                      covariance: ball.covariance, truth: frame.true_ball && frame.true_ball.point,
                      colour: classOf("ball").colour});
  }
  if (pose) {
    drawCloseUp(box, {title: "Robot in the field", axes: ["X / cm", "Y / cm"], point: [pose.x, pose.y],
                      covariance: pose.covariance, truth: frame.true_pose && [frame.true_pose.x, frame.true_pose.y],
                      colour: ESTIMATE});
  }
}
