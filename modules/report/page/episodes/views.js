// What the cameras saw at the stored time nearest to the chosen one.

function nearestView(views, time) {
  return d3.range(views.length).reduce((best, i) =>
    best < 0 || Math.abs(views[i].time_s - time) < Math.abs(views[best].time_s - time) ? i : best, -1);
}

function addView(panel, view) {
  const row = panel.append("div").attr("class", "view").style("display", "none");
  const figure = row.selectAll("figure").data(view.pictures).enter().append("figure");
  figure.each(function (picture, i) {
    const parent = d3.select(this);
    if (picture) {
      // Decoded at once: a picture that comes late flickers while the episode plays.
      parent.append("img").attr({decoding: "sync", width: picture.width, height: picture.height, src: picture.src,
                                 alt: `Camera ${page.cameras[i]} at ${secondsText(view.time_s)} s`});
    } else {
      addAbsent(parent, "no picture");
    }
  });
  figure.append("figcaption").text((d, i) => page.cameras[i]);
  return row;
}

// Returns what moves on to a tick.
function drawViews(panel, episode) {
  if (episode.views.length === 0) {
    addAbsent(panel, "No pictures of this episode are stored.");
    return () => {};
  }
  const rows = episode.views.map(view => addView(panel, view));
  const caption = panel.append("p").attr("class", "caption");
  let shown = -1;
  return tick => {
    const index = nearestView(episode.views, tick < 0 ? 0 : episode.time_s[tick]);
    if (index === shown) return;
    if (shown >= 0) rows[shown].style("display", "none");
    rows[index].style("display", null);
    shown = index;
    caption.text(`Taken at ${secondsText(episode.views[index].time_s)} s, picture ${index + 1} of ` +
        `${episode.views.length} that are stored.`);
  };
}
