#include "movis/scan/light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace movis::scan {
namespace {

constexpr int kRowStep = 8;
constexpr int kColumnStep = 4;
constexpr double kBalance = 1.6;  // a balance from 1/1.6 to 1.6 is believed
constexpr int kClipped = 250;     // from here on a byte may have been cut off
constexpr std::size_t kMostWhites = 1024;

// Fractions of 1/256: whole numbers compare faster.
constexpr double kUnit = 256.0;

struct Ratio {
  Ratio(double value, double factor)
      : least(static_cast<int>(kUnit * value / factor)), most(static_cast<int>(kUnit * value * factor)) {}
  bool holds(int numerator, int denominator) const {
    const int scaled = static_cast<int>(kUnit) * numerator;
    return (scaled >= least * denominator) & (scaled <= most * denominator);
  }

  int least, most;
};

// The colours that a surface may have in any light that is believed. (& and not &&: a branch a pixel costs more.)
struct Recognizable {
  Recognizable(const Eigen::Vector3d& typical, const LightOptions& options)
      : red(typical[0] / typical[1], kBalance),
        blue(typical[2] / typical[1], kBalance),
        green_min(static_cast<int>(options.least_gain * typical[1])),
        green_max(static_cast<int>(options.most_gain * typical[1])) {}
  bool holds(int r, int g, int b) const {
    return (g >= green_min) & (g <= green_max) & red.holds(r, g) & blue.holds(b, g);
  }

  Ratio red, blue;
  int green_min, green_max;
};

struct Counts {
  std::array<std::uint32_t, 256> bytes{};
  void add(int byte) { ++bytes[static_cast<std::size_t>(byte)]; }

  // Finer than a byte: its pixels are taken to lie evenly over its width.
  double median(int total) const {
    const double half = 0.5 * total;
    double below = 0.0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      if (below + bytes[i] >= half && bytes[i] > 0) return static_cast<double>(i) - 0.5 + (half - below) / bytes[i];
      below += bytes[i];
    }
    return 0.0;
  }
};

// Calls use(r, g, b) for every step-th pixel of a run.
template <typename Use>
void for_each_pixel(const ImageView& image, const Run& run, int step, Use use) {
  const int bytes = channels(image.format);
  const int red = image.format == PixelFormat::bgr8 ? 2 : 0;
  const std::uint8_t* pixel = image.row(run.row) + static_cast<std::ptrdiff_t>(bytes) * run.begin;
  for (int u = run.begin; u < run.end; u += step, pixel += bytes * step) use(pixel[red], pixel[1], pixel[2 - red]);
}

// The carpet's colour in this image. Nothing where there is too little of it, or where it is clipped.
std::optional<Eigen::Vector3d> find_carpet(const ImageView& image, const std::vector<Run>& rows,
                                           const Eigen::Vector3d& typical, const LightOptions& options) {
  const Recognizable recognizable(typical, options);
  Counts red, green, blue;
  int carpet = 0;
  int looked_at = 0;
  for (const Run& run : rows) {
    for_each_pixel(image, run, kColumnStep, [&](int r, int g, int b) {
      ++looked_at;
      if (!recognizable.holds(r, g, b)) return;
      ++carpet;
      red.add(r);
      green.add(g);
      blue.add(b);
    });
  }
  constexpr int kFewest = 50;
  if (carpet < kFewest || carpet < options.least_share * looked_at) return std::nullopt;
  const Eigen::Vector3d colour(red.median(carpet), green.median(carpet), blue.median(carpet));
  if (colour.maxCoeff() >= kClipped) return std::nullopt;
  return colour;
}

// Bytes from a median over 1.35 to 1.35 times it.
struct Alike {
  explicit Alike(double median) : least(static_cast<int>(median / 1.35)), most(static_cast<int>(median * 1.35)) {}
  bool holds(int byte) const { return (byte >= least) & (byte <= most); }

  int least, most;
};

