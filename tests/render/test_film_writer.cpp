#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "render/film_writer.h"
#include "tests/mesh/meshes.h"
#include "tests/support/temporary_folder.h"

namespace test_film_writer {

namespace fs = std::filesystem;
using namespace pliant_render;
using namespace pliant_tests;

namespace {

/// PATH is one folder while this lives.
class OnlyPath {
 public:
  explicit OnlyPath(const fs::path& folder) {
    if (const char* old = std::getenv("PATH")) old_ = old;
    setenv("PATH", folder.c_str(), 1);
  }
  ~OnlyPath() {
    if (old_) {
      setenv("PATH", old_->c_str(), 1);
    } else {
      unsetenv("PATH");
    }
  }
  OnlyPath(const OnlyPath&) = delete;
  OnlyPath& operator=(const OnlyPath&) = delete;

 private:
  std::optional<std::string> old_;
};

struct Output {
  int status = 0;  ///< 0 for success
  std::string text;
};

/// What a shell command prints, and how it ends.
Output output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  return {pclose(pipe), output};
}

bool is_installed(const std::string& program) {
  return output_of("command -v " + program).status == 0;
}

/// Whether the test can go on, and if not, a word about it.
bool has_ffmpeg() {
  const bool has = is_installed("ffmpeg") && is_installed("ffprobe");
  if (!has) MESSAGE("skipped: ffmpeg or ffprobe is not installed");
  return has;
}

/// What the chunks of a moving WebP say, which ffprobe cannot read.
struct MovingPicture {
  int width = 0, height = 0;   ///< [pixels]
  int repeats = -1;            ///< 0: for ever
  std::vector<int> durations;  ///< of each frame [ms]
};

MovingPicture read_webp(const fs::path& path) {
  const std::string bytes = TemporaryFolder::read(path);
  const auto number = [&](std::size_t at, std::size_t size) {
    int value = 0;
    for (std::size_t i = size; i-- > 0;) value = 256 * value + static_cast<unsigned char>(bytes.at(at + i));
    return value;
  };
  REQUIRE(bytes.starts_with("RIFF"));
  REQUIRE(bytes.substr(8, 4) == "WEBP");
  CHECK(number(4, 4) + 8 == static_cast<int>(bytes.size()));
  MovingPicture picture;
  for (std::size_t at = 12; at < bytes.size();) {
    const std::string name = bytes.substr(at, 4);
    const std::size_t content = at + 8;
    if (name == "VP8X") picture.width = number(content + 4, 3) + 1;
    if (name == "VP8X") picture.height = number(content + 7, 3) + 1;
    if (name == "ANIM") picture.repeats = number(content + 4, 2);
    if (name == "ANMF") picture.durations.push_back(number(content + 12, 3));
    at = content + static_cast<std::size_t>((number(at + 4, 4) + 1) / 2 * 2);
  }
  return picture;
}

/// "width,height,frames" of the film, counted frame by frame.
std::string shape_of(const fs::path& film) {
  if (film_format_of(film) == FilmFormat::webp) {
    const MovingPicture picture = read_webp(film);
    return fmt::format("{},{},{}", picture.width, picture.height, picture.durations.size());
  }
  const Output probe = output_of(
      "ffprobe -v error -select_streams v:0 -count_frames -show_entries stream=width,height,nb_read_frames -of csv=p=0 "
      "'" +
      film.string() + "'");
  CHECK(probe.status == 0);
  return probe.text.substr(0, probe.text.find('\n'));
}

Image plain(int width, int height, std::vector<std::uint8_t> color) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) image.pixels.insert(image.pixels.end(), color.begin(), color.end());
  return image;
}

/// A bright bar that moves.
Image frame_of(int width, int height, int number) {
  Image image = plain(width, height, {30, 60, 90});
  for (int y = 0; y < height; ++y) {
    const auto first = static_cast<std::size_t>(3 * (y * width + number % width));
    image.pixels[first] = 250;
    image.pixels[first + 1] = 220;
  }
  return image;
}

