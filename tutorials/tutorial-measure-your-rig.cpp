// How to measure a rig that somebody built: how many balls, how exactly, and where.
//
// Scenario: three cameras were built after the drawing data/rigs/movis.yaml, and no part is quite where the drawing has
// it. A ball is laid on marks whose places somebody took with a tape; from what the cameras see of it the rig is
// calibrated. Then the ball lies at other places over 8 m × 8 m, and the calibrated rig measures it. The renderer knows
// the rig as it was built; nothing that estimates does.
//
//   δ            by how much a camera differs from its drawing, nine numbers: movis/omni/deviation.h. Expected are 2 mm,
//                0.6°, 0.25°, 0.4 % and 1.5 px, one sigma each; so much the built rig is drawn with
//   mark i       at azimuth 2π·frac(g₁ i) and distance near·(far/near)^frac(g₂ i), g₁ = 0.7549, g₂ = 0.5698: the first N
//                of them are spread evenly, for every N (M. Roberts, The Unreasonable Effectiveness of Quasirandom
//                Sequences, 2018), over all directions and over the logarithm of the distance
//   tape         sigma of what x and of what y of a mark's written place are off by, each mark by itself, metres
//   error        distance of the measured ball from the true one, mean over all balls measured and all rigs
//   sigma        what is left of a δ's uncertainty, as the calibration states it; where that is more than 0.7 of what
//                was expected, the data say nothing of it: it is not determined
//
// Source: the calibration's equations stand in movis/calibration/rig_calibration.h.

#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageDraw.h>

#include "common.h"
#include "movis/calibration/rig_calibration.h"
#include "movis/sim/renderer.h"
#include "movis/triangulation/joint.h"

using namespace movis;
using Places = std::vector<Eigen::Vector3d>;  // robot frame
using Images = std::vector<std::shared_ptr<grab::FrameSet>>;

constexpr double kNear = 0.45, kFar = 4.0;  // of marks, metres from the robot's centre
constexpr std::array<int, 5> kCounts{8, 12, 16, 24, 40};
constexpr std::array<double, 3> kTapes{0.0, 0.005, 0.010};
constexpr int kTests = 20;

Places marks() {
  Places places;
  for (int i = 1; i <= kCounts.back(); ++i) {
    const double azimuth = 2.0 * kPi * std::fmod(0.7549 * i, 1.0);
    const double distance = kNear * std::pow(kFar / kNear, std::fmod(0.5698 * i, 1.0));
    places.emplace_back(distance * std::cos(azimuth), distance * std::sin(azimuth), sim::kBallRadius);
  }
  return places;
}

Places anywhere(int count, RandomStream& random) {
  std::uniform_real_distribution<double> along(-4.0, 4.0);
  Places places;
  while (static_cast<int>(places.size()) < count) {
    const Eigen::Vector3d place(along(random), along(random), sim::kBallRadius);
    if (place.head<2>().norm() > kNear) places.push_back(place);
  }
  return places;
}

