#include "report_files.h"

#include <system_error>

#include <fmt/format.h>

#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"
#include "system/child_process.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;

fs::path figures_of(const fs::path& folder) {
  return folder / "figures";
}

/// Whether rsvg-convert is there and has made it.
bool convert_to_pdf(const fs::path& svg) {
  fs::path pdf = svg;
  pdf.replace_extension(".pdf");
  // A name that begins with a dash would be an option.
  const auto name = [](const fs::path& path) { return fs::absolute(path).string(); };
  pliant_system::ChildProcess process({"rsvg-convert", {"--format", "pdf", "--output", name(pdf), name(svg)}});
  process.end_input();
  const pliant_system::ProcessEnd end = process.wait();
  if (end.signal == 0 && end.exit_code == 0) return true;
  print_to_stderr(fmt::format("warning: figures are left out as PDF: rsvg-convert failed on {}, {}\n",
                              pliant::printable_place(svg.string()), end_text(end)));
  return false;
}

}  // namespace

void write_report(const pliant_report::Report& report, const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(figures_of(folder), failed);
  for (const pliant_report::FigureFile& file : pliant_report::figure_files(report)) {
    pliant::write_file_atomically(figures_of(folder) / file.name, file.content);
  }
  pliant::write_file_atomically(folder / "index.html", to_html(report));
  pliant::write_file_atomically(folder / "report.json", to_json(report));
}

void write_pdfs(const pliant_report::Report& report, const fs::path& folder) {
  try {
    for (const pliant_report::FigureFile& file : pliant_report::figure_files(report)) {
      const fs::path place = figures_of(folder) / file.name;
      if (place.extension() == ".svg" && !convert_to_pdf(place)) return;
    }
  } catch (const std::system_error&) {
    print_to_stderr(
        "note: figures are left out as PDF: there is no rsvg-convert here (Debian: librsvg2-bin); they are there as "
        "SVG\n");
  }
}

}  // namespace pliant_cli
