#pragma once
// What every experiment is given: scenes, a camera, a place to say how far it is.
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/scene/scene.h"
#include "render/image.h"
#include "report/report.h"

namespace pliant_experiments {

using Sets = std::vector<std::string>;  ///< "PATH=VALUE" each, as `pliant run --set` takes them

class Lab {
 public:
  struct Options {
    bool draws = true;  ///< pictures; without, they are left out
    std::function<void(std::string_view)> progress = [](std::string_view) {};
    std::function<bool()> stop = [] { return false; };  ///< asked between steps
  };
  explicit Lab(Options options) : options_(std::move(options)) {}

  /// "damping/curtain": experiments/damping/curtain.json with other values. Throws Error(input) on a scene that there
  /// is not, or values that do not fit.
  pliant::Scene scene(std::string_view name, const Sets& sets = {}) const;
  /// The same of a built-in scene.
  pliant::Scene builtin_scene(std::string_view name, const Sets& sets = {}) const;

  /// Takes one step of the scene; throws Error(interrupted) when the experiments are to end.
  pliant::StepReport step(pliant::Scene& scene) const;
  void step(pliant::Scene& scene, std::int64_t count) const {
    for (std::int64_t i = 0; i < count; ++i) step(scene);
  }
  /// The same; false where the scene has diverged on the way.
  bool try_steps(pliant::Scene& scene, std::int64_t count) const;

  /// Says what is under way.
  void say(std::string_view what) const { options_.progress(what); }

  /// The scene as it is now, in the look that it has; of no pixels where pictures are left out.
  pliant_render::Image picture(const pliant::Scene& scene) const;
  /// Adds pictures to a chapter, beside each other in so many columns; nothing where they are left out.
  void show(pliant_report::Chapter& chapter, const std::vector<pliant_render::Image>& pictures, int columns,
            std::string caption) const;
  /// Both, of one picture.
  void draw(pliant_report::Chapter& chapter, const pliant::Scene& scene, std::string caption) const {
    show(chapter, {picture(scene)}, 1, std::move(caption));
  }

 private:
  Options options_;
};

}  // namespace pliant_experiments
