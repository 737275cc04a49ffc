// The scan of three 640×480 colour images against the same with OpenCV: remap to polar coordinates with precomputed
// fixed-point maps, cvtColor, one inRange a class, and the sum over radius. OpenCV's part ends with the histograms;
// ours is measured to the histograms and, with bearings, to the end. One thread each.
#include <benchmark/benchmark.h>

#include <array>
#include <opencv2/imgproc.hpp>

#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/grab/dataset_source.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/pipeline.h"
#include "movis/scan/classify.h"
#include "movis/scan/scanner.h"
#include "ratio_table.h"

namespace {

using namespace movis;

constexpr int kAzimuths = 720;

struct Scene {
  omni::Rig rig;
  std::optional<Field> field;
  grab::FrameSet images;
};

// The first set of a shipped data set.
Scene load(const char* name) {
  grab::DatasetSource source(grab::read_dataset(data_file(std::string("images/") + name)));
  Scene scene;
  scene.rig = source.dataset().rig;
  if (source.dataset().field_file) scene.field = read_field(*source.dataset().field_file);
  source.open();
  source.acquire(scene.images);
  return scene;
}

const Scene& field_scene() {
  static const Scene scene = load("field");
  return scene;
}

scan::Colours colours() {
  return scan::read_colours(data_file("colours/default.yaml"));
}

// OpenCV's way for one camera, with everything that can be precomputed.
class OpenCvScan {
 public:
  explicit OpenCvScan(const omni::Camera& camera) {
    // Radii from the body to the rim, one pixel apart, as the annulus has them.
    constexpr int kInner = 15;
    constexpr int kOuter = 226;
    cv::Mat map_x(kOuter - kInner, kAzimuths, CV_32FC1);
    cv::Mat map_y(kOuter - kInner, kAzimuths, CV_32FC1);
    for (int r = 0; r < map_x.rows; ++r) {
      for (int i = 0; i < kAzimuths; ++i) {
        const double azimuth = -kPi + (i + 0.5) * 2.0 * kPi / kAzimuths - camera.yaw;
        map_x.at<float>(r, i) = static_cast<float>(319.5 + (kInner + r) * std::cos(azimuth));
        map_y.at<float>(r, i) = static_cast<float>(239.5 + (kInner + r) * std::sin(azimuth));
      }
    }
    cv::convertMaps(map_x, map_y, fixed_xy_, fixed_fraction_, CV_16SC2);
  }

  void operator()(const cv::Mat& image) {
    cv::remap(image, polar_, fixed_xy_, fixed_fraction_, cv::INTER_LINEAR);
    cv::cvtColor(polar_, hsv_, cv::COLOR_BGR2HSV);
    // The default classes in OpenCV's hue of 0…180.
    const std::array<std::pair<cv::Scalar, cv::Scalar>, 3> classes{
        {{{2, 64, 64}, {19, 255, 255}}, {{20, 64, 64}, {35, 255, 255}}, {{102, 51, 51}, {125, 255, 255}}}};
    for (std::size_t i = 0; i < classes.size(); ++i) {
      cv::inRange(hsv_, classes[i].first, classes[i].second, mask_);
      cv::reduce(mask_, histograms_[i], 0, cv::REDUCE_SUM, CV_32S);
    }
  }

  const cv::Mat& histogram(int i) const { return histograms_[i]; }

