#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "movis/core/image_view.h"
#include "movis/scan/colours.h"
#include "movis/scan/polar_map.h"

namespace movis::scan {

// The light of one image, and the image as it would look in the light that colours.yaml was made for.
//
// A channel's gain k is what the image shows over what the reference light would have shown, in gamma-encoded bytes:
//   byte = k · reference byte,   brightness = k_g,   balance = (k_r / k_g, k_b / k_g)
// In sRGB a factor of the light itself is one of about byte + 14: of bright bytes a larger k than of dark ones.
//
// It is told by what can be recognized in any light, compared with its `typical` colour in colours.yaml:
//   carpet  what lies below the horizon, with green ahead of red and blue by about as much as the typical carpet has.
//           The gains are those of the channels' medians. Where white light explains them, as a factor of the bytes or
//           of the light, the balance is 1.
//   lines   where the carpet says that the light differs: stretches of a row, white for any light that is believed,
//           with carpet on both sides. Their bytes are as bright as those of ball and goals, which the carpet's are not;
//           but they are thin, most of their pixels are mixed with carpet, and bright ones are clipped. They count where
//           they are as bright as the carpet says, or where the two contradict each other: then it is another carpet.
// Without a typical carpet in the file nothing is adapted; without a typical line the carpet alone counts.
enum class LightStatus : std::uint8_t {
  unknown,    // no carpet, or gains beyond belief: taken for the reference light
  reference,  // within the bands: the image is left alone, bit by bit
  by_carpet,  // gains from the carpet
  by_lines,   // gains from the lines
};

struct Gains {
  double r = 1.0, g = 1.0, b = 1.0;
};

struct Illumination {
  LightStatus status = LightStatus::unknown;
  Gains gains;  // 1 where nothing is adapted

  bool differs() const { return status == LightStatus::by_carpet || status == LightStatus::by_lines; }
};

struct LightOptions {
  double brightness_band = 0.15;  // what the classes bear as they are: relative change of brightness,
  double balance_band = 0.06;     // and of the balance
  double least_gain = 0.3;        // gains beyond these are not believed
  double most_gain = 2.5;
  double least_share = 0.15;  // of what lies below the horizon must be carpet
};

// What of an image is looked at: parts of every eighth row below the horizon, in memory order.
std::vector<Run> light_rows(const PolarMap& map);

// A pixel's red, green and blue.
using Rgb = std::array<std::uint8_t, 3>;

// The light of an image in BGR8, RGB8 or RGBA8. `whites` is memory that is reused; it never grows beyond its capacity.
Illumination estimate_light(const ImageView& image, const std::vector<Run>& rows, const TypicalColours& typical,
                            const LightOptions& options, std::vector<Rgb>& whites);

// Writes the runs' pixels divided by the gains, rounded and cut off at 255, to an image of the same size and format
// whose rows follow each other without gaps. Alpha stays. Vectorized for whatever the processor has.
void remove_gains(const ImageView& image, const std::vector<Run>& runs, const Gains& gains, std::uint8_t* to);

// The two together for the images of one camera. Allocates nothing after construction.
class LightAdapter {
 public:
  LightAdapter(const PolarMap& map, const Colours& colours, const LightOptions& options);

  // The image itself, or, where its light is another, a copy in the reference light: of the scanned pixels and some
  // more around them, black elsewhere. The copy is valid until the next call.
  ImageView adapt(const ImageView& image);

  // The same for the last image once more.
  ImageView adapted(const ImageView& image) const;

  const Illumination& light() const { return light_; }  // of the last image

 private:
  LightOptions options_;
  TypicalColours typical_;
  std::vector<Run> rows_;    // that are looked at
  std::vector<Run> copied_;  // one run a row
  std::vector<Rgb> whites_;
  std::vector<std::uint8_t> copy_;
  int copy_channels_ = 0;
  Illumination light_;
};

}  // namespace movis::scan
