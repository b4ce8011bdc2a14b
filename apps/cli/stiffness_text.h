#pragma once
#include <string>

#include "pliant/simulation/group_stiffness.h"

namespace pliant_cli {

/// "stiffness 500 to 2000 N/m, 2500 to 1e+04 once taut".
std::string stiffness_text(const pliant::StiffnessRange& range);

}  // namespace pliant_cli
