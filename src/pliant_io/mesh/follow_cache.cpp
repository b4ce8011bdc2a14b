#include "pliant_io/mesh/follow_cache.h"

namespace pliant {
namespace {

class CachedAnimation final : public PointAnimation {
 public:
  explicit CachedAnimation(PointCache cache) : cache_(std::move(cache)) {}

  Index point_count() const override { return cache_.vertex_count(); }
  Real duration() const override { return cache_.time(cache_.frame_count() - 1) - cache_.time(0); }
  void sample(Real elapsed, Positions& positions) override { cache_.sample(cache_.time(0) + elapsed, positions); }

 private:
  PointCache cache_;
};

}  // namespace

std::shared_ptr<PointAnimation> cached_animation(PointCache cache) {
  return std::make_shared<CachedAnimation>(std::move(cache));
}

std::shared_ptr<Path> follow_cache(PointCache cache, std::vector<Index> vertices, Attach attach) {
  return follow_animation(cached_animation(std::move(cache)), std::move(vertices), attach);
}

}  // namespace pliant