FilmOptions film(const fs::path& out, int width, int height, int frames = 12, int fps = 30) {
  return {.out = out, .width = width, .height = height, .fps = fps, .frame_count = frames};
}

std::string write_film(const FilmOptions& options) {
  FilmWriter writer(options);
  for (int i = 0; i < options.frame_count; ++i) writer.add(frame_of(options.width, options.height, i));
  return writer.close();
}

/// A program named ffmpeg of that shell text, in a folder of its own.
void write_fake_ffmpeg(const TemporaryFolder& folder, const std::string& text) {
  const fs::path program = folder.write("ffmpeg", "#!/bin/sh\n" + text + "\n");
  fs::permissions(program, fs::perms::owner_all);
}

}  // namespace

TEST_CASE("the format is in the ending of the name") {
  CHECK(film_format_of("a.png") == FilmFormat::png);
  CHECK(film_format_of("folder.gif/A.MP4") == FilmFormat::mp4);
  CHECK(film_format_of("a.b.WebM") == FilmFormat::webm);
  CHECK(film_format_of("a.WEBP") == FilmFormat::webp);
  CHECK(film_format_of("a.gif") == FilmFormat::gif);
  for (const char* name : {"a", "a.avi", "png", ".png", "a.mp4.tmp", ""}) CHECK(!film_format_of(name));
}

TEST_CASE("each film has the size and the frames that were added, and its name only at the end") {
  if (!has_ffmpeg()) return;
  for (const char* name : {"a.mp4", "a.webm", "a.webp", "a.gif", "A.MP4"}) {
    CAPTURE(name);
    const TemporaryFolder folder;
    const fs::path path = folder.write(name, "old");
    FilmWriter writer(film(path, 64, 48));
    CHECK(writer.hint().empty());
    for (int i = 0; i < 12; ++i) {
      writer.add(frame_of(64, 48, i));
      CHECK(TemporaryFolder::read(path) == "old");
    }
    CHECK(writer.close() == path.string());
    CHECK(shape_of(path) == "64,48,12");
    CHECK(folder.file_count() == 1);
    CHECK_THROWS_AS(writer.add(frame_of(64, 48, 0)), std::logic_error);
    CHECK_THROWS_AS(writer.close(), std::logic_error);
  }
}

TEST_CASE("odd sizes become even ones in MP4 only") {
  if (!has_ffmpeg()) return;
  const TemporaryFolder folder;
  for (const auto& film_and_shape : {std::pair("a.mp4", "34,22,3"), std::pair("a.webm", "33,21,3"),
                                     std::pair("a.webp", "33,21,3"), std::pair("a.gif", "33,21,3")}) {
    const fs::path path = folder.path() / film_and_shape.first;
    write_film(film(path, 33, 21, 3));
    CHECK(shape_of(path) == film_and_shape.second);
  }
  write_film(film(folder.path() / "one.mp4", 1, 1, 1));
  CHECK(shape_of(folder.path() / "one.mp4") == "2,2,1");
}

TEST_CASE("a film lasts as long as its frames, and GIF is shown at most at 50 a second") {
  if (!has_ffmpeg()) return;
  const TemporaryFolder folder;
  write_film(film(folder.path() / "a.mp4", 32, 32, 50, 25));
  const Output seconds =
      output_of("ffprobe -v error -show_entries format=duration -of csv=p=0 " + (folder.path() / "a.mp4").string());
  REQUIRE(seconds.status == 0);
  CHECK(std::stod(seconds.text) == doctest::Approx(2));
  write_film(film(folder.path() / "a.gif", 32, 32, 100, 100));
  CHECK(shape_of(folder.path() / "a.gif") == "32,32,50");
}

TEST_CASE("a WebP runs for ever, as fast as its frames, at most at 50 a second") {
  if (!has_ffmpeg()) return;
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.webp";
  write_film(film(path, 32, 32, 50, 25));
  CHECK(read_webp(path).repeats == 0);
  CHECK(read_webp(path).durations == std::vector<int>(50, 40));
  write_film(film(path, 32, 32, 100, 100));
  CHECK(read_webp(path).durations == std::vector<int>(50, 20));
}

