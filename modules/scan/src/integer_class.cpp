#include <algorithm>
#include <array>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/scan/classify.h"

namespace movis::scan {
namespace {

// R, G, B over chroma of a pixel of the given hue, min(R, G, B) being 0: the inverse of colours.h.
std::array<double, 3> pure_colour(double hue) {
  const double alpha = std::cos(hue);
  const double beta = std::sin(hue);
  std::array<double, 3> rgb{2.0 / 3.0 * alpha, -alpha / 3.0 + beta / std::sqrt(3.0),
                            -alpha / 3.0 - beta / std::sqrt(3.0)};
  const auto [least, most] = std::minmax_element(rgb.begin(), rgb.end());
  const double low = *least;
  const double chroma = *most - low;
  for (double& channel : rgb) channel = (channel - low) / chroma;
  return rgb;
}

// The two channels whose difference is the largest share of the chroma wherever in the sector the hue lies.
void set_lead(const ColourClass& colour, IntegerClass& integers) {
  constexpr int kSteps = 64;
  constexpr double kRounding = 0.02;  // of the sector's borders, and between the steps
  double best = 0.0;
  for (std::uint8_t lead = 0; lead < 3; ++lead) {
    for (std::uint8_t trail = 0; trail < 3; ++trail) {
      double share = 1.0;
      for (int i = 0; i <= kSteps; ++i) {
        const auto rgb = pure_colour(colour.hue_from + colour.hue_width * i / kSteps);
        share = std::min(share, rgb[lead] - rgb[trail]);
      }
      if (share <= best) continue;
      best = share;
      integers.lead = lead;
      integers.trail = trail;
    }
  }
  integers.lead_min = static_cast<std::uint8_t>(std::max(0.0, (best - kRounding) * integers.chroma_min - 1.0));
}

}  // namespace

IntegerClass to_integers(const ColourClass& colour) {
  constexpr double kScale = 126.0;
  const auto word = [](double coefficient) { return static_cast<std::int16_t>(std::lround(kScale * coefficient)); };
  const auto at_least = [](double fraction) { return static_cast<std::uint8_t>(std::ceil(255.0 * fraction - 1e-9)); };
  const auto at_most = [](double fraction) { return static_cast<std::uint8_t>(std::floor(255.0 * fraction + 1e-9)); };
  IntegerClass integers;
  if (colour.hue_width < kPi) {
    // Counter-clockwise from the border at angle h: β cos h − α sin h ≥ 0, with α = X − Y/2 and β = −√3/2 Y, so that
    // the coefficients are −sin h and sin h/2 − √3/2 cos h = sin(h − 60°).
    const double from = colour.hue_from;
    const double to = colour.hue_from + colour.hue_width;
    integers.from_x = word(-std::sin(from));
    integers.from_y = word(std::sin(from - kPi / 3.0));
    integers.to_x = word(std::sin(to));
    integers.to_y = word(-std::sin(to - kPi / 3.0));
  }
  integers.chroma_min = at_least(colour.chroma_min);
  integers.chroma_max = at_most(colour.chroma_max);
  integers.brightness_min = at_least(colour.brightness_min);
  integers.brightness_max = at_most(colour.brightness_max);
  integers.object = colour.object;
  set_lead(colour, integers);
  return integers;
}

std::vector<IntegerClass> detected_classes(const Colours& colours) {
  std::vector<IntegerClass> classes;
  for (const ColourClass& colour : colours.classes) {
    const bool detected = colour.object == ObjectClass::ball || colour.object == ObjectClass::yellow_goal ||
                          colour.object == ObjectClass::blue_goal;
    if (detected) classes.push_back(to_integers(colour));
  }
  return classes;
}

}  // namespace movis::scan
