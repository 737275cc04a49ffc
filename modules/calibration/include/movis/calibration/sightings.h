#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/grab/dataset.h"
#include "movis/grab/image_source.h"
#include "movis/grab/truth.h"
#include "movis/omni/rig.h"
#include "movis/scan/scanner.h"

namespace movis::calibration {

// What the cameras saw in one frame of a calibration, and where the ball stood, where that is known.
struct Sighting {
  std::int64_t frame = 0;
  std::vector<Bearing> bearings;
  std::optional<Eigen::Vector3d> ball_in_robot;  // of its centre, metres
};

// Bearings are angles in the robot's axes by the rig that was believed when they were scanned; with it they can be
// turned back into pixels.
struct Sightings {
  omni::Rig rig;
  std::vector<Sighting> frames;
};

// The known places of a data set's balls, by frame: here they are what somebody measured out for the calibration.
using KnownPlaces = std::map<std::int64_t, Eigen::Vector3d>;  // robot frame, metres

// Of `file`, which errors name. Throws an Error where a ball's centre is below 2 cm, or farther than 30 m away.
KnownPlaces known_places(const std::map<std::int64_t, grab::Truth>& truth, const std::filesystem::path& file);

// One scanner for each camera of a rig that is believed.
class SightingScanner {
 public:
  SightingScanner(const omni::Rig& rig, const scan::Colours& colours, const scan::ScanOptions& options);

  // What is seen in a set of images; its place is unknown. Throws an Error where the images do not fit the rig.
  Sighting scan(const grab::FrameSet& images);

 private:
  std::vector<scan::Scanner> scanners_;  // one a camera
};

// All sets of a data set, seen through the rig that is believed; `rig` takes the place of the data set's own.
// `after_each` is called after every set: for progress, and to end the work by an exception. Throws an Error where an
// image cannot be read, and where `places` has none of the frames.
Sightings collect_sightings(const grab::Dataset& dataset, const omni::Rig& rig, const scan::Colours& colours,
                            const scan::ScanOptions& options, const KnownPlaces& places,
                            const std::function<void()>& after_each = {});

}  // namespace movis::calibration
