#pragma once

#include <cstdint>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/image_view.h"
#include "movis/core/yaml.h"
#include "movis/omni/rig.h"
#include "movis/scan/classify.h"
#include "movis/scan/colours.h"
#include "movis/scan/floor_scan.h"
#include "movis/scan/histogram.h"
#include "movis/scan/light.h"
#include "movis/scan/polar_map.h"
#include "movis/scan/refine.h"
#include "movis/scan/sector.h"

namespace movis::scan {

struct ScanOptions {
  int bins = 720;                    // of the histogram over azimuth
  double min_elevation_deg = -75.0;  // below it a camera sees only its own robot
  double max_elevation_deg = 45.0;
  int min_object_pixels = 6;
  double ball_gap_deg = 1.5;    // bridged within one ball
  double goal_gap_deg = 12.0;   // bridged within one goal: another sensor unit may stand before it
  double sensor_radius = 0.03;  // of another sensor unit, metres: azimuths that it may hide
  ThresholdOptions threshold;
  RefineOptions refine;
  FloorOptions floor;
  LightOptions light;
};

ScanOptions read_scan_options(const YamlMap& map);

// The scan of one camera (§2.2 and §2.3): colour classes in memory order with a precomputed azimuth bin for every
// pixel, histograms over azimuth, adaptive threshold, detection of ball and goals, bearings finer than a bin. All of it
// on the image as it would look in the light that the classes are made for.
// Allocates nothing after construction.
class Scanner {
 public:
  // `line_width` of the field's lines, metres; 0: none are sought.
  Scanner(const omni::Rig& rig, int camera, const Colours& colours, const ScanOptions& options,
          double line_width = 0.0);

  Scanner(Scanner&&) = default;
  Scanner& operator=(Scanner&&) = default;
  Scanner(const Scanner&) = delete;  // a copy would lose the memory that scan() relies on
  Scanner& operator=(const Scanner&) = delete;

  // Appends the bearings of what this camera sees, at most one for each class. Throws an Error where the image has
  // another size or format than the rig says.
  void scan(const ImageView& image, double time_s, std::vector<Bearing>& bearings);

  // Appends what this camera sees of the floor, in an image that scan() has taken.
  void scan_floor(const ImageView& image, std::vector<LinePoint>& lines, std::vector<ObstacleSight>& obstacles);

  // Of the last scan.
  const Illumination& light() const { return light_.light(); }
  const Histogram& histogram(ObjectClass object) const { return histograms_[object]; }
  const PolarMap& polar_map() const { return map_; }

 private:
  void check(const ImageView& image) const;
  bool find_object(ObjectClass object, Bearing& bearing, const ImageView& image);
  void collect_object(ObjectClass object, const Segment& segment);
  void flag_sensors(Bearing& bearing) const;

  omni::Camera camera_;
  int camera_index_;
  ScanOptions options_;
  PolarMap map_;
  LightAdapter light_;
  std::vector<IntegerClass> classes_;
  std::vector<Sector> sensors_;  // azimuths in which other sensor units stand
  std::vector<Stretch> stretches_;
  Histograms histograms_;
  std::vector<Segment> segments_;
  std::vector<std::int16_t> places_;  // by bin: its place in the segment at hand, or kElsewhere
  std::vector<ObjectPixel> object_;   // its pixels
  RefineScratch scratch_;
  FloorScan floor_;
};

}  // namespace movis::scan
