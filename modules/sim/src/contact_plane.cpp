#include "contact_plane.h"

#include <box2d/box2d.h>

#include <algorithm>
#include <mutex>
#include <vector>

#include "panels.h"

namespace movis::sim {
namespace {

// Box2D is tuned to bodies of 0.1 to 10 units: its contacts give way by 0.005 and its corners are rounded by 0.01
// units. In decimetres a ball measures 2.2 of them, and that is 0.5 and 1 mm.
constexpr double kUnits = 10.0;  // a metre
constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

b2Vec2 to_box(const Eigen::Vector2d& metres) {
  return {static_cast<float>(kUnits * metres.x()), static_cast<float>(kUnits * metres.y())};
}

Eigen::Vector2d to_metres(const b2Vec2& units) {
  return Eigen::Vector2d(units.x, units.y) / kUnits;
}

// Lets the ball fly over what is lower than it, and notes who was touched.
class Heights : public b2ContactListener {
 public:
  double ball_bottom = 0.0;
  bool robot_touched = false, ball_touched = false;
  const b2Body* robot = nullptr;
  const b2Body* ball = nullptr;

  // Of what a fixture belongs to. The fixture carries its index.
  std::uintptr_t add(double height) {
    heights_.push_back(height);
    return heights_.size() - 1;
  }

  void PreSolve(b2Contact* contact, const b2Manifold* /*before*/) override {
    b2Fixture* a = contact->GetFixtureA();
    b2Fixture* b = contact->GetFixtureB();
    if (a->GetBody() != ball && b->GetBody() != ball) return;
    b2Fixture* other = a->GetBody() == ball ? b : a;
    if (ball_bottom > heights_[other->GetUserData().pointer]) contact->SetEnabled(false);
  }

  void PostSolve(b2Contact* contact, const b2ContactImpulse* /*impulse*/) override {
    for (const b2Fixture* fixture : {contact->GetFixtureA(), contact->GetFixtureB()}) {
      robot_touched |= fixture->GetBody() == robot;
      ball_touched |= fixture->GetBody() == ball;
    }
  }

 private:
  std::vector<double> heights_;
};

// Box2D fills a table of its own at the first contact of the process. That must not happen in two threads at once.
void fill_contact_table() {
  b2World world(b2Vec2(0.0F, 0.0F));
  b2BodyDef definition;
  definition.type = b2_dynamicBody;
  b2CircleShape circle;
  circle.m_radius = 1.0F;
  for (int i = 0; i < 2; ++i) world.CreateBody(&definition)->CreateFixture(&circle, 1.0F);
  world.Step(0.01F, 1, 1);
}

}  // namespace

struct ContactPlane::World {
  b2World world{b2Vec2(0.0F, 0.0F)};
  Heights heights;
  b2Body* robot = nullptr;
  b2Body* ball = nullptr;
  b2Body* standing = nullptr;
  float friction = 0.0F;

  void add_fixture(b2Body* body, const b2Shape& shape, double height, double restitution) {
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.friction = friction;                            // of two hulls the geometric mean is taken,
    fixture.restitution = static_cast<float>(restitution);  // the greater restitution,
    fixture.restitutionThreshold = 0.0F;                    // and the smaller threshold
    fixture.userData.pointer = heights.add(height);
    body->CreateFixture(&fixture);
  }

  // `inertia` is about the vertical, as a factor on mass · radius².
  b2Body* add_disc(double radius, double height, double mass, double inertia, double restitution) {
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.bullet = true;
    b2Body* body = world.CreateBody(&definition);
    b2CircleShape circle;
    circle.m_radius = static_cast<float>(kUnits * radius);
    add_fixture(body, circle, height, restitution);
    b2MassData mass_data;
    mass_data.mass = static_cast<float>(mass);
    mass_data.center.SetZero();
    mass_data.I = static_cast<float>(inertia * mass) * circle.m_radius * circle.m_radius;
    body->SetMassData(&mass_data);
    return body;
  }

  void add_panel(const Panel& panel) {
    constexpr double kSkin = b2_polygonRadius;  // Box2D's shapes with corners touch that much before their sides
    const Eigen::Vector2d half = (kUnits * panel.half).array() - kSkin;
    b2PolygonShape box;
    box.SetAsBox(static_cast<float>(std::max(half.x(), 0.1 * kSkin)),
                 static_cast<float>(std::max(half.y(), 0.1 * kSkin)), to_box(panel.centre), 0.0F);
    add_fixture(standing, box, panel.height, 0.0);
  }

  void add_obstacle(const Obstacle& obstacle) {
    b2CircleShape circle;
    circle.m_radius = static_cast<float>(kUnits * obstacle.radius);
    circle.m_p = to_box(obstacle.position);
    add_fixture(standing, circle, obstacle.height, 0.0);
  }
};

ContactPlane::ContactPlane(const Arena& arena, const control::RobotModel& robot, const PhysicsOptions& options)
    : world_(std::make_unique<World>()) {
  static std::once_flag filled;
  std::call_once(filled, fill_contact_table);
  World& world = *world_;
  world.friction = static_cast<float>(options.contact_friction);
  world.world.SetContactListener(&world.heights);
  world.world.SetAllowSleeping(false);
  const b2BodyDef definition;
  world.standing = world.world.CreateBody(&definition);
  if (arena.field) {
    for (const Panel& panel : goal_panels(*arena.field)) world.add_panel(panel);
  }
  for (const Panel& panel : wall_panels(arena)) world.add_panel(panel);
  for (const Obstacle& obstacle : arena.obstacles) world.add_obstacle(obstacle);
  world.robot = world.add_disc(robot.radius, robot.height, robot.mass, 1.0 / 2.0, 0.0);  // a disc
  world.ball =
      world.add_disc(kBallRadius, 0.0, options.ball_mass, 2.0 / 3.0, options.ball_restitution);  // a thin shell
  world.heights.robot = world.robot;
  world.heights.ball = world.ball;
}

ContactPlane::~ContactPlane() = default;

ContactPlane::Touched ContactPlane::step(const Disc& robot, const Disc& ball, double ball_bottom, double seconds) {
  World& world = *world_;
  const auto put = [](b2Body* body, const Disc& disc) {
    body->SetTransform(to_box(disc.position), static_cast<float>(disc.angle));
    body->SetLinearVelocity(to_box(disc.velocity));
    body->SetAngularVelocity(static_cast<float>(disc.rate));
  };
  const auto get = [](const b2Body* body, bool touched) -> std::optional<Disc> {
    if (!touched) return std::nullopt;
    return Disc{to_metres(body->GetPosition()), body->GetAngle(), to_metres(body->GetLinearVelocity()),
                body->GetAngularVelocity()};
  };
  put(world.robot, robot);
  put(world.ball, ball);
  world.heights.ball_bottom = ball_bottom;
  world.heights.robot_touched = world.heights.ball_touched = false;
  world.world.Step(static_cast<float>(seconds), kVelocityIterations, kPositionIterations);
  return {get(world.robot, world.heights.robot_touched), get(world.ball, world.heights.ball_touched)};
}

}  // namespace movis::sim