TEST_CASE("an ffmpeg without the encoder is told, and what else can be done") {
  const TemporaryFolder programs;
  const TemporaryFolder folder;
  write_fake_ffmpeg(programs, "echo \"Unknown encoder 'libwebp'\" >&2; exit 1");
  const OnlyPath only(programs.path());
  const std::string message =
      error_of([&] { write_film(film(folder.path() / "a.webp", 256, 256)); }, pliant::ErrorKind::output);
  CHECK(contains(message, "a.webp: cannot be written: ffmpeg failed, "));
  CHECK(contains(message, "Unknown encoder 'libwebp'; fix that, or write .png pictures"));
  CHECK(folder.file_count() == 0);
}

TEST_CASE("colors come back from films as they went in") {
  if (!has_ffmpeg()) return;
  const TemporaryFolder folder;
  // Orange differs by 15 between the matrices of standard and high definition.
  const std::vector<std::uint8_t> color = {230, 110, 40};
  for (const char* name : {"a.mp4", "a.webm", "a.webp", "a.gif"}) {
    CAPTURE(name);
    const fs::path path = folder.path() / name;
    const bool is_webp = film_format_of(path) == FilmFormat::webp;
    // One frame of a WebP is a picture, which ffmpeg can read.
    FilmWriter writer(film(path, 64, 64, is_webp ? 1 : 2));
    for (int i = 0; i < (is_webp ? 1 : 2); ++i) writer.add(plain(64, 64, color));
    writer.close();
    const bool has_matrix = !is_webp && film_format_of(path) != FilmFormat::gif;
    const Output pixels =
        output_of(fmt::format("ffmpeg -v error -i {} -frames:v 1 -vf {}format=rgb24 -f rawvideo -", path.string(),
                              has_matrix ? "scale=in_color_matrix=bt709:in_range=tv," : ""));
    CHECK(pixels.status == 0);
    REQUIRE(pixels.text.size() == 64 * 64 * 3);
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(std::abs(static_cast<unsigned char>(pixels.text[3 * (32 * 64 + 32) + c]) - color[c]) <= 3);
    }
    if (!has_matrix) continue;
    const Output tags =
        output_of("ffprobe -v error -show_entries stream=pix_fmt,color_space,color_range -of csv=p=0 " + path.string());
    CHECK(contains(tags.text, "yuv420p,tv,bt709"));
  }
}

TEST_CASE("an MP4 begins with its index, so that it plays while it loads") {
  if (!has_ffmpeg()) return;
  const TemporaryFolder folder;
  write_film(film(folder.path() / "a.mp4", 64, 48));
  const std::string bytes = TemporaryFolder::read(folder.path() / "a.mp4");
  REQUIRE(contains(bytes, "mdat"));
  CHECK(bytes.find("moov") < bytes.find("mdat"));
}

TEST_CASE("names that look like options, protocols or patterns are names") {
  if (!has_ffmpeg()) return;
  const TemporaryFolder folder;
  for (const char* name : {"http:a.mp4", "50% of $HOME 'a'.gif", "a%03d.webm"}) {
    CAPTURE(name);
    write_film(film(folder.path() / name, 16, 16, 2));
    CHECK(fs::file_size(folder.path() / name) > 20);
  }
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  write_film(film("-y.mp4", 16, 16, 2));
  CHECK(fs::file_size("-y.mp4") > 20);
  fs::current_path(before);
  CHECK(folder.file_count() == 4);
}

TEST_CASE("one picture has its name, more have numbers") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.png";
  SUBCASE("one") {
    FilmWriter writer(film(path, 5, 3, 1));
    writer.add(frame_of(5, 3, 0));
    CHECK_THROWS_AS(writer.add(frame_of(5, 3, 1)), std::logic_error);
    CHECK(writer.close() == path.string());
    CHECK(writer.hint().empty());
    CHECK(fs::exists(path));
    CHECK(folder.file_count() == 1);
  }
  SUBCASE("several") {
    const std::string told = write_film(film(path, 5, 3, 3));
    CHECK(told == fmt::format("{0}/a-0000.png to {0}/a-0002.png", folder.path().string()));
    for (const char* name : {"a-0000.png", "a-0001.png", "a-0002.png"}) CHECK(fs::exists(folder.path() / name));
    CHECK(folder.file_count() == 3);
  }
  SUBCASE("so many that four digits do not do") {
    FilmWriter writer(film(path, 5, 3, 10001));
    writer.add(frame_of(5, 3, 0));
    CHECK(writer.close() == (folder.path() / "a-00000.png").string());
  }
}

