#include "movis/fuzzy/rule_base.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace movis::fuzzy {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double rising(double x, double from, double to) {
  if (x >= to || from == -kInfinity) return 1.0;
  return x <= from ? 0.0 : (x - from) / (to - from);
}

double falling(double x, double from, double to) {
  if (x <= from || to == kInfinity) return 1.0;
  return x >= to ? 0.0 : (to - x) / (to - from);
}

struct At {
  double x;

  double operator()(const Triangle& t) const { return std::min(rising(x, t.a, t.b), falling(x, t.b, t.c)); }
  double operator()(const Trapezoid& t) const { return std::min(rising(x, t.a, t.b), falling(x, t.c, t.d)); }
  double operator()(const Ramp& r) const {
    return r.start < r.end ? rising(x, r.start, r.end) : falling(x, r.end, r.start);
  }
  double operator()(const Rectangle& r) const { return x >= r.start && x <= r.end ? 1.0 : 0.0; }
  double operator()(const Gaussian& g) const {
    const double z = (x - g.mean) / g.sigma;
    return std::exp(-0.5 * z * z);
  }
};

}  // namespace

double membership(const MembershipFunction& function, double x) {
  return std::visit(At{x}, function);
}

double hedged(Hedge hedge, double membership) {
  const double m = membership;
  switch (hedge) {
    case Hedge::negation:
      return 1.0 - m;
    case Hedge::very:
      return m * m;
    case Hedge::somewhat:
      return std::sqrt(m);
    case Hedge::extremely:
      return m <= 0.5 ? 2.0 * m * m : 1.0 - 2.0 * (1.0 - m) * (1.0 - m);
    case Hedge::seldom:
      return m <= 0.5 ? std::sqrt(0.5 * m) : 1.0 - std::sqrt(0.5 * (1.0 - m));
  }
  return m;
}

}  // namespace movis::fuzzy
