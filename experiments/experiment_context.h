#pragma once
// What every experiment is given: scenes, pictures and a way to report progress.
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/scene/scene.h"
#include "render/image.h"
#include "report/report.h"

namespace pliant_experiments {

using Sets = std::vector<std::string>;  ///< "PATH=VALUE" each, as `pliant run --set` takes them

enum class Winds { kept, left_out };

class ExperimentContext {
 public:
  struct Options {
    bool draws = true;                                                         ///< whether pictures are drawn
    unsigned seed = 0;                                                         ///< see seed()
    std::function<void(std::string_view)> progress = [](std::string_view) {};  ///< told what is under way
    std::function<bool()> stop = [] { return false; };                         ///< asked between steps whether to end
  };
  explicit ExperimentContext(Options options) : options_(std::move(options)) {}

  /// "damping/curtain" is experiments/damping/curtain.json, with the values of `sets` in place of its own.
  /// @throws pliant::Error (input) for an unknown scene or invalid values
  pliant::Scene scene(std::string_view name, const Sets& sets = {}) const;
  /// The same for a built-in scene.
  pliant::Scene builtin_scene(std::string_view name, const Sets& sets = {}) const;

  /// The same without colliders, contact between surfaces and, if asked, winds, and without what moves or changes
  /// these; with 10 iterations where it has no number of its own.
  pliant::Scene builtin_scene_without_contact(std::string_view name, Winds winds, const Sets& sets = {}) const;

  /// Takes one step. @throws pliant::Error (interrupted) when the experiments are to end
  pliant::StepReport step(pliant::Scene& scene) const;
  void step(pliant::Scene& scene, std::int64_t count) const {
    for (std::int64_t i = 0; i < count; ++i) step(scene);
  }
  /// The same; returns false if the scene diverges on the way.
  bool try_steps(pliant::Scene& scene, std::int64_t count) const;

  /// 0: scenes begin as they are written, and what is random is as it has always been. Another number: both are others,
  /// by disturb() too little to be seen. Verdicts should be the same.
  unsigned seed() const { return options_.seed; }
  /// Moves every vertex that no hard pin holds by up to a millionth of a meter in each direction, by chance, as seed
  /// and repeat have it; leaves the scene as it is where both are 0.
  void disturb(pliant::Scene& scene, unsigned repeat = 0) const;

  /// Reports what is under way.
  void say(std::string_view what) const { options_.progress(what); }

  /// A picture of the current state in the appearance that the scene has; empty if pictures are left out.
  pliant_render::Image picture(const pliant::Scene& scene) const;
  /// Adds pictures to a chapter, side by side in `columns` columns; does nothing if pictures are left out.
  void show(pliant_report::Chapter& chapter, const std::vector<pliant_render::Image>& pictures, int columns,
            std::string caption) const;
  /// Adds one picture of the scene.
  void draw(pliant_report::Chapter& chapter, const pliant::Scene& scene, std::string caption) const {
    show(chapter, {picture(scene)}, 1, std::move(caption));
  }

 private:
  Options options_;
};

}  // namespace pliant_experiments
