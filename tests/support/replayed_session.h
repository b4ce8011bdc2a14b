#pragma once
// A session that does again what another one has recorded.
#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"
#include "viewer/session.h"

namespace pliant_tests {

/// The session that a file of this one makes, run for so many steps.
inline pliant_viewer::Session replayed(const pliant_viewer::Session& session, const TemporaryFolder& folder) {
  const auto file = folder.path() / "some.session";
  pliant_viewer::write_session_record(file, session.record(file, session.scene().view));
  const pliant_viewer::SessionRecord record = pliant_viewer::read_session_record(file);
  pliant_viewer::Session again(pliant_viewer::scene_maker_of(record, file));
  again.replay(record);
  while (again.is_replaying()) again.step();
  CHECK(again.replayed().has_ended);
  CHECK_FALSE(again.replayed().differs_from.has_value());
  return again;
}

}  // namespace pliant_tests
