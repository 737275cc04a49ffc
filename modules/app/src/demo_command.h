#pragma once

#include <filesystem>

namespace movis::app {

struct DemoArguments {
  std::filesystem::path out = "movis-demo.html";
};

// `movis demo`: tracks the shipped images and writes one self-contained HTML page that shows what the cameras saw and
// what was measured, against the truth. Throws an Error, and then leaves no file behind.
void demo(const DemoArguments& arguments);

}  // namespace movis::app
