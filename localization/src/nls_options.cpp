#include "movis/localization/nls.h"

namespace movis::localization {
namespace {

LineMatchOptions read_line_match_options(const YamlMap& map) {
  map.allow({"outliers", "largest_sigma", "worst_spread", "most_left_out", "independent", "distinct", "fewest_points"});
  LineMatchOptions options;
  map.read_number("outliers", {0.0, 0.9}, options.outliers);
  map.read_number("largest_sigma", {0.001, 10.0}, options.largest_sigma);
  map.read_number("worst_spread", {0.1, 100.0}, options.worst_spread);
  map.read_number("most_left_out", {0.0, 1.0}, options.most_left_out);
  map.read_number("independent", {1.0, 1e6}, options.independent);
  map.read_number("distinct", {0.0, 1.0}, options.distinct);
  map.read_integer("fewest_points", {4.0, 10000.0}, options.fewest_points);
  return options;
}

}  // namespace

NlsOptions read_nls_options(const YamlMap& map) {
  map.allow({"edge_floor_deg", "edge_bias_deg", "line_floor", "line_points", "loss_width", "worst_scale", "worst_sigma",
             "lines"});
  NlsOptions options;
  map.read_number("edge_floor_deg", {0.0, 5.0}, options.edge_floor_deg);
  map.read_number("edge_bias_deg", {1e-4, 5.0}, options.edge_bias_deg);
  map.read_number("line_floor", {1e-4, 1.0}, options.line_floor);
  map.read_number("line_points", {0.0, 1e4}, options.line_points);
  map.read_number("loss_width", {1.0, 100.0}, options.loss_width);
  map.read_number("worst_scale", {1.0, 1e4}, options.worst_scale);
  map.read_number("worst_sigma", {1e-4, 100.0}, options.worst_sigma);
  if (map.has("lines")) options.lines = read_line_match_options(map.map("lines"));
  return options;
}

}  // namespace movis::localization
