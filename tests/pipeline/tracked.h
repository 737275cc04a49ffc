#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "movis/core/paths.h"
#include "movis/grab/dataset_source.h"
#include "movis/grab/truth.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/pipeline.h"

namespace movis::test {

inline pipeline::Pipeline make_pipeline(const grab::Dataset& dataset, const char* localizer = "composed") {
  std::optional<Field> field;
  if (dataset.field_file) field = read_field(*dataset.field_file);
  return {dataset.rig,
          field,
          scan::read_colours(data_file("colours/default.yaml")),
          {},
          localization::find_localizer(localizer)};
}

struct Tracked {
  pipeline::Estimate estimate;
  grab::Truth truth;
};

// Every set of a data set through the pipeline, the images changed by `change` first.
inline std::vector<Tracked> track(const std::filesystem::path& folder,
                                  const std::function<void(cv::Mat&)>& change = nullptr) {
  grab::DatasetSource source(grab::read_dataset(folder));
  const auto truth = grab::read_truth(folder / "truth.csv");
  pipeline::Pipeline pipeline = make_pipeline(source.dataset());
  std::vector<Tracked> tracked;
  source.open();
  for (grab::FrameSet images; source.acquire(images);) {
    if (change) {
      for (cv::Mat& image : images.memory) change(image);
    }
    tracked.push_back({step(pipeline, images), truth.at(images.index)});
  }
  return tracked;
}

}  // namespace movis::test