TEST_CASE("without ffmpeg a film becomes numbered pictures, and a hint says how to make it") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "it's 5%.mp4";
  std::string hint;
  {
    const TemporaryFolder empty;
    const OnlyPath only(empty.path());
    FilmWriter writer(film(path, 33, 21, 3));
    hint = writer.hint();
    for (int i = 0; i < 3; ++i) writer.add(frame_of(33, 21, i));
    const std::string stem = (folder.path() / "it's 5%").string();
    CHECK(writer.close() == fmt::format("{0}-0000.png to {0}-0002.png", stem));
    CHECK(folder.file_count() == 3);
  }
  CHECK(contains(hint, "ffmpeg is not in PATH"));
  CHECK(contains(hint, "install"));
  const std::size_t command = hint.find("ffmpeg -framerate 30 -i ");
  REQUIRE(command != std::string::npos);
  if (!has_ffmpeg()) return;
  CHECK(output_of(hint.substr(command) + " 2>&1").status == 0);
  REQUIRE(fs::exists(path));
  fs::rename(path, folder.path() / "a.mp4");
  CHECK(shape_of(folder.path() / "a.mp4") == "34,22,3");
}

TEST_CASE("what ffmpeg says when it fails is in the error, and no file remains") {
  const TemporaryFolder programs;
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.mp4";
  std::string message;
  const auto message_with = [&](const std::string& script, int frames) {
    write_fake_ffmpeg(programs, script);
    const OnlyPath only(programs.path());
    return error_of([&] { write_film(film(path, 640, 480, frames)); }, pliant::ErrorKind::output);
  };
  SUBCASE("after it took all frames") {
    message = message_with("/bin/cat > /dev/null; echo first >&2; echo >&2; echo Unknown encoder >&2; exit 1", 2);
    CHECK(contains(message, "ffmpeg failed, exit code 1: first / Unknown encoder; fix that"));
  }
  SUBCASE("at once, while frames are being written") {
    message = message_with("echo Unknown encoder >&2; exit 3", 100);
    CHECK(contains(message, "it took no more frames, exit code 3: Unknown encoder;"));
  }
  SUBCASE("in the middle of a frame") {
    message = message_with("/usr/bin/head -c 1000000 > /dev/null; echo Unknown encoder >&2; exit 4", 100);
    CHECK(contains(message, "it took no more frames, exit code 4: Unknown encoder;"));
  }
  SUBCASE("by a signal") {
    message = message_with("kill -9 $$", 100);
    CHECK(contains(message, "it took no more frames, ended by signal 9 (Killed);"));
  }
  SUBCASE("with success, but without a film") {
    message = message_with("/bin/cat > /dev/null", 2);
    CHECK(contains(message, "ffmpeg failed, it wrote nothing;"));
  }
  SUBCASE("after more words than a pipe holds") {
    message = message_with("/usr/bin/yes 2> /dev/null | /usr/bin/head -c 1000000 >&2; echo End >&2; exit 1", 100);
    CHECK(contains(message, "y / y / End;"));
  }
  CHECK(message.starts_with(path.string() + ": cannot be written: "));
  CHECK(folder.file_count() == 0);
}

TEST_CASE("a writer that failed goes on failing") {
  const TemporaryFolder programs;
  const TemporaryFolder folder;
  write_fake_ffmpeg(programs, "echo Unknown encoder >&2; exit 1");
  const OnlyPath only(programs.path());
  {
    FilmWriter writer(film(folder.path() / "a.mp4", 64, 48));
    const auto add_many = [&] {
      for (int i = 0; i < 1000; ++i) writer.add(frame_of(64, 48, i));
    };
    for (int i = 0; i < 2; ++i) CHECK(contains(error_of(add_many, pliant::ErrorKind::output), "Unknown encoder"));
    CHECK_THROWS(writer.close());
  }
  CHECK(folder.file_count() == 0);
}

