#include "plot/column_info.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "pliant/core/printable.h"

namespace pliant_plot {
namespace {

struct KnownColumn {
  std::string_view name, label, unit;
  bool is_of_step = false, is_logarithmic = false;
};

constexpr std::array known_columns = {
    KnownColumn{"kinetic", "kinetic energy", "J"},
    KnownColumn{"elastic", "elastic energy", "J"},
    KnownColumn{"gravitational", "energy in gravity", "J"},
    KnownColumn{"other_potential", "potential of other forces", "J"},
    KnownColumn{"total", "total energy", "J"},
    KnownColumn{"speed_sum", "total speed Σ‖v‖", "m/s"},
    KnownColumn{"momentum", "momentum ‖Σ m v‖", "N·s"},
    KnownColumn{"angular_momentum_x", "angular momentum about x", "N·m·s"},
    KnownColumn{"angular_momentum_y", "angular momentum about y", "N·m·s"},
    KnownColumn{"angular_momentum_z", "angular momentum about z", "N·m·s"},
    KnownColumn{"past_limits", "stretch past its limits", ""},
    KnownColumn{"residual", "largest force left on a vertex", "N", true, true},
    KnownColumn{"objective", "objective", "J", true},
    KnownColumn{"iterations", "iterations", "", true},
    KnownColumn{"ms_local", "local steps", "ms", true},
    KnownColumn{"ms_global", "global steps", "ms", true},
    KnownColumn{"ms_contact", "contact", "ms", true},
    KnownColumn{"ms_total", "whole step", "ms", true},
    KnownColumn{"contacts", "contacts with colliders and surfaces", "", true},
    KnownColumn{"deepest", "depth within the contact distance", "m", true},
    KnownColumn{"friction_power", "power that friction takes", "W", true},
    KnownColumn{"held_back", "moves cut at colliders", "", true},
    KnownColumn{"backtracks", "moves taken back or shortened", "", true},
    KnownColumn{"refactorizations", "refactorizations with contact", "", true},
    KnownColumn{"pairs", "pairs that are near", "", true},
    KnownColumn{"active", "pairs that push", "", true},
    KnownColumn{"smallest_gap", "smallest gap between surfaces", "m", true, true},
    KnownColumn{"shortened", "moves cut at surfaces", "", true},
    KnownColumn{"momentum_lost", "momentum that contact loses", "N·s", true},
    KnownColumn{"energy_taken", "energy that contact takes", "J", true},
    KnownColumn{"lag", "lag of pinned vertices", "m", true},
    KnownColumn{"let_go", "edges and pins let go", "", true},
};

struct KnownPrefix {
  std::string_view prefix, label, unit;
  bool is_of_step = false;
};

constexpr std::array known_prefixes = {
    KnownPrefix{"elastic_", "elastic energy of {}", "J"},
    KnownPrefix{"force_x_", "force on {} along x", "N", true},
    KnownPrefix{"force_y_", "force on {} along y", "N", true},
    KnownPrefix{"force_z_", "force on {} along z", "N", true},
    KnownPrefix{"torque_x_", "torque on {} about x", "N·m", true},
    KnownPrefix{"torque_y_", "torque on {} about y", "N·m", true},
    KnownPrefix{"torque_z_", "torque on {} about z", "N·m", true},
};

}  // namespace

ColumnInfo column_info(std::string_view column) {
  const auto known = std::ranges::find(known_columns, column, &KnownColumn::name);
  if (known != known_columns.end()) {
    return {std::string(known->label), std::string(known->unit), known->is_of_step, known->is_logarithmic};
  }
  for (const KnownPrefix& each : known_prefixes) {
    if (!column.starts_with(each.prefix)) continue;
    const std::string name = pliant::printable(column.substr(each.prefix.size()), 60);
    return {fmt::format(fmt::runtime(each.label), name), std::string(each.unit), each.is_of_step};
  }
  return {pliant::printable(column, 60)};
}

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : fmt::format("{} [{}]", text, unit);
}

}  // namespace pliant_plot
