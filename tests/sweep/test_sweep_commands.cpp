// The words of command lines, and what is noted of how they ended. tests/cli/test_sweep_list.py runs them.
#include <csignal>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "sweep/sweep_commands.h"
#include "tests/support/temporary_folder.h"

namespace test_sweep_commands {

namespace {

using namespace pliant_sweep;
using pliant_tests::TemporaryFolder;

TEST_CASE("words of a shell") {
  CHECK(shell_word("out/runs/0001") == "out/runs/0001");
  CHECK(shell_word("--set=steps=5") == "--set=steps=5");
  CHECK(shell_word("A=5") == "'A=5'");
  CHECK(shell_word("") == "''");
  CHECK(shell_word("~") == "'~'");
  CHECK(shell_word("$x `y` \"z\"") == "'$x `y` \"z\"'");
  CHECK(shell_word("it's") == R"('it'\''s')");
  CHECK_THROWS_WITH_AS(shell_word("a\nb"), doctest::Contains("line break"), pliant::Error);
}

TEST_CASE("how a run ended is noted in its log") {
  const TemporaryFolder folder;
  const auto log = folder.write("log", "pliant: error: no\n");
  CHECK(noted_exit_code(log) == 0);
  CHECK(result_of_noted_end(folder.path(), log).outcome == RunOutcome::waiting);
  note_end(log, {0, 0});
  CHECK(noted_exit_code(log) == 0);
  note_end(log, {4, 0});
  CHECK(TemporaryFolder::read(log) == "pliant: error: no\nexit code 4\n");
  const RunResult result = result_of_noted_end(folder.path(), log);
  CHECK(result.outcome == RunOutcome::failed);
  CHECK(result.exit_code == 4);
  CHECK(result.message == "no");
  note_end(log, {0, SIGKILL});
  CHECK(result_of_noted_end(folder.path(), log).message.starts_with("ended by signal 9"));
  note_end(log, {0, SIGTERM});
  CHECK(result_of_noted_end(folder.path(), log).outcome == RunOutcome::waiting);
  for (const char* text : {"", "exit code", "exit code ", "exit code x", "exit code 4 ", "exit code 0", "exit code -4",
                           "exit code 256", "exit code 99999999999", "an exit code 4"}) {
    CAPTURE(text);
    CHECK(noted_exit_code(folder.write("log", text)) == 0);
  }
  CHECK(noted_exit_code(folder.path() / "none") == 0);
}

}  // namespace

}  // namespace test_sweep_commands