calibration::Sightings sightings(const omni::Rig& believed, const Images& images, const Places& places) {
  calibration::SightingScanner scanner(believed, scan::read_colours(data_file("colours/default.yaml")), {});
  calibration::Sightings result{believed, {}};
  for (std::size_t i = 0; i < images.size(); ++i) {
    result.frames.push_back(scanner.scan(*images[i]));
    result.frames.back().ball_in_robot = places[i];
  }
  return result;
}

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  auto t0 = Clock::now();
  auto lap = [&](const char* s) { auto t = Clock::now(); fprintf(stderr, "  [%s %.2f s]\n", s, std::chrono::duration<double>(t - t0).count()); t0 = Clock::now(); };
  const omni::Rig nominal = omni::read_rig(data_file("rigs/movis.yaml"));
  int seed = argc > 1 ? atoi(argv[1]) : 1;
    RandomStream random = make_stream(seed, 1);
    const omni::Rig built = omni::draw_rig(nominal, omni::individual_differences(), random);
    Places cal = marks(), test = anywhere(kTests, random);
    sim::Renderer renderer(built, {}, control::read_robot(data_file("robots/miniature.yaml")), sim::read_look(data_file("looks/hall.yaml")));
    lap("construct");
    Images ci(cal.size()), ti(test.size());
    for (auto& p : ci) p = std::make_shared<grab::FrameSet>(); for (auto& p : ti) p = std::make_shared<grab::FrameSet>();
    for (size_t i = 0; i < cal.size(); ++i) { renderer.render({0.0, {}, cal[i]}, seed*1000 + i, *ci[i]); ci[i]->index = i; }
    for (size_t i = 0; i < test.size(); ++i) { renderer.render({0.0, {}, test[i]}, seed*1000 + 500+ i, *ti[i]); ti[i]->index = i; }
    lap("render");
    auto err = [&](const omni::Rig& r, double* worst=nullptr) {
      auto s = sightings(r, ti, test); double sum = 0; int n = 0; double w=0; int miss=0;
      for (auto& f : s.frames) { auto b = triangulation::triangulate_joint(r, f.bearings, ObjectClass::ball); if (b.status != PointStatus::ok) {miss++; continue;} double e=(b.point - *f.ball_in_robot).head<2>().norm(); w=std::max(w,e); sum += e; ++n; }
      fmt::print("[{:5.2f} w {:5.2f} m {}]", 100*sum / n, 100*w, miss); return sum/n; };
    err(nominal); err(built); fmt::print("\n"); lap("two err");
    const Places offp = [&]{ Places p = cal; for (auto& q : p) { double c=std::cos(radians(0.5)), s=std::sin(radians(0.5)); q = Eigen::Vector3d(c*q.x()-s*q.y()+0.005, s*q.x()+c*q.y(), q.z()); } return p; }();
    auto sel = [&](auto pred, int most) { std::vector<size_t> v; for (size_t i = 0; i < cal.size() && (int)v.size() < most; ++i) if (pred(cal[i])) v.push_back(i); return v; };
    auto cali = [&](const std::vector<size_t>& idx, double tape, const Places& written, calibration::RigOptions o = {}) {
      Images im; Places pl; RandomStream r2 = make_stream(seed, 2); std::normal_distribution<double> g;
      Places noisy = written; for (auto& p : noisy) { p.x() += tape*g(r2); p.y() += tape*g(r2); }
      for (auto i : idx) { im.push_back(ci[i]); pl.push_back(noisy[i]); }
      auto first = calibration::calibrate_rig(nominal, sightings(nominal, im, pl), o).rig;
      return calibration::calibrate_rig(nominal, sightings(first, im, pl), o); };
    auto all = [](const Eigen::Vector3d&) { return true; };
    for (int n : kCounts) { fmt::print("{:3} ", n); for (double t : kTapes) { try { auto c = cali(sel(all, n), t, cal); err(c.rig); fmt::print(" r{} ", c.rejected.size()); } catch (std::exception& e) { fmt::print("{} ", e.what()); } } fmt::print("\n"); lap("row"); }
    auto where = [&](const char* name, auto pred, int most, const Places& w) { auto v = sel(pred, most); fmt::print("{:20} {:3}", name, v.size()); for (double t : kTapes) { try { auto c = cali(v, t, w); err(c.rig); fmt::print(" r{} ", c.rejected.size()); } catch (std::exception& e) { fmt::print("{} ", e.what()); } } fmt::print("\n"); };
    where("all", all, 16, cal);
    where("front", [](auto& p) { return p.y() > 0; }, 16, cal);
    where("far>1.5", [](auto& p) { return p.norm() > 1.4; }, 16, cal);
    where("near<1.4", [](auto& p) { return p.norm() < 1.4; }, 16, cal);
    where("off", all, 16, offp);
    lap("where");
    setbuf(stdout, nullptr); for (double t : {0.0, 0.002}) try { auto c = cali(sel(all, 40), t, cal); for (int i = 0; i < 9; ++i) { fmt::print("{:7}", omni::kDeviationNames[i]); for (int k = 0; k < 3; ++k) fmt::print(" {:9.5f} ± {:8.5f}", c.deviation[k][i], c.sigma[k][i]); fmt::print("  {:.5f}\n", c.prior[i]); } fmt::print("bias {:.3f}±{:.3f} rms {:.3f} {:.3f}\n", degrees(c.elevation_bias), degrees(c.elevation_bias_sigma), degrees(c.azimuth_rms), degrees(c.elevation_rms)); } catch (std::exception& e) { fmt::print("{} ", e.what()); }
    for (double fl : {0.05, 0.1, 0.2}) { calibration::RigOptions o; o.azimuth_floor_deg = fl; o.elevation_floor_deg = fl; for (double t : {0.005, 0.01}) { try { err(cali(sel(all, 40), t, cal, o).rig); } catch (std::exception& e) { fmt::print("{} ", e.what()); } } } fmt::print("\n");
}
