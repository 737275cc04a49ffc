// correction.yaml: what is written is read, and what is wrong is said.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "movis/triangulation/correction.h"
#include "movis_rig.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

// A correction of the paper's rig, of three orders.
class CorrectionFile : public testing::Test {
 protected:
  CorrectionFile() : rig_(paper_rig()) {
    const char* const names[] = {"M1", "it's M2", "M3: low"};
    for (int i = 0; i < 3; ++i) {
      rig_.cameras[i].name = names[i];
      rig_.cameras[i].tilt_x = 0.001 * i;
      CameraCorrection camera;
      camera.camera = names[i];
      camera.position = rig_.cameras[i].position;
      camera.yaw = rig_.cameras[i].yaw;
      camera.tilt_x = rig_.cameras[i].tilt_x;
      camera.tilt_y = rig_.cameras[i].tilt_y;
      camera.lens = lens_digest(rig_.cameras[i]);
      for (int k = 0; k < kAzimuthOrders[i + 1]; ++k) camera.azimuth.push_back(0.001 * (k + 1) * (i - 1.5));
      for (int k = 0; k < kElevationOrders[i + 2]; ++k) camera.elevation.push_back(-0.002 / (k + 3) * (i - 0.5));
      camera.azimuth_sigma = 1e-4 * (i + 1);
      camera.elevation_sigma = 2e-4 * (i + 1);
      camera.min_elevation = -0.4 - 0.01 * i;
      camera.max_elevation = -0.02 - 0.01 * i;
      correction_.cameras.push_back(camera);
    }
    write_correction(correction_, file_);
    std::ifstream stream(file_);
    text_.assign(std::istreambuf_iterator<char>(stream), {});
  }

  Correction read() const { return read_correction(file_, rig_); }

  void replace(const std::string& from, const std::string& to) {
    const auto at = text_.find(from);
    ASSERT_NE(at, std::string::npos) << from << "\n" << text_;
    text_.replace(at, from.size(), to);
    folder_.write("correction.yaml", text_);
  }

  omni::Rig rig_;
  Correction correction_;
  const test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "correction.yaml";
  std::string text_;
};

TEST_F(CorrectionFile, RoundTrip) {
  const Correction found = read();
  ASSERT_EQ(found.cameras.size(), 3U);
  constexpr double kClose = 1e-11;
  for (int i = 0; i < 3; ++i) {
    const CameraCorrection& a = correction_.cameras[i];
    const CameraCorrection& b = found.cameras[i];
    EXPECT_EQ(a.camera, b.camera);
    ASSERT_EQ(a.azimuth.size(), b.azimuth.size());
    ASSERT_EQ(a.elevation.size(), b.elevation.size());
    for (std::size_t k = 0; k < a.azimuth.size(); ++k) EXPECT_NEAR(a.azimuth[k], b.azimuth[k], kClose);
    for (std::size_t k = 0; k < a.elevation.size(); ++k) EXPECT_NEAR(a.elevation[k], b.elevation[k], kClose);
    EXPECT_NEAR(a.azimuth_sigma, b.azimuth_sigma, kClose);
    EXPECT_NEAR(a.elevation_sigma, b.elevation_sigma, kClose);
    EXPECT_NEAR(a.min_elevation, b.min_elevation, kClose);
    EXPECT_NEAR(a.max_elevation, b.max_elevation, kClose);
  }
}

TEST_F(CorrectionFile, CamerasInAnotherOrder) {
  std::swap(rig_.cameras[0], rig_.cameras[2]);
  const Correction found = read();
  EXPECT_EQ(found.cameras[0].camera, "M3: low");
  EXPECT_EQ(found.cameras[2].camera, "M1");
  EXPECT_NEAR(found.cameras[2].azimuth[0], correction_.cameras[0].azimuth[0], 1e-11);
}

TEST_F(CorrectionFile, UnknownKey) {
  replace("azimuth_sigma_deg", "azimut_sigma_deg");
  test::expect_error([&] { read(); }, {"correction.yaml:", "azimut_sigma_deg", "azimuth_sigma_deg"});
}

TEST_F(CorrectionFile, MissingKey) {
  replace("  elevation_sigma_deg: ", "  # ");
  test::expect_error([&] { read(); }, {"correction.yaml:", "'cameras[0].elevation_sigma_deg'", "missing"});
}

