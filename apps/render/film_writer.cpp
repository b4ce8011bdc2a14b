#include "render/film_writer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"

namespace pliant_render {

namespace fs = std::filesystem;

namespace {

using Arguments = std::vector<std::string>;

/// GIF counts in hundredths of a second, and browsers show what is shorter than two of them ten times too long.
constexpr int max_gif_fps = 50;

[[noreturn]] void fail_output(const fs::path& path, const std::string& why) {
  throw pliant::Error(pliant::ErrorKind::output,
                      fmt::format("{}: cannot be written: {}", pliant::printable_place(path.string()), why));
}

std::string reason(int error_number) {
  return std::generic_category().message(error_number);
}

std::string numbered_name(const std::string& stem, const std::string& number) {
  return fmt::format("{}-{}.png", stem, number);
}

/// As many as the last number needs, at least four.
int digits_for(int frame_count) {
  return std::max(4, static_cast<int>(std::to_string(std::max(frame_count - 1, 0)).size()));
}

// ---- what ffmpeg is told

/// What makes the format of RGB frames, without the name of the file.
Arguments encoding_arguments(FilmFormat format, int fps) {
  // Without the matrix in the filter the film would be made with that of standard definition, whatever its tags say.
  const std::string yuv = "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";
  Arguments tags = {"-pix_fmt", "yuv420p",    "-colorspace", "bt709",        "-color_primaries",
                    "bt709",    "-color_trc", "bt709",       "-color_range", "tv"};
  Arguments arguments;
  switch (format) {
    case FilmFormat::png:
      throw std::logic_error("ffmpeg is not used for pictures");
    case FilmFormat::mp4:
      arguments = {"-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2," + yuv, "-c:v", "libx264", "-crf", "18", "-movflags",
                   "+faststart"};
      break;
    case FilmFormat::webm:
      arguments = {"-vf", yuv, "-c:v", "libvpx-vp9", "-crf", "30", "-b:v", "0", "-row-mt", "1"};
      break;
    case FilmFormat::gif: {
      const std::string slower = fps > max_gif_fps ? fmt::format("fps={},", max_gif_fps) : "";
      tags.clear();
      arguments = {"-filter_complex", "[0:v]" + slower + "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-loop", "0"};
      break;
    }
  }
  arguments.insert(arguments.end(), tags.begin(), tags.end());
  return arguments;
}

const char* muxer_name(FilmFormat format) {
  return format == FilmFormat::mp4 ? "mp4" : format == FilmFormat::webm ? "webm" : "gif";
}

Arguments pipe_command(const FilmOptions& options, FilmFormat format, const fs::path& out) {
  Arguments command = {"ffmpeg",
                       "-hide_banner",
                       "-loglevel",
                       "error",
                       "-xerror",
                       "-y",
                       "-f",
                       "rawvideo",
                       "-pixel_format",
                       "rgb24",
                       "-video_size",
                       fmt::format("{}x{}", options.width, options.height),
                       "-framerate",
                       std::to_string(options.fps),
                       "-i",
                       "pipe:0"};
  const Arguments encoding = encoding_arguments(format, options.fps);
  command.insert(command.end(), encoding.begin(), encoding.end());
  // With "file:" a name is never taken for an option or a protocol.
  command.insert(command.end(), {"-f", muxer_name(format), "file:" + out.string()});
  return command;
}

// ---- what people are told

std::string quoted_for_shell(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("-_./:,+=%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// The name as ffmpeg takes it on a command line.
std::string name_for_ffmpeg(const std::string& path) {
  return path.starts_with('-') || path.find(':') != std::string::npos ? "file:" + path : path;
}

/// The command that makes the film of its numbered pictures.
std::string film_command(const FilmOptions& options, FilmFormat format) {
  std::string stem;
  for (const char c : (options.out.parent_path() / options.out.stem()).string())
    stem += c == '%' ? "%%" : std::string(1, c);
  const std::string pictures = numbered_name(stem, fmt::format("%0{}d", digits_for(options.frame_count)));
  Arguments command = {"ffmpeg", "-framerate", std::to_string(options.fps), "-i", name_for_ffmpeg(pictures)};
  const Arguments encoding = encoding_arguments(format, options.fps);
  command.insert(command.end(), encoding.begin(), encoding.end());
  command.push_back(name_for_ffmpeg(options.out.string()));
  std::string line;
  for (const std::string& word : command) {
    if (!line.empty()) line += ' ';
    line += quoted_for_shell(word);
  }
  return line;
}

// ---- system

class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  void reset(int number) {
    close();
    number_ = number;
  }

 private:
  int number_;
};

/// A file of its own name beside the target, gone with this object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : name_(target.string() + ".tmp-XXXXXX") {
    const Descriptor file(mkostemp(name_.data(), O_CLOEXEC));
    if (file.number() < 0) fail_output(target, reason(errno) + "; choose another place or make room");
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(name_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  fs::path path() const { return name_; }

 private:
  std::string name_;
};

/// The last few lines, in one.
std::string last_lines(const std::string& text) {
  constexpr int max_lines = 3;
  std::string result;
  std::size_t end = text.size();
  for (int lines = 0; lines < max_lines && end > 0;) {
    const std::size_t newline = text.rfind('\n', end - 1);
    const std::size_t begin = newline == std::string::npos ? 0 : newline + 1;
    if (begin < end) {
      result = text.substr(begin, end - begin) + (result.empty() ? "" : " / ") + result;
      ++lines;
    }
    end = newline == std::string::npos ? 0 : newline;
  }
  return pliant::printable_place(result);
}

/// Sets up what a child process inherits.
class SpawnSettings {
 public:
  SpawnSettings() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  /// @returns the error number, 0 if the program runs
  int start(Arguments command, int input, int messages, pid_t& process) {
    std::vector<char*> words;
    for (std::string& word : command) words.push_back(word.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, messages, STDERR_FILENO);
    // Ctrl-C at the terminal is for this program, which may still want to end the film properly.
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes_, 0);
    return posix_spawnp(&process, words[0], &actions_, &attributes_, words.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

// ---- ffmpeg at work

/// One process that makes one film, under a temporary name.
class FilmWriter::Ffmpeg {
 public:
  Ffmpeg(const FilmOptions& options, FilmFormat format) : out_(options.out), film_(options.out) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail_start(errno);
    frames_.reset(ends[0]);
    const Descriptor input(ends[1]);
    messages_.reset(memfd_create("ffmpeg-messages", MFD_CLOEXEC));
    if (messages_.number() < 0) fail_start(errno);
    const int error = SpawnSettings().start(pipe_command(options, format, film_.path()), input.number(),
                                            messages_.number(), process_);
    if (error == 0) return;
    process_ = -1;
    // A folder of PATH that cannot be read counts as one without ffmpeg.
    if (error != ENOENT && error != ENOTDIR && error != EACCES) fail_start(error);
  }
  ~Ffmpeg() {
    if (process_ < 0) return;
    kill(process_, SIGKILL);
    wait();
  }
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;

  bool is_running() const { return process_ >= 0; }

  void write(const std::vector<std::uint8_t>& bytes) {
    // A socket rather than a pipe, since only send() can be told to raise no SIGPIPE.
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t part = send(frames_.number(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (part >= 0) {
        sent += static_cast<std::size_t>(part);
      } else if (errno != EINTR) {
        frames_.close();
        const int status = wait();
        fail(fmt::format("it took no more frames, {}", told(status)));
      }
    }
  }

  /// Waits for the film to be complete and gives it its name.
  void finish() {
    frames_.close();
    const int status = wait();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail(told(status));
    std::error_code error;
    const std::uintmax_t size = fs::file_size(film_.path(), error);
    if (error || size == 0) fail("it wrote nothing");
    copy_to_target();
  }

 private:
  /// A copy rather than a rename: the atomic file follows links, refuses devices and has the usual permissions.
  void copy_to_target() {
    pliant::AtomicFile target(out_);
    std::ifstream film(film_.path(), std::ios::binary);
    std::vector<char> part(std::size_t{1} << 20U);
    while (film) {
      film.read(part.data(), static_cast<std::streamsize>(part.size()));
      target.write({part.data(), static_cast<std::size_t>(film.gcount())});
    }
    if (!film.eof()) fail_output(out_, "the film that ffmpeg made cannot be read; make it once more");
    target.commit();
  }

  /// @returns the status as waitpid() has it
  int wait() {
    int status = -1;
    if (process_ < 0) return status;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
  }

  static std::string told(int status) {
    return WIFEXITED(status)     ? fmt::format("exit code {}", WEXITSTATUS(status))
           : WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                                 : std::string("ended in an unknown way");
  }

  std::string messages() const {
    constexpr off_t max_size = 4096;
    const off_t size = std::max<off_t>(lseek(messages_.number(), 0, SEEK_END), 0);
    std::string text(static_cast<std::size_t>(std::min(size, max_size)), '\0');
    const ssize_t got = pread(messages_.number(), text.data(), text.size(), size - static_cast<off_t>(text.size()));
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    return text;
  }

  [[noreturn]] void fail(const std::string& what) const {
    const std::string lines = last_lines(messages());
    fail_output(out_, fmt::format("ffmpeg failed, {}{}{}; mend that, or write .png pictures", what,
                                  lines.empty() ? "" : ": ", lines));
  }
  [[noreturn]] void fail_start(int error) const {
    fail_output(out_, fmt::format("ffmpeg cannot be started: {}; mend that, or write .png pictures", reason(error)));
  }

  fs::path out_;
  TemporaryFile film_;
  Descriptor frames_;
  Descriptor messages_;  ///< a file in memory, so that ffmpeg never waits for a reader
  pid_t process_ = -1;
};

// ---- the writer

std::optional<FilmFormat> film_format_of(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (ending == ".png") return FilmFormat::png;
  if (ending == ".mp4") return FilmFormat::mp4;
  if (ending == ".webm") return FilmFormat::webm;
  if (ending == ".gif") return FilmFormat::gif;
  return std::nullopt;
}

namespace {

FilmFormat checked_format(const FilmOptions& options) {
  const std::string name = pliant::printable_place(options.out.string());
  const std::optional<FilmFormat> format = film_format_of(options.out);
  if (!format) pliant::fail_input(name + ": not the name of a picture or film; end it with .png, .mp4, .webm or .gif");
  if (options.width < 1 || options.height < 1) {
    pliant::fail_input(
        fmt::format("{}: a size of {} x {} pixels; give at least 1 x 1", name, options.width, options.height));
  }
  if (options.fps < 1 || options.frame_count < 1) {
    pliant::fail_input(
        fmt::format("{}: {} frames, {} a second; give at least 1 of both", name, options.frame_count, options.fps));
  }
  return *format;
}

}  // namespace

FilmWriter::FilmWriter(FilmOptions options) : options_(std::move(options)), format_(checked_format(options_)) {
  if (format_ == FilmFormat::png) return;
  // Says now, rather than after all the frames, that no file can be made there.
  { const pliant::AtomicFile probe(options_.out); }
  ffmpeg_ = std::make_unique<Ffmpeg>(options_, format_);
  if (ffmpeg_->is_running()) return;
  ffmpeg_.reset();
  hint_ = fmt::format(
      "ffmpeg is not in PATH, so {} becomes numbered pictures; install it (apt-get install ffmpeg) and make the film "
      "with: {}",
      options_.out.filename().string(), film_command(options_, format_));
}

FilmWriter::~FilmWriter() = default;

fs::path FilmWriter::numbered(int frame) const {
  const std::string number = fmt::format("{:0{}}", frame, digits_for(options_.frame_count));
  return options_.out.parent_path() / numbered_name(options_.out.stem().string(), number);
}

void FilmWriter::add(const Image& frame) {
  if (is_closed_) throw std::logic_error("FilmWriter: a frame after the end");
  if (!is_whole(frame) || frame.width != options_.width || frame.height != options_.height) {
    throw std::logic_error("FilmWriter: a frame of another size than was announced");
  }
  const bool is_single = format_ == FilmFormat::png && options_.frame_count == 1;
  if (is_single && added_ > 0) throw std::logic_error("FilmWriter: more frames than the one that was announced");
  if (ffmpeg_) {
    ffmpeg_->write(frame.pixels);
  } else {
    write_png(is_single ? options_.out : numbered(added_), frame);
  }
  ++added_;
}

std::string FilmWriter::close() {
  if (added_ == 0 || is_closed_) throw std::logic_error("FilmWriter: no frames, or closed twice");
  is_closed_ = true;
  if (ffmpeg_) {
    const std::unique_ptr<Ffmpeg> ffmpeg = std::move(ffmpeg_);
    ffmpeg->finish();
    return options_.out.string();
  }
  if (format_ == FilmFormat::png && options_.frame_count == 1) return options_.out.string();
  if (added_ == 1) return numbered(0).string();
  return fmt::format("{} to {}", numbered(0).string(), numbered(added_ - 1).string());
}

}  // namespace pliant_render
