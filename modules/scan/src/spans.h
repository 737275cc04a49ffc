#pragma once

#include <algorithm>
#include <vector>

#include "movis/scan/refine.h"

namespace movis::scan {

struct Rows {
  int begin = 0, end = 0;
};

// The columns from the first to the last pixel that `keep` keeps, in every row.
template <typename Keep>
Rows collect_spans(const std::vector<ObjectPixel>& object, Keep keep, std::vector<RefineScratch::Span>& spans) {
  Rows rows;
  for (const ObjectPixel& pixel : object) {
    if (!keep(pixel)) continue;
    if (rows.end == 0) rows.begin = rows.end = pixel.v;
    for (; rows.end <= pixel.v; ++rows.end) spans[rows.end] = {};  // pixels come in memory order
    RefineScratch::Span& span = spans[pixel.v];
    if (span.begin >= span.end) span.begin = pixel.u;
    span.end = pixel.u + 1;
  }
  return rows;
}

// Every span united with those of the rows within `border`, and widened by as many columns.
inline Rows widen(const std::vector<RefineScratch::Span>& spans, Rows rows, int border, int width, int height,
                  std::vector<RefineScratch::Span>& widened) {
  const Rows wide{std::max(0, rows.begin - border), std::min(height, rows.end + border)};
  for (int v = wide.begin; v < wide.end; ++v) {
    RefineScratch::Span united{width, 0};
    for (int near = std::max(rows.begin, v - border); near < std::min(rows.end, v + border + 1); ++near) {
      if (spans[near].begin >= spans[near].end) continue;
      united.begin = std::min(united.begin, spans[near].begin);
      united.end = std::max(united.end, spans[near].end);
    }
    widened[v] = {};
    if (united.begin >= united.end) continue;
    widened[v].begin = std::max(0, united.begin - border);
    widened[v].end = std::min(width, united.end + border);
  }
  return wide;
}

}  // namespace movis::scan
