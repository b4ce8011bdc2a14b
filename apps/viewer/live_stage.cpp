#include "viewer/live_stage.h"

namespace pliant_viewer {

LiveStage::LiveStage(MakeScene make, Index threads, bool is_playing, std::function<void()> wake)
    : scene_(std::move(make), threads, is_playing, std::move(wake)),
      snapshot_(&scene_.newest()),
      is_playing_(is_playing) {}

bool LiveStage::refresh(Clock::time_point) {
  if (!scene_.has_news()) return false;
  snapshot_ = &scene_.newest();
  if (snapshot_->commands >= play_command_) is_playing_ = snapshot_->is_playing;
  return true;
}

Seconds LiveStage::time_to_news(Clock::time_point) const {
  return scene_.has_news() ? Seconds(0) : Seconds::max();
}

void LiveStage::show(pliant::ColorBy color) {
  scene_.post([color](Workshop& workshop) { workshop.color = color; });
}

void LiveStage::play(bool on) {
  is_playing_ = on;
  play_command_ = scene_.post([on](Workshop& workshop) { workshop.is_playing = on; });
}

void LiveStage::step(int direction) {
  if (direction < 0) return;
  is_playing_ = false;
  play_command_ = scene_.post(
      [](Workshop& workshop) {
        workshop.is_playing = false;
        workshop.single_steps = 1;  // a key that is held asks for no more than are taken
      },
      LiveScene::Kind::steers);
}

void LiveStage::restart(bool keep_values) {
  scene_.post([keep_values](Workshop& workshop) { workshop.restart(keep_values); }, LiveScene::Kind::ends);
}

}  // namespace pliant_viewer
