#pragma once

#include <filesystem>

namespace movis {

// The playing field, metres. Field frame: origin at the centre spot, Y from the blue goal to the yellow goal, X to
// the right of that, Z up. Goals stand at Y = ±Fd; the inner sides of their posts at X = ±Fw.
struct Field {
  double half_width = 0.0;   // X, to the outer edge of the lines
  double half_length = 0.0;  // Y
  double circle = 0.0;       // radius of the centre circle, to the line's centre
  double line = 0.0;         // width of the lines
  double Fd = 0.0;           // NOLINT(readability-identifier-naming): the paper's name
  double Fw = 0.0;           // NOLINT(readability-identifier-naming): the paper's name; half the goal's inner width
  double goal_height = 0.0;
  double goal_depth = 0.0;
  double goal_thickness = 0.0;  // of the walls, which lie outside Fw

  enum class Goals { coloured, white };  // coloured: yellow at +Y, blue at −Y
  Goals goals = Goals::coloured;

  struct Area {
    double depth = 0.0;  // from the goal line into the field; 0: not drawn
    double width = 0.0;
  };
  Area penalty_area;
  Area goal_area;
  double corner_arc = 0.0;  // radius; 0: not drawn
};

// Reads field.yaml strictly: an unknown or missing key, or a value out of range, is an Error naming file, line, key.
Field read_field(const std::filesystem::path& file);

}  // namespace movis
