// The window as a program opens it.
#include <memory>
#include <utility>

#include "pliant_viewer/pliant_viewer.h"
#include "viewer/copied_scene.h"
#include "viewer/live_source.h"
#include "viewer/viewer.h"

namespace pliant_viewer {
namespace {

/// Gives the scene back, however the window ends.
class Loan {
 public:
  Loan(pliant::Scene& owner, LiveSource& shown) : owner_(owner), shown_(shown) {}
  ~Loan() { owner_ = shown_.live()->close(); }
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;

 private:
  pliant::Scene& owner_;
  LiveSource& shown_;
};

/// Takes the scene over. Where that does not come off, it is as it was, made again.
std::unique_ptr<LiveSource> take_over(pliant::Scene& scene, bool is_program, const Window& window) {
  const Remaker again = remaker_of(scene, is_program);
  try {
    return std::make_unique<LiveSource>(maker_of(std::move(scene), again), window.is_software() ? spare_threads() : 0,
                                        false, Window::wake);
  } catch (...) {
    scene = again.make();
    throw;
  }
}

void show(pliant::Scene& scene, const pliant::ViewOptions& options, Window& window) {
  const ProgramHooks hooks{options.before_step, options.restarted, options.rebuilt};
  const bool is_program = hooks.before_step || hooks.restarted || hooks.rebuilt;
  const std::unique_ptr<LiveSource> shown = take_over(scene, is_program, window);
  const Loan loan(scene, *shown);
  shown->live()->post([hooks](CommandContext& context) { context.session.set_hooks(hooks); });
  if (!options.paused) shown->play(true);
  ViewerOptions viewer_options;
  viewer_options.appearance = shown->appearance();
  viewer_options.settings_file = window_settings_path();
  Viewer viewer(window, *shown, std::move(viewer_options));
  viewer.run([&] { return options.should_close && options.should_close(); });
  viewer.finish_film();
}

/// What is the program's, and not the window's, to say, put back.
void put_back(const pliant::SceneSource& source, Index threads, pliant::Scene& scene) {
  scene.source = source;
  pliant::SolverSettings settings = scene.simulation.settings();
  if (threads != 0 || settings.threads != spare_threads()) return;
  settings.threads = 0;
  scene.simulation.set_settings(settings);
}

}  // namespace
}  // namespace pliant_viewer

namespace pliant {

void view(Scene& scene, const ViewOptions& options) {
  pliant_viewer::limit_software_driver();
  pliant_viewer::Window window(scene.name.empty() ? "Pliant" : scene.name + " - Pliant", scene.view.size[0],
                               scene.view.size[1]);
  const SceneSource source = scene.source;
  const Index threads = scene.simulation.settings().threads;
  try {
    pliant_viewer::show(scene, options, window);
  } catch (...) {
    pliant_viewer::put_back(source, threads, scene);
    throw;
  }
  pliant_viewer::put_back(source, threads, scene);
}

void view(Simulation& simulation, const ViewOptions& options) {
  Scene scene;
  scene.name = "simulation";
  scene.simulation = std::move(simulation);
  try {
    view(scene, options);
  } catch (...) {
    simulation = std::move(scene.simulation);
    throw;
  }
  simulation = std::move(scene.simulation);
}

}  // namespace pliant
