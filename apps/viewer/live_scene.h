#pragma once
// A scene that is simulated in a thread of its own. The window sends commands through one queue and takes the newest
// snapshot; neither thread waits for the other.
#include <atomic>
#include <condition_variable>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>

#include "render/clip.h"
#include "viewer/frame_statistics.h"
#include "viewer/history.h"
#include "viewer/session.h"

namespace pliant_viewer {

/// Everything the window shows of one moment.
struct Snapshot {
  std::shared_ptr<const pliant_render::RenderMesh> render_mesh;
  std::shared_ptr<const std::vector<std::string>> body_names;
  pliant_render::ClipFrame frame;
  pliant::ColorBy color = pliant::ColorBy::none;       ///< what the values of the frame mean
  std::vector<std::uint32_t> pins;                     ///< pinned vertices, which can be grabbed, ascending
  std::vector<PinnedVertex> pinned;                    ///< the same, with where they are held
  std::vector<char> is_figure;                         ///< of each body, see Session::figures
  std::shared_ptr<const std::vector<char>> is_closed;  ///< of each body: a pressure can be in it
  std::optional<Pull> pull;
  std::shared_ptr<const std::vector<Slider>> sliders;
  std::shared_ptr<const std::vector<BodyMaterial>> materials;
  std::shared_ptr<const std::vector<PaintableGroup>> paintable;  ///< but for those of figures
  std::shared_ptr<const std::map<std::string, pliant::BodyAppearance>>
      appearances;                                                         ///< by body, of those that have one
  std::shared_ptr<const std::map<std::string, bool>> switches;             ///< by name, see Session::switches
  std::shared_ptr<const std::map<std::string, SwitchedOff>> switched_off;  ///< by name
  std::map<pliant::ColliderId, pliant::Wrench> wrenches;                   ///< what colliders felt in the last step
  std::map<pliant::ColliderId, MovableCollider> movable;                   ///< colliders that a hand can move
  std::vector<MeasuredStep> measured;  ///< since the snapshot that newest() returned before
  FrameStatistics::Means statistics;
  std::int64_t step = 0;
  std::int64_t single_steps = 0;  ///< still to take while paused
  double time_step = 0;
  bool is_playing = false;
  bool is_behind = false;      ///< as far behind the clock as the pacer allows
  std::string note;            ///< last error or warning; empty for none
  std::string message;         ///< what a command last said that it has done
  std::uint64_t messages = 0;  ///< number of such messages so far
  std::string undone_next;     ///< what undo would take back, and redo do again; empty: nothing
  std::string redone_next;
  std::uint64_t edits = 0;           ///< changes so far
  bool has_unsaved_changes = false;  ///< of the scene
  bool has_text = false;             ///< see Session::has_text
  bool is_replaying = false;         ///< a recorded session
  ReplayReport replayed;             ///< how far that is
  std::uint64_t restarts = 0;        ///< number of restarts so far
  std::uint64_t rebuilds = 0;        ///< see Session::rebuilds
  std::uint64_t commands = 0;        ///< number of commands that have taken effect
};

/// What commands act on, in the simulation's thread.
struct CommandContext {
  Session& session;
  Pacer& pacer;
  bool is_playing = false;
  std::int64_t single_steps = 0;  ///< still to take while paused
  pliant::ColorBy color = pliant::ColorBy::none;
  std::string painted = {};  ///< the group whose painted stiffness is shown; empty: none
  Measuring measuring = {};
  std::string message = {};  ///< for the user; empty: none

  /// As Session::restart; also drops single steps that were requested.
  void restart(bool keep_changes) {
    session.restart(keep_changes);
    single_steps = 0;
  }
};

class LiveScene {
 public:
  using Command = std::function<void(CommandContext&)>;
  /// steers: follows the mouse, sent many times a second. changes: everything else; a slow step is abandoned for it.
  /// ends: a step under way is abandoned at once.
  enum class Kind { steers, changes, ends };

  /// Makes the scene on the calling thread and lets its exceptions pass, then simulates on another thread, which calls
  /// `wake` whenever a new snapshot is ready. The simulation uses as many threads as the scene says, or at most
  /// `threads` where the scene leaves it open.
  /// `record`: a session to be replayed, whose scene `make` makes.
  LiveScene(MakeScene make, Index threads, bool is_playing, std::function<void()> wake,
            std::optional<SessionRecord> record = {});
  ~LiveScene();
  LiveScene(const LiveScene&) = delete;
  LiveScene& operator=(const LiveScene&) = delete;

