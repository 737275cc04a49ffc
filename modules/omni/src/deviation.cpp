#include "movis/omni/deviation.h"

#include "movis/core/angle.h"

namespace movis::omni {

namespace {

template <typename Model>
void scale_image(Model& model, double factor) {
  model.fu *= factor;
  model.fv *= factor;
}

void scale_image(Radial& model, double factor) {
  model.b /= factor;
  model.max_radius_px *= factor;
}

}  // namespace

Deviation individual_differences() {
  Deviation sigma;
  sigma << 0.002, 0.002, 0.002, radians(0.6), radians(0.25), radians(0.25), 0.004, 1.5, 1.5;
  return sigma;
}

Camera deviated(const Camera& nominal, const Deviation& deviation) {
  Camera camera = nominal;
  camera.position += deviation.head<3>();
  camera.yaw += deviation[3];
  camera.tilt_x += deviation[4];
  camera.tilt_y += deviation[5];
  std::visit(
      [&](auto& model) {
        scale_image(model, 1.0 + deviation[6]);
        model.u0 += deviation[7];
        model.v0 += deviation[8];
      },
      camera.model);
  return camera;
}

Rig draw_rig(const Rig& nominal, const Deviation& sigma, RandomStream& random) {
  std::normal_distribution<double> normal;
  Rig rig = nominal;
  for (Camera& camera : rig.cameras) {
    Deviation deviation;
    for (int i = 0; i < kDeviations; ++i) deviation[i] = sigma[i] * normal(random);
    camera = deviated(camera, deviation);
  }
  return rig;
}

}  // namespace movis::omni
