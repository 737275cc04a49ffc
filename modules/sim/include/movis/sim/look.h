#pragma once

#include <Eigen/Core>
#include <filesystem>

namespace movis::sim {

// Linear red, green, blue in 0…1 of a surface under full light. The fourth number is always 0: four floats are one
// vector register.
using Colour = Eigen::Array4f;

// A diffuse surface with unit normal n at a point p of the field frame returns its colour times
//   ambient + sky·n_z + lamp·(n·l),   l: the unit vector from p to (0, 0, lamp_height)
// which is at least 0.05: a hall with light walls, an evenly bright ceiling and a group of lamps over the centre spot.
struct Light {
  float ambient = 0.51F;
  float sky = 0.25F;
  float lamp = 0.26F;
  float lamp_height = 3.0F;  // metres
  float shadow = 0.25F;      // of the floor's light that an object standing on it takes right beside it
  float gloss = 0.068F;      // added where a ball mirrors the lamps
};

// The lens and the sensor. The noise of a pixel whose linear signal is s (1: white) has the variance
//   (read_noise² + s·full_well) / full_well²,  in electrons (EMVA 1288, release 4.0, section 2.2),
// then exposure and white balance scale the signal with its noise, and sRGB's curve makes 8 bits of it.
struct Sensor {
  double blur_px = 0.0;     // sigma of the lens's Gaussian blur; 0: none
  double full_well = 0.0;   // electrons at white; 0: no noise
  double read_noise = 0.0;  // electrons
  double exposure = 1.0;    // factor on the signal
  double red_gain = 1.0;    // white balance
  double blue_gain = 1.0;
};

struct Look {
  Colour floor, line, surround, wall, hall, ball, yellow_goal, blue_goal, white_goal;
  Colour hull, cyan, magenta;
  Colour outside;                // of the picture beside the mirror
  double floor_margin = 0.3;     // metres of floor beyond the lines; the surround follows
  double hall_half_width = 7.5;  // metres from the centre spot to the four walls of the hall
  Light light;
  Sensor sensor;
};

// Reads look.yaml strictly. Its colours are 8-bit sRGB, as one picks them from a picture.
Look read_look(const std::filesystem::path& file);

}  // namespace movis::sim
