#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/image_view.h"
#include "movis/core/yaml.h"
#include "movis/scan/histogram.h"
#include "movis/scan/polar_map.h"

namespace movis::scan {

// From the pixels of a class to a bearing far finer than a pixel.
//
// A pixel on an object's border shows a mixture, and mixing is linear in the light, not in the gamma-encoded bytes.
// Colour is therefore taken in linear light as chromaticity, which shading leaves alone,
//   c = (α, β) / (max(R, G, B) + ε)          (α, β as in colours.h)
// and a pixel's membership w in 0…1 is how far c has come from the surroundings' c_b to the object's c_o:
//   ball  along the line from c_b to c_o; surroundings that do not lean towards the ball's colour count as grey
//   goal  along its hue, solved for the share of the pixel's area that it covers (refine_goal.cpp)
//
// Ball: a sphere is seen under a circular cone, so the solid-angle-weighted mean of its pixels' rays is the direction
//   of its centre in any central camera, near or far, tilted or not:  direction ∝ Σ w Ω r.
//   Where the own robot or another sensor unit hides a part, the visible rest of the outline is fitted instead: rays on
//   a cone around n with half angle γ satisfy r·m = 1 with m = n/cos γ, linear least squares in m, outliers trimmed.
//   From there the cone is fitted to the light of the pixels on the border (src/silhouette.h), which tells direction,
//   angular radius and their covariance. Where the ball is too small for that, the first direction stands.
// Goal: an upright edge at azimuth φ_e is where the memberships add up to those of a step seen through a pixel:
//   Σ w_i = Σ S((φ_e − φ_i)/δ_i),  S(x) = clamp(x + 1/2, 0, 1), over a window around the edge within the goal's height;
//   δ is the azimuth that a pixel covers. Solved by Newton's method. Where it has no
//   solution the edge is that of the histogram. There, and where the goal ends at something black, an opponent or the
//   own robot, the edge lies hidden somewhere behind: the bearing is flagged, and the edge's standard deviation is half
//   of the width that is seen.
struct RefineOptions {
  double dark = 0.03;                 // ε, linear light of 1
  int border_px = 2;                  // how far a mixed pixel may lie from the class's own pixels
  double edge_window_deg = 1.5;       // half width of the window around a goal's edge, at least four pixels
  double edge_band = 0.5;             // the central part of the goal's height in which its edges are sought
  double pixel_sigma = 0.15;          // noise of one border pixel's position, in pixels: see the bearings' covariance
  double azimuth_floor_deg = 0.0035;  // what no number of pixels takes away: aliasing, the model
  double elevation_floor_deg = 0.01;
  double radius_floor_deg = 0.01;  // of a ball's angular radius
};

RefineOptions read_refine_options(const YamlMap& map);

// Memory that is reused from object to object.
struct RefineScratch {
  struct Span {
    int begin = 0, end = 0;  // columns, end excluded; empty where begin ≥ end
    std::size_t first = 0;   // where the row's pixels start in `memberships`
  };
  struct Sample {
    float offset;  // azimuth from the coarse edge towards the inside, radians
    float scale;   // 1 / the azimuth that the pixel covers, 1/radians
    float membership;
    float brightness;  // linear light
  };
  std::vector<Span> spans, widened;  // by image row
  std::vector<float> values, memberships;
  std::vector<Sample> samples;
  struct BorderSample {
    Eigen::Vector3d ray, light;  // linear red, green, blue
    double gradient;             // change of the ray's cosine to the ball's centre over one pixel
    double inside;               // pixels inside of the outline, by the cone of this round
    int sector;                  // of the outline
  };
  std::vector<BorderSample> border;
  std::vector<Eigen::Vector3f> outline;  // unit rays

  RefineScratch(int image_width, int image_height);
};

// A pixel of the object's colour in its segment of the histogram.
struct ObjectPixel {
  std::uint16_t u, v;
  std::int16_t place;  // of its bin in the segment: 0 is the right end
  float z;             // of its ray
};

// `object` holds the pixels in memory order: all of a ball, of a goal those near its edges and a sample of the others.
// The bearing's camera, object and time are kept; the rest is filled in. False where too little of the object is left.
bool refine_ball(const ImageView& image, const PolarMap& map, const std::vector<ObjectPixel>& object,
                 const RefineOptions& options, RefineScratch& scratch, Bearing& bearing);

bool refine_goal(const ImageView& image, const PolarMap& map, const std::vector<ObjectPixel>& object,
                 const Segment& segment, const RefineOptions& options, RefineScratch& scratch, Bearing& bearing);

}  // namespace movis::scan
