#pragma once
// A scene that is simulated in a thread of its own. The window sends it commands through one queue and takes over what
// it shows last; neither waits for the other.
#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "render/take.h"
#include "viewer/pulse.h"
#include "viewer/session.h"

namespace pliant_viewer {

/// What the window is shown: everything of one moment.
struct Snapshot {
  std::shared_ptr<const pliant_render::Scenery> scenery;
  pliant_render::TakeFrame frame;
  pliant::ColorBy color = pliant::ColorBy::none;  ///< that the values of the frame are for
  std::vector<std::uint32_t> pins;                ///< vertices that can be taken hold of, ascending
  std::optional<Pull> pull;
  std::shared_ptr<const std::vector<Parameter>> parameters;
  Pulse::Means pulse;
  std::int64_t step = 0;
  double time_step = 0;
  bool is_playing = false;
  bool is_behind = false;      ///< behind the clock by as much as it may be
  std::string note;            ///< what went wrong last, or should be known; empty for nothing
  std::uint64_t restarts = 0;  ///< how often the scene was begun anew
  std::uint64_t commands = 0;  ///< how many of the commands have acted
};

/// What commands act on, in the thread of the simulation.
struct Workshop {
  Session& session;
  Pacer& pacer;
  bool is_playing = false;
  std::int64_t single_steps = 0;  ///< to take although it is not playing
  pliant::ColorBy color = pliant::ColorBy::none;
  std::uint64_t restarts = 0;

  /// As Session::restart, and single steps that were asked for are forgotten.
  void restart(bool keep_values) {
    session.restart(keep_values);
    single_steps = 0;
    ++restarts;
  }
};

class LiveScene {
 public:
  using Command = std::function<void(Workshop&)>;
  /// Steers: what follows the mouse, of which many come. Changes: all others; a step that takes long is given up for
  /// them. Ends: a step is given up at once.
  enum class Kind { steers, changes, ends };

  /// Makes the scene on this thread, which throws what that throws, then simulates on another. `wake` is called there
  /// when there is something new. Of threads the simulation takes as many as the scene says, or, where that leaves it
  /// open, at most `threads`.
  LiveScene(MakeScene make, Index threads, bool is_playing, std::function<void()> wake);
  ~LiveScene();
  LiveScene(const LiveScene&) = delete;
  LiveScene& operator=(const LiveScene&) = delete;

  /// Hands over a command; what it throws becomes the note of a snapshot. Returns its number, see Snapshot::commands.
  std::uint64_t post(Command command, Kind kind = Kind::changes);

  /// The newest snapshot; it stays valid until the next call.
  const Snapshot& newest();
  /// What newest() returned last.
  const Snapshot& shown() const { return front_; }
  /// Whether there is one that newest() has not returned yet.
  bool has_news() const;
  /// How long the step under way has taken; zero between steps.
  Seconds step_age() const;
  const pliant::ViewSettings& look() const { return look_; }
  const std::string& name() const { return name_; }
  Real suggested_pull() const { return suggested_pull_; }

 private:
  void work();
  void turn();
  void run_commands();
  void wait_for_work();
  void step();
  void update_scenery();
  Seconds time_to_step();
  void publish();
  void list_parameters();
  bool shall_give_up() const;
  void set_thread_count();

  Session session_;
  Pacer pacer_;
  Workshop workshop_;
  Index threads_;
  std::function<void()> wake_;
  pliant::ViewSettings look_;
  std::string name_;
  Real suggested_pull_ = 1;

  // Of the simulation's thread alone.
  Pulse pulse_;
  std::shared_ptr<const pliant_render::Scenery> scenery_;
  std::string note_;
  Clock::time_point published_{};
  std::uint64_t commands_done_ = 0;
  std::uint64_t commands_published_ = 0;
  std::uint64_t restarts_seen_ = 0;
  std::shared_ptr<const std::vector<Parameter>> parameters_;
  Clock::time_point parameters_listed_{};
  std::uint64_t commands_listed_ = ~std::uint64_t{0};
  bool is_dirty_ = true;

  // Of both.
  mutable std::mutex mutex_;
  std::condition_variable work_;
  std::deque<std::pair<Command, Kind>> queue_;
  std::uint64_t commands_posted_ = 0;
  std::atomic<Clock::rep> step_began_ = 0;  // 0: between steps
  std::atomic<int> changes_waiting_ = 0;
  std::atomic<int> ends_waiting_ = 0;
  std::atomic<bool> is_closing_ = false;
  bool has_news_ = false;
  Snapshot middle_;  // handed from one to the other

  Snapshot back_;   // of the simulation's thread
  Snapshot front_;  // of the window's
  std::thread thread_;
};

}  // namespace pliant_viewer
