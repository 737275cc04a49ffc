#include <fmt/format.h>

#include <set>
#include <utility>

#include "movis/core/angle.h"
#include "movis/core/yaml.h"
#include "movis/omni/rig.h"

namespace movis::omni {
namespace {

constexpr Range kMirror{0.001, 1.0};     // metres
constexpr Range kFocalLength{1.0, 1e5};  // pixels
constexpr Range kPixel{-1e4, 1e5};
constexpr Range kPosition{-10.0, 10.0};    // metres
constexpr Range kAnyAngle{-1e4, 1e4};      // degrees; files may hold any angle
constexpr Range kTilt{-180.0, 180.0};      // degrees
constexpr Range kImageSize{1.0, 65535.0};  // pixels
constexpr double kMostPixels = 1e8;
constexpr Range kDistortion{-10.0, 10.0};

Hyperboloid read_hyperboloid(const YamlMap& camera) {
  const YamlMap mirror = camera.map("hyperboloid");
  mirror.allow({"a", "b", "rim_radius"});
  const YamlMap pinhole = camera.map("pinhole");
  pinhole.allow({"fu", "fv", "u0", "v0"});
  Hyperboloid model;
  model.a = mirror.number("a", kMirror);
  model.b = mirror.number("b", kMirror);
  model.rim_radius = mirror.number("rim_radius", kMirror);
  model.fu = pinhole.number("fu", kFocalLength);
  model.fv = pinhole.number("fv", kFocalLength);
  model.u0 = pinhole.number("u0", kPixel);
  model.v0 = pinhole.number("v0", kPixel);
  return model;
}

UnifiedSphere read_unified(const YamlMap& camera) {
  const YamlMap map = camera.map("unified");
  map.allow({"xi", "fu", "fv", "u0", "v0", "k1", "k2", "p1", "p2", "skew", "max_elevation_deg"});
  UnifiedSphere model;
  model.xi = map.number("xi", {0.01, 10.0});
  model.fu = map.number("fu", kFocalLength);
  model.fv = map.number("fv", kFocalLength);
  model.u0 = map.number("u0", kPixel);
  model.v0 = map.number("v0", kPixel);
  map.read_number("k1", kDistortion, model.k1);
  map.read_number("k2", kDistortion, model.k2);
  map.read_number("p1", kDistortion, model.p1);
  map.read_number("p2", kDistortion, model.p2);
  map.read_number("skew", kDistortion, model.skew);
  double max_elevation_deg = degrees(model.max_elevation);
  map.read_number("max_elevation_deg", {-90.0, 90.0}, max_elevation_deg);
  model.max_elevation = radians(max_elevation_deg);
  return model;
}

Radial read_radial(const YamlMap& camera, double height) {
  const YamlMap map = camera.map("radial");
  map.allow({"a", "b", "u0", "v0", "max_radius_px"});
  if (!(height >= 0.01)) {
    camera.fail("position",
                "`model: radial` is known by what it shows of the floor, so the camera must be 1 cm or more above it");
  }
  Radial model;
  model.a = map.number("a", {0.001, 100.0});
  model.b = map.number("b", {1e-6, 1.0});
  model.u0 = map.number("u0", kPixel);
  model.v0 = map.number("v0", kPixel);
  model.height = height;
  map.read_number("max_radius_px", {1.0, 1e5}, model.max_radius_px);
  return model;
}

// The blocks of the models; those of the others than `model` must not stand in the file.
CameraModel read_model(const YamlMap& camera, double height) {
  const std::string model = camera.one_of("model", {"hyperboloid", "unified", "radial"});
  for (const auto& [block, owner] : {std::pair{"hyperboloid", "hyperboloid"},
                                     {"pinhole", "hyperboloid"},
                                     {"unified", "unified"},
                                     {"radial", "radial"}}) {
    if (model != owner && camera.has(block))
      camera.fail(block, fmt::format("stands beside `model: {}`; remove it or change the model", model));
  }
  if (model == "hyperboloid") return read_hyperboloid(camera);
  if (model == "unified") return read_unified(camera);
  return read_radial(camera, height);
}

PixelFormat read_format(const YamlMap& image) {
  static constexpr PixelFormat kFormats[] = {
      PixelFormat::bgr8,        PixelFormat::rgb8,        PixelFormat::rgba8,       PixelFormat::mono8,
      PixelFormat::bayer_rggb8, PixelFormat::bayer_bggr8, PixelFormat::bayer_grbg8, PixelFormat::bayer_gbrg8};
  const std::string text =
      image.one_of("format", {"BGR8", "RGB8", "RGBA8", "Mono8", "BayerRG8", "BayerBG8", "BayerGR8", "BayerGB8"});
  for (const PixelFormat format : kFormats) {
    if (text == name(format)) return format;
  }
  image.fail("format", "is not known");
}

Camera read_camera(const YamlMap& map) {
  map.allow({"name", "position", "yaw_deg", "tilt_deg", "image", "model", "hyperboloid", "pinhole", "unified", "radial",
             "mask"});
  Camera camera;
  camera.name = map.text("name");
  const std::vector<double> position = map.numbers("position", 3, kPosition);
  camera.position = {position[0], position[1], position[2]};
  camera.yaw = wrap_angle(radians(map.number("yaw_deg", kAnyAngle)));
  const std::vector<double> tilt = map.numbers("tilt_deg", 2, kTilt);
  camera.tilt_x = radians(tilt[0]);
  camera.tilt_y = radians(tilt[1]);

  const YamlMap image = map.map("image");
  image.allow({"width", "height", "format"});
  camera.width = image.integer("width", kImageSize);
  camera.height = image.integer("height", kImageSize);
  if (static_cast<double>(camera.width) * camera.height > kMostPixels) {
    image.fail("width", "times height is more than 100 million pixels");
  }
  if (image.has("format")) camera.format = read_format(image);

  camera.model = read_model(map, camera.position.z());
  if (map.has("mask")) camera.mask = map.file().parent_path() / map.text("mask");
  return camera;
}

}  // namespace

Rig read_rig(const std::filesystem::path& file) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"cameras"});
  Rig rig;
  std::set<std::string> names;
  for (const YamlMap& camera : map.list_of_maps("cameras")) {
    rig.cameras.push_back(read_camera(camera));
    if (!names.insert(rig.cameras.back().name).second) {
      camera.fail("name", "is that of an earlier camera; every camera needs its own");
    }
  }
  if (rig.cameras.empty()) map.fail("cameras", "lists no camera");
  return rig;
}

}  // namespace movis::omni
