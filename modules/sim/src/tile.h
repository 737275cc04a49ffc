#pragma once

#include <array>
#include <vector>

#include "eye.h"
#include "stage.h"

namespace movis::sim {

// Three planes of linear light of some rows of a picture.
struct LightRowsOut {
  std::array<std::array<float*, kTile>, 3> rows;  // red, green, blue; by row of the tile: its pixel at u = 0
};

// Memory that painters use one after the other.
struct TileScratch {
  std::vector<Bounds> bounds;
  std::vector<const Prop*> near;
};

// Lays what stands on the floor over the light of floor and hall, tile by tile. Where all four
// corners of a pixel see the same face of the same body, the ray through its middle is enough; where they do not, 3 × 3
// rays find how much of it each has.
class TilePainter {
 public:
  TilePainter(const Eye& eye, const Standpoint& standpoint, const Stage& stage, TileScratch& scratch);

  void paint(int column, int row, const LightRowsOut& light);

 private:
  static constexpr int kCorners = kTile + 1;
  static constexpr int kBackground = -1;

  struct Seen {
    int face = kBackground;
    const Prop* prop = nullptr;
    Hit hit{};
  };
  void find_near_props(const Eye::Tile& tile);
  void paint_props(int left, int top, int columns, int rows, const LightRowsOut& light);
  Seen look(const Ray& ray) const;
  Colour colour(const Ray& ray, const Seen& seen) const;
  Colour pixel(int corner) const;
  Colour sampled(int corner) const;

  const Eye& eye_;
  const Standpoint& standpoint_;
  const Stage& stage_;
  std::vector<Bounds>& bounds_;                            // of the props, as seen from here, in the robot's axes
  std::vector<const Prop*>& near_;                         // that the tile may show
  std::array<Eigen::Vector3f, kCorners * kCorners> rays_;  // through the pixels' corners, field frame
  std::array<int, kCorners * kCorners> faces_{};
};

}  // namespace movis::sim
