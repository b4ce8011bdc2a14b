#include "render/film_writer.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"
#include "system/child_process.h"
#include "system/nameless_file.h"

namespace pliant_render {

namespace fs = std::filesystem;

namespace {

using Arguments = std::vector<std::string>;

/// Browsers show pictures of a GIF or WebP that are to last a hundredth of a second or less ten times as long; GIF
/// counts in whole hundredths.
constexpr int max_picture_fps = 50;

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
    case FilmFormat::webp:
      // Each frame whole: libwebp_anim keeps what has changed little, which leaves traces, and is hardly smaller. The
      // encoder makes of RGB the one kind of YUV that the format has.
      tags = {"-pix_fmt", "bgra"};
      arguments = {"-vf",      fps > max_picture_fps ? fmt::format("fps={}", max_picture_fps) : "null",
                   "-c:v",     "libwebp",
                   "-quality", "75",
                   "-loop",    "0"};
      break;
    case FilmFormat::gif: {
      const std::string slower = fps > max_picture_fps ? fmt::format("fps={},", max_picture_fps) : "";
      tags.clear();
      arguments = {"-filter_complex", "[0:v]" + slower + "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-loop", "0"};
      break;
    }
  }
  arguments.insert(arguments.end(), tags.begin(), tags.end());
  return arguments;
}

const char* muxer_name(FilmFormat format) {
  switch (format) {
    case FilmFormat::png:
      break;
    case FilmFormat::mp4:
      return "mp4";
    case FilmFormat::webm:
      return "webm";
    case FilmFormat::webp:
      return "webp";
    case FilmFormat::gif:
      return "gif";
  }
  throw std::logic_error("ffmpeg is not used for pictures");
}

/// Without the program's own name.
Arguments pipe_arguments(const FilmOptions& options, FilmFormat format) {
  Arguments command = {"-hide_banner",
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
  const std::string film = fmt::format("file:/proc/self/fd/{}", pliant_system::child_file_number);
  command.insert(command.end(), {"-f", muxer_name(format), film});
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

/// On the disk of the film that is to be.
pliant_system::NamelessFile make_nameless_file(const fs::path& target) {
  try {
    return pliant_system::NamelessFile(target);
  } catch (const std::system_error& error) {
    fail_output(target, error.code().message() + "; choose another place or make room");
  }
}

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

}  // namespace

// ---- ffmpeg at work

/// One process that makes one film, in a file that has no name yet.
class FilmWriter::Ffmpeg {
 public:
  Ffmpeg(const FilmOptions& options, FilmFormat format) : out_(options.out), film_(make_nameless_file(options.out)) {
    pliant_system::ChildOptions child{"ffmpeg", pipe_arguments(options, format)};
    child.file = film_.number();
    // Ctrl-C at the terminal is for this program, which may still want to end the film properly.
    child.interrupts = pliant_system::Interrupts::parent;
    try {
      process_.emplace(child);
    } catch (const std::system_error& error) {
      // A folder of PATH that cannot be read counts as one without ffmpeg.
      const int number = error.code().value();
      if (number != ENOENT && number != ENOTDIR && number != EACCES) fail_start(number);
    }
  }

  bool is_running() const { return process_.has_value(); }

  void write(const std::vector<std::uint8_t>& bytes) {
    if (process_->feed(bytes)) return;
    process_->end_input();
    fail(fmt::format("it took no more frames, {}", end_text(process_->wait())));
  }

  /// Waits for the film to be complete and gives it its name.
  void finish() {
    process_->end_input();
    const pliant_system::ProcessEnd end = process_->wait();
    if (end.signal != 0 || end.exit_code != 0) fail(end_text(end));
    copy_to_target();
  }

 private:
  /// A copy rather than a rename: the atomic file follows links, refuses devices and has the usual permissions.
  void copy_to_target() {
    std::vector<char> part(std::size_t{1} << 20U);
    std::uint64_t place = read_film(0, part);
    if (place == 0) fail("it wrote nothing");
    pliant::AtomicFile target(out_);
    for (std::size_t size = place; size > 0; size = read_film(place, part), place += size) {
      target.write({part.data(), size});
    }
    target.commit();
  }

  std::size_t read_film(std::uint64_t place, std::vector<char>& part) const {
    try {
      return film_.read(place, part);
    } catch (const std::system_error&) {
      fail_output(out_, "the film that ffmpeg made cannot be read; make it once more");
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    const std::string lines = last_lines(process_->messages());
    fail_output(out_, fmt::format("ffmpeg failed, {}{}{}; fix that, or write .png pictures", what,
                                  lines.empty() ? "" : ": ", lines));
  }
  [[noreturn]] void fail_start(int error) const {
    fail_output(out_, fmt::format("ffmpeg cannot be started: {}; fix that, or write .png pictures", reason(error)));
  }

  fs::path out_;
  pliant_system::NamelessFile film_;
  std::optional<pliant_system::ChildProcess> process_;
};

// ---- the writer

std::optional<FilmFormat> film_format_of(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (ending == ".png") return FilmFormat::png;
  if (ending == ".mp4") return FilmFormat::mp4;
  if (ending == ".webm") return FilmFormat::webm;
  if (ending == ".webp") return FilmFormat::webp;
  if (ending == ".gif") return FilmFormat::gif;
  return std::nullopt;
}

namespace {

/// What a killed program was writing of this film or its pictures.
void remove_leftovers_of(const FilmOptions& options) {
  const std::string film = options.out.filename().string();
  const std::string head = options.out.stem().string() + "-";
  const fs::path folder = options.out.has_parent_path() ? options.out.parent_path() : ".";
  pliant::remove_leftovers(folder, [&](std::string_view name) {
    return name == film || (name.starts_with(head) && name.ends_with(".png"));
  });
}

FilmFormat checked_format(const FilmOptions& options) {
  const std::string name = pliant::printable_place(options.out.string());
  const std::optional<FilmFormat> format = film_format_of(options.out);
  if (!format)
    pliant::fail_input(name + ": not the name of a picture or film; end it with .png, .mp4, .webm, .webp or .gif");
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
  remove_leftovers_of(options_);
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
