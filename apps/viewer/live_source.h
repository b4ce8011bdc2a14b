#pragma once
// A simulated scene as a source of the view.
#include "viewer/live_scene.h"
#include "viewer/panels/body_panel.h"
#include "viewer/panels/parameter_panel.h"
#include "viewer/view_source.h"

namespace pliant_viewer {

class LiveSource final : public ViewSource {
 public:
  /// `record`: see LiveScene.
  LiveSource(MakeScene make, Index threads, bool is_playing, std::function<void()> wake,
             std::optional<SessionRecord> record = {});

  const std::string& name() const override { return scene_.name(); }
  const pliant::ViewSettings& appearance() const override { return scene_.appearance(); }
  bool refresh(Clock::time_point now) override;
  Seconds time_to_news(Clock::time_point now) const override;
  const pliant_render::ClipFrame& frame() const override { return snapshot_->frame; }
  std::shared_ptr<const pliant_render::RenderMesh> render_mesh() const override { return snapshot_->render_mesh; }
  std::uint64_t restarts() const override { return snapshot_->restarts; }
  bool knows(pliant::ColorBy) const override { return true; }
  void show(pliant::ColorBy color) override;
  pliant::ColorBy color() const override { return snapshot_->color; }
  bool is_playing() const override { return is_playing_; }
  void play(bool on) override;
  void step(int direction) override;
  bool is_stepping() const override;
  void restart(bool keep_values) override;
  double speed() const override { return is_unlimited_ ? 1 : speed_; }
  /// Simulated seconds in a second; none: as fast as the machine can.
  void set_speed(std::optional<double> speed);
  void hold_at(std::optional<double> time) override;
  const pliant_plot::MeasuredRun* measured() const override { return &history_.run(); }
  std::uint64_t measured_version() const override { return history_.version(); }
  void measure(const Measuring& measuring) override;
  void draw_panel(const std::string& selected_collider) override;
  std::string take_clicked_collider() override { return parameters_.take_clicked_collider(); }
  bool shows_forces() const override { return parameters_.shows_forces(); }
  LiveScene* live() override { return &scene_; }

  const Snapshot& snapshot() const { return *snapshot_; }
  const ParameterPanel& parameter_panel() const { return parameters_; }
  const BodyPanel& body_panel() const { return bodies_; }
  const MaterialPanel& material_panel() const { return bodies_.materials(); }

 private:
  void draw_pace();
  void take_snapshot();

  LiveScene scene_;
  const Snapshot* snapshot_ = nullptr;
  History history_;
  Measuring measuring_;
  bool is_playing_;                 // as requested; the snapshot follows a little later
  std::uint64_t play_command_ = 0;  // that requested it
  double speed_ = 1;
  bool is_unlimited_ = false;
  BodyPanel bodies_;
  ParameterPanel parameters_;
};

}  // namespace pliant_viewer
