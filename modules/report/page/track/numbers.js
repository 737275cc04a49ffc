// The selected frame in numbers, and what went wrong in it.

function drawNumbers(frame) {
  const box = d3.select("#numbers").html("");
  const body = addTable(box, "numbers measured", null, ["", "measured", "±", "true", "error"]);
  const ball = frame.ball.measured || {sigma: {}};
  const trueBall = frame.true_ball || {};
  const ballError = frame.ball_error || {};
  const at = (point, axis) => point ? point[axis] : null;
  addGroup(body, "Ball in the robot frame", frame.ball.status);
  addLength(body, "x, right", at(ball.point, 0), ball.sigma.x, at(trueBall.point, 0), ballError.x);
  addLength(body, "y, ahead", at(ball.point, 1), ball.sigma.y, at(trueBall.point, 1), ballError.y);
  addLength(body, "z, up", ball.z, ball.sigma.z, null, null);
  addLength(body, "distance", ball.distance, ball.sigma.distance, trueBall.distance, ballError.distance);
  addAngle(body, "direction", ball.direction_deg, ball.sigma.direction_deg, trueBall.direction_deg,
           ballError.direction_deg);
  if (!frame.fix) return;
  const pose = frame.fix.measured || {sigma: {}};
  const truePose = frame.true_pose || {};
  const error = frame.fix_error || {};
  addGroup(body, "Robot in the field", frame.fix.status);
  addLength(body, "X", pose.x, pose.sigma.x, truePose.x, error.x);
  addLength(body, "Y", pose.y, pose.sigma.y, truePose.y, error.y);
  addAngle(body, "β", pose.beta_deg, pose.sigma.beta_deg, truePose.beta_deg, error.beta_deg);
}

function addGroup(body, title, status) {
  const cell = body.append("tr").attr("class", "group").append("th").attr({colspan: 5, scope: "colgroup"});
  cell.append("span").text(title + " ");
  addStatus(cell, status);
}

function addRow(body, cells) {
  const row = body.append("tr");
  row.append("th").attr("scope", "row").text(cells[0]);
  row.selectAll("td").data(cells.slice(1)).enter().append("td").text(d => d);
}

const unit = (text, name) => text === "–" ? text : text + name;

function addLength(body, title, measured, sigma, truth, error) {
  addRow(body, [title, unit(metres(measured), " m"), unit(millimetres(sigma), " mm"), unit(metres(truth), " m"),
                unit(signed(error, millimetres(error)), " mm")]);
}

function addAngle(body, title, measured, sigma, truth, error) {
  addRow(body, [title, unit(degrees(measured), "°"), unit(degrees(sigma), "°"), unit(degrees(truth), "°"),
                unit(signed(error, degrees(error)), "°")]);
}

function noticesOf(frame) {
  const notices = [];
  if (frame.ball.status !== "ok") notices.push(`No ball position (${frame.ball.status}): ${frame.ball.explanation}.`);
  if (frame.fix && frame.fix.status !== "ok") notices.push(`No pose (${frame.fix.status}): ${frame.fix.explanation}.`);
  for (const camera of frame.cameras.filter(c => c.lost)) notices.push(`Camera ${camera.name}: its image is lost.`);
  return notices;
}

function drawNotices(frame) {
  const notice = d3.select("#notices").html("").selectAll("p").data(noticesOf(frame));
  notice.enter().append("p").attr("class", "notice").text(d => d);
}
