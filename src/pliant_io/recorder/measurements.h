#pragma once
// What a run is judged by: energies, momenta, residual and times, one row a recorded step.
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pliant/simulation/simulation.h"
#include "pliant_io/recorder/output_file.h"

namespace pliant {

/// The state after a step. Energies [J] are those of its positions and velocities; none of them is damped or shifted.
struct Measurements {
  std::int64_t step = 0;
  Real time = 0;                         ///< [s]
  Real kinetic = 0;                      ///< Σ m ‖v‖²/2
  std::vector<std::string> groups;       ///< names, in the order of Simulation::groups()
  std::vector<Real> elastic;             ///< of each of these groups
  Real gravitational = 0;                ///< the potential of gravity
  Real other_potential = 0;              ///< of all other forces that have one: pressure, mouse springs, your own
  Real total = 0;                        ///< the sum of the energies: kinetic, elastic of all groups, both potentials
  Real speed_sum = 0;                    ///< Σ ‖v‖ [m/s]
  Vec3 momentum = Vec3::Zero();          ///< Σ m v [N·s]
  Vec3 angular_momentum = Vec3::Zero();  ///< Σ m x × v about the origin [N·m·s]
  Real past_limits = 0;                  ///< see stretch_past_limits()
  Real residual = 0;                     ///< largest force left on a vertex by the step's last iterate [N]
  Real objective = 0;                    ///< of that iterate [J]
  StepReport report;                     ///< of the step; all zero for the start
  std::vector<std::string> colliders;    ///< names, in the order of Simulation::colliders()
  std::vector<Wrench> wrenches;          ///< what each of these colliders felt at the end of the step
};

/// Measures the state; costs one local step.
Measurements measure(Simulation& simulation, const StepReport& report);

/// The same without `past_limits`, which takes most of the time and is NaN.
Measurements measure_energies(Simulation& simulation, const StepReport& report);

/// What of it is at hand without a local step; elastic and potential energies, their total, `past_limits`, `residual`
/// and `objective` are NaN.
Measurements measure_motion(const Simulation& simulation, const StepReport& report);

/// Whether measure_motion() leaves a column of measurements.csv out, or "elastic", the sum over all groups.
bool takes_local_step(std::string_view column);

/// How far stretches are past their limits in the state at hand: the largest ‖z − p‖ of all strains, which is 0.02
/// where cloth that may not stretch is 2 % longer. Of a body with fibres, these alone: what else it has is its shear.
/// 0 where there are none.
Real stretch_past_limits(const Simulation& simulation);

/// What of contact has columns.
struct ContactColumns {
  std::vector<std::string> colliders{};  ///< names; one that comes later may be among them
  bool surfaces = false;                 ///< whether bodies touch each other or themselves at any time
};

/// Columns of what has names, which several may share: each takes the next column of its name.
class NamedColumns {
 public:
  explicit NamedColumns(const std::vector<std::string>& names);
  /// What each column has: of these values, of so many names; a column whose name is not among them has `Value{}`.
  template <class Value>
  std::vector<Value> values(const std::vector<std::string>& names, const std::vector<Value>& given) const {
    std::vector<Value> columns(count_);
    const std::vector<std::optional<std::size_t>> places = places_of(names);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i]) columns[*places[i]] = given[i];
    }
    return columns;
  }

 private:
  std::vector<std::optional<std::size_t>> places_of(const std::vector<std::string>& names) const;

  std::size_t count_;
  std::map<std::string, std::vector<std::size_t>, std::less<>> columns_;
};

/// The columns of measurements.csv.
class MeasurementColumns {
 public:
  /// `groups` and colliders have columns: one that is not there has 0, a group that is not among them counts in the
  /// total alone. Without colliders and surfaces there are no columns of contact.
  explicit MeasurementColumns(const std::vector<std::string>& groups, const ContactColumns& contact = {});

  /// "step", "time" and so on.
  const std::vector<std::string>& names() const { return names_; }
  /// One for each name.
  std::vector<Real> values(const Measurements& row) const;

 private:
  std::vector<std::string> names_;
  NamedColumns elastic_;
  NamedColumns wrenches_;
  bool has_contact_;
  bool has_surfaces_;
};

/// Writes measurements.csv: a line of column names, then a row for each measurement. Numbers are the shortest that read
/// back to the same bits.
class MeasurementsWriter {
 public:
  /// Makes the file and writes the names of the columns. Or goes on behind the first `kept_rows` rows of the file that
  /// is there.
  /// @throws Error (output); Error (input): that file has other columns, or fewer rows
  MeasurementsWriter(const std::filesystem::path& path, const std::vector<std::string>& groups,
                     std::int64_t kept_rows = 0, const ContactColumns& contact = {});

  void add(const Measurements& row);

 private:
  MeasurementColumns columns_;
  OutputFile file_;
};

}  // namespace pliant
