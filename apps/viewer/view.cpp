// The window as a program opens it.
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

void show(pliant::Scene& scene, const pliant::ViewOptions& options, Window& window) {
  const bool has_hooks = options.before_step || options.restarted;
  LiveSource shown(maker_of(std::move(scene), has_hooks), window.is_software() ? spare_threads() : 0, false,
                   Window::wake);
  const Loan loan(scene, shown);
  const ProgramHooks hooks{options.before_step, options.restarted};
  shown.live()->post([hooks](CommandContext& context) { context.session.set_hooks(hooks); });
  if (!options.paused) shown.play(true);
  ViewerOptions viewer_options;
  viewer_options.appearance = shown.appearance();
  Viewer viewer(window, shown, std::move(viewer_options));
  viewer.run([&] { return options.should_close && options.should_close(); });
  viewer.finish_film();
}

/// What is the program's, and not the window's, to say.
class Kept {
 public:
  explicit Kept(pliant::Scene& scene) : scene_(scene), source_(scene.source), threads_(threads()) {}
  ~Kept() {
    scene_.source = std::move(source_);
    if (threads_ != 0 || threads() != spare_threads()) return;
    pliant::SolverSettings settings = scene_.simulation.settings();
    settings.threads = 0;
    scene_.simulation.set_settings(settings);
  }
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

 private:
  Index threads() const { return scene_.simulation.settings().threads; }

  pliant::Scene& scene_;
  pliant::SceneSource source_;
  Index threads_;
};

}  // namespace
}  // namespace pliant_viewer

namespace pliant {

void view(Scene& scene, const ViewOptions& options) {
  pliant_viewer::limit_software_driver();
  pliant_viewer::Window window(scene.name.empty() ? "Pliant" : scene.name + " - Pliant", scene.view.size[0],
                               scene.view.size[1]);
  const pliant_viewer::Kept kept(scene);
  pliant_viewer::show(scene, options, window);
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
