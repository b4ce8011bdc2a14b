#include "viewer/playback.h"

#include <algorithm>

#include "render/outline.h"

namespace pliant_viewer {
namespace {

constexpr Seconds rest_at_end{0.5};  // before it starts over

}  // namespace

Playback::Playback(pliant_render::RunFrames frames, pliant::ViewSettings appearance, bool is_playing)
    : frames_(std::move(frames)),
      appearance_(std::move(appearance)),
      render_mesh_(std::make_shared<const pliant_render::RenderMesh>(frames_.render_mesh())),
      color_(knows(appearance_.color) ? appearance_.color : pliant::ColorBy::none),
      is_playing_(is_playing && frames_.count() > 1),
      began_(Clock::now()),
      began_at_(frames_.time(0)) {
  pliant_render::Outline outline;
  for (std::size_t i = 0; i < frames_.count(); ++i) {
    outline.add(frames_.frame(i, pliant::ColorBy::none).content, appearance_);
  }
  bounds_ = outline.bounds();
  show(color_);
  refresh(began_);
  has_begun_ = false;
}

double Playback::run_time(Clock::time_point now) const {
  if (!is_playing_) return frames_.time(place_);
  const double time = began_at_ + speed_ * Seconds(now - began_).count();
  return hold_ ? std::min(time, *hold_) : time;
}

bool Playback::refresh(Clock::time_point now) {
  if (!has_begun_) began_ = now;  // time spent before the first refresh does not count
  has_begun_ = true;
  if (is_playing_) {
    const double time = run_time(now);
    std::size_t next = place_;
    while (next + 1 < count() && frames_.time(next + 1) <= time) ++next;
    if (next != place_) is_stale_ = true;
    place_ = next;
    const double end = frames_.time(count() - 1);
    if (place_ + 1 == count() && !is_looping_) play(false);
    if (is_looping_ && time > end + speed_ * rest_at_end.count()) go_to(0);
  }
  if (!is_stale_) return false;
  frame_ = frames_.frame(place_, color_);
  is_stale_ = false;
  return true;
}

Seconds Playback::time_to_news(Clock::time_point now) const {
  if (is_stale_) return Seconds(0);
  if (!is_playing_) return Seconds::max();
  if (place_ + 1 >= count()) return rest_at_end;
  return Seconds(std::max(0.0, (frames_.time(place_ + 1) - run_time(now)) / speed_));
}

void Playback::show(pliant::ColorBy color) {
  color_ = color;
  is_stale_ = true;
  if (color == pliant::ColorBy::none || ranges_.contains(color)) return;
  std::vector<float> extremes;
  for (std::size_t i = 0; i < count(); ++i) {
    const std::vector<float> values = frames_.frame(i, color).content.values;
    const auto [least, most] = std::ranges::minmax_element(values);
    if (least == values.end()) continue;
    extremes.push_back(*least);
    extremes.push_back(*most);
  }
  ranges_[color] = pliant_render::field_range(color, extremes);
}

std::optional<std::array<float, 2>> Playback::range() const {
  const auto found = ranges_.find(color_);
  if (found == ranges_.end()) return {};
  return found->second;
}

void Playback::play(bool on) {
  if (on && place_ + 1 == count()) go_to(0);
  is_playing_ = on && count() > 1;
  began_ = Clock::now();
  began_at_ = frames_.time(place_);
}

void Playback::step(int direction) {
  play(false);
  if (direction < 0 && place_ > 0) go_to(place_ - 1);
  if (direction > 0 && place_ + 1 < count()) go_to(place_ + 1);
}

void Playback::restart(bool) {
  go_to(0);
}

void Playback::hold_at(std::optional<double> time) {
  began_at_ = run_time(Clock::now());
  began_ = Clock::now();
  hold_.reset();
  for (std::size_t i = place_; time && !hold_ && i < count(); ++i) {
    if (frames_.time(i) >= *time) hold_ = frames_.time(i);
  }
}

void Playback::go_to(std::size_t frame) {
  ++cuts_;
  hold_.reset();
  is_stale_ = true;
  place_ = std::min(frame, count() - 1);
  began_ = Clock::now();
  began_at_ = frames_.time(place_);
}

void Playback::set_speed(double speed) {
  began_at_ = run_time(Clock::now());
  began_ = Clock::now();
  speed_ = speed;
}

}  // namespace pliant_viewer
