#pragma once

#include <memory>
#include <string>
#include <vector>

#include "movis/control/controller.h"
#include "movis/control/percepts.h"

namespace movis::experiments {

// A controller by its name, with its file after a colon where it is not the default one:
//   fuzzy[:FILE]  the multilayered fuzzy controller; FILE is its controller.yaml
//   pbvs[:FILE]   position-based visual servoing; FILE is its pbvs.yaml
// An unknown name is an Error that lists these.
std::unique_ptr<control::Controller> make_controller(const std::string& name, const control::Task& task);

std::vector<std::string> controller_names();

}  // namespace movis::experiments
