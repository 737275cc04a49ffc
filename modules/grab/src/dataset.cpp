#include "movis/grab/dataset.h"

#include <map>

#include "movis/core/csv.h"
#include "movis/core/error.h"

namespace movis::grab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFramesFile = "frames.csv";

bool is_file(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

void check_folder(const fs::path& folder, bool needs_rig) {
  std::error_code ignored;
  const auto fail = [&](const char* what) {
    throw Error(
        "{}: {}. A data set is a folder with rig.yaml, frames.csv (columns frame, time_s and one of image paths for "
        "each camera of the rig) and the images",
        folder.string(), what);
  };
  if (!fs::exists(folder, ignored)) fail("does not exist");
  if (!fs::is_directory(folder, ignored)) fail("is not a folder");
  if (!is_file(folder / kFramesFile)) fail("is not a data set: frames.csv is missing");
  if (needs_rig && !is_file(folder / "rig.yaml")) fail("is not a data set: rig.yaml is missing");
}

std::string camera_names(const omni::Rig& rig) {
  std::string names;
  for (const omni::Camera& camera : rig.cameras) names += (names.empty() ? "" : ", ") + camera.name;
  return names;
}

// Where the parts of a frame stand in frames.csv.
struct Columns {
  struct OfCamera {
    std::size_t file;
    std::optional<std::size_t> time;
  };
  std::size_t frame;
  std::size_t time;
  std::vector<OfCamera> cameras;
};

Columns find_columns(const CsvTable& table, const Dataset& dataset) {
  Columns columns{table.column("frame"), table.column("time_s"), {}};
  std::vector<bool> known(table.header().size(), false);
  known[columns.frame] = known[columns.time] = true;
  for (const omni::Camera& camera : dataset.rig.cameras) {
    const auto file = table.find_column(camera.name);
    if (!file) {
      throw Error("{}:1: the column '{}' is missing: {} has the cameras {}. Add it, or name the rig of these images",
                  table.file().string(), camera.name, dataset.rig_file.string(), camera_names(dataset.rig));
    }
    const auto time = table.find_column(camera.name + "_time_s");
    known[*file] = true;
    if (time) known[*time] = true;
    columns.cameras.push_back({*file, time});
  }
  for (std::size_t column = 0; column < known.size(); ++column) {
    if (known[column]) continue;
    throw Error(
        "{}:1: unknown column '{}': {} has the cameras {}. Correct or remove it, or name the rig of these images",
        table.file().string(), table.header()[column], dataset.rig_file.string(), camera_names(dataset.rig));
  }
  return columns;
}

DatasetFrame read_frame(const CsvTable& table, std::size_t row, const Columns& columns, const Dataset& dataset) {
  DatasetFrame frame;
  frame.line = table.line(row);
  frame.index = table.integer(row, columns.frame);
  frame.time_s = table.number(row, columns.time);
  for (std::size_t k = 0; k < columns.cameras.size(); ++k) {
    const auto [file_column, time_column] = columns.cameras[k];
    DatasetImage image{table.text(row, file_column), frame.time_s};
    if (image.file.is_absolute()) {
      throw Error("{}: '{}' is an absolute path; paths are relative to the folder of the data set",
                  where(dataset, frame, k), image.file.string());
    }
    const bool lost = image.file.empty();
    if (!lost) image.file = dataset.folder / image.file;
    if (time_column && !(lost && table.text(row, *time_column).empty())) {
      image.time_s = table.number(row, *time_column);
    }
    frame.images.push_back(std::move(image));
  }
  return frame;
}

}  // namespace

Dataset read_dataset(const fs::path& folder, const std::optional<fs::path>& rig_override) {
  check_folder(folder, !rig_override);
  Dataset dataset;
  dataset.folder = folder;
  dataset.rig_file = rig_override.value_or(folder / "rig.yaml");
  dataset.rig = omni::read_rig(dataset.rig_file);
  if (is_file(folder / "field.yaml")) dataset.field_file = folder / "field.yaml";

  const CsvTable table = CsvTable::read(folder / kFramesFile);
  const Columns columns = find_columns(table, dataset);
  std::map<std::int64_t, int> lines;  // by frame number
  for (std::size_t row = 0; row < table.rows(); ++row) {
    dataset.frames.push_back(read_frame(table, row, columns, dataset));
    const DatasetFrame& frame = dataset.frames.back();
    const auto [first, is_new] = lines.emplace(frame.index, frame.line);
    if (!is_new) {
      throw Error("{}:{}: column 'frame': {} is the number of line {} already; every frame needs its own",
                  table.file().string(), frame.line, frame.index, first->second);
    }
  }
  if (dataset.frames.empty()) {
    throw Error("{}: has a header but no frame; record some, or name another data set", table.file().string());
  }
  return dataset;
}

void check_images(const Dataset& dataset) {
  for (const DatasetFrame& frame : dataset.frames) {
    for (std::size_t k = 0; k < frame.images.size(); ++k) {
      const fs::path& file = frame.images[k].file;
      if (file.empty() || is_file(file)) continue;
      throw Error("{}: there is no image file '{}'; correct the path, or leave the cell empty if the image is lost",
                  where(dataset, frame, k), file.string());
    }
  }
}

std::string where(const Dataset& dataset, const DatasetFrame& frame, std::size_t camera) {
  return fmt::format("{}:{}: column '{}'", (dataset.folder / kFramesFile).string(), frame.line,
                     dataset.rig.cameras[camera].name);
}

}  // namespace movis::grab
