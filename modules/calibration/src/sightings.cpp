#include "movis/calibration/sightings.h"

#include <algorithm>
#include <cmath>

#include "movis/core/error.h"
#include "movis/grab/dataset_source.h"

namespace movis::calibration {

KnownPlaces known_places(const std::map<std::int64_t, grab::Truth>& truth, const std::filesystem::path& file) {
  constexpr double kLowest = 0.02;    // metres; of a ball's centre: no ball is smaller
  constexpr double kFarthest = 30.0;  // metres; no camera sees a ball there
  KnownPlaces places;
  for (const auto& [frame, row] : truth) {
    const Eigen::Vector2d ball_in_field = row.ball_in_field.head<2>();
    const Eigen::Vector2d ball_in_robot = inverse(row.world_from_robot) * ball_in_field;
    if (!(row.ball_in_field.z() >= kLowest)) {
      throw Error("{}: frame {}: ball_z is {} m; it is the height of the ball's centre, on the floor its radius",
                  file.string(), frame, row.ball_in_field.z());
    }
    if (!(std::hypot(ball_in_robot.norm(), row.ball_in_field.z()) <= kFarthest)) {
      throw Error("{}: frame {}: the ball is {:.0f} m from the robot, farther than {:.0f} m; are these metres?",
                  file.string(), frame, ball_in_robot.norm(), kFarthest);
    }
    places[frame] = {ball_in_robot.x(), ball_in_robot.y(), row.ball_in_field.z()};
  }
  return places;
}

SightingScanner::SightingScanner(const omni::Rig& rig, const scan::Colours& colours, const scan::ScanOptions& options) {
  scanners_.reserve(rig.cameras.size());
  for (int camera = 0; camera < static_cast<int>(rig.cameras.size()); ++camera) {
    scanners_.emplace_back(rig, camera, colours, options);
  }
}

Sighting SightingScanner::scan(const grab::FrameSet& images) {
  if (images.frames.size() != scanners_.size()) {
    throw Error("a set of {} images came to a rig of {} cameras", images.frames.size(), scanners_.size());
  }
  Sighting sighting;
  sighting.frame = images.index;
  for (std::size_t camera = 0; camera < scanners_.size(); ++camera) {
    const grab::Frame& frame = images.frames[camera];
    if (!frame.lost()) scanners_[camera].scan(frame.view, frame.time_s, sighting.bearings);
  }
  return sighting;
}

Sightings collect_sightings(const grab::Dataset& dataset, const omni::Rig& rig, const scan::Colours& colours,
                            const scan::ScanOptions& options, const KnownPlaces& places,
                            const std::function<void()>& after_each) {
  const auto known = [&](const auto& frame) { return places.count(frame.index) > 0; };
  if (!places.empty() && std::none_of(dataset.frames.begin(), dataset.frames.end(), known)) {
    throw Error("{}: its truth.csv has none of the frames of frames.csv; is it of another recording?",
                dataset.folder.string());
  }
  SightingScanner scanner(rig, colours, options);
  grab::DatasetSource source(dataset);
  source.open();
  Sightings sightings{rig, {}};
  for (grab::FrameSet images; source.acquire(images);) {
    sightings.frames.push_back(scanner.scan(images));
    Sighting& sighting = sightings.frames.back();
    if (const auto place = places.find(sighting.frame); place != places.end()) sighting.ball_in_robot = place->second;
    if (after_each) after_each();
  }
  return sightings;
}

}  // namespace movis::calibration
