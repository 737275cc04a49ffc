// How to measure a rig that somebody built: how many balls, where, and how exactly.
//
// Scenario: three cameras were built after the drawing data/rigs/movis.yaml; nothing is quite where the drawing has it.
// A ball is laid on marks whose places somebody measured, and the rig is calibrated from what the cameras see of it.
// Then the ball lies elsewhere, and the calibrated rig measures it. Only the renderer knows the rig as it was built.
//
//   δ        by how much a camera differs from its drawing: movis/omni/deviation.h. A calibration finds it and tells
//            what sigma is left: movis/calibration/rig_calibration.h has the equations
//   place i  at azimuth 2π·frac(0.7549 i) and a distance that goes with frac(0.5698 i): however many follow each other,
//            they are spread evenly (M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018)
//   tape     sigma of a written place, x and y each, metres; the calibration is told it
//   m error    of a ball's place on the floor: mean over all rigs and over 20 places 0.5 to 4.5 m away
#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageDraw.h>

#include "common.h"
#include "movis/calibration/rig_calibration.h"
#include "movis/sim/renderer.h"
#include "movis/triangulation/joint.h"

using namespace movis;
using Eigen::Vector3d;
using Images = std::vector<grab::FrameSet>;
constexpr std::array<double, 3> kTapes{0.0, 0.002, 0.005};
constexpr int kNear = 8, kMarks = 48, kAll = kMarks + 20;  // places: marks, the near ones first, then others

struct Choice {  // a row of the table: the first marks that are so
  const char* name;
  std::size_t first, count;
  bool (*so)(const Vector3d& mark) = [](const Vector3d&) { return true; };
};
const std::vector<Choice> kChoices{{"8, 1 to 4 m", kNear, 8},
                                   {"16", kNear, 16},
                                   {"16 in front", kNear, 16, [](const Vector3d& mark) { return mark.y() > 0.0; }},
                                   {"16, 1 to 2 m", kNear, 16, [](const Vector3d& mark) { return mark.norm() < 2.0; }},
                                   {"16 and 8 near", 0, 24},
                                   {"40", kNear, 40}};

struct Study {
  double drawing = 0.0, built = 0.0;  // where the drawing is believed; where the rig is known
  std::array<std::array<double, kTapes.size()>, 6> calibrated{};  // mean errors by choice and tape
  std::array<calibration::RigCalibration, kTapes.size()> shown;   // of the last rig and choice
  omni::Deviation truth;                                          // of its last camera
};

Vector3d place(int i) {
  const double azimuth = 2.0 * kPi * 0.7549 * i, share = std::fmod(0.5698 * i, 1.0);
  const double distance = i < kNear ? 0.5 : i < kMarks ? 1.0 + 3.0 * share : 0.5 + 4.0 * share;
  return {distance * std::cos(azimuth), distance * std::sin(azimuth), sim::kBallRadius};
}

calibration::Sightings see(const omni::Rig& believed, const Images& images, int first, int last) {
  calibration::SightingScanner scanner(believed, scan::read_colours(data_file("colours/default.yaml")), {});
  calibration::Sightings seen{believed, {}};
  for (int i = first; i < last; ++i) seen.frames.push_back(scanner.scan(images[i]));
  return seen;
}

void add_error(const omni::Rig& believed, const Images& images, int rigs, double& mean) {
  const calibration::Sightings seen = see(believed, images, kMarks, kAll);
  triangulation::JointOptions options;
  options.contradiction_deg = 90.0;  // a point at any price: the drawing's cameras contradict each other
  for (int i = kMarks; i < kAll; ++i) {
    const auto& bearings = seen.frames[i - kMarks].bearings;
    const auto ball = triangulation::triangulate_joint(believed, bearings, ObjectClass::ball, options);
    if (ball.status != PointStatus::ok) throw Error("the ball at place {} is not measured: {}", i, word(ball.status));
    mean += (ball.point - place(i)).head<2>().norm() / (rigs * (kAll - kMarks));
  }
}

calibration::RigCalibration calibrate(const calibration::Sightings& marks, const Choice& choice, double tape,
                                      int seed) {
  RandomStream random = make_stream(seed, 2);
  std::normal_distribution<double> normal;
  calibration::Sightings written{marks.rig, {}};
  for (auto i = static_cast<int>(choice.first); i < kMarks && written.frames.size() < choice.count; ++i) {
    const Vector3d slip(normal(random), normal(random), 0.0), mark = place(i);
    if (!choice.so(mark)) continue;
    written.frames.push_back(marks.frames[i]);
    written.frames.back().ball_in_robot = mark + tape * slip;
  }
  calibration::RigOptions options;
  options.place_sigma = tape;
  return calibration::calibrate_rig(marks.rig, written, options);
}