 private:
  cv::Mat fixed_xy_, fixed_fraction_, polar_, hsv_, mask_;
  std::array<cv::Mat, 3> histograms_;
};

void scan_opencv_remap(benchmark::State& state) {
  const Scene& scene = field_scene();
  std::vector<OpenCvScan> scanners;
  for (const omni::Camera& camera : scene.rig.cameras) scanners.emplace_back(camera);
  for (auto _ : state) {
    for (std::size_t i = 0; i < scanners.size(); ++i) scanners[i](scene.images.memory[i]);
    benchmark::DoNotOptimize(scanners[0].histogram(0).data);
  }
}
BENCHMARK(scan_opencv_remap)->Unit(benchmark::kMicrosecond);

// Classes and histograms: what OpenCV's part does.
void scan_histograms(benchmark::State& state) {
  const Scene& scene = field_scene();
  scan::Histograms histograms(kAzimuths);
  std::vector<scan::PolarMap> maps;
  std::vector<scan::Stretch> stretches;
  for (const omni::Camera& camera : scene.rig.cameras) {
    const scan::ScanOptions options;
    maps.push_back(scan::make_polar_map(camera, kAzimuths, radians(options.min_elevation_deg),
                                        radians(options.max_elevation_deg)));
    stretches.reserve(maps.back().scanned_pixels());
  }
  const std::vector<scan::IntegerClass> classes = scan::detected_classes(colours());
  for (auto _ : state) {
    for (std::size_t i = 0; i < maps.size(); ++i) {
      stretches.clear();
      scan::classify(scene.images.frames[i].view, maps[i].runs, classes, stretches);
      histograms.fill(maps[i], stretches);
      benchmark::DoNotOptimize(stretches.data());
    }
  }
}
BENCHMARK(scan_histograms)->Unit(benchmark::kMicrosecond);

// The whole scan, to bearings with covariance.
void scan_bearings(benchmark::State& state) {
  const Scene& scene = field_scene();
  std::vector<scan::Scanner> scanners;
  for (int i = 0; i < static_cast<int>(scene.rig.cameras.size()); ++i) {
    scanners.emplace_back(scene.rig, i, colours(), scan::ScanOptions{});
  }
  std::vector<Bearing> bearings;
  for (auto _ : state) {
    bearings.clear();
    for (std::size_t i = 0; i < scanners.size(); ++i) scanners[i].scan(scene.images.frames[i].view, 0.0, bearings);
    benchmark::DoNotOptimize(bearings.data());
  }
}
BENCHMARK(scan_bearings)->Unit(benchmark::kMicrosecond);

// Line points and what hides the floor.
void scan_floor(benchmark::State& state) {
  const Scene& scene = field_scene();
  std::vector<scan::Scanner> scanners;
  for (int i = 0; i < static_cast<int>(scene.rig.cameras.size()); ++i) {
    scanners.emplace_back(scene.rig, i, colours(), scan::ScanOptions{}, scene.field->line);
  }
  std::vector<LinePoint> lines;
  std::vector<ObstacleSight> obstacles;
  for (auto _ : state) {
    lines.clear();
    obstacles.clear();
    for (std::size_t i = 0; i < scanners.size(); ++i) {
      scanners[i].scan_floor(scene.images.frames[i].view, lines, obstacles);
    }
    benchmark::DoNotOptimize(lines.data());
  }
}
BENCHMARK(scan_floor)->Unit(benchmark::kMicrosecond);

// OpenCV's way to white on the floor: threshold of white in HSV beside carpet, thinned to the stretches' middles by a
// distance transform. It ends with a mask of middles to a pixel; ours has points finer than that, with sigma.
void floor_opencv(benchmark::State& state) {
  const Scene& scene = field_scene();
  cv::Mat hsv, carpet, white, beside, distance, widest, middles;
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {9, 9});
  for (auto _ : state) {
    for (const cv::Mat& image : scene.images.memory) {
      cv::cvtColor(image, hsv, cv::COLOR_BGR2HSV);
      cv::inRange(hsv, cv::Scalar(45, 40, 25), cv::Scalar(85, 255, 255), carpet);
      cv::inRange(hsv, cv::Scalar(0, 0, 120), cv::Scalar(180, 60, 255), white);
      cv::dilate(carpet, beside, kernel);
      cv::bitwise_and(white, beside, white);
      cv::distanceTransform(white, distance, cv::DIST_L2, 3);
      cv::dilate(distance, widest, cv::Mat());
      middles = (distance >= widest) & white;
      benchmark::DoNotOptimize(middles.data);
    }
  }
}
BENCHMARK(floor_opencv)->Unit(benchmark::kMicrosecond);

void tick(benchmark::State& state, const char* name) {
  const Scene scene = load(name);
  pipeline::Pipeline pipeline(scene.rig, scene.field, colours(), {}, localization::find_localizer("composed"));
  for (auto _ : state) benchmark::DoNotOptimize(step(pipeline, scene.images).tick_us);
}
BENCHMARK_CAPTURE(tick, open, "open")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(tick, near, "near")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(tick, field, "field")->Unit(benchmark::kMicrosecond);

// The limit: the bytes of the annuli, read once.
void read_annuli(benchmark::State& state) {
  const Scene& scene = field_scene();
  const scan::ScanOptions options;
  const scan::PolarMap map = scan::make_polar_map(scene.rig.cameras[0], kAzimuths, radians(options.min_elevation_deg),
                                                  radians(options.max_elevation_deg));
  for (auto _ : state) {
    std::uint64_t sum = 0;
    for (const grab::Frame& frame : scene.images.frames) {
      for (const scan::Run& run : map.runs) {
        const std::uint8_t* row = frame.view.row(run.row);
        for (int i = 3 * run.begin; i + 8 <= 3 * run.end; i += 8) {
          std::uint64_t eight = 0;
          std::memcpy(&eight, row + i, sizeof eight);
          sum += eight;
        }
      }
    }
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(read_annuli)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return movis::bench::run_and_compare(argc, argv,
                                       {{"scan_histograms", "scan_opencv_remap"},
                                        {"scan_bearings", "scan_opencv_remap"},
                                        {"scan_floor", "floor_opencv"}});
}
