#pragma once
// What a window shows: a scene that is simulated, or a run that was recorded.
#include <memory>

#include "render/take.h"
#include "viewer/pacer.h"

namespace pliant_viewer {

class LiveScene;

class Stage {
 public:
  virtual ~Stage() = default;

  virtual const std::string& name() const = 0;
  virtual const pliant::ViewSettings& look() const = 0;

  /// Takes over the newest frame; whether that is another one than before.
  virtual bool refresh(Clock::time_point now) = 0;
  /// Until refresh() will have another one, where that is known beforehand.
  virtual Seconds time_to_news(Clock::time_point now) const = 0;
  virtual const pliant_render::TakeFrame& frame() const = 0;
  /// Another pointer when it is another one.
  virtual std::shared_ptr<const pliant_render::Scenery> scenery() const = 0;
  /// How often everything was begun anew.
  virtual std::uint64_t restarts() const = 0;

  virtual bool knows(pliant::ColorBy color) const = 0;
  virtual void show(pliant::ColorBy color) = 0;
  /// What the values of the frame tell, which is a little later what was asked for.
  virtual pliant::ColorBy color() const = 0;
  /// The ends of the color map, where they are known for all frames.
  virtual std::optional<std::array<float, 2>> range() const { return {}; }

  /// The box around all frames, where they are known.
  virtual std::optional<pliant_render::Bounds> known_bounds() const { return {}; }

  virtual bool is_playing() const = 0;
  virtual void play(bool on) = 0;
  /// One step or frame on, or back where that is possible.
  virtual void step(int direction) = 0;
  /// `keep_values`: with what was set since.
  virtual void restart(bool keep_values) = 0;

  /// Draws its part of the panel.
  virtual void draw_panel() = 0;
  /// What can be pulled and pinned; null for what is only played.
  virtual LiveScene* live() { return nullptr; }
};

}  // namespace pliant_viewer
