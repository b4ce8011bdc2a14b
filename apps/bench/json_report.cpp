#include <nlohmann/json.hpp>

#include "bench/figures.h"
#include "bench/report.h"
#include "pliant/core/version.h"

namespace pliant_bench {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json optional_json(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json seconds_json(const Seconds& seconds) {
  return {{"min", seconds.min}, {"median", seconds.median}};
}

Json machine_json(const Machine& machine) {
  return {{"processor", machine.processor},
          {"processors", machine.processors},
          {"compiler", machine.compiler},
          {"eigen", machine.eigen},
          {"cholmod", machine.cholmod.empty() ? Json(nullptr) : Json(machine.cholmod)},
          {"instruction_set", machine.instruction_set}};
}

Json levels_json(const std::vector<Level>& levels) {
  Json list = Json::array();
  for (const Level& level : levels) {
    list.push_back({{"name", level.name},
                    {"bytes", level.bytes > 0 ? Json(level.bytes) : Json(nullptr)},
                    {"buffer_bytes", level.buffer_bytes},
                    {"bytes_per_second", level.bytes_per_second}});
  }
  return list;
}

Json set_up_json(const SetUpResult& set_up) {
  return {{"mesh", set_up.mesh},
          {"constraints", set_up.constraints},
          {"layout", set_up.solver.layout},
          {"assembly", set_up.solver.assembly},
          {"symbolic", set_up.solver.symbolic},
          {"numeric", set_up.solver.numeric},
          {"repack", set_up.solver.repack},
          {"estimate", set_up.solver.estimate},
          {"total", set_up.total()},
          {"peak_bytes", optional_json(set_up.peak_bytes)}};
}

Json phases_json(const WorkloadResult& workload) {
  Json list = Json::array();
  for (const Phase& phase : workload.phases) {
    list.push_back({{"name", phase.name},
                    {"seconds", seconds_json(phase.seconds)},
                    {"times_eigen", optional_json(times_eigen(workload, phase.seconds))},
                    {"bytes", optional_json(phase.bytes)},
                    {"bytes_per_second", optional_json(speed(phase))},
                    {"share_of_bandwidth", optional_json(share(workload, phase))}});
  }
  return list;
}

Json baselines_json(const WorkloadResult& workload) {
  Json list = Json::array();
  for (const BaselineResult& each : workload.baselines) {
    list.push_back({{"name", each.name},
                    {"what", each.what},
                    {"seconds", seconds_json(each.seconds)},
                    {"times_eigen", optional_json(times_eigen(workload, each.seconds))},
                    {"difference", each.difference},
                    {"set_up_seconds", each.set_up_seconds},
                    {"peak_bytes", optional_json(each.peak_bytes)}});
  }
  return list;
}

Json threads_json(const WorkloadResult& workload) {
  Json list = Json::array();
  for (const ThreadsResult& each : workload.threads) {
    list.push_back({{"threads", each.threads},
                    {"used", each.used},
                    {"iteration_seconds", seconds_json(each.iteration)},
                    {"times_as_fast", ratio(workload.threads.front().iteration, each.iteration)},
                    {"same_bits", each.has_same_bits}});
  }
  return list;
}

Json workload_json(const BenchResult& result, const WorkloadResult& workload) {
  Json constraints = Json::object();
  for (const ConstraintCount& each : workload.constraints) constraints[each.type] = each.count;
  const Level* level = result.level_of(workload.working_set_bytes);
  return {{"name", workload.workload.name},
          {"vertices", workload.vertices},
          {"constraints", constraints},
          {"iterations", workload.workload.iterations},
          {"repeats", workload.repeats},
          {"backend", workload.backend},
          {"factor_entries", workload.factor_entries},
          {"panels", workload.panels},
          {"working_set_bytes", workload.working_set_bytes},
          {"level", level != nullptr ? Json(level->name) : Json(nullptr)},
          {"read_bytes_per_second", optional_json(workload.read_bytes_per_second)},
          {"phases", phases_json(workload)},
          {"baselines", baselines_json(workload)},
          {"threads", threads_json(workload)},
          {"set_up_seconds", set_up_json(workload.set_up)}};
}

Json contact_json(const std::vector<ContactResult>& results) {
  Json list = Json::array();
  for (const ContactResult& each : results) {
    Json runs = Json::array();
    for (const ContactRun& run : each.runs) {
      Json phases = Json::object();
      for (const Phase& phase : run.phases) phases[phase.name] = seconds_json(phase.seconds);
      runs.push_back({{"name", run.name},
                      {"step_seconds", seconds_json(run.step)},
                      {"times_plain", ratio(run.step, each.runs.front().step)},
                      {"phases", phases},
                      {"iterations", run.iterations},
                      {"backtracks", run.backtracks},
                      {"contacts", run.contacts},
                      {"pairs", run.pairs}});
    }
    list.push_back({{"name", each.workload.name},
                    {"vertices", each.vertices},
                    {"threads", each.threads},
                    {"rounds", each.rounds},
                    {"runs", runs}});
  }
  return list;
}

Json projections_json(const std::vector<ProjectionsResult>& projections) {
  Json list = Json::array();
  for (const ProjectionsResult& each : projections) {
    list.push_back({{"type", each.type},
                    {"count", each.count},
                    {"seconds", seconds_json(each.seconds)},
                    {"per_second", static_cast<double>(each.count) / each.seconds.median}});
  }
  return list;
}

Json times_to_error_json(const std::vector<TimeToErrorResult>& cases) {
  Json list = Json::array();
  for (const TimeToErrorResult& each : cases) {
    Json methods = Json::object(), last_errors = Json::object();
    for (const MethodResult& method : each.methods) {
      Json levels = Json::array();
      for (const ErrorLevel& level : method.levels) {
        levels.push_back({{"error", level.error},
                          {"iterations", optional_json(level.iterations)},
                          {"seconds", level.iterations ? seconds_json(level.seconds) : Json(nullptr)}});
      }
      methods[method.name] = levels;
      last_errors[method.name] = optional_json(method.last_error);
    }
    list.push_back({{"name", each.name},
                    {"description", each.description},
                    {"vertices", each.vertices},
                    {"uncertainty", each.uncertainty},
                    {"usual_error", each.usual_error},
                    {"methods", methods},
                    {"last_errors", last_errors}});
  }
  return list;
}

Json against_json(const std::vector<AgainstResult>& results) {
  Json list = Json::array();
  for (const AgainstResult& each : results) {
    list.push_back({{"name", each.name},
                    {"threads", each.threads},
                    {"iterations", each.iterations},
                    {"own_step_seconds", seconds_json(each.own_step)},
                    {"other_step_seconds", seconds_json(each.other_step)},
                    {"times_as_fast", each.times_as_fast}});
  }
  return list;
}

}  // namespace

std::string json_report(const BenchResult& result) {
  Json workloads = Json::array();
  for (const WorkloadResult& workload : result.workloads) workloads.push_back(workload_json(result, workload));
  const Json json = {{"pliant", pliant::version},
                     {"date", result.machine.date},
                     {"machine", machine_json(result.machine)},
                     {"levels", levels_json(result.levels)},
                     {"workloads", workloads},
                     {"contact", contact_json(result.contact)},
                     {"projections", projections_json(result.projections)},
                     {"time_to_error", times_to_error_json(result.times_to_error)},
                     {"against", against_json(result.against)}};
  return json.dump(2) + "\n";
}

}  // namespace pliant_bench
