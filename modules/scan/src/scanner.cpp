#include "movis/scan/scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::scan {
namespace {

constexpr ObjectClass kDetected[] = {ObjectClass::ball, ObjectClass::yellow_goal, ObjectClass::blue_goal};
constexpr std::size_t kMaxSegments = 64;
constexpr std::int16_t kElsewhere = std::numeric_limits<std::int16_t>::min();

}  // namespace

Scanner::Scanner(const omni::Rig& rig, int camera, const Colours& colours, const ScanOptions& options,
                 double line_width)
    : camera_(rig.cameras.at(camera)),
      camera_index_(camera),
      options_(options),
      map_(make_polar_map(camera_, options.bins, radians(options.min_elevation_deg),
                          radians(options.max_elevation_deg))),
      light_(map_, colours, options.light),
      classes_(detected_classes(colours)),
      sensors_(sensor_sectors(rig, camera, options.sensor_radius)),
      histograms_(options.bins),
      places_(options.bins),
      scratch_(camera_.width, camera_.height),
      floor_(camera_, camera, map_, colours, options.floor, line_width, sensors_) {
  stretches_.reserve(map_.scanned_pixels());
  segments_.reserve(kMaxSegments);
  object_.reserve(map_.scanned_pixels());
}

void Scanner::check(const ImageView& image) const {
  if (image.width != camera_.width || image.height != camera_.height) {
    throw Error("camera '{}': the image is {}×{}, the rig says {}×{}; use the rig file that belongs to these images",
                camera_.name, image.width, image.height, camera_.width, camera_.height);
  }
  if (channels(image.format) == 1) {
    throw Error("camera '{}': the image is {}, which has no colours to scan; convert it to BGR8, RGB8 or RGBA8",
                camera_.name, name(image.format));
  }
  if (camera_.format && image.format != *camera_.format) {
    throw Error("camera '{}': the image is {}, the rig says {}", camera_.name, name(image.format),
                name(*camera_.format));
  }
}

void Scanner::scan(const ImageView& image, double time_s, std::vector<Bearing>& bearings) {
  check(image);
  stretches_.clear();
  const ImageView adapted = light_.adapt(image);
  classify(adapted, map_.runs, classes_, stretches_);
  histograms_.fill(map_, stretches_, options_.threshold);
  for (const ObjectClass object : kDetected) {
    Bearing bearing;
    bearing.camera = camera_index_;
    bearing.object = object;
    bearing.time_s = time_s;
    if (find_object(object, bearing, adapted)) bearings.push_back(bearing);
  }
}

void Scanner::scan_floor(const ImageView& image, std::vector<LinePoint>& lines,
                         std::vector<ObstacleSight>& obstacles) {
  floor_.scan(light_.adapted(image), map_, lines, obstacles);
}

bool Scanner::find_object(ObjectClass object, Bearing& bearing, const ImageView& image) {
  const bool ball = object == ObjectClass::ball;
  const double gap_deg = ball ? options_.ball_gap_deg : options_.goal_gap_deg;
  find_segments(histograms_[object], static_cast<int>(std::lround(gap_deg / 360.0 * options_.bins)), segments_);
  const auto largest = std::max_element(segments_.begin(), segments_.end(),
                                        [](const Segment& a, const Segment& b) { return a.pixels < b.pixels; });
  if (largest == segments_.end() || largest->pixels < static_cast<std::uint64_t>(options_.min_object_pixels)) {
    return false;
  }
  collect_object(object, *largest);
  const bool found = ball ? refine_ball(image, map_, object_, options_.refine, scratch_, bearing)
                          : refine_goal(image, map_, object_, *largest, options_.refine, scratch_, bearing);
  if (found) flag_sensors(bearing);
  return found;
}

// Every pixel of a ball, and of a goal those near its edges and a few of the others: they tell its colour and height.
void Scanner::collect_object(ObjectClass object, const Segment& segment) {
  constexpr double kMarginDeg = 3.0;  // what refine_goal looks at
  constexpr int kOneIn = 16;
  const int margin =
      object == ObjectClass::ball ? segment.length : static_cast<int>(kMarginDeg / 360.0 * options_.bins);
  std::fill(places_.begin(), places_.end(), kElsewhere);
  // One bin more on either side: the object's border pixels may lie in bins below the threshold.
  for (int place = -1; place <= segment.length; ++place) {
    places_[(segment.first + place + options_.bins) % options_.bins] = static_cast<std::int16_t>(place);
  }
  object_.clear();
  for (const Stretch& stretch : stretches_) {
    if (stretch.object != object) continue;
    const std::size_t row = map_.index(0, stretch.row);
    const auto place_at = [&](int u) { return places_[map_.bin[row + u]]; };
    const auto inside = [&](int u) { return place_at(u) >= margin && place_at(u) < segment.length - margin; };
    const auto keep = [&](int u) {
      const std::int16_t place = place_at(u);
      if (place == kElsewhere) return;
      object_.push_back({static_cast<std::uint16_t>(u), stretch.row, place, map_.ray[row + u].z});
    };
    // The azimuth turns one way along a stretch: its inside is one piece.
    int first = stretch.begin;
    int last = stretch.end;
    for (; first < last && !inside(first); ++first) keep(first);
    while (last > first && !inside(last - 1)) --last;
    for (int u = first + kOneIn / 2; u < last; u += kOneIn) keep(u);
    for (int u = last; u < stretch.end; ++u) keep(u);
  }
}

// A ball is disturbed by a sensor unit anywhere before it, a goal by one before its edges.
void Scanner::flag_sensors(Bearing& bearing) const {
  const auto overlaps = [](const Sector& sector, double right, double left) {
    return turn(sector.azimuth + sector.half_width, right) < 0.0 &&
           turn(sector.azimuth - sector.half_width, left) > 0.0;
  };
  for (const Sector& sector : sensors_) {
    if (bearing.object == ObjectClass::ball) {
      if (overlaps(sector, bearing.right, bearing.left)) bearing.flags |= kNearSensor;
      continue;
    }
    if (overlaps(sector, bearing.left, bearing.left)) bearing.left_flags |= kNearSensor;
    if (overlaps(sector, bearing.right, bearing.right)) bearing.right_flags |= kNearSensor;
  }
  bearing.flags |= bearing.left_flags | bearing.right_flags;
}

}  // namespace movis::scan
