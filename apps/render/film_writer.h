#pragma once
// Frames to a film, which ffmpeg makes, or to numbered pictures.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "render/image.h"

namespace pliant_render {

enum class FilmFormat { png, mp4, webm, gif };

/// By the ending of the name, in upper or lower case; none for an unknown one.
std::optional<FilmFormat> film_format_of(const std::filesystem::path& path);

struct FilmOptions {
  std::filesystem::path out;  ///< its ending is the format
  int width = 0;              ///< [pixels] of every frame
  int height = 0;
  int fps = 30;         ///< frames a second, at least 1; GIF shows at most 50
  int frame_count = 1;  ///< PNG: 1 is one file of that name, more are numbered; films may have more or fewer frames
};

/// Takes frames one by one, and needs no memory for those that it has taken. A film has its name only after close(); an
/// MP4 of odd width or height gets one black column or row more. Without ffmpeg in PATH a film becomes numbered
/// pictures beside it, "film-0000.png" and so on. A writer that goes without close(), or has failed, leaves whole
/// pictures and nothing of a film.
class FilmWriter {
 public:
  /// Starts ffmpeg if the format needs it.
  /// @throws pliant::Error (input) for a name or number that makes no film, (output) if no film can be written there.
  explicit FilmWriter(FilmOptions options);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  /// @throws pliant::Error (output) if the frame cannot be written, with the last lines that ffmpeg said;
  ///   std::logic_error for a frame of another size, or for a second one where frame_count promised one picture.
  void add(const Image& frame);

  /// To be called once, last.
  /// @returns what was written, for people: "film.mp4", or "film-0000.png to film-0099.png"
  /// @throws pliant::Error (output), as add(); std::logic_error without frames.
  std::string close();

  /// Empty, or a sentence that says that ffmpeg is missing and how the pictures become the film; known from the start.
  const std::string& hint() const { return hint_; }

 private:
  class Ffmpeg;

  std::filesystem::path numbered(int frame) const;

  FilmOptions options_;
  FilmFormat format_;
  std::unique_ptr<Ffmpeg> ffmpeg_;  ///< none for pictures
  std::string hint_;
  int added_ = 0;
  bool is_closed_ = false;
};

}  // namespace pliant_render