void study_rig(const omni::Rig& drawing, int seed, int rigs, Study& study) {
  RandomStream random = make_stream(seed, 1);
  std::normal_distribution<double> normal;
  omni::Rig built = drawing;
  for (omni::Camera& camera : built.cameras) {
    for (int i = 0; i < omni::kDeviations; ++i) study.truth[i] = omni::individual_differences()[i] * normal(random);
    camera = omni::deviated(camera, study.truth);
  }
  sim::Renderer renderer(built, {}, control::read_robot(data_file("robots/miniature.yaml")),
                         sim::read_look(data_file("looks/hall.yaml")));
  Images images(kAll);
  for (int i = 0; i < kAll; ++i) renderer.render({0.0, {}, place(i)}, 1000 * seed + i, images[i]);
  const calibration::Sightings marks = see(drawing, images, 0, kMarks);
  add_error(drawing, images, rigs, study.drawing);
  add_error(built, images, rigs, study.built);
  for (std::size_t i = 0; i < kChoices.size() * kTapes.size(); ++i) {
    const std::size_t c = i / kTapes.size(), k = i % kTapes.size();
    study.shown[k] = calibrate(marks, kChoices[c], kTapes[k], seed);
    add_error(study.shown[k].rig, images, rigs, study.calibrated[c][k]);
  }
}

// Prints the errors and δ, and draws the errors as bars, 100 pixels a centimetre.
void show(const Study& study, const std::string& out) {
  vpImage<vpRGBa> chart(270, 590, vpRGBa(255, 255, 255));
  fmt::print("error, cm; tape:     exact       2 mm       5 mm\n");
  for (int c = 0; c < static_cast<int>(kChoices.size()); ++c) {
    fmt::print("{:15}", kChoices[c].name);
    vpFont(13).drawText(chart, kChoices[c].name, vpImagePoint(252, 12.0 + 94.0 * c), vpColor::black);
    for (int k = 0; k < static_cast<int>(kTapes.size()); ++k) {
      const double cm = 100.0 * study.calibrated[c][k], height = 100.0 * cm;
      const vpRect bar(12.0 + 94.0 * c + 25.0 * k, 245.0 - height, 22.0, height);
      vpImageDraw::drawRectangle(chart, bar, std::array{vpColor::green, vpColor::blue, vpColor::red}[k], true);
      fmt::print("{:11.2f}{}", cm, k < 2 ? "" : "\n");
    }
  }
  fmt::print("by the drawing {:.0f}, by the true rig {:.2f}\n", 100.0 * study.drawing, 100.0 * study.built);
  fmt::print("δ by {} marks   true        exact              2 mm               5 mm\n", kChoices.back().count);
  for (int i = 0; i < omni::kDeviations; ++i) {
    const double unit = i < 3 ? 1e3 : i < 6 ? degrees(1.0) : i == 6 ? 1e2 : 1.0;  // mm, °, %, px
    fmt::print("{:7}{:12.3f}", omni::kDeviationNames[i], unit * study.truth[i]);
    for (const auto& found : study.shown) {
      fmt::print("{:10.3f} ± {:5.3f}", unit * found.deviation.back()[i], unit * found.sigma.back()[i]);
      fmt::print("{}", found.determined(2, i) ? ' ' : '*');
    }
    fmt::print("\n");
  }
  tutorial::write_picture(chart, out);
}

int main(int argc, char** argv) {
  CLI::App arguments("Calibrates rigs from balls at marks and measures by them", "tutorial-measure-your-rig");
  int rigs = 1;
  std::string out = "tutorial-measure-your-rig.png";
  arguments.add_option("--rigs", rigs, "How many rigs")->capture_default_str()->check(CLI::Range(1, 1000));
  arguments.add_option("--out", out, "The picture")->capture_default_str();
  return tutorial::run(arguments, argc, argv, [&] {
    Study study;
    const omni::Rig drawing = omni::read_rig(data_file("rigs/movis.yaml"));
    for (int seed = 1; seed <= rigs; ++seed) study_rig(drawing, seed, rigs, study);
    show(study, out);
    return study.calibrated.back()[0] < 1.5 * study.built && study.calibrated.back()[2] < 0.1 * study.drawing;
  });
}
