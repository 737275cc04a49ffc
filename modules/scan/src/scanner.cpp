#include "movis/scan/scanner.h"

#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::scan {
namespace {

constexpr ObjectClass kDetected[] = {ObjectClass::ball, ObjectClass::yellow_goal, ObjectClass::blue_goal};
constexpr std::size_t kMaxSegments = 64;

std::vector<IntegerClass> detected_classes(const Colours& colours) {
  std::vector<IntegerClass> classes;
  for (const ColourClass& colour : colours.classes) {
    if (std::find(std::begin(kDetected), std::end(kDetected), colour.object) != std::end(kDetected)) {
      classes.push_back(to_integers(colour));
    }
  }
  return classes;
}

}  // namespace

Scanner::Scanner(const omni::Rig& rig, int camera, const Colours& colours, const ScanOptions& options)
    : camera_(rig.cameras.at(camera)),
      camera_index_(camera),
      options_(options),
      map_(make_polar_map(camera_, options.bins, radians(options.min_elevation_deg),
                          radians(options.max_elevation_deg))),
      classes_(detected_classes(colours)),
      histograms_(kObjectClasses),
      selected_(options.bins),
      scratch_(camera_.width, camera_.height) {
  for (int other = 0; other < static_cast<int>(rig.cameras.size()); ++other) {
    const Eigen::Vector2d towards = (rig.cameras[other].position - camera_.position).head<2>();
    if (other == camera || towards.norm() <= options.sensor_radius) continue;  // itself, or one above the other
    sensors_.push_back({std::atan2(towards.y(), towards.x()), std::asin(options.sensor_radius / towards.norm())});
  }
  hits_.reserve(map_.scanned_pixels());
  segments_.reserve(kMaxSegments);
  for (Histogram& histogram : histograms_) histogram.counts.assign(options.bins, 0);
}

const Histogram& Scanner::histogram(ObjectClass object) const {
  return histograms_[static_cast<int>(object)];
}

void Scanner::check(const ImageView& image) const {
  if (image.width != camera_.width || image.height != camera_.height) {
    throw Error("camera '{}': the image is {}×{}, the rig says {}×{}; use the rig file that belongs to these images",
                camera_.name, image.width, image.height, camera_.width, camera_.height);
  }
  if (camera_.format && image.format != *camera_.format) {
    throw Error("camera '{}': the image is {}, the rig says {}", camera_.name, name(image.format),
                name(*camera_.format));
  }
}

void Scanner::scan(const ImageView& image, double time_s, std::vector<Bearing>& bearings) {
  check(image);
  hits_.clear();
  classify(image, map_.runs, classes_, hits_);
  fill_histograms();
  for (const ObjectClass object : kDetected) {
    Bearing bearing;
    bearing.camera = camera_index_;
    bearing.object = object;
    bearing.time_s = time_s;
    if (find_object(object, bearing, image)) bearings.push_back(bearing);
  }
}

void Scanner::fill_histograms() {
  for (const ObjectClass object : kDetected) {
    auto& counts = histograms_[static_cast<int>(object)].counts;
    std::fill(counts.begin(), counts.end(), 0U);
  }
  for (const Hit& hit : hits_) {
    ++histograms_[static_cast<int>(hit.object)].counts[map_.bin[map_.index(hit.u, hit.v)]];
  }
  for (const ObjectClass object : kDetected) {
    Histogram& histogram = histograms_[static_cast<int>(object)];
    histogram.threshold = adaptive_threshold(histogram.counts, options_.threshold);
  }
}

bool Scanner::find_object(ObjectClass object, Bearing& bearing, const ImageView& image) {
  const bool ball = object == ObjectClass::ball;
  const double gap_deg = ball ? options_.ball_gap_deg : options_.goal_gap_deg;
  find_segments(histogram(object), static_cast<int>(std::lround(gap_deg / 360.0 * options_.bins)), segments_);
  const auto largest = std::max_element(segments_.begin(), segments_.end(),
                                        [](const Segment& a, const Segment& b) { return a.pixels < b.pixels; });
  if (largest == segments_.end() || largest->pixels < static_cast<std::uint64_t>(options_.min_object_pixels)) {
    return false;
  }
  // One bin more on either side: the object's border pixels may lie in bins below the threshold.
  std::fill(selected_.begin(), selected_.end(), std::uint8_t{0});
  for (int i = -1; i <= largest->length; ++i) {
    selected_[(largest->first + i + options_.bins) % options_.bins] = 1;
  }
  const bool found = ball ? refine_ball(image, map_, hits_, selected_, options_.refine, scratch_, bearing)
                          : refine_goal(image, map_, hits_, selected_, largest->first, largest->length, options_.refine,
                                        scratch_, bearing);
  if (found) flag_sensors(bearing);
  return found;
}

// A ball is disturbed by a sensor unit anywhere before it, a goal by one before its edges.
void Scanner::flag_sensors(Bearing& bearing) const {
  const auto overlaps = [](const Sector& sector, double right, double left) {
    return turn(sector.azimuth + sector.half_width, right) < 0.0 &&
           turn(sector.azimuth - sector.half_width, left) > 0.0;
  };
  for (const Sector& sector : sensors_) {
    const bool hidden = bearing.object == ObjectClass::ball ? overlaps(sector, bearing.right, bearing.left)
                                                            : overlaps(sector, bearing.left, bearing.left) ||
                                                                  overlaps(sector, bearing.right, bearing.right);
    if (hidden) bearing.flags |= kNearSensor;
  }
}

}  // namespace movis::scan
