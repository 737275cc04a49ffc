#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "drawn_rig.h"
#include "eyes.h"
#include "movis/calibration/sightings.h"
#include "movis/experiments/measurement.h"
#include "movis/triangulation/correction.h"

namespace movis::experiments {

// One rig of one draw on the bench: its true cameras, and what is known of them.
class MeasurementBench {
 public:
  MeasurementBench(const MeasurementSettings& settings, std::uint64_t seed, const MeasurementBlock& block);

  const Lattice& lattice() const { return lattice_; }

  // The rows of one point of the lattice, appended.
  void measure(int point, std::vector<MeasurementRow>& rows);

 private:
  struct Belief {
    Knowledge knowledge;
    int eyes;  // number of the believed rig
    omni::Rig rig;
    std::optional<triangulation::Correction> correction;
    bool known = true;  // else nothing could be fitted
  };
  void believe_nominal();
  calibration::Sightings sightings_by(int believed, const omni::Rig& rig);
  Belief corrected(const calibration::Sightings& sightings) const;
  Belief calibrated(const calibration::Sightings& sightings);

  const MeasurementSettings& settings_;
  RigDraw draw_;
  MeasurementBlock block_;
  Lattice lattice_;
  omni::Rig nominal_;
  std::unique_ptr<Eyes> eyes_;
  std::vector<Belief> beliefs_;
  std::vector<Bearing> bearings_;
};

// Of a block: which knowledges, and which systems are of its rig.
std::vector<Knowledge> knowledges_of(Differences differences);
std::vector<int> systems_of(RigIndex rig);

}  // namespace movis::experiments
