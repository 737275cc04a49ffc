#include <cmath>
#include <cstring>

#include "physics_scene.h"

namespace movis::sim {
namespace {

// FNV-1a over a state's bytes.
std::uint64_t hash(std::uint64_t so_far, const State& state) {
  const double numbers[] = {state.time_s,
                            state.world_from_robot.x,
                            state.world_from_robot.y,
                            state.world_from_robot.beta,
                            state.ball_in_field.x(),
                            state.ball_in_field.y(),
                            state.ball_in_field.z()};
  unsigned char bytes[sizeof numbers];
  std::memcpy(bytes, numbers, sizeof numbers);
  for (const unsigned char byte : bytes) so_far = (so_far ^ byte) * 1099511628211ULL;
  return so_far;
}

// A robot that drives about at random, chases the ball and kicks it, with noise, among walls, goals and obstacles.
class Riot {
 public:
  explicit Riot(std::uint64_t seed)
      : physics_(make_physics(arena(), {}, robot(), seed)), random_(make_stream(seed, 9)) {}

  // Now and then it starts again, lest it end in a corner.
  void step() {
    if (frame_++ % 300 == 0) start();
    const Eigen::Vector2d ball =
        inverse(physics_.state().world_from_robot) * Eigen::Vector2d(physics_.state().ball_in_field.head<2>());
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const double vx = 2.0 * ball.x() + uniform(random_);
    const double vy = 2.0 * ball.y() + uniform(random_);
    const double omega = 4.0 * std::atan2(-ball.x(), ball.y()) + uniform(random_);
    physics_.step({{vx, vy, omega}, true}, 1.0 / 30.0);
    hash_ = hash(hash_, physics_.state());
  }

  std::uint64_t state_hash() const { return hash_; }
  int kicks() const { return kicks_; }  // before the last start

 private:
  static Arena arena() {
    Arena arena{paper_field(), Wall{0.5, 0.3}, {}};
    for (const Eigen::Vector2d& position : {Eigen::Vector2d(0.8, 0.9), Eigen::Vector2d(-0.9, 0.4)}) {
      arena.obstacles.emplace_back().position = position;
    }
    return arena;
  }
  static control::RobotModel robot() {
    control::RobotModel robot = exact_robot();
    robot.kicker = {0.20, 0.05, 4.0, 0.05, 0.03, 0.1};
    robot.actuator_sigma = 0.02;
    return robot;
  }

  void start() {
    kicks_ += physics_.kicks();
    physics_.place(scene({0.0, -0.5, 0.0}, {0.0, 0.0}));
  }

  Physics physics_;
  RandomStream random_;
  int frame_ = 0;
  int kicks_ = 0;
  std::uint64_t hash_ = 14695981039346656037ULL;
};

constexpr int kFrames = 3000;

std::uint64_t hash_of_run(std::uint64_t seed) {
  Riot riot(seed);
  for (int i = 0; i < kFrames; ++i) riot.step();
  EXPECT_GT(riot.kicks(), 10);
  return riot.state_hash();
}

TEST(PhysicsDeterminism, SameSeedSameBits) {
  EXPECT_EQ(hash_of_run(7), hash_of_run(7));
  EXPECT_NE(hash_of_run(7), hash_of_run(8));
}

TEST(PhysicsDeterminism, TwoAtOnce) {
  Riot first(7);
  Riot second(8);
  for (int i = 0; i < kFrames; ++i) {
    first.step();
    second.step();
  }
  EXPECT_EQ(first.state_hash(), hash_of_run(7));
  EXPECT_EQ(second.state_hash(), hash_of_run(8));
}

// Without noise, place() leaves nothing of the past: an episode is the same whatever was played before.
TEST(PhysicsDeterminism, PlaceForgets) {
  const Arena arena{paper_field(), Wall{0.5, 0.3}, {}};
  Physics used = make_physics(arena);
  used.place(scene({1.0, 1.0, 1.0}, {0.5, 0.5}));
  step_frames(used, 200, drive_at(-1.0, 1.0, 0.5));
  Physics fresh = make_physics(arena);
  for (Physics* physics : {&used, &fresh}) {
    physics->place(scene({0.0, -0.5, 0.0}, {0.01, 0.0}));
    step_frames(*physics, 300, drive_at(0.0, 1.5, 0.1));
  }
  EXPECT_EQ(hash(0, used.state()), hash(0, fresh.state()));
}

}  // namespace
}  // namespace movis::sim