  /// Ends the simulation's thread, in the middle of a step if there is one, and hands the scene out: the last call.
  pliant::Scene close();

  /// Queues a command; if it throws, the message becomes the note of a snapshot. Returns its number, to be compared
  /// with Snapshot::commands.
  std::uint64_t post(Command command, Kind kind = Kind::changes);

  /// Simulated time [s] from which on no step is taken until the next call, but for single steps; infinity: none.
  void hold_at(double time);

  /// The newest snapshot; it stays valid until the next call.
  const Snapshot& newest();
  /// The snapshot that newest() returned last.
  const Snapshot& shown() const { return front_; }
  /// Whether there is a snapshot that newest() has not returned yet.
  bool has_news() const;
  /// How long the current step has been running; zero between steps.
  Seconds step_age() const;
  const pliant::ViewSettings& appearance() const { return appearance_; }
  const std::string& name() const { return name_; }
  Real suggested_pull() const { return suggested_pull_; }

 private:
  void end();
  void work();
  void turn();
  void run_commands();
  void follow_session();
  void say(std::string message);
  void say_replay_ended();
  void wait_for_work();
  bool is_held() const { return session_.simulation().state().time >= hold_; }
  void hold_at_start();
  void step();
  void measure_start();
  void update_render_mesh();
  Seconds time_to_step();
  void publish();
  void update_sliders();
  void update_looks();
  void update_bodies();
  bool shall_give_up() const;
  void set_thread_count();

  Session session_;
  Pacer pacer_;
  CommandContext context_;
  Index threads_;
  std::function<void()> wake_;
  pliant::ViewSettings appearance_;
  std::string name_;
  Real suggested_pull_ = 1;

  // Used by the simulation's thread alone.
  FrameStatistics statistics_;
  StepMeasurer measurer_;
  std::vector<MeasuredStep> measured_;  // not in a snapshot yet
  bool is_at_start_ = true;             // no step since the scene was made or began anew
  std::shared_ptr<const pliant_render::RenderMesh> render_mesh_;
  std::shared_ptr<const std::vector<std::string>> body_names_;
  std::shared_ptr<const std::vector<char>> is_closed_;
  pliant_render::ColliderSurfaces surfaces_;
  std::string note_;
  Clock::time_point published_{};
  std::uint64_t commands_done_ = 0;
  std::uint64_t commands_published_ = 0;
  std::uint64_t restarts_seen_ = 0;
  std::uint64_t rebuilds_seen_ = 0, looks_seen_ = 0;
  std::string painted_seen_;
  std::string message_;
  std::uint64_t messages_ = 0;
  std::shared_ptr<const std::vector<Slider>> sliders_;
  std::shared_ptr<const std::vector<BodyMaterial>> materials_;
  std::shared_ptr<const std::vector<PaintableGroup>> paintable_;
  std::shared_ptr<const std::map<std::string, pliant::BodyAppearance>> appearances_;
  std::shared_ptr<const std::map<std::string, bool>> switches_;
  std::shared_ptr<const std::map<std::string, SwitchedOff>> switched_off_;
  Clock::time_point sliders_listed_{};
  std::uint64_t commands_listed_ = ~std::uint64_t{0};
  bool is_dirty_ = true;

  // Shared by both threads.
  mutable std::mutex mutex_;
  std::condition_variable work_;
  std::deque<std::pair<Command, Kind>> queue_;
  std::uint64_t commands_posted_ = 0;
  std::atomic<Clock::rep> step_began_ = 0;  // 0: between steps
  std::atomic<double> hold_ = std::numeric_limits<double>::infinity();
  std::atomic<int> changes_waiting_ = 0;
  std::atomic<int> ends_waiting_ = 0;
  std::atomic<bool> is_closing_ = false;
  bool has_news_ = false;
  Snapshot middle_;  // passed from one thread to the other

  Snapshot back_;   // owned by the simulation's thread
  Snapshot front_;  // owned by the window's thread
  std::thread thread_;
};

}  // namespace pliant_viewer