// The whitest pixel of every stretch that may be a line across the carpet.
void collect_whites(const ImageView& image, const std::vector<Run>& rows, const Eigen::Vector3d& carpet,
                    const Recognizable& white, std::vector<Rgb>& whites) {
  constexpr int kWidest = 12;  // pixels
  const Alike red(carpet[0]);
  const Alike green(carpet[1]);
  const Alike blue(carpet[2]);
  whites.clear();
  for (const Run& run : rows) {
    if (run.row % (2 * kRowStep) != 0) continue;
    int since_carpet = kWidest + 1;
    int whiteness = 0;
    Rgb whitest{};
    for_each_pixel(image, run, 1, [&](int r, int g, int b) {
      if (red.holds(r) & green.holds(g) & blue.holds(b)) {
        if (whiteness > 0 && since_carpet <= kWidest && whites.size() < whites.capacity()) whites.push_back(whitest);
        since_carpet = 0;
        whiteness = 0;
        return;
      }
      ++since_carpet;
      if (r + b <= whiteness || !white.holds(r, g, b)) return;
      whiteness = r + b;  // the carpet has least of these
      whitest = {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)};
    });
  }
}

// The lines' colour: that of the whitest pixels, as the others are mixed with carpet. Nothing where there are too few
// lines, or where they are clipped.
std::optional<Eigen::Vector3d> find_lines(std::vector<Rgb>& whites) {
  constexpr std::size_t kFewest = 16;
  constexpr double kPure = 0.9;  // of the ninth decile's whiteness
  if (whites.size() < kFewest) return std::nullopt;
  const auto whiteness = [](const Rgb& rgb) { return rgb[0] + rgb[2]; };
  const auto decile = whites.begin() + static_cast<std::ptrdiff_t>(whites.size() * 9 / 10);
  std::nth_element(whites.begin(), decile, whites.end(),
                   [&](const Rgb& a, const Rgb& b) { return whiteness(a) < whiteness(b); });
  const double least = kPure * whiteness(*decile);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int pure = 0;
  int clipped = 0;
  for (const Rgb& rgb : whites) {
    if (whiteness(rgb) < least) continue;
    ++pure;
    clipped += *std::max_element(rgb.begin(), rgb.end()) >= kClipped ? 1 : 0;
    sum += Eigen::Vector3d(rgb[0], rgb[1], rgb[2]);
  }
  constexpr int kClippedShare = 5;  // one in
  if (kClippedShare * clipped > pure) return std::nullopt;
  return Eigen::Vector3d(sum / pure);
}

Gains gains_of(const Eigen::Vector3d& seen, const Eigen::Vector3d& typical) {
  return {seen[0] / typical[0], seen[1] / typical[1], seen[2] / typical[2]};
}

bool within(double value, double band) {
  return value <= 1.0 + band && value * (1.0 + band) >= 1.0;
}

// Would white light give these gains, be it a factor of the bytes or of the light? sRGB's light goes nearly as
// (byte + 14)^2.4, so that a factor of the light is one of byte + 14.
bool neutral(const Gains& gains, const Eigen::Vector3d& typical, double band) {
  constexpr double kOffset = 14.0;
  const double factor = (gains.g * typical[1] + kOffset) / (typical[1] + kOffset);
  const auto explained = [&](double gain, double byte) {
    const double of_light = (factor * (byte + kOffset) - kOffset) / byte;
    return gain * (1.0 + band) >= std::min(gains.g, of_light) && gain <= (1.0 + band) * std::max(gains.g, of_light);
  };
  return explained(gains.r, typical[0]) && explained(gains.b, typical[2]);
}

Illumination light_of(const Gains& gains, const Eigen::Vector3d& typical, LightStatus source,
                      const LightOptions& options) {
  const auto [least, most] = std::minmax({gains.r, gains.g, gains.b});
  if (least < options.least_gain || most > options.most_gain) return {LightStatus::unknown, {}};
  if (!neutral(gains, typical, options.balance_band)) return {source, gains};
  if (within(gains.g, options.brightness_band)) return {LightStatus::reference, {}};
  return {source, {gains.g, gains.g, gains.g}};
}

