#include "outcome.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::calibration {
namespace {

constexpr double kLimit = 5.0;       // sigmas: a term beyond is wrong
constexpr double kWrongToo = 3.5;    // beside one that is wrong
constexpr double kMostSpread = 5.0;  // of residuals, as a factor, before they count as contradictions

bool is_ball(const Term& term) {
  return term.kind == TermKind::ball;
}

struct FrameTerms {
  std::vector<Term*> balls, edges, places;

  std::vector<Term*>& of(TermKind kind) {
    return kind == TermKind::ball ? balls : kind == TermKind::place ? places : edges;
  }
};

// By the last solution, which terms are used and which frames are not.
FrameVerdicts judge(Adjustment& adjustment, std::size_t frames) {
  std::array<double, 4> scale{};
  for (const TermKind kind : {TermKind::ball, TermKind::left_edge, TermKind::right_edge, TermKind::place}) {
    scale[static_cast<std::size_t>(kind)] = spread(adjustment, kind, kMostSpread);
  }
  const auto excess = [&](const Term& term) { return term.length() / scale[static_cast<std::size_t>(term.kind)]; };
  std::vector<FrameTerms> by_frame(frames);
  for (Term& term : adjustment.terms) {
    term.used = excess(term) <= kLimit;
    by_frame[term.frame].of(term.kind).push_back(&term);
  }
  FrameVerdicts verdicts{std::vector<bool>(frames), std::vector<bool>(frames)};
  const auto left_out = [](const Term* term) { return !term->used; };
  for (std::size_t i = 0; i < frames; ++i) {
    auto& [balls, edges, places] = by_frame[i];
    const auto wrong_too = std::count_if(balls.begin(), balls.end(), [&](auto* t) { return excess(*t) > kWrongToo; });
    const bool moved = std::any_of(places.begin(), places.end(), left_out);
    if (moved || (std::any_of(balls.begin(), balls.end(), left_out) && wrong_too >= 2)) {
      verdicts.ball[i] = true;
      for (Term* term : balls) term->used = false;
      for (Term* term : places) term->used = false;
    }
    constexpr std::ptrdiff_t kFewestEdges = 4;  // for the three numbers of a pose
    const auto wrong = std::count_if(edges.begin(), edges.end(), left_out);
    const auto all = static_cast<std::ptrdiff_t>(edges.size());
    if (2 * wrong > all || (wrong > 0 && all - wrong < kFewestEdges)) {
      verdicts.goals[i] = true;
      for (Term* term : edges) term->used = false;
    }
  }
  return verdicts;
}

std::vector<bool> uses(const Adjustment& adjustment) {
  std::vector<bool> used;
  for (const Term& term : adjustment.terms) used.push_back(term.used);
  return used;
}

double root_mean_square(double sum, int count) {
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

void summarize_residuals(const Adjustment& adjustment, RigCalibration& result) {
  double azimuth = 0.0, elevation = 0.0, edge = 0.0, place = 0.0;
  int balls = 0, edges = 0, places = 0;
  std::set<int> ball_frames, goal_frames;
  for (const Term& term : adjustment.terms) {
    if (!term.used) continue;
    const Eigen::Vector2d error = term.root * term.at_solution;
    if (is_ball(term)) {
      azimuth += error.x() * error.x();
      elevation += error.y() * error.y();
      ++balls;
      ball_frames.insert(term.frame);
    } else if (term.kind == TermKind::place) {
      place += error.squaredNorm();
      places += 2;
    } else {
      edge += error.x() * error.x();
      ++edges;
      goal_frames.insert(term.frame);
    }
  }
  result.azimuth_rms = root_mean_square(azimuth, balls);
  result.elevation_rms = root_mean_square(elevation, balls);
  result.edge_rms = root_mean_square(edge, edges);
  result.place_rms = root_mean_square(place, places);
  result.balls = static_cast<int>(ball_frames.size());
  result.goals = static_cast<int>(goal_frames.size());
}

void refuse_unbelievable(const RigCalibration& result, const omni::Rig& nominal) {
  constexpr double kBeyondBelief = 10.0;
  for (std::size_t k = 0; k < nominal.cameras.size(); ++k) {
    for (int i = 0; i < omni::kDeviations; ++i) {
      const double sigmas = std::abs(result.deviation[k][i]) / result.prior[i];
      if (sigmas < kBeyondBelief) continue;
      throw Error(
          "{} of camera {} would have to differ from the nominal rig by {:.0f} times what is expected of a build: do "
          "rig, places and frames belong together? A looser `prior` in the options allows larger differences",
          omni::kDeviationNames[i], nominal.cameras[k].name, sigmas);
    }
  }
}

}  // namespace

RigUnknowns add_rig_unknowns(Adjustment& adjustment, std::size_t cameras) {
  RigUnknowns unknowns;
  for (std::size_t k = 0; k < cameras; ++k) unknowns.cameras.push_back(adjustment.add_expected(omni::kDeviations));
  unknowns.elevation_bias = adjustment.add_expected(1);
  unknowns.edge_bias = adjustment.add_expected(1);
  return unknowns;
}

FrameVerdicts solve_without_outliers(Adjustment& adjustment, std::size_t frames) {
  constexpr int kMostRounds = 10;
  FrameVerdicts verdicts;
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<bool> before = uses(adjustment);
    verdicts = judge(adjustment, frames);
    if (round > 0 && uses(adjustment) == before) break;
    solve(adjustment, 0.0);
  }
  return verdicts;
}

