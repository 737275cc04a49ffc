#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/field.h"
#include "movis/core/pose.h"
#include "movis/core/status.h"
#include "movis/report/picture.h"

// A page that shows, frame by frame, what the cameras saw and what was measured from it: pictures with the bearings
// drawn in, panoramas, histograms, the plan of the field, and the errors where the truth is known.
//
// Everything here is plain data for a screen. Azimuths are in the robot's axes (0° right, 90° ahead), any turn of
// them will do; elevations are up from the horizontal plane; fields with _deg are degrees, all other angles radians.
// Lengths are metres, pixels have their origin at the centre of the top-left pixel. A number that is not finite is
// shown as unknown, and what would need it is not drawn.
namespace movis::report {

// A picture unrolled as one looks outwards: the azimuth falls evenly from +180° at the left border to −180° at the
// right one, the elevation from max at the top border to min at the bottom one. The page turns it to have the
// direction ahead in the middle.
struct Panorama {
  EncodedImage image;
  double min_elevation_deg = 0.0;
  double max_elevation_deg = 0.0;
};

// A bearing of one camera, and the lines that show it in that camera's picture.
struct BearingMark {
  ObjectClass object = ObjectClass::ball;
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;
  double left_deg = 0.0;  // azimuths of the object's edges
  double right_deg = 0.0;
  std::uint8_t flags = 0;                    // BearingFlag; any of them draws the mark dashed
  std::optional<Eigen::Vector2d> centre_px;  // where the bearing points in the picture
  std::vector<Eigen::Vector2d> centre_line;  // the azimuth as a polyline in the picture, pixels; may be empty
  std::vector<Eigen::Vector2d> left_line;
  std::vector<Eigen::Vector2d> right_line;
};

// Extracted pixels over azimuth, the paper's Fig. 4. Bin i of n covers azimuths from −180° + 360°·i/n.
struct HistogramCurve {
  ObjectClass object = ObjectClass::ball;
  std::vector<std::uint32_t> counts;
  double threshold = 0.0;  // pixels a bin
};

struct CameraPicture {
  std::string name;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // of the viewpoint in the robot frame, from above
  bool lost = false;                                   // the frame has no image of this camera
  EncodedImage image;
  Panorama panorama;
  std::vector<BearingMark> marks;
  std::vector<HistogramCurve> histograms;
};

struct TrackFrame {
  std::string set;    // the data set, e.g. "field"
  int frame = 0;      // its number in the set
  std::string label;  // of the robot's spot, e.g. "A"; may be empty
  std::vector<CameraPicture> cameras;

  PointEstimate ball_in_robot;
  std::optional<Fix> fix;  // nothing, or no_field, where no pose is sought
  double tick_us = 0.0;    // time from images to results, microseconds; NaN: unknown

  std::optional<Field> field;  // where it is given, the plan is the field's, else the robot frame's
  std::optional<Pose2> true_pose;
  std::optional<Eigen::Vector2d> true_ball_in_robot;
  std::optional<Eigen::Vector2d> true_ball_in_field;
};

struct TrackPage {
  std::string title;
  std::vector<TrackFrame> frames;
  std::string version;  // of the program, for the page's foot
  std::string command;  // that made the page
};

// Writes one HTML file that needs nothing beside it and no network. An Error where the file cannot be written, or
// where a picture is neither PNG nor JPEG or has no size; then no file is left behind.
void write_track_page(const TrackPage& page, const std::filesystem::path& file);

}  // namespace movis::report
