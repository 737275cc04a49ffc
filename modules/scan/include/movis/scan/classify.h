#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "movis/core/image_view.h"
#include "movis/scan/colours.h"
#include "movis/scan/polar_map.h"

namespace movis::scan {

// A stretch of a row whose pixels all belong to one colour class: columns [begin, end).
struct Stretch {
  std::uint16_t row = 0;
  std::uint16_t begin = 0;
  std::uint16_t end = 0;
  ObjectClass object = ObjectClass::ball;
};

// A colour class as inequalities in 8-bit integers. With X = R − G and Y = B − G the hue sector's borders are
//   from_x X + from_y Y ≥ 0   and   to_x X + to_y Y ≥ 0
// Coefficients are rounded to 1/126, so that the sums fit in 16 bits: hue borders are kept to 0.45°.
struct IntegerClass {
  std::int16_t from_x = 0, from_y = 0, to_x = 0, to_y = 0;
  std::uint8_t chroma_min = 0, chroma_max = 255;
  std::uint8_t brightness_min = 0, brightness_max = 255;
  ObjectClass object = ObjectClass::ball;

  // Every pixel of the class has channel `lead` at least `lead_min` above channel `trail` (0, 1, 2: R, G, B). Most
  // vectors of pixels fail this cheap test in every lane and are done.
  std::uint8_t lead = 0, trail = 0, lead_min = 0;
};

IntegerClass to_integers(const ColourClass& colour);

inline bool belongs(const IntegerClass& colour, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  const int x = r - g;
  const int y = b - g;
  const std::uint8_t brightness = std::max({r, g, b});
  const int chroma = brightness - std::min({r, g, b});
  return colour.from_x * x + colour.from_y * y >= 0 && colour.to_x * x + colour.to_y * y >= 0 &&
         chroma >= colour.chroma_min && chroma <= colour.chroma_max && brightness >= colour.brightness_min &&
         brightness <= colour.brightness_max;
}

// Of the classes that the scan detects, ball and goals, those that stand in `colours`.
std::vector<IntegerClass> detected_classes(const Colours& colours);

// Appends the stretches of scanned pixels that belong to a class; of overlapping classes the first counts. Stretches of
// one class come in memory order. Vectorized for whatever the processor has. BGR8, RGB8 and RGBA8; an Error otherwise.
void classify(const ImageView& image, const std::vector<Run>& runs, const std::vector<IntegerClass>& classes,
              std::vector<Stretch>& stretches);

}  // namespace movis::scan
