// Copies a data set with blur, noise and other light added to its images:
//   degrade-dataset DIR OUT [BLUR_PX NOISE_LEVELS SEED [RED_GAIN GREEN_GAIN BLUE_GAIN]]
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "movis/grab/dataset.h"
#include "support/degrade.h"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  if (argc != 3 && argc != 6 && argc != 9) {
    std::fprintf(stderr, "usage: %s DIR OUT [BLUR_PX NOISE_LEVELS SEED [RED_GAIN GREEN_GAIN BLUE_GAIN]]\n", argv[0]);
    return 2;
  }
  try {
    const fs::path from = argv[1];
    const fs::path to = argv[2];
    movis::test::Degradation degradation;
    std::uint64_t seed = 1;
    if (argc >= 6) {
      degradation.blur_px = std::atof(argv[3]);
      degradation.noise_levels = std::atof(argv[4]);
      seed = std::strtoull(argv[5], nullptr, 10);
    }
    if (argc == 9) degradation.gains = {std::atof(argv[6]), std::atof(argv[7]), std::atof(argv[8])};
    const movis::grab::Dataset dataset = movis::grab::read_dataset(from);
    fs::create_directories(to);
    for (const char* name : {"rig.yaml", "field.yaml", "frames.csv", "truth.csv", "odometry.csv"}) {
      if (fs::exists(from / name)) fs::copy_file(from / name, to / name, fs::copy_options::overwrite_existing);
    }
    movis::RandomStream random = movis::make_stream(seed, 0);
    for (const auto& frame : dataset.frames) {
      for (const auto& image : frame.images) {
        if (image.file.empty()) continue;
        const fs::path copy = to / fs::relative(image.file, from);
        cv::Mat bgr = cv::imread(image.file.string());
        movis::test::degrade(bgr, degradation, random);
        fs::create_directories(copy.parent_path());
        cv::imwrite(copy.string(), bgr, {cv::IMWRITE_PNG_COMPRESSION, 1});
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "degrade-dataset: %s\n", error.what());
    return 1;
  }
  return 0;
}
