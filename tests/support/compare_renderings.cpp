// Pictures of the ray-traced sets beside ours of the same scenes, two pairs in a row:  compare-renderings POV_DIR
// OUT.jpg
#include <array>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "support/traced_set.h"

namespace {

namespace fs = std::filesystem;

struct Choice {
  const char* set;
  std::int64_t frame;
  std::size_t camera;
};
constexpr std::array<Choice, 4> kChoices{{{"open", 3, 1}, {"near", 12, 0}, {"field", 9, 2}, {"field-obstacles", 4, 1}}};

// The mirror, smaller.
cv::Mat cut_out(const cv::Mat& image) {
  const cv::Rect mirror(90, 10, 460, 460);
  cv::Mat smaller;
  cv::resize(image(mirror), smaller, {316, 316}, 0.0, 0.0, cv::INTER_AREA);
  return smaller;
}

cv::Mat pair_of(const fs::path& folder, const Choice& choice) {
  movis::test::TracedSet set(folder / choice.set);
  cv::Mat traced;
  for (const auto& frame : set.dataset().frames) {
    if (frame.index == choice.frame) traced = cv::imread(frame.images[choice.camera].file.string());
  }
  if (traced.empty()) throw std::runtime_error(std::string(choice.set) + ": no such frame");
  movis::grab::FrameSet ours;
  set.render(choice.frame, ours);
  cv::Mat pair;
  cv::hconcat(cut_out(traced), cut_out(ours.memory[choice.camera]), pair);
  return pair;
}

cv::Mat row_of(const fs::path& folder, const Choice& left, const Choice& right) {
  const cv::Mat first = pair_of(folder, left);
  const cv::Mat gap(first.rows, 1280 - 2 * first.cols, CV_8UC3, cv::Scalar::all(255));
  cv::Mat row;
  cv::hconcat(std::array<cv::Mat, 3>{first, gap, pair_of(folder, right)}, row);
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s POV_DIR OUT.jpg\n", argv[0]);
    return 2;
  }
  try {
    const fs::path folder = argv[1];
    const cv::Mat upper = row_of(folder, kChoices[0], kChoices[1]);
    const cv::Mat gap(16, upper.cols, CV_8UC3, cv::Scalar::all(255));
    cv::Mat page;
    cv::vconcat(std::array<cv::Mat, 3>{upper, gap, row_of(folder, kChoices[2], kChoices[3])}, page);
    if (!cv::imwrite(argv[2], page, {cv::IMWRITE_JPEG_QUALITY, 88}))
      throw std::runtime_error("cannot write the picture");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compare-renderings: %s\n", error.what());
    return 1;
  }
  return 0;
}
