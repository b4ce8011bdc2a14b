#pragma once
// Numbers as print has them: 4.2e+05 becomes 4.2·10⁵.
#include "report/report.h"

namespace pliant_report {

/// The text with its numbers in exponent notation written as powers of ten; nothing else is changed.
std::string with_powers(std::string_view text);

/// The same for every text of a plot or a report that people read. Names of chapters stay, since they are anchors.
Plot with_powers(Plot plot);
Report with_powers(Report report);

}  // namespace pliant_report
