#include "viewer/live_source.h"

#include <limits>

namespace pliant_viewer {

LiveSource::LiveSource(MakeScene make, Index threads, bool is_playing, std::function<void()> wake,
                       std::optional<SessionRecord> record)
    : scene_(std::move(make), threads, is_playing, std::move(wake), std::move(record)),
      history_(scene_.name()),
      is_playing_(is_playing) {
  take_snapshot();
}

void LiveSource::take_snapshot() {
  snapshot_ = &scene_.newest();
  for (const MeasuredStep& step : snapshot_->measured) history_.add(step);
}

bool LiveSource::refresh(Clock::time_point) {
  if (!scene_.has_news()) return false;
  take_snapshot();
  if (snapshot_->commands >= play_command_) is_playing_ = snapshot_->is_playing;
  return true;
}

Seconds LiveSource::time_to_news(Clock::time_point) const {
  return scene_.has_news() ? Seconds(0) : Seconds::max();
}

void LiveSource::show(pliant::ColorBy color) {
  scene_.post([color](CommandContext& context) { context.color = color; });
}

void LiveSource::measure(const Measuring& measuring) {
  if (measuring == measuring_) return;
  measuring_ = measuring;
  scene_.post([measuring](CommandContext& context) { context.measuring = measuring; }, LiveScene::Kind::steers);
}

void LiveSource::hold_at(std::optional<double> time) {
  scene_.hold_at(time.value_or(std::numeric_limits<double>::infinity()));
}

void LiveSource::set_speed(std::optional<double> speed) {
  speed_ = speed.value_or(speed_);
  is_unlimited_ = !speed;
  const double wanted = speed.value_or(Pacer::unlimited);
  scene_.post([wanted](CommandContext& context) { context.pacer.set_speed(wanted); });
}

void LiveSource::play(bool on) {
  is_playing_ = on;
  play_command_ = scene_.post([on](CommandContext& context) { context.is_playing = on; });
}

void LiveSource::step(int direction) {
  if (direction < 0) return;
  is_playing_ = false;
  play_command_ = scene_.post(
      [](CommandContext& context) {
        context.is_playing = false;
        ++context.single_steps;
      },
      LiveScene::Kind::steers);
}

bool LiveSource::is_stepping() const {
  return snapshot_->single_steps > 0 || snapshot_->commands < play_command_;
}

void LiveSource::restart(bool keep_values) {
  scene_.post([keep_values](CommandContext& context) { context.restart(keep_values); }, LiveScene::Kind::ends);
}

}  // namespace pliant_viewer