// Are the lines as bright as the carpet says, and so hardly mixed with it? If not, do they contradict its balance?
bool lines_count(const Gains& lines, const Gains& carpet) {
  constexpr double kPure = 0.1;
  constexpr double kTolerance = 0.2;
  return within(lines.g / carpet.g, kPure) || !within(lines.r / lines.g / (carpet.r / carpet.g), kTolerance) ||
         !within(lines.b / lines.g / (carpet.b / carpet.g), kTolerance);
}

// What is copied: the scanned pixels row by row, and as many more as a refinement may look beyond them; from and to
// columns that suit vectors.
std::vector<Run> copied_rows(const PolarMap& map) {
  constexpr int kMargin = 16;
  constexpr int kBlock = 32;  // columns
  std::vector<Run> rows;
  for (const Run& run : map.runs) {
    if (rows.empty() || rows.back().row != run.row) rows.push_back({run.row, run.begin, run.end});
    rows.back().end = run.end;
  }
  for (Run& row : rows) {
    row.begin = std::max(0, row.begin - kMargin) / kBlock * kBlock;
    row.end = std::min(map.width, (row.end + kMargin + kBlock - 1) / kBlock * kBlock);
  }
  return rows;
}

}  // namespace

std::vector<Run> light_rows(const PolarMap& map) {
  constexpr float kBelow = -0.05F;  // z of a ray
  std::vector<Run> rows;
  for (const Run& run : map.runs) {
    if (run.row % kRowStep != 0) continue;
    for (int u = run.begin; u < run.end; ++u) {
      if (map.ray[map.index(u, run.row)].z > kBelow) continue;
      if (rows.empty() || rows.back().row != run.row || rows.back().end != u) rows.push_back({run.row, u, u});
      rows.back().end = u + 1;
    }
  }
  return rows;
}

Illumination estimate_light(const ImageView& image, const std::vector<Run>& rows, const TypicalColours& typical,
                            const LightOptions& options, std::vector<Rgb>& whites) {
  if (!typical.field) return {};
  const auto carpet = find_carpet(image, rows, *typical.field, options);
  if (!carpet) return {};
  const Gains by_carpet = gains_of(*carpet, *typical.field);
  const Illumination light = light_of(by_carpet, *typical.field, LightStatus::by_carpet, options);
  if (light.status == LightStatus::reference || !typical.line) return light;
  collect_whites(image, rows, *carpet, Recognizable(*typical.line, options), whites);
  const auto lines = find_lines(whites);
  if (!lines) return light;
  const Gains by_lines = gains_of(*lines, *typical.line);
  if (!lines_count(by_lines, by_carpet)) return light;
  const Illumination of_lines = light_of(by_lines, *typical.line, LightStatus::by_lines, options);
  return of_lines.status == LightStatus::unknown ? light : of_lines;
}

LightAdapter::LightAdapter(const PolarMap& map, const Colours& colours, const LightOptions& options)
    : options_(options), typical_(colours.typical) {
  if (!typical_.field) return;
  constexpr std::size_t kMostChannels = 4;
  rows_ = light_rows(map);
  copied_ = copied_rows(map);
  whites_.reserve(kMostWhites);
  copy_.resize(kMostChannels * static_cast<std::size_t>(map.width) * map.height);
}

ImageView LightAdapter::adapt(const ImageView& image) {
  light_ = estimate_light(image, rows_, typical_, options_, whites_);
  if (!light_.differs()) return image;
  if (copy_channels_ != channels(image.format)) std::fill(copy_.begin(), copy_.end(), std::uint8_t{0});
  copy_channels_ = channels(image.format);
  remove_gains(image, copied_, light_.gains, copy_.data());
  return adapted(image);
}

ImageView LightAdapter::adapted(const ImageView& image) const {
  if (!light_.differs()) return image;
  return {copy_.data(), image.width, image.height, static_cast<std::ptrdiff_t>(copy_channels_) * image.width,
          image.format};
}

}  // namespace movis::scan
