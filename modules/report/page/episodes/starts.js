// The starts that can be played: the episodes of one seed, one of each contender.

const unique = values => values.filter((value, i) => values.indexOf(value) === i);

function startsOf(episodes) {
  return unique(episodes.map(e => e.seed)).map(seed => ({seed, episodes: episodes.filter(e => e.seed === seed)}));
}

// In the order of the outcomes; who has no summary comes after.
function contendersOf({summaries, episodes}) {
  const shown = episodes.map(e => e.contender);
  return unique(summaries.map(s => s.contender).filter(name => shown.includes(name)).concat(shown));
}

const episodeOf = (start, contender) => start.episodes.find(e => e.contender === contender) || null;

const meanOf = values => values.some(known) ? d3.mean(values.filter(known)) : null;
const kicksText = count => `${count} ${count === 1 ? "kick" : "kicks"}`;

const START_COLUMNS = ["outcome", "time\u00a0/\u00a0s", "kicks",
                       "pose error\u00a0/\u00a0cm", "ball error\u00a0/\u00a0cm"];

function startCells(start, contenders) {
  const cells = contenders.map(contender => {
    const episode = episodeOf(start, contender);
    if (!episode) return START_COLUMNS.map(() => ({text: "–"}));
    const {believed} = episode;
    return [{outcome: episode.outcome}, {text: secondsText(episode.duration_s)}, {text: episode.kicks},
            {text: centimetres(meanOf(believed.pose_error_m))}, {text: centimetres(meanOf(believed.ball_error_m))}];
  });
  return [{seed: start.seed}].concat(...cells);
}

function fillStartCell(cell) {
  const td = d3.select(this);
  if ("seed" in cell) {
    td.append("button").attr({type: "button", class: "link"}).text(cell.seed);
  } else if ("outcome" in cell) {
    addStatus(td, cell.outcome || null, SUCCESS);
  } else {
    td.text(cell.text);
  }
}

function drawStarts(starts, contenders, select) {
  const groups = [{text: "", span: 1}].concat(contenders.map(text => ({text, span: START_COLUMNS.length})));
  const columns = ["Seed"].concat(...contenders.map(() => START_COLUMNS));
  const body = addTable(d3.select("#starts"), "numbers selectable", groups, columns);
  body.selectAll("tr").data(starts).enter().append("tr").attr("class", "start").on("click", (d, i) => select(i))
      .selectAll("td").data(start => startCells(start, contenders)).enter().append("td").each(fillStartCell);
}
