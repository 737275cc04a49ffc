#include "movis/control/command_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "movis/control/limits.h"
#include "movis/core/error.h"

namespace movis::control {
namespace {

constexpr std::size_t kRemembered = 32;  // commands, beside those that do not act yet
constexpr double kStep = 1e-3;           // seconds, while the velocity changes

}  // namespace

CommandHistory::CommandHistory(const RobotModel& robot)
    : robot_(robot), capacity_(kRemembered + static_cast<std::size_t>(robot.latency_frames)) {
  start(-std::numeric_limits<double>::infinity());
}

void CommandHistory::start(double time_s) {
  sent_.clear();
  sent_.reserve(capacity_);
  sent_.push_back({-std::numeric_limits<double>::infinity(), {}, {}});
  last_sent_s_ = time_s;
}

void CommandHistory::sent(const Command& command, double time_s) {
  if (!(time_s >= last_sent_s_)) {
    throw Error("a command of time {} s came after one of {} s; commands must be given in the order of time", time_s,
                last_sent_s_);
  }
  last_sent_s_ = time_s;
  const double acts_s = time_s + robot_.latency();
  const Sent sent{acts_s, velocity(acts_s), command.velocity};
  if (sent_.back().acts_s == acts_s) sent_.pop_back();  // replaced before it acted
  if (sent_.size() == capacity_) sent_.erase(sent_.begin());
  sent_.push_back(sent);
}

std::size_t CommandHistory::acting(double time_s) const {
  const auto later = std::upper_bound(sent_.begin(), sent_.end(), time_s,
                                      [](double time, const Sent& sent) { return time < sent.acts_s; });
  if (later == sent_.begin()) {
    throw Error("the commands of time {} s are forgotten; the oldest that is known acts from {} s on", time_s,
                sent_.front().acts_s);
  }
  return static_cast<std::size_t>(later - sent_.begin()) - 1;
}

Twist2 CommandHistory::velocity(const Sent& sent, double time_s) const {
  return limited(sent.wanted, sent.initial, robot_, time_s - sent.acts_s);
}

Twist2 CommandHistory::velocity(double time_s) const {
  return velocity(sent_[acting(time_s)], time_s);
}

// While the velocity changes, each short step is taken at the velocity of its middle; from then on in one step.
Pose2 CommandHistory::motion(const Sent& sent, double from_s, double to_s) const {
  const double settled_s = std::clamp(sent.acts_s + settling_time(sent.wanted, sent.initial, robot_), from_s, to_s);
  const int steps = static_cast<int>(std::ceil((settled_s - from_s) / kStep));
  const double step = (settled_s - from_s) / std::max(steps, 1);
  Pose2 from_from_now;
  for (int i = 0; i < steps; ++i) {
    from_from_now = from_from_now * start_from_end(velocity(sent, from_s + (i + 0.5) * step), step);
  }
  return from_from_now * start_from_end(velocity(sent, to_s), to_s - settled_s);
}

Pose2 CommandHistory::motion(double from_s, double to_s) const {
  if (to_s < from_s) return inverse(motion(to_s, from_s));
  Pose2 from_from_now;
  double now_s = from_s;
  for (std::size_t i = acting(from_s); i < sent_.size() && now_s < to_s; ++i) {
    const double end_s = i + 1 < sent_.size() ? std::min(sent_[i + 1].acts_s, to_s) : to_s;
    from_from_now = from_from_now * motion(sent_[i], now_s, end_s);
    now_s = end_s;
  }
  return from_from_now;
}

}  // namespace movis::control