TEST_F(CorrectionFile, UnknownBasis) {
  replace("basis: harmonics", "basis: splines");
  test::expect_error([&] { read(); }, {"correction.yaml:", "basis", "splines", "harmonics"});
}

TEST_F(CorrectionFile, WrongNumberOfCoefficients) {
  replace("azimuth_deg: [", "azimuth_deg: [0, ");
  test::expect_error([&] { read(); }, {"azimuth_deg", "has 4 coefficients", "1, 3, 5, 7, 9"});
}

TEST_F(CorrectionFile, NotANumber) {
  replace("azimuth_deg: [", "azimuth_deg: [.nan, 0, ");
  test::expect_error([&] { read(); }, {"azimuth_deg", "out of range"});
}

TEST_F(CorrectionFile, ElevationsTheWrongWayRound) {
  replace("elevations_deg: [", "elevations_deg: [20, 10] # ");
  test::expect_error([&] { read(); }, {"elevations_deg", "from < to"});
}

TEST_F(CorrectionFile, MissingCamera) {
  correction_.cameras.pop_back();
  write_correction(correction_, file_);
  test::expect_error([&] { read(); }, {"correction.yaml", "no entry", "'M3: low'"});
}

TEST_F(CorrectionFile, CameraTwice) {
  correction_.cameras[1] = correction_.cameras[0];
  write_correction(correction_, file_);
  test::expect_error([&] { read(); }, {"cameras[1].name", "earlier camera"});
}

TEST_F(CorrectionFile, NamesOfAnotherRig) {
  rig_.cameras[0].name = "left";
  test::expect_error([&] { read(); }, {"correction.yaml:", "'M1'", "no camera of the rig", "left"});
}

TEST_F(CorrectionFile, RigThatItWasNotFittedWith) {
  rig_.cameras[1].yaw += radians(0.6);
  test::expect_error([&] { read(); }, {"cameras[1]", "another rig", "it's M2", "movis calibrate correction"});
}

TEST_F(CorrectionFile, RigWhoseCameraWasMoved) {
  rig_.cameras[2].position.x() += 0.002;
  test::expect_error([&] { read(); }, {"cameras[2]", "another rig"});
}

TEST_F(CorrectionFile, RigWithAnotherLens) {
  auto& lens = std::get<omni::Hyperboloid>(rig_.cameras[1].model);
  lens.fu = 500.0;
  test::expect_error([&] { read(); }, {"cameras[1].lens", "another lens", "it's M2"});
  lens.fu = std::get<omni::Hyperboloid>(rig_.cameras[0].model).fu;
  read();
  lens.u0 += 20.0;
  test::expect_error([&] { read(); }, {"cameras[1].lens", "another lens"});
}

TEST_F(CorrectionFile, CorrectsTooMuch) {
  correction_.cameras[0].azimuth = {radians(11.0)};
  test::expect_error([&] { write_correction(correction_, file_); }, {"correction.yaml", "not written", "M1", "11.0°"});
  EXPECT_EQ(read().cameras[0].azimuth.size(), 3U);  // the former file stands
  replace("azimuth_deg: [", "azimuth_deg: [11] # ");
  test::expect_error([&] { read(); }, {"cameras[0]", "corrects by up to 11.0°"});
}

// 100.7° sin e is at most 9.1° down to e = −0.09.
TEST_F(CorrectionFile, LargeCoefficientsThatDoLittleAreReadBack) {
  CameraCorrection& camera = correction_.cameras[0];
  camera.min_elevation = -0.09;
  camera.elevation = {0.0, 0.0, 0.0, radians(-100.7), 0.0, 0.0};
  write_correction(correction_, file_);
  EXPECT_NEAR(read().cameras[0].elevation[3], radians(-100.7), 1e-9);
}

TEST_F(CorrectionFile, ElevationsThatCannotBeReadAreNotWritten) {
  correction_.cameras[2].min_elevation = radians(-86.0);
  test::expect_error([&] { write_correction(correction_, file_); }, {"not written", "M3: low", "elevations_deg"});
}

TEST_F(CorrectionFile, NoSuchFile) {
  test::expect_error([&] { read_correction(folder_.path() / "none.yaml", rig_); }, {"none.yaml", "cannot be opened"});
}

}  // namespace
}  // namespace movis::triangulation
