#pragma once

#include <cstdint>
#include <vector>

#include "movis/core/image_view.h"
#include "movis/core/line_point.h"
#include "movis/core/obstacle.h"
#include "movis/core/yaml.h"
#include "movis/omni/rig.h"
#include "movis/scan/classify.h"
#include "movis/scan/colours.h"
#include "movis/scan/polar_map.h"
#include "movis/scan/sector.h"

namespace movis::scan {

// What one camera sees of the floor: points on white lines, and what hides the floor.
//
// Both are sought relative to the carpet, whose colour is the mean of a sample of the pixels of the class `field`, so
// that neither depends on how bright the light is.
//
// Line points. Where a row or a column of the image crosses a line there is carpet, white, carpet. With the light
// s = R + B (linear; carpet has little of it, white much), the carpet's s_c interpolated between both sides and
// e_i = s_i − s_c of the pixels in between,
//   middle  c = Σ i e_i / Σ e_i      width  w = Σ e_i / W,   W: the mean of the whitest pixels
// which no symmetric blur and no sampling by pixels moves. Where the white is more than some two pixels wide, both its
// edges c ± w/2 are placed on the floor and the point is half way: a chord's middle between parallel edges lies on the
// line's middle, however obliquely it is crossed. Where it is thinner, the point is where c meets the floor. The line's
// direction comes from the structure tensor of s beside it; of rows and columns, those count that cross it steeply.
//
// σ_c² = Σ (i − c)² σ_i² / (Σ e_i)² + (position_floor/cos θ)²,  with σ_i from the noise of the bytes, which is
// measured at the carpet beside the lines and so holds its texture, and θ between the scan and the line's normal. It
// becomes that of the point across the line by the camera's Jacobian.
//
// Obstacles. Going outward in one azimuth, carpet ends and something dark begins. Neighbouring azimuths whose feet are
// about equally far away are one obstacle, of half width α. For a round foot, in the azimuth δ beside its middle,
//   r(δ) = r(0) (cos δ − √(sin² α − sin² δ))/(1 − sin α)
// so that every azimuth tells r(0): the distance is the median. Azimuths that the own body or another sensor unit hides
// end no obstacle.
//
// Where this fails: without pixels of class `field` there is nothing; a line narrower than about a fifth of a pixel,
// one with less than three pixels of carpet beside it, and a corner of two lines give no points or bad ones; something
// bright at the foot of an obstacle hides it; where the own body hides a part of a foot, as of an opponent that nearly
// touches it, the rest is taken for a narrower obstacle that stands farther away; what is dark without being an
// obstacle, on carpet, is taken for one.
struct FloorOptions {
  double max_range = 4.0;       // of lines and feet, metres from under the camera
  int line_step = 8;            // every so many rows and columns are searched for lines
  int most_line_points = 130;   // a camera
  double white_contrast = 0.3;  // least e of a line's whitest pixel, of the carpet's R + G + B
  double white_balance = 0.4;   // least share of the least brightened channel in the most brightened
  double least_pixels = 0.5;    // width of a line along the scan: a thinner one falls between the pixels
  double position_floor = 0.1;  // of a line's middle, pixels: sampling, the model
  double floor_sigma = 0.001;   // of a line's middle on the floor, metres: paint and floor are not as drawn
  double obstacle_dark = 0.45;  // most brightness of an obstacle's foot, of the carpet's, gamma-encoded
  int obstacle_pixels = 6;      // least height of what is dark
  double obstacle_width_deg = 3.0;
  double foot_sigma_px = 0.5;  // of the floor's end in one azimuth: shadow, sampling
};

FloorOptions read_floor_options(const YamlMap& map);

// The mean of the carpet's pixels; gamma-encoded bytes.
struct Carpet {
  float r = 0.0F, g = 0.0F, b = 0.0F;
  int samples = 0;
};

// What may be white on carpet:  256 R ≥ red G,  256 B ≥ blue G,  G ≥ green. Bytes.
struct WhiteBounds {
  std::uint16_t red = 0, blue = 0;  // at most 257: products of bytes stay within 16 bits
  std::uint8_t green = 0;
};

inline bool may_be_white(const WhiteBounds& bounds, int r, int g, int b) {
  return 256 * r >= bounds.red * g && 256 * b >= bounds.blue * g && g >= bounds.green;
}

// The stretches of pixels that may be white, in memory order, appended. Vectorized like classify().
void find_white(const ImageView& image, const std::vector<Run>& runs, const WhiteBounds& bounds,
                std::vector<Stretch>& stretches);

// Sights of obstacles by one camera, at most.
inline constexpr int kMostSights = 32;

// The floor of one camera. Allocates nothing after construction.
class FloorScan {
 public:
  // `line_width` in metres; 0: no lines are sought. Azimuths of `sensors` show no obstacles.
  FloorScan(const omni::Camera& camera, int camera_index, const PolarMap& map, const Colours& colours,
            const FloorOptions& options, double line_width, const std::vector<Sector>& sensors);

  // Appends. `map` is that of the construction.
  void scan(const ImageView& image, const PolarMap& map, std::vector<LinePoint>& lines,
            std::vector<ObstacleSight>& obstacles);

 private:
  static constexpr int kRays = 360;  // azimuths in which obstacles are sought
  struct Pixel {
    std::uint16_t u, v;
  };
  static Pixel pixel(int u, int v) { return {static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(v)}; }
  struct Candidate {
    LinePoint point;
    float noise_gain;        // of σ_c², pixels² for bytes of unit variance
    float across_per_pixel;  // metres across the line for a pixel along the scan
    float carpet_noise;      // a sample of the bytes' variance
    float steepness;         // cosine of the angle between the scan and the line's normal, in the image
  };
  struct Foot {
    float range = 0.0F;  // metres; 0: none
    float sigma = 0.0F;
    bool unknown = false;  // another sensor unit stands there
    bool hidden = false;   // nothing is known of the floor there: that, or the own body hides all of it
  };

  static double azimuth_of(int ray);
  void lay_rays(const omni::Camera& camera, const PolarMap& map, const std::vector<Sector>& sensors);
  Carpet sample_carpet(const ImageView& image) const;
  void scan_lines(const ImageView& image, const PolarMap& map, const Carpet& carpet, std::vector<LinePoint>& lines);
  void cross(const ImageView& image, const PolarMap& map, const Carpet& carpet, int u, int v, int length, bool column);
  void add_evenly(std::vector<LinePoint>& lines) const;
  void find_feet(const ImageView& image, const PolarMap& map, const Carpet& carpet);
  Foot foot_at(const ImageView& image, const PolarMap& map, int ray, int dark_from) const;
  void add_obstacle(int first, int last, std::size_t first_sight, std::vector<ObstacleSight>& obstacles) const;
  void join_feet(std::vector<ObstacleSight>& obstacles) const;

  int camera_index_;
  double height_;
  Eigen::Vector2d under_camera_;  // robot frame
  FloorOptions options_;
  double line_width_;
  bool has_field_ = false;
  IntegerClass field_;
  std::vector<Run> runs_;       // the floor within max_range
  std::vector<Pixel> samples_;  // of the floor
  std::vector<Pixel> rays_;     // outward, azimuth after azimuth
  std::vector<int> ray_begin_;  // in rays_; one more than there are azimuths
  std::vector<Foot> feet_;      // by azimuth
  std::vector<Stretch> white_;
  std::vector<Candidate> candidates_;
};

}  // namespace movis::scan
