#pragma once
// A report as files in a folder.
#include <filesystem>

#include "report/report.h"

namespace pliant_cli {

/// index.html, report.json, and a file for each figure and table in figures/; whole files of what is there so far.
void write_report(const pliant_report::Report& report, const std::filesystem::path& folder);

/// Figures as PDF beside their SVG, by rsvg-convert; where there is none, or where it fails, says so on standard error.
void write_pdfs(const pliant_report::Report& report, const std::filesystem::path& folder);

}  // namespace pliant_cli
