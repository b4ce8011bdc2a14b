#include "viewer/plot_files.h"

#include "pliant_io/files/atomic_file.h"
#include "viewer/free_name.h"

namespace pliant_viewer {

namespace fs = std::filesystem;

std::string saved_names(const std::vector<fs::path>& files) {
  std::string names = files.front().lexically_normal().string();
  for (std::size_t i = 1; i < files.size(); ++i) {
    names += (i + 1 == files.size() ? " and " : ", ") + files[i].filename().string();
  }
  return names;
}

fs::path save_measured(const pliant_plot::MeasuredRun& run, const fs::path& folder) {
  const fs::path file = free_name(folder, run.name, {".csv"}, "measurements");
  pliant::write_file_atomically(file, to_csv(run.table));
  return file;
}

std::vector<fs::path> save_plots(const std::vector<pliant_report::Plot>& plots, const std::string& scene,
                                 const fs::path& folder) {
  std::vector<fs::path> files;
  for (const pliant_report::Plot& plot : plots) {
    files.push_back(free_name(folder, scene, {".svg"}, "plot"));
    pliant::write_file_atomically(files.back(), to_svg(plot, true));
  }
  return files;
}

}  // namespace pliant_viewer
