#include "viewer/plot_files.h"

#include <fmt/format.h>

#include "pliant_io/files/atomic_file.h"

namespace pliant_viewer {

namespace fs = std::filesystem;

fs::path free_file(const fs::path& folder, const std::string& scene, const std::string& what,
                   const std::string& ending) {
  std::string base = fs::path(scene).filename().string();
  if (base.empty() || base == "." || base == "..") base = "scene";
  fs::path file;
  for (int number = 1; file.empty() || fs::exists(fs::symlink_status(file)); ++number) {
    file = folder / fmt::format("{}-{}-{}{}", base, what, number, ending);
  }
  return file;
}

std::string saved_names(const std::vector<fs::path>& files) {
  std::string names = files.front().lexically_normal().string();
  for (std::size_t i = 1; i < files.size(); ++i) {
    names += (i + 1 == files.size() ? " and " : ", ") + files[i].filename().string();
  }
  return names;
}

fs::path save_measured(const pliant_plot::MeasuredRun& run, const fs::path& folder) {
  const fs::path file = free_file(folder, run.name, "measurements", ".csv");
  pliant::write_file_atomically(file, to_csv(run.table));
  return file;
}

std::vector<fs::path> save_plots(const std::vector<pliant_report::Plot>& plots, const std::string& scene,
                                 const fs::path& folder) {
  std::vector<fs::path> files;
  for (const pliant_report::Plot& plot : plots) {
    files.push_back(free_file(folder, scene, "plot", ".svg"));
    pliant::write_file_atomically(files.back(), to_svg(plot, true));
  }
  return files;
}

}  // namespace pliant_viewer
