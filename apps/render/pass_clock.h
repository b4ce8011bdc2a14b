#pragma once
// How long each pass of a picture takes.
#include <string>
#include <string_view>
#include <vector>

#include "pliant/core/stopwatch.h"

namespace pliant_render {

/// Waits for the driver after each pass, so that a picture takes longer on it than without.
class PassClock {
 public:
  /// What follows belongs to a picture. Needs a current OpenGL context.
  void begin();
  /// What came since the last call belongs to this pass; a name may come several times in a picture.
  void end(std::string_view pass);
  /// A table: the median of each pass and of their sum [ms], the first picture left out where there are others, in
  /// which drivers compile.
  std::string text() const;

 private:
  struct Pass {
    std::string name;
    std::vector<double> seconds{};  ///< of each picture
  };

  std::vector<Pass> passes_;  // in the order in which they came first
  std::size_t pictures_ = 0;
  pliant::Stopwatch watch_;
};

}  // namespace pliant_render