TEST_CASE("a writer that goes without close leaves nothing, and no process") {
  const TemporaryFolder programs;
  const TemporaryFolder folder;
  write_fake_ffmpeg(programs, "exec /bin/sleep 1000");
  const OnlyPath only(programs.path());
  {
    FilmWriter writer(film(folder.path() / "a.webm", 8, 8));
    writer.add(frame_of(8, 8, 0));
    CHECK(folder.file_count() == 0);  // nor does it before, should this process be killed
  }
  CHECK(folder.file_count() == 0);
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
}

TEST_CASE("a place where no film can be is told before the first frame") {
  const TemporaryFolder folder;
  const auto message_for = [](const fs::path& path, pliant::ErrorKind kind) {
    return error_of([&] { FilmWriter(film(path, 8, 8)); }, kind);
  };
  const fs::path absent = folder.path() / "absent" / "a.mp4";
  CHECK(contains(message_for(absent, pliant::ErrorKind::output),
                 absent.string() + ": cannot be written: No such file or directory;"));
  const fs::path taken = folder.path() / "b.gif";
  fs::create_directory(taken);
  CHECK(contains(message_for(taken, pliant::ErrorKind::output), "Is a directory"));
  CHECK(contains(message_for("a.avi", pliant::ErrorKind::input), "end it with .png, .mp4, .webm, .webp or .gif"));
  const auto message_of = [](const FilmOptions& options) { return error_of([&] { FilmWriter{options}; }); };
  CHECK(contains(message_of(film("a.gif", 0, 8)), "a size of 0 x 8 pixels"));
  CHECK(contains(message_of(film("a.gif", 8, 8, 1, 0)), "1 frames, 0 a second"));
  CHECK(folder.file_count() == 1);
}

TEST_CASE("pictures that cannot be written are an output error") {
  const TemporaryFolder folder;
  const fs::path absent = folder.path() / "absent" / "a.png";
  const auto act = [&] { write_film(film(absent, 8, 8, 3)); };
  CHECK(
      contains(error_of(act, pliant::ErrorKind::output), "a-0000.png: cannot be written: No such file or directory;"));
}

TEST_CASE("a link is followed, and the film has the permissions of any file") {
  if (!has_ffmpeg()) return;
  const TemporaryFolder folder;
  const fs::path target = folder.write("target", "old");
  const fs::perms usual = fs::status(target).permissions();
  fs::create_symlink("target", folder.path() / "a.gif");
  write_film(film(folder.path() / "a.gif", 8, 8, 2));
  CHECK(fs::is_symlink(folder.path() / "a.gif"));
  CHECK(TemporaryFolder::read(target).starts_with("GIF8"));
  CHECK(fs::status(target).permissions() == usual);
}

TEST_CASE("a full disk is an error, and leaves the old film and nothing else") {
  if (!has_ffmpeg()) return;
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.webm", "a.webp", "a.gif"}) {
    const fs::path path = folder.write(name, "old");
    rlimit old{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &old) == 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{500, old.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string message = error_of([&] { write_film(film(path, 64, 48)); }, pliant::ErrorKind::output);
    setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, old_handler);
    CHECK(contains(message, "File too large"));
    CHECK(TemporaryFolder::read(path) == "old");
  }
  CHECK(folder.file_count() == 4);
}

TEST_CASE("frames of another size, and no frames, are the program's mistakes") {
  const TemporaryFolder folder;
  FilmWriter writer(film(folder.path() / "a.png", 8, 8));
  CHECK_THROWS_AS(writer.add(frame_of(8, 7, 0)), std::logic_error);
  CHECK_THROWS_AS(writer.close(), std::logic_error);
  CHECK(folder.file_count() == 0);
}

}  // namespace test_film_writer
