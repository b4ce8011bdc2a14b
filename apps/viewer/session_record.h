#pragma once
// A session in a file: the scene as it was opened, and what was done to it when, from which all of it comes again.
//
//     write_session_record("silk.session", session.record("silk.session", view));
//     const SessionRecord record = read_session_record("silk.session");
//     Session again(scene_maker_of(record, "silk.session"));
//     again.replay(record);
//     while (again.is_replaying()) again.step();
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/scene/scene.h"
#include "viewer/action.h"

namespace pliant_viewer {

struct SessionRecord {
  std::string scene;                    ///< its name
  std::string start;                    ///< a checkpoint of the scene as it was opened
  std::int64_t steps = 0;               ///< taken in all
  std::vector<TimedAction> actions;     ///< in turn
  std::vector<StepChecksum> checksums;  ///< of some steps, ascending, the last one among them

  /// Of the last restart, before which nothing is to be shown; 0: there was none.
  std::int64_t last_start() const;
};

/// What came of doing it again.
struct ReplayReport {
  std::int64_t steps = 0;                         ///< so far
  std::int64_t wanted_steps = 0;                  ///< that the session had
  std::optional<std::int64_t> differs_from = {};  ///< the first step that has other bits than it had; none: the same
  bool has_ended = false;                         ///< all was done again; false: it goes on, or was broken off
};

/// The scene as a session opened it.
struct OpenedScene {
  pliant::SceneSource source;
  std::vector<pliant::SceneFile> files;
  std::string checkpoint;    ///< of where it was then; empty: at its start
  bool was_changed = false;  ///< its files, while it was open
};

/// Whether a scene was read from the same texts and files.
bool is_made_from(const OpenedScene& opened, const pliant::Scene& scene);

/// A record that is done again, and how far it is.
struct Replay {
  SessionRecord record;
  std::size_t next_action = 0, next_checksum = 0;
};

/// As the file has it: "move_pin".
std::string_view action_name(const Action& action);

/// @throws pliant::Error (output): the file cannot be written
void write_session_record(const std::filesystem::path& file, const SessionRecord& record);

/// @throws pliant::Error (input), naming the file and the place in it: not such a file, cut, or with an action that is
/// none. What is wrong with the checkpoint in it shows when that is read.
SessionRecord read_session_record(const std::filesystem::path& file);

/// Makes the scene of a record as it was opened; from the second call on as it starts, as MakeScene does.
/// `file`: of the record. @throws pliant::Error (input) as pliant::parse_checkpoint does
std::function<pliant::Scene()> scene_maker_of(const SessionRecord& record, const std::filesystem::path& file);

}  // namespace pliant_viewer
