#include <fmt/format.h>

#include "pliant_io/files/csv.h"
#include "sweep/sweep.h"

namespace pliant_sweep {

std::string sweep_csv(const SweepPlan& plan) {
  std::string text = "run";
  for (const Variation& variation : plan.setup.variations) text += ',' + pliant::csv_field(variation.path);
  text += ",outcome,steps_done";
  for (const FigureInfo& info : figure_infos()) text += ',' + info.name;
  text += ",message\n";
  for (const SweepRun& run : plan.runs) {
    text += run.name;
    for (const std::string& value : run.values) text += ',' + pliant::csv_field(plain_value(value));
    const RunResult& result = run.result;
    text += fmt::format(",{},", choice_names(result.outcome)[static_cast<std::size_t>(result.outcome)]);
    const bool is_measured = result.has_ended_by_itself();
    if (is_measured) text += std::to_string(result.steps_done);
    for (std::size_t i = 0; i < figure_infos().size(); ++i) {
      const auto figure = result.figure(i);
      text += figure ? fmt::format(",{}", *figure) : ",";
    }
    text += ',' + pliant::csv_field(result.message) + '\n';
  }
  return text;
}

}  // namespace pliant_sweep
