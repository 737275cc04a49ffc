// The field from above, to scale.

const PLAN = {left: 46, right: 12, top: 10, bottom: 42};

const farthest = (points, axis) => d3.max(points, p => Math.abs(p[axis])) || 0;

// Half the width and height, metres, that show the field with its goals, and the points that are not far outside.
function fieldReach(field, points) {
  const margin = 0.06 * field.half_length;
  const within = (half, axis) => Math.max(half, Math.min(farthest(points, axis), 1.5 * half));
  const shown = (half, axis) => Math.max(0.5, margin + within(half, axis));
  return [shown(field.half_width, 0), shown(Math.max(field.half_length, field.Fd + field.goal_depth), 1)];
}

// A drawing to scale of what is around the origin, as large as its box lets it be. Returns where to draw, and the scales
// from metres to pixels.
function addPlan(box, [halfWidth, halfHeight], labels, description) {
  const width = contentWidth(box);
  const room = width - PLAN.left - PLAN.right;
  const tallest = Math.min(Math.max(420, 0.95 * room), 640);
  const scale = Math.min(room / (2 * halfWidth), tallest / (2 * halfHeight));  // pixels a metre
  const [w, h] = [2 * halfWidth * scale, 2 * halfHeight * scale];
  const left = PLAN.left + (room - w) / 2;
  const svg = addSvg(box, width, h + PLAN.top + PLAN.bottom, description).attr("class", "plan");
  const x = d3.scale.linear().domain([-halfWidth, halfWidth]).range([0, w]);
  const y = d3.scale.linear().domain([-halfHeight, halfHeight]).range([h, 0]);
  const clip = addClip(svg, left, PLAN.top, w, h);
  addPlanAxes(svg, labels, x, y, left, w, h);
  return {clip, x, y, scale, point: p => [x(p[0]), y(p[1])]};
}

function addPlanAxes(svg, labels, x, y, left, w, h) {
  addAxis(svg, "x", left, PLAN.top + h, d3.svg.axis().scale(x).orient("bottom").ticks(w / 60).tickSize(5));
  addAxis(svg, "y", left, PLAN.top, d3.svg.axis().scale(y).orient("left").ticks(h / 50).tickSize(5));
  addText(svg, "axis-label", left + w / 2, PLAN.top + h + 34, labels[0]);
  addVerticalLabel(svg, left - 34, PLAN.top + h / 2, labels[1]);
}

function drawField(svg, field, at) {
  const lines = svg.append("g").attr({class: "lines", "stroke-width": Math.max(1, field.line * at.scale)});
  const halfWidth = field.half_width - field.line / 2;
  const halfLength = field.half_length - field.line / 2;
  const rectangle = (parent, x1, y1, x2, y2) => parent.append("rect").attr({
    x: at.x(Math.min(x1, x2)), y: at.y(Math.max(y1, y2)),
    width: Math.abs(x2 - x1) * at.scale, height: Math.abs(y2 - y1) * at.scale});
  rectangle(lines, -halfWidth, -halfLength, halfWidth, halfLength);
  lines.append("line").attr({x1: at.x(-halfWidth), x2: at.x(halfWidth), y1: at.y(0), y2: at.y(0)});
  lines.append("circle").attr({cx: at.x(0), cy: at.y(0), r: field.circle * at.scale});
  for (const end of [1, -1]) {
    for (const area of [field.penalty_area, field.goal_area].filter(a => a.depth > 0)) {
      rectangle(lines, -area.width / 2, end * halfLength, area.width / 2, end * (halfLength - area.depth));
    }
    for (const side of [1, -1]) drawCornerArc(lines, field.corner_arc, side * halfWidth, end * halfLength, at);
    const outer = field.Fw + field.goal_thickness;
    rectangle(svg, -outer, end * field.Fd, outer, end * (field.Fd + field.goal_depth))
        .attr("class", "goal " + (field.white_goals ? "white" : end > 0 ? "yellow" : "blue"));
  }
}

function drawCornerArc(lines, radius, x, y, at) {
  if (!(radius > 0)) return;
  const r = radius * at.scale;
  const sweep = x * y > 0 ? 0 : 1;
  lines.append("path").attr("d", `M${at.x(x - Math.sign(x) * radius)},${at.y(y)}` +
      `A${r},${r} 0 0 ${sweep} ${at.x(x)},${at.y(y - Math.sign(y) * radius)}`);
}
