#include "report/report.h"

#include <algorithm>

namespace pliant_report {

int count(const Report& report, Verdict verdict) {
  std::ptrdiff_t sum = 0;
  for (const Chapter& chapter : report.chapters) {
    sum += std::count_if(chapter.claims.begin(), chapter.claims.end(),
                         [=](const Claim& claim) { return claim.verdict == verdict; });
  }
  return static_cast<int>(sum);
}

}  // namespace pliant_report
