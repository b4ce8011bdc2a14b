#include "bench/figures.h"

namespace pliant_bench {

std::optional<double> times_eigen(const WorkloadResult& workload, const Seconds& seconds) {
  const BaselineResult* eigen = workload.baseline("Eigen");
  if (eigen == nullptr || !(eigen->seconds.median > 0)) return std::nullopt;
  return seconds.median / eigen->seconds.median;
}

double ratio(const Seconds& slow, const Seconds& fast) {
  return fast.median > 0 ? slow.median / fast.median : 0;
}

std::optional<Seconds> best_cholmod(const WorkloadResult& workload) {
  const BaselineResult* simplicial = workload.baseline("CHOLMOD simplicial");
  const BaselineResult* supernodal = workload.baseline("CHOLMOD supernodal");
  if (simplicial == nullptr || supernodal == nullptr) return std::nullopt;
  return simplicial->seconds.median < supernodal->seconds.median ? simplicial->seconds : supernodal->seconds;
}

std::optional<double> speed(const Phase& phase) {
  if (!phase.bytes || !(phase.seconds.min > 0)) return std::nullopt;
  return static_cast<double>(*phase.bytes) / phase.seconds.min;
}

std::optional<double> share(const WorkloadResult& workload, const Phase& phase) {
  const std::optional<double> bytes_per_second = speed(phase);
  if (!workload.read_bytes_per_second || !bytes_per_second) return std::nullopt;
  return *bytes_per_second / *workload.read_bytes_per_second;
}

}  // namespace pliant_bench