std::vector<CameraVerdict> contradicting_cameras(const Adjustment& adjustment, const FrameVerdicts& verdicts,
                                                 const Sightings& sightings) {
  std::vector<CameraVerdict> cameras(sightings.rig.cameras.size());
  for (const Term& term : adjustment.terms) {
    if (term.kind == TermKind::place || (is_ball(term) ? verdicts.ball : verdicts.goals)[term.frame]) continue;
    CameraVerdict& verdict = cameras[term.camera];
    verdict.camera = term.camera;
    ++verdict.sightings;
    if (!term.used) verdict.left_out.push_back(sightings.frames[term.frame].frame);
  }
  const auto fine = [](const CameraVerdict& verdict) { return 3 * verdict.left_out.size() <= verdict.sightings; };
  cameras.erase(std::remove_if(cameras.begin(), cameras.end(), fine), cameras.end());
  std::sort(cameras.begin(), cameras.end(), [](const CameraVerdict& a, const CameraVerdict& b) {
    return a.left_out.size() * b.sightings > b.left_out.size() * a.sightings;
  });
  return cameras;
}

void throw_contradiction(const CameraVerdict& verdict, const omni::Rig& nominal) {
  throw Error(
      "camera {} contradicts the others in {} of its {} sightings, in frames {}; are its images its own and of the "
      "same instants?",
      nominal.cameras[verdict.camera].name, verdict.left_out.size(), verdict.sightings, listed(verdict.left_out));
}

RigCalibration outcome(const Adjustment& adjustment, const RigUnknowns& unknowns, const omni::Rig& nominal,
                       const RigOptions& options) {
  RigCalibration result;
  result.prior = options.prior;
  result.rig = nominal;
  const std::vector<Eigen::VectorXd> sigma = sigmas(adjustment);
  // Where residuals are larger than expected, so is what they leave.
  const double factor = std::max(1.0, unit_weight_error(adjustment));
  for (std::size_t k = 0; k < nominal.cameras.size(); ++k) {
    const omni::Deviation in_sigmas = adjustment.unknowns[unknowns.cameras[k]].value;
    result.deviation.push_back(options.prior.cwiseProduct(in_sigmas));
    result.sigma.push_back(factor * options.prior.cwiseProduct(omni::Deviation(sigma[unknowns.cameras[k]])));
    result.rig.cameras[k] = omni::deviated(nominal.cameras[k], result.deviation[k]);
  }
  const double bias_sigma = radians(options.elevation_bias_deg);
  result.elevation_bias = bias_sigma * adjustment.unknowns[unknowns.elevation_bias].value[0];
  result.elevation_bias_sigma = factor * bias_sigma * sigma[unknowns.elevation_bias][0];
  summarize_residuals(adjustment, result);
  refuse_unbelievable(result, nominal);
  return result;
}

std::string listed(const std::vector<std::int64_t>& frames) {
  constexpr std::size_t kMost = 12;
  const std::set<std::int64_t> different(frames.begin(), frames.end());
  std::string text;
  std::size_t count = 0;
  for (const std::int64_t frame : different) {
    if (count == kMost) break;
    text += fmt::format("{}{}", count++ == 0 ? "" : ", ", frame);
  }
  if (different.size() > kMost) text += fmt::format(" and {} more", different.size() - kMost);
  return text;
}

}  // namespace movis::calibration
