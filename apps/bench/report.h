#pragma once
// The results as people, programs and tables read them.
#include <string>

#include "bench/results.h"

namespace pliant_bench {

/// Tables with units, and how to read them.
std::string text_report(const BenchResult& result);

/// Everything, in seconds and bytes.
std::string json_report(const BenchResult& result);

/// One line for each time that was measured: workload, table, name, threads, min_s, median_s, times_eigen, bytes,
/// bytes_per_second, share_of_bandwidth. What does not apply is left empty.
std::string csv_report(const BenchResult& result);

}  // namespace pliant_bench
