#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "movis/sim/look.h"
#include "movis/sim/scene.h"
#include "prop.h"

namespace movis::sim {

// Where something stands on the floor, or close above it, and takes light from it: at a distance r from the centre the
// part
//   strength·(1 − (r/reach)²)²
struct Shadow {
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();
  float reach = 1.0F;  // metres
  float strength = 0.0F;
};

// The floor with its lines and the four walls of the hall, with the light on them: what a ray hits that hits nothing
// else. The floor is painted once, on a grid, finely on the field and coarsely around it.
class Hall {
 public:
  Hall(const Arena& arena, const Look& look);

  // What a ray that starts inside the hall brings back.
  Colour colour(const Ray& ray, const std::vector<Shadow>& shadows) const;

  // Square cells of the floor, row by row from the corner with the smallest coordinates.
  struct Grid {
    float cells_per_metre = 1.0F;
    float left = 0.0F, bottom = 0.0F;  // field frame
    int columns = 0, rows = 0;
    int first = 0;  // of its cells in the planes
  };
  const Grid& field() const { return field_; }    // without a field it has no cells
  const Grid& around() const { return around_; }  // up to the walls of the hall
  // The cells' light: red and green as 16-bit fractions of kFullLight in the upper and lower half of a word, and blue.
  // Two words are fetched faster than three.
  static constexpr float kFullLight = 2.0F;
  const std::int32_t* red_green() const { return red_green_.data(); }
  const float* blue() const { return blue_.data(); }

  float half_width() const { return half_width_; }
  const Light& light() const { return light_; }
  const Colour& wall_colour() const { return wall_; }

 private:
  void paint(const Grid& grid, const Arena& arena, const Look& look, int samples);

  float half_width_;
  Light light_;
  Colour wall_;
  Grid field_, around_;
  std::vector<std::int32_t> red_green_;
  std::vector<float> blue_;
};

}  // namespace movis::sim
