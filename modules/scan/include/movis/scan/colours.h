#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "movis/core/bearing.h"

namespace movis::scan {

// A colour class: a hue sector with bounds of chroma and brightness.
// For gamma-encoded R, G, B in 0…1:  brightness = max(R, G, B),  chroma = max − min, and hue is the angle of
//   α = R − (G + B)/2,  β = √3/2 (G − B)
// (red 0°, yellow 60°, green 120°, blue 240°; at most 1.2° from the hexagonal hue of HSV). A sector's two borders are
// then lines through the grey axis: two linear inequalities in R, G, B.
struct ColourClass {
  ObjectClass object = ObjectClass::ball;
  double hue_from = 0.0;   // radians, in [0, 2π)
  double hue_width = 0.0;  // radians, counter-clockwise from hue_from: below π, or 2π for every hue
  double chroma_min = 0.0, chroma_max = 1.0;
  double brightness_min = 0.0, brightness_max = 1.0;
};

// What most pixels of a surface show in the light that the classes are made for: red, green, blue in bytes. By them
// another light is recognized (light.h).
struct TypicalColours {
  std::optional<Eigen::Vector3d> field, line;
};

struct Colours {
  std::vector<ColourClass> classes;
  TypicalColours typical = {};
};

// Reads colours.yaml strictly. Any subset of the classes may stand in it. A typical colour is of its own class.
Colours read_colours(const std::filesystem::path& file);

}  // namespace movis::scan
