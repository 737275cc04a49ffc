#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "movis/omni/rig.h"

namespace movis::grab {

struct DatasetImage {
  std::filesystem::path file;  // empty: lost
  double time_s = 0.0;
};

// One row of frames.csv. The rows need not follow each other in time.
struct DatasetFrame {
  int line = 0;  // of frames.csv
  std::int64_t index = 0;
  double time_s = 0.0;
  std::vector<DatasetImage> images;  // in the rig's order
};

// A recorded data set: a folder with rig.yaml, frames.csv and the images; optionally field.yaml. Its truth is read
// apart from it (truth.h), so that no estimator comes upon it.
struct Dataset {
  std::filesystem::path folder;
  std::filesystem::path rig_file;
  omni::Rig rig;
  std::optional<std::filesystem::path> field_file;
  std::vector<DatasetFrame> frames;  // at least one, in the order of the file
};

// Reads the tables of a data set, not its images.
//
// frames.csv has the columns frame (a whole number of its own for each row), time_s (seconds) and, for each camera of
// the rig, one of its name with the path of its image and perhaps NAME_time_s with the time of that image, where the
// row's does not hold. Columns stand in any order; any other is refused. Paths are relative to the folder and may
// leave it by `..`; an absolute one is refused, because the folder could not be moved. An empty cell is a lost image,
// whose time may be empty too. Every Error names file, line and column.
//
// `rig_override` is read instead of the folder's rig.yaml; its cameras must have the same names.
Dataset read_dataset(const std::filesystem::path& folder,
                     const std::optional<std::filesystem::path>& rig_override = std::nullopt);

// Throws an Error for the first image that is named but not there, so that this is known before any work is done.
void check_images(const Dataset& dataset);

// The cell of an image, for messages: "…/frames.csv:7: column 'M2'".
std::string where(const Dataset& dataset, const DatasetFrame& frame, std::size_t camera);

}  // namespace movis::grab
